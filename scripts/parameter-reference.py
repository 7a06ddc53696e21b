#!/usr/bin/env python3
"""Writes doc/parameters, a page for each subsection of a parameter file, from what the program says of its entries:
scripts/parameter-reference.py [build/supple] [--check]. --check writes nothing and fails where a page is not what it
would be."""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "doc" / "parameters"
COMMAND = "scripts/parameter-reference.py"

# What a subsection is about: the program has no text for that.
SUBJECTS = {
    "Mesh": "The body's shape: a box, a rectangle, a hollow cylinder or a file; its layers, and ids of its boundaries.",
    "Plane": "What the triangles of a plane body stand for.",
    "Material": "How stiff, how heavy, and how well volume is kept; by material id if there are several.",
    "Corotation": "Which rotation is taken out of a cell before its strain is measured.",
    "Damping": "What slows the motion down, beside the method in time.",
    "Constraints": "What is held.",
    "Motion": "What is moved as prescribed: up to four, in Motion, Motion 2, Motion 3 and Motion 4.",
    "Loads": "What pulls and pushes.",
    "Contact": "How the body and rigid tools keep each other out.",
    "Tool NAME": "A rigid body that moves as prescribed and that the body can't enter: any number, each in a subsection with "
                 "its name.",
    "Start": "Displacement and velocity at the beginning.",
    "Time": "From where to where, in which steps, by which method.",
    "Solver": "How the linear systems are solved.",
    "Output": "What is written, and when.",
    "Probes": "Which points, boundaries, regions and surfaces are followed over time.",
    "Space": "The error that the mesh makes.",
    "Checkpoint": "To go on with a run that was ended.",
    "Live": "What was done by hand in a live session, to be repeated.",
    "Study": "Many runs of one scene, compared. A file of its own, with this subsection alone.",
    "Identification": "Two layers of skin fitted to measured surfaces. A file of its own, with this subsection alone.",
}


class Entry:
    """What the program says of an entry."""

    def __init__(self, name, node):
        self.name = name
        self.order = int(node["pattern"])
        found = re.fullmatch(r"(.*) Unit: (.*?)\. Range: (.*)\.", node["documentation"], re.DOTALL)
        if not found:
            sys.exit(f"{name} does not say its meaning, unit and range: {node['documentation']}")
        self.meaning, self.unit, self.range = found.groups()
        self.default = ", ".join(short(part) for part in node["default_value"].split(", "))


def short(text):
    """A number without the digits that some versions of deal.II add."""
    try:
        number = float(text)
    except ValueError:
        return text
    return f"{number:g}" if float(f"{number:g}") == number else repr(number)


def base(section):
    """Motion 2 is declared as Motion is, and each tool as the example."""
    return re.sub(r"^Tool .*", "Tool NAME", re.sub(r" \d+$", "", section))


def declared(program):
    """{section: [entries]}, in the order in which the program declares them."""
    text = subprocess.run([program, "--print-parameters", "json"], capture_output=True, text=True, check=True).stdout
    sections = {}
    for section, nodes in json.loads(text).items():
        if base(section) == section:
            sections[section] = sorted((Entry(name, node) for name, node in nodes.items()), key=lambda entry: entry.order)
    return dict(sorted(sections.items(), key=lambda item: item[1][0].order))


def settings(scene):
    """(section, entry) of all that a parameter file sets, those in the overrides of a study among them."""
    section = None
    for line in scene.read_text().split("\n"):
        if found := re.match(r"\s*subsection\s+(.*?)\s*(#.*)?$", line):
            section = base(found[1])
        elif found := re.match(r"\s*set\s+(.*?)\s*=(.*)", line):
            yield section, found[1]
        for inner in re.finditer(r"\b([A-Z][a-z]+(?: \d)?)/([A-Z][A-Za-z ]*?) *=", line.split("#")[0]):
            yield base(inner[1]), inner[2]


