"""Tables of the pages in doc/ that scripts write: for thesis_*.py, not called."""

import pathlib

DOC = pathlib.Path(__file__).resolve().parent.parent / "doc"


def put_table(page, heading, rows):
    """Prints a table, and writes it into a page in place of the one there that has the same heading."""
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in [heading, *rows]]
    lines.insert(1, "|---" * len(heading) + "|")
    print("\n".join(lines) + "\n", flush=True)
    text = (DOC / page).read_text().split("\n")
    if text.count(lines[0]) != 1:
        raise SystemExit(f"doc/{page} has {text.count(lines[0])} tables with the heading {lines[0]}, where one is needed.")
    begin = text.index(lines[0])
    end = next(number for number in range(begin, len(text)) if not text[number].startswith("|"))
    (DOC / page).write_text("\n".join(text[:begin] + lines + text[end:]))
