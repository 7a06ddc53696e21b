#!/usr/bin/env python3
"""Checks the tree without building anything: lengths of files and functions, include guards, white space, the links of the
Markdown pages, and that each folder of the code includes from the folders below it alone. scripts/check.py [--longest N];
--longest lists the longest files and functions instead."""

import argparse
import ast
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST_LINES = 700
MOST_LINES_OF_FUNCTION = 60
CODE = {".cc", ".h", ".py", ".js", ".mjs", ".css", ".sh"}
NO_TEXT = {".png", ".webp", ".svg", ".msh", ".output", ".csv", ".json"}
# The folders of include/supple and source, from the ground up: each includes from those before it.
FLOORS = ["base", "input", "linear_algebra", "multigrid", "mesh", "mechanics", "contact", "forces", "solvers", "time", "observe", "output",
          "scene", "report", "run", "study", "identification", "live", "program"]
# None of these knows another.
TASKS = ["study", "identification", "live"]
BESIDE = {(one, other) for one in TASKS for other in TASKS if one != other}
# What is measured and written does not depend on who made the step: of `time` it knows what a step reports.
ONLY = {("observe", "time"): "supple/time/step_report.h", ("output", "time"): "supple/time/step_report.h"}
SCOPE = re.compile(r"\s*(inline )?(namespace|struct|class|enum|union|extern)\b")

JAVASCRIPT_FUNCTION = re.compile(r"(?P<indent>\s*)(export |default |async |static |get |set )*"
                                 r"((function\*? |(const|let) )?(?P<name>\w+)( = .*=>|\s?\(.*\))) \{$")
JAVASCRIPT_WORDS = {"if", "for", "while", "switch", "catch", "with"}


def files():
    """Those of the repository and those about to be, without what others or programs wrote."""
    listed = subprocess.run(["git", "-c", f"safe.directory={ROOT}", "-C", ROOT, "ls-files", "-co", "--exclude-standard"],
                            capture_output=True, text=True, check=True).stdout
    paths = [ROOT / name for name in listed.split("\n") if name]
    return sorted(path for path in paths if path.is_file() and path.suffix not in NO_TEXT
                  and "data" not in path.parts and path.parent.name != "built" and path.name != "LICENSE")


def functions_of_cpp(lines):
    """(line, name, lines between the braces). By the formatting: the brace of a function stands on a line of its own, and
    the next closing brace as far in is its end."""
    number = 0
    while number < len(lines):
        if lines[number].strip() == "{":
            indent = lines[number][:-1]
            head = number
            while head > 0 and lines[head - 1].strip() and not re.search(r"([;}]|\*/|^\s*\w+:)$", lines[head - 1]):
                head -= 1
            if not any(SCOPE.match(line) for line in lines[head:number]):
                end = next(i for i in range(number + 1, len(lines)) if lines[i].startswith(indent + "}"))
                name = next((found[1] for line in lines[head:number] if (found := re.search(r"([\w:~]+|operator\S+) ?\(", line))), "?")
                yield number + 1, name, end - number - 1
                number = end
        number += 1