def users():
    """{(section, entry): [parameter files that set it]}"""
    found = {}
    for scene in sorted((ROOT / "parameters").rglob("*.prm")):
        for key in dict.fromkeys(settings(scene)):
            found.setdefault(key, []).append(scene.relative_to(ROOT))
    return found


def escaped(text):
    return re.sub(r"([*<|\[\]])", r"\\\1", text)


def anchor(heading):
    """What GitHub makes of a heading."""
    return re.sub(r"[^a-z0-9 _-]", "", heading.lower()).replace(" ", "-")


def file_of(section):
    return section.split()[0].lower() + ".md"


def scenes_line(scenes, most=6):
    if not scenes:
        return "No scene of this repository sets it."
    links = [f"[{scene.relative_to('parameters').with_suffix('')}](../../{scene})" for scene in scenes[:most]]
    rest = f" and {len(scenes) - most} more" if len(scenes) > most else ""
    return "Set in " + ", ".join(links) + rest + "."


def wrapped(text):
    return textwrap.fill(text, 118, break_long_words=False, break_on_hyphens=False)


def page(section, entries, scenes):
    heading = [f"# {section}", "", wrapped(SUBJECTS[section]), "",
               f"(Made by `{COMMAND}` of `supple --print-parameters`; all subsections: [README.md](README.md).)", "",
               "| entry | default | unit |", "|---|---|---|"]
    for entry in entries:
        default = f"`{entry.default}`" if entry.default else "empty"
        heading.append(f"| [{entry.name}](#{anchor(entry.name)}) | {default} | {escaped(entry.unit)} |")
    for entry in entries:
        default = f"`{entry.default}`" if entry.default else "empty"
        heading += ["", f"## {entry.name}", "", wrapped(escaped(entry.meaning)), "",
                    f"- Default: {default}", wrapped(f"- Unit: {escaped(entry.unit)}"),
                    wrapped(f"- Range: {escaped(entry.range)}").replace("\n", "\n  "), "",
                    scenes_line(scenes.get((section, entry.name), []))]
    return "\n".join(heading) + "\n"


def index(sections):
    lines = ["# All parameters", "",
             wrapped(f"What a parameter file may say, a page for each subsection: {sum(map(len, sections.values()))} entries. "
                     "What is not set has its default. `supple --print-parameters` prints the same as a parameter file. "
                     f"These pages are made by `{COMMAND}`; a test fails when they are not what the program says."), "",
             "| subsection | about | entries |", "|---|---|---|"]
    for section, entries in sections.items():
        links = ", ".join(f"[{entry.name}]({file_of(section)}#{anchor(entry.name)})" for entry in entries)
        lines.append(f"| [{section}]({file_of(section)}) | {SUBJECTS[section]} | {links} |")
    return "\n".join(lines) + "\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program", nargs="?", default=str(ROOT / "build" / "supple"))
    arguments.add_argument("--check", action="store_true")
    options = arguments.parse_args()

    sections, scenes = declared(options.program), users()
    if set(sections) != set(SUBJECTS):
        sys.exit(f"{COMMAND}: SUBJECTS has not the program's subsections: {sorted(set(sections) ^ set(SUBJECTS))}")
    pages = {PAGES / file_of(section): page(section, entries, scenes) for section, entries in sections.items()}
    pages[PAGES / "README.md"] = index(sections)
    if options.check:
        there = {file: file.read_text() for file in PAGES.glob("*.md")}
        stale = sorted(file.name for file in pages.keys() | there.keys() if pages.get(file) != there.get(file))
        if stale:
            sys.exit(f"doc/parameters is not what the program says: {', '.join(stale)}. Run {COMMAND}, look at the difference.")
        return
    PAGES.mkdir(exist_ok=True)
    for file in PAGES.glob("*.md"):
        if file not in pages:
            file.unlink()
    for file, text in pages.items():
        file.write_text(text)


if __name__ == "__main__":
    main()
