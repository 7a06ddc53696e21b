"""Contact against what is known, on several meshes: the tables of doc/contact.md.

    scripts/build.sh && python3 benchmarks/contact/figures.py [mindlin] [ironing] [pressure]

mindlin   the force sideways against Cattaneo's and Mindlin's, and the radius within which it sticks
ironing   how much the force of a die varies while it goes over the cells, without friction and with it
pressure  the pressure in the middle of Hertz's contact, and its largest error within 0.8 a
"""

import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUPPLE = os.environ.get("SUPPLE", str(ROOT / "build" / "supple"))
wanted = sys.argv[1:] or ["mindlin", "ironing", "pressure"]
sys.argv[1:] = [SUPPLE]  # which the readers of the tests take from there
sys.path.insert(0, str(ROOT / "tests" / "support"))
import contact_solutions
import vtu


def run(name, settings):
    """The folder of a run of a scene."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
    words = [word for entry, value in settings.items() for word in ("--set", f"{entry}={value}")]
    subprocess.run([SUPPLE, ROOT / "parameters" / "contact" / f"{name}.prm", "--quiet", "--output", folder, "--set", "Output/Report=false", *words],
                   check=True)
    return folder


def frames(folder):
    return [vtu.Frame(file) for file in sorted((folder / "solution").glob("*.vtu"))]


def table(folder, name):
    with open(folder / name) as file:
        return [{column: float(text) for column, text in row.items()} for row in csv.DictReader(file)]


def mindlin():
    for cubes in ("8, 4, 4", "12, 6, 6", "16, 8, 8", "20, 10, 10"):
        folder = run("mindlin", {"Mesh/Box cubes": cubes, "Output/Frames": "every"})
        states = frames(folder)
        for row, state in list(zip(table(folder, "tool_sphere.csv"), states))[2:]:
            load = contact_solutions.mindlin_load(row["time"])
            force = 2 * row["fx"] / contact_solutions.MINDLIN_LIMIT
            radius = contact_solutions.stick_radius(state, states[1], row["time"])
            print(f"mindlin {cubes}: Q/(mu P) {force:.4f} instead of {load:.4f}, c/a {radius:.3f} instead of {(1 - load) ** (1 / 3):.3f}", flush=True)


def ironing():
    for friction in (0, 0.3):
        for squares in ("40, 10", "80, 20", "160, 40"):
            settings = {"Mesh/Rectangle squares": squares, "Tool die/Friction": friction, "Contact/Slip resolution": 2e-4, "Output/Frames": "none"}
            rows = table(run("ironing", settings), "tool_die.csv")
            whole, period = contact_solutions.variation([row["fy"] for row in rows[4:]], 20 * 40 // int(squares.split(",")[0]))
            print(f"ironing {squares}, friction {friction}: varies by {100 * whole:.2f} %, within a cell by {100 * period:.2f} %", flush=True)


def pressure():
    for order, meshes in ((2, (8, 12, 16)), (1, (8, 16, 24))):
        for n in meshes:
            folder = run("hertz", {"Mesh/Order": order, "Mesh/Box cubes": f"{n}, {n}, {n}", "Time/Steps": 1})
            middle, worst = contact_solutions.errors_of_pressure(frames(folder)[-1])
            print(f"pressure, order {order}, {n} cubes: in the middle {100 * middle:+.1f} %, largest error {100 * worst:.1f} % of it", flush=True)


for part in wanted:
    globals()[part]()
