"""Hundreds of random throws, pokes and collisions of small bodies: how many end, how near anything came, Newton's iterations.

    scripts/run.sh --version && python3 benchmarks/contact/campaign.py [--runs 500] [--first 0]

Each run is made by its number alone: `--first 17 --runs 1 --keep` does the 17th again and leaves its folder. A run that ends with another
status than 0 or 2, or in which a gap is not more than zero, is told and makes the status 1.
"""

import argparse
import collections
import csv
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
METHODS = ["backward euler", "implicit backward euler", "trbdf2", "esdirk3"]


def numbers(values):
    return ", ".join(f"{value:.6g}" for value in values)


def body(choose, size, shift):
    cubes = choose.choice([2, 3, 4])
    return {"Mesh/Box size": numbers([size] * 3), "Mesh/Box cubes": numbers([cubes] * 3), "Mesh/Box origin": numbers([-size / 2] * 3),
            "Mesh/Map": "; ".join(f"{axis} + {length:.6g}" for axis, length in zip("xyz", shift)),
            "Material/Young modulus": f"{10 ** choose.uniform(4, 7):.4g}", "Material/Poisson ratio": f"{choose.uniform(0, 0.45):.3g}",
            "Start/Rotation": numbers(choose.uniform(-90, 90) for _ in range(3)), "Start/Rotation center": numbers(shift),
            "Time/Method": choose.choice(METHODS), "Time/Step": f"{10 ** choose.uniform(-3.3, -1):.4g}", "Time/Steps": "25"}


def tool(choose, size):
    shape = choose.choice(["plane", "sphere", "capsule", "box", "file"])
    turn = [choose.uniform(-180, 180) for _ in range(3)]
    return shape, {"plane": {"Normal": "0, 0, 1"}, "sphere": {"Radius": f"{size * 10 ** choose.uniform(-2, 0.5):.4g}"},
                   "capsule": {"Radius": f"{size * 10 ** choose.uniform(-2.5, -0.5):.4g}", "Axis": numbers(size * choose.uniform(-2, 2) for _ in range(3))},
                   "box": {"Size": numbers(size * choose.uniform(0.2, 3) for _ in range(3)), "Rotation": "; ".join(f"{angle:.4g}" for angle in turn)},
                   "file": {"File": str(ROOT / "parameters" / "contact" / "punch.obj"), "Scale": f"{size * choose.uniform(0.2, 2):.4g}",
                            "Rotation": "; ".join(f"{angle:.4g}" for angle in turn)}}[shape]


def settled(choose, entries):
    """Friction is for backward Euler."""
    if entries["Time/Method"] in METHODS[:2] and choose.random() < 0.5:
        return {"Contact/Slip resolution": "0.05"}, f"{choose.uniform(0.05, 1):.3g}"
    return {}, "0"


def throw(choose):
    """A cube is thrown at a tool that stands still."""
    size = 10 ** choose.uniform(-3, 1)
    entries = body(choose, size, [0, 0, 6 * size])
    speed = 10 ** choose.uniform(-1, 2.5) * size
    entries["Start/Velocity"] = f"{choose.uniform(-0.2, 0.2) * speed:.4g}; {choose.uniform(-0.2, 0.2) * speed:.4g}; {-speed:.4g}"
    shape, what = tool(choose, size)
    more, friction = settled(choose, entries)
    return {**entries, **more}, {"target": {"Shape": shape, **what, "Friction": friction}}


def poke(choose):
    """A cube that is held below is hit by a tool that comes down, and turns."""
    size = 10 ** choose.uniform(-3, 1)
    entries = body(choose, size, [0, 0, 0])
    entries.update({"Start/Rotation": "0, 0, 0", "Constraints/Clamped boundaries": "4"})
    shape, what = tool(choose, size)
    if shape == "plane":
        shape, what = "sphere", {"Radius": f"{size * 10 ** choose.uniform(-2, 0):.4g}"}
    speed = 10 ** choose.uniform(-1, 2) * size
    place = [choose.uniform(-0.4, 0.4) * size for _ in range(2)]
    duration = 25 * float(entries["Time/Step"])
    way = min(speed * duration, (4.5 + choose.uniform(0, 0.3)) * size)
    what["Position"] = f"{place[0]:.4g}; {place[1]:.4g}; {5 * size:.6g} - {way:.6g}*min(t/{duration:.6g}*{choose.uniform(1, 3):.3g}, 1)"
    more, friction = settled(choose, entries)
    return {**entries, **more}, {"finger": {"Shape": shape, **what, "Friction": friction}}


