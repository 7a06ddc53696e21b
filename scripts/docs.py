#!/usr/bin/python3
"""Makes pages for a browser out of the Markdown pages: scripts/docs.py FOLDER. Called by scripts/docs.sh."""

import os
import pathlib
import re
import sys

import markdown

ROOT = pathlib.Path(__file__).resolve().parent.parent
STYLE = """body{max-width:60rem;margin:2rem auto;padding:0 1rem;font:16px/1.55 system-ui,sans-serif;color:#1d2327;background:#fbfbfa}
table{border-collapse:collapse;display:block;overflow-x:auto}td,th{border:1px solid #dfe3e6;padding:.3rem .6rem;text-align:left;vertical-align:top}
pre{background:#eef1f3;padding:.8rem;overflow-x:auto}code{font-size:.92em}img{max-width:100%;background:#fff}a{color:#1b6f8f}
@media(prefers-color-scheme:dark){body{color:#e6eaec;background:#14191c}pre{background:#1f272b}td,th{border-color:#313b41}a{color:#5cb8d6}}"""


def anchor(text, separator):
    """As on GitHub."""
    return re.sub(r"[^\w -]", "", text.lower()).replace(" ", separator)


def target(link, page, folder):
    """Where a link of a page leads from its place in the folder: to another page there, or to a file of the repository."""
    name, mark, heading = link.partition("#")
    if re.match(r"[a-z]+:", link) or not name:
        return link
    there = (page.parent / name).resolve()
    if there.suffix == ".md":
        there = folder / there.relative_to(ROOT).with_suffix(".html")
    here = folder / page.relative_to(ROOT).parent
    return os.path.relpath(there, here) + mark + heading


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    pages = [*ROOT.glob("*.md"), *(ROOT / "doc").rglob("*.md"), *(ROOT / "benchmarks").rglob("*.md")]
    for page in pages:
        text = page.read_text().replace("\n- ", "\n\n- ")  # Markdown on GitHub needs no empty line before a list
        body = markdown.markdown(text, extensions=["tables", "fenced_code", "toc", "sane_lists"],
                                 extension_configs={"toc": {"slugify": anchor}})
        body = re.sub(r'(href|src)="([^"]+)"', lambda found: f'{found[1]}="{target(found[2], page, folder)}"', body)
        home = os.path.relpath(folder / "index.html", folder / page.relative_to(ROOT).parent)
        file = folder / page.relative_to(ROOT).with_suffix(".html")
        file.parent.mkdir(parents=True, exist_ok=True)
        title = re.search(r"^# (.*)", page.read_text(), re.M)[1]
        file.write_text(f'<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
                        f'<title>{title} - Supple</title><style>{STYLE}</style></head><body><p><a href="{home}">All pages</a></p>{body}</body></html>\n')
    items = [(file, name) for file, name in [
        ("README.html", "What Supple is"), ("doc/guide.html", "Guide"), ("doc/parameters/README.html", "All parameters"),
        ("doc/gallery.html", "Gallery"), ("doc/meshes.html", "Your own mesh"), ("doc/studies.html", "Error against run time"),
        ("doc/validation.html", "Validation"), ("doc/locking.html", "Almost incompressible bodies"), ("doc/skin.html", "Skin"),
        ("doc/report.html", "The report page"), ("CONTRIBUTING.html", "To contribute"), ("code/index.html", "The code")]
             if (folder / file).exists() or file.startswith("code")]
    links = "".join(f'<li><a href="{file}">{name}</a></li>' for file, name in items)
    (folder / "index.html").write_text(f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Supple</title><style>{STYLE}</style>'
                                       f"</head><body><h1>Supple</h1><ul>{links}</ul></body></html>\n")


if __name__ == "__main__":
    main()
