"""Each name of an entry in the sources is one that the program declares: the strings "Section/Entry", also in the middle of a
message, "/Entry" behind a section that is computed, and place("Entry") of studies and identifications."""

import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

STRING = r'"(?:\\.|[^"\\\n])*"'
TOKEN = re.compile(rf"(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<text>{STRING}(?:\s*{STRING})*)|'(?:\\.|[^'\\])+'", re.S)
WHOLE = re.compile(r"[A-Z][a-z]+(?: \d)?/[A-Za-z0-9 -]*")
EXAMPLES = {"Section/Entry"}


def strings(code):
    """(offset, content) of the strings of a source, neighbours joined; no comments and no included files."""
    for found in TOKEN.finditer(code):
        line = code[code.rfind("\n", 0, found.start()) + 1:found.start()]
        if found["text"] and not line.lstrip().startswith("#"):
            yield found.start(), "".join(part[1:-1] for part in re.findall(STRING, found["text"]))


def wrong_names(text, known):
    """Names of entries in a string that nothing declares. A string that is a name alone must be a known one, or the beginning
    of one if more is put behind it; in a message the words after the slash must begin with a known one."""
    if WHOLE.fullmatch(text):
        beginning = text.endswith((" ", "/"))
        if text not in known | EXAMPLES and not (beginning and any(name.startswith(text) for name in known)):
            yield text
    elif re.fullmatch(r"/[A-Z][a-z]+( [a-z]+)*", text):
        if not any(name.endswith(text) for name in known):
            yield text
    else:
        for start in re.finditer(r"\b[A-Z][a-z]+(?: \d)?/[A-Z]", text):
            rest = text[start.start():]
            if not any(re.match(re.escape(name) + r"(?!\w)", rest) for name in known | EXAMPLES):
                yield re.split(r"[^\w /]", rest)[0]


def problems(code, known, section=None):
    """(line, name) of the names in a source that nothing declares.
    @param section of the files that the source is about, whose entries it names alone"""
    for offset, text in strings(code):
        is_place = section and re.search(r"\bplace\($", code[:offset])
        names = [f"{section}/{text}"] if is_place and f"{section}/{text}" not in known else [] if is_place \
            else wrong_names(text, known)
        for name in names:
            yield code.count("\n", 0, offset) + 1, name


status, output, error = runner.run("--print-parameters", "json")
runner.check(status == 0, error)
known = {f"{section}/{entry}" for section, entries in json.loads(output).items() for entry in entries}
runner.check({"Material/Elastic constants", "Motion 2/Of", "Study/Scene"} <= known, "entries are missing in --print-parameters json")

# What this test finds, and what it lets pass.
for code, wrong in (('origin("Material/Constants")', "Material/Constants"), ('origin("Mesh/Layer")', "Mesh/Layer"),
                    ('": set\\n Mesh/Layer "\n  "row to 2"', "Mesh/Layer row to 2"), ('"; see Materials/Density"', "Materials/Density"),
                    ('section + "/Off"', "/Off"), ('"Loads/Body " + name', None), ('// "Material/Constants"', None),
                    ('": set Mesh/Layer "\n  "rows to 2."', None), ('"Time/Steps=1"', None), ('"[N/m^3] A/B"', None)):
    found = [name for _, name in problems(code, known)]
    runner.check(found == ([] if wrong is None else [wrong]), f"{code}: found {found}")
runner.check(list(problems('\nplace("Level")', known, "Study")) == [(2, "Study/Level")], "place() is not looked at")

n_names = 0
wrong = []
for path in sorted([*runner.ROOT.glob("source/**/*.cc"), *runner.ROOT.glob("include/**/*.h")]):
    code = path.read_text()
    n_names += sum(WHOLE.fullmatch(text) is not None and text in known for _, text in strings(code))
    section = {"study": "Study", "identification": "Identification"}.get(path.parent.name)
    wrong += [f"{path.relative_to(runner.ROOT)}:{line}: there is no entry {name}" for line, name in problems(code, known, section)]
runner.check(not wrong, "\n".join(wrong))
runner.check(n_names > 50, f"only {n_names} names of entries were found in the sources: this test looks in the wrong place")
print(f"{n_names} names of entries in the sources, all declared")