def functions_of_python(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            yield node.lineno, node.name, node.end_lineno - node.lineno


def functions_of_javascript(lines):
    """As in C++: what a function opens at the end of a line is closed by the next brace as far in."""
    for number, line in enumerate(lines):
        if (found := JAVASCRIPT_FUNCTION.match(line)) and line.endswith("{") and found["name"] not in JAVASCRIPT_WORDS:
            end = next(i for i in range(number + 1, len(lines)) if lines[i].startswith(found["indent"] + "}"))
            yield number + 1, found["name"], end - number - 1


def functions(path):
    text = path.read_text()
    if path.suffix in (".js", ".mjs"):
        return list(functions_of_javascript(text.split("\n")))
    if path.suffix in (".cc", ".h"):
        return list(functions_of_cpp(text.split("\n")))
    return list(functions_of_python(text)) if path.suffix == ".py" else []


def guard_problems(path):
    place = "tests_" if "tests" in path.parts else ""
    guard = f"supple_{place}{path.stem}_h"
    if path.suffix == ".h" and not path.read_text().startswith(f"#ifndef {guard}\n#define {guard}\n"):
        yield f"1: the include guard is not {guard}"


def length_problems(path):
    if path.suffix not in CODE:
        return
    n_lines = path.read_text().count("\n")
    if n_lines > MOST_LINES:
        yield f"{n_lines}: {n_lines} lines; at most {MOST_LINES} are right"
    for line, name, length in functions(path):
        if length > MOST_LINES_OF_FUNCTION:
            yield f"{line}: {name} has {length} lines; at most {MOST_LINES_OF_FUNCTION} are right"


def white_space_problems(path):
    text = path.read_text()
    for number, line in enumerate(text.split("\n"), 1):
        if "\t" in line:
            yield f"{number}: a tab"
        if line != line.rstrip():
            yield f"{number}: blanks at the end of the line"
    if not text.endswith("\n") or text.endswith("\n\n"):
        yield f"{text.count(chr(10))}: a file ends with one newline"


def prose(path):
    """The numbered lines of a page that are not in a code block."""
    in_code = False
    for number, line in enumerate(path.read_text().split("\n"), 1):
        if line.startswith("```"):
            in_code = not in_code
        elif not in_code and not line.startswith("    "):
            yield number, line


def anchors(path):
    """The names that GitHub gives to a page's headings."""
    found = set()
    for _, line in prose(path):
        if heading := re.match(r"#+ (.*)", line):
            plain = re.sub(r"\[(.*?)\]\(.*?\)", r"\1", heading[1].lower())
            name = re.sub(r"[^\w -]", "", plain).replace(" ", "-")
            more = 0
            while name + (f"-{more}" if more else "") in found:
                more += 1
            found.add(name + (f"-{more}" if more else ""))
    return found


def link_problems(path):
    if path.suffix != ".md":
        return
    for number, line in prose(path):
        targets = re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)) + re.findall(r"(?:href|src)=\"([^\"]+)\"", line)
        for target in targets:
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            there = (path.parent / name).resolve() if name else path
            if not there.exists():
                yield f"{number}: {target} is not there"
            elif anchor and there.suffix == ".md" and anchor not in anchors(there):
                yield f"{number}: {name or path.name} has no heading for #{anchor}"


def floor(path):
    """The folder of include/supple or source that a file is in; nothing for files elsewhere."""
    parts = path.relative_to(ROOT).parts
    return parts[2] if parts[:2] == ("include", "supple") else parts[1] if parts[0] == "source" else None


def includes(path):
    """(line, included file, its folder) of what a file includes from this project."""
    for number, line in enumerate(path.read_text().split("\n"), 1):
        if found := re.match(r"#include <(supple/(\w+)/\w+\.h)>", line):
            yield number, found[1], found[2]


def points_up(here, included):
    return FLOORS.index(included) > FLOORS.index(here) or (here, included) in BESIDE


def floor_problems(path):
    """A folder includes from the folders below it alone."""
    here = floor(path)
    if here is None or path.suffix not in (".cc", ".h"):
        return
    if here not in FLOORS:
        yield f"1: {here} is not one of the folders in FLOORS of scripts/check.py"
        return
    for number, included, there in includes(path):
        if there not in FLOORS:
            yield f"{number}: {there} is not one of the folders in FLOORS of scripts/check.py"
        elif points_up(here, there):
            yield f"{number}: {here} includes from {there}, which is above or beside it"
        elif included != ONLY.get((here, there), included):
            yield f"{number}: of {there}, {here} may include {ONLY[here, there]} alone"


def problems(path):
    for kind in (guard_problems, length_problems, white_space_problems, link_problems, floor_problems):
        for problem in kind(path):
            yield f"{path.relative_to(ROOT)}:{problem}"


def print_longest(most):
    code = [path for path in files() if path.suffix in CODE]
    print("Files")
    for path in sorted(code, key=lambda path: -path.read_text().count("\n"))[:most]:
        print(f"{path.read_text().count(chr(10)):5d}  {path.relative_to(ROOT)}")
    print("Functions")
    every = [(length, name, path, line) for path in code for line, name, length in functions(path)]
    for length, name, path, line in sorted(every, key=lambda item: -item[0])[:most]:
        print(f"{length:5d}  {path.relative_to(ROOT)}:{line} {name}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--longest", type=int, metavar="N")
    options = arguments.parse_args()
    if options.longest:
        print_longest(options.longest)
        return
    found = [problem for path in files() for problem in problems(path)]
    print("\n".join(found), end="\n" if found else "")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