def collide(choose):
    """Two or three cubes fly into each other, with a floor or without."""
    size = 10 ** choose.uniform(-3, 1)
    entries = body(choose, size, [0, 0, 0])
    for entry in ("Start/Rotation", "Start/Rotation center"):
        del entries[entry]
    n = choose.choice([2, 3])
    turns = [choose.uniform(-math.pi, math.pi) for _ in range(n)]
    entries["Mesh/Map"] = ""
    entries["Mesh/Piece maps"] = " | ".join(
        f"{math.cos(a):.9g}*x - {math.sin(a):.9g}*y + {choose.uniform(-0.3, 0.3) * size:.6g}; {math.sin(a):.9g}*x + {math.cos(a):.9g}*y; z + {1.6 * k * size:.6g}"
        for k, a in enumerate(turns))
    speed = 10 ** choose.uniform(-1, 2) * size
    entries["Start/Velocity"] = f"0; {0.1 * speed:.4g}*z/{size:.6g}; if(z > {0.8 * size:.6g}, {-speed:.4g}, {0.5 * speed:.4g})"
    entries["Contact/Bodies"] = choose.choice(["pieces", "all"])
    more, friction = settled(choose, entries)
    if friction != "0":
        entries["Contact/Friction"] = friction
    floor = {"floor": {"Shape": "plane", "Position": f"0; 0; {-0.8 * size:.6g}", "Friction": friction}} if choose.random() < 0.5 else {}
    return {**entries, **more}, floor


def scene_of(entries, tools):
    sections = collections.defaultdict(list)
    for entry, value in entries.items():
        section, name = entry.split("/")
        sections[section].append((name, value))
    for name, what in tools.items():
        sections[f"Tool {name}"] = list(what.items())
    return "\n".join(f"subsection {section}\n" + "".join(f"  set {name} = {value}\n" for name, value in lines) + "end" for section, lines in sections.items())


def result(program, folder, scene, seconds):
    """(status, message, least gap over the reach, iterations of each step, error in the balance of energies)"""
    (folder / "scene.prm").write_text(scene + "\n")
    output = folder / "output"
    try:
        done = subprocess.run([program, folder / "scene.prm", "--quiet", "--output", output, "--set", "Output/Frames=none", "--set", "Output/Report=false"],
                              capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return None, f"not done after {seconds} s", math.nan, [], math.nan
    if done.returncode == 1 or not (output / "history.csv").exists():
        return done.returncode, done.stderr.strip(), math.nan, [], math.nan
    with open(output / "history.csv") as file:
        rows = [{name: float(text) for name, text in row.items()} for row in csv.DictReader(file)]
    gap = min((row["min_gap"] for row in rows), default=math.nan)
    size = max(abs(row[name]) for row in rows for name in ("kinetic", "elastic", "work", "dissipated", "contact")) or 1
    missing = max(abs(row["total"] + row["dissipated"] + row["rubbed"] - row["work"] - rows[0]["total"]) for row in rows) / size
    return done.returncode, done.stderr.strip(), gap, [row["newton_iterations"] for row in rows[1:]], missing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=500)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=60, help="that a run may take")
    parser.add_argument("--keep", action="store_true", help="leave the folders")
    parser.add_argument("--program", default=str(ROOT / "build" / "supple"))
    arguments = parser.parse_args()
    kinds = [throw, poke, collide]
    table = {kind.__name__: collections.Counter() for kind in kinds}
    worst = {kind.__name__: {"gap": math.inf, "most": 0, "steps": 0, "iterations": 0, "missing": 0.0} for kind in kinds}
    bad = 0
    for number in range(arguments.first, arguments.first + arguments.runs):
        kind = kinds[number % len(kinds)]
        folder = pathlib.Path(tempfile.mkdtemp(prefix=f"supple-{number}-"))
        status, message, gap, iterations, missing = result(arguments.program, folder, scene_of(*kind(random.Random(number))), arguments.seconds)
        refused = status == 1 and ("at the start" in message)
        table[kind.__name__]["too slow" if status is None else "done" if status == 0 else "failed with words" if status == 2 else "refused" if refused else "WRONG"] += 1
        if not (status in (None, 0, 2) or refused) or gap <= 0:
            bad += 1
            print(f"run {number}, {kind.__name__}: status {status}, least gap {gap}: {message}", flush=True)
        elif status != 0 and not refused:
            print(f"run {number}, {kind.__name__}: {message}", flush=True)
        of_kind = worst[kind.__name__]
        if status in (0, 2):
            of_kind["gap"] = min(of_kind["gap"], gap if gap == gap else math.inf)
            of_kind["most"] = max([of_kind["most"], *iterations])
            of_kind["steps"] += len(iterations)
            of_kind["iterations"] += sum(iterations)
        if status == 0:
            if missing > 1e-6:
                print(f"run {number}, {kind.__name__}: energies out of balance by {missing:.2g}", flush=True)
            of_kind["missing"] = max(of_kind["missing"], missing)
        if not arguments.keep:
            shutil.rmtree(folder)
        else:
            print(folder)
    for name, counts in table.items():
        told = worst[name]
        print(f"{name}: {dict(counts)}; least gap {told['gap']:.3g} m; corrections a step {told['iterations'] / max(told['steps'], 1):.2f}, at most "
              f"{told['most']:.0f}; balance {told['missing']:.1g}")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
