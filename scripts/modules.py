#!/usr/bin/env python3
"""Writes doc/modules.dot, a picture of the folders of the code: scripts/modules.py [--check]. A box has the name of a folder,
what it is (the first line of its CMakeLists.txt) and its files; an arrow goes to a folder whose headers are included. --check
writes nothing and fails where doc/modules.dot is not what it would be. scripts/docs.sh draws doc/pictures/modules.svg of it."""

import argparse
import re
import sys
import textwrap

import check

PICTURE = check.ROOT / "doc" / "modules.dot"
HEAD = """// Made by scripts/modules.py from the includes of the code; scripts/docs.sh draws doc/pictures/modules.svg of it.
digraph modules {
  ranksep = 0.3; nodesep = 0.35; bgcolor = "white";
  node [shape = box, style = "rounded,filled", fillcolor = "#eef3f6", color = "#5b666e", fontname = "Helvetica", fontsize = 12, margin = "0.14,0.06"];
  edge [color = "#5b666e"];

"""
# What comes from outside and what goes there.
OUTSIDE = """
  node [shape = note, style = filled, fillcolor = "#fff5dc"];
  edge [style = dashed];
  scene_file [label = "SCENE.prm"];
  mesh_file [label = "body.msh"];
  results [label = "solution.pvd\\nhistory.csv\\nreport.html"];
  scene_file -> input;
  mesh_file -> mesh;
  output -> results;
  report -> results;
  {rank = same; scene_file; input}
  {rank = same; mesh_file; mesh}
  {rank = same; output; results}
}
"""


def files(folder):
    """Headers and sources of a folder of the code."""
    return sorted([*(check.ROOT / "include/supple" / folder).glob("*.h"), *(check.ROOT / "source" / folder).glob("*.cc")])


def subject(folder):
    """What a folder is, by its own words."""
    name = f"source/{folder}/CMakeLists.txt"
    line = (check.ROOT / name).read_text().split("\n")[0]
    if not (found := re.match(rf"# {folder}: (.+)", line)):
        sys.exit(f"{name}:1: the first line is not '# {folder}: what it is'")
    return found[1]


def wrapped(words, width):
    """Lines of nearly the same length, as few as there can be."""
    n_lines = len(textwrap.wrap(words, width))
    return "<br/>".join(next(lines for narrower in range(len(words) // n_lines, width + 1)
                             if len(lines := textwrap.wrap(words, narrower)) == n_lines))


def box(folder):
    """The node of a folder: its name, what it is, and its files in small type."""
    stems = ", ".join(sorted({path.stem for path in files(folder)}))
    return (f'  {folder} [label = <<b>{folder}</b><br/>{wrapped(subject(folder), 42)}<br/>'
            f'<font point-size="10" color="#5b666e">{wrapped(stems, 56)}</font>>];\n')


def below():
    """For each folder those below it that it includes from."""
    return {here: {there for path in files(here) for _, _, there in check.includes(path)
                   if there != here and not check.points_up(here, there)} for here in check.FLOORS}


def reached(folder, arrows):
    """All folders that arrows lead to, in one step or in many."""
    return arrows[folder] | {far for near in arrows[folder] for far in reached(near, arrows)}


def text():
    arrows = below()
    # An arrow is left out where others lead to the same folder.
    lines = [f"  {here} -> {there};\n" for here in check.FLOORS for there in sorted(arrows[here], key=check.FLOORS.index)
             if not any(there in reached(other, arrows) for other in arrows[here])]
    return HEAD + "".join(map(box, check.FLOORS)) + "\n" + "".join(lines) + OUTSIDE


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--check", action="store_true")
    if not arguments.parse_args().check:
        PICTURE.write_text(text())
    elif PICTURE.read_text() != text():
        sys.exit("doc/modules.dot is not what scripts/modules.py writes: call scripts/check.sh --fix")


if __name__ == "__main__":
    main()
