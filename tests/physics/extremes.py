"""Extreme starts, sizes and turned scenes: what comes home, what must be alike, what is refused. All rows: parameters/studies/extremes.prm."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

AT_REST = {"Start/Velocity": "0; 0; 0", "Output/Frames": "none", "Output/Report": "false", "Time/Energy guard": "reject"}


def hashed(number):
    """An expression between 0 and 1 that looks random."""
    wave = f"43758.5453*sin(12.9898*x + 78.233*y + 37.719*z + {number})"
    return f"({wave} - floor({wave}))"


def comes_home(name, start, inverted, settings={}, time=4.9):
    results = runner.simulate(runner.BAR, {**AT_REST, "Time/Steps": round(time / 0.07), **start, **settings})
    summary = results.summary()
    runner.check(summary["extremes"]["most_inverted"] >= inverted, f"{name}: {summary['extremes']}")
    runner.check(summary["extremes"]["not_finite"] == 0 and summary["last"]["inverted"] == 0, f"{name}: {summary}")
    return summary


def at_rest(name, summary):
    distance = summary["relative_to_diameter"]["distance_from_rest"]
    runner.check(distance < 1e-3, f"{name}: {distance} of the diameter from rest")
    runner.check(abs(distance * math.sqrt(176) - summary["distance_from_rest"]) < 1e-12, f"{name}: the diameter")
    runner.check(summary["distance_from_shape"] <= summary["distance_from_rest"] * (1 + 1e-6) + 1e-12, f"{name}: the shape")


RANDOM = {"Start/Displacement": f"4*{hashed(1)} - x; 12*{hashed(2)} - y; 4*{hashed(3)} - z"}
FREE = {"Constraints/Clamped boundaries": ""}
for name, start, inverted in [("one point", {"Start/Displacement": "2-x; 6-y; 2-z"}, 150),
                              ("mirrored", {"Start/Displacement": "0; 24-2*y; 0"}, 192),
                              ("random", RANDOM, 80)]:
    held = {**start, "Loads/Gravity": "0, 0, 0"}
    summary = comes_home(name, held, inverted)
    at_rest(name, summary)
    runner.check(summary["extremes"]["energy_rises"] == 0, f"{name}: the energy rises")

# A free body comes back to its shape, at another place and turned.
summary = comes_home("free", {**RANDOM, **FREE, "Loads/Gravity": "0, 0, 0"}, 80, time=7)
relative = summary["relative_to_diameter"]
runner.check(relative["distance_from_shape"] < 1e-3 < 0.01 < relative["distance_from_rest"], f"free: {relative}")
turned = runner.simulate(runner.BAR, {**AT_REST, **FREE, "Start/Rotation": "30, 40, 50", "Start/Displacement": "1; 2; 3", "Time/Steps": 1})
runner.check(turned.summary()["distance_from_shape"] < 1e-12, "a turned body has another shape")
squeezed = runner.simulate(runner.BAR, {**AT_REST, **FREE, "Start/Displacement": "0; 0.1*(y-6); 0", "Time/Steps": 1, "Time/Step": 1e-9})
runner.check(abs(squeezed.summary()["distance_from_shape"] - 0.6) < 1e-6, "the distance of a stretched body from its shape")

# Where Newton's method finds no solution the energy guard goes on, and tells what rises.
summary = comes_home("4000 m/s", {"Start/Velocity": "0; 0; -4000", "Loads/Gravity": "0, 0, 0", "Time/Retries": 3}, 10)
at_rest("4000 m/s", summary)
extremes = summary["extremes"]
runner.check((extremes["energy_rises"] > 0) == (extremes["energy_risen"] > 0), f"{extremes}")
runner.check((extremes["energy_rises"] > 0) == ("the total energy rose" in " ".join(summary["warnings"])), f"{summary}")

# Tiny and huge bodies move alike: all lengths and times the same number of times larger.
columns = ["min_volume_ratio", "max_volume_ratio"]
MOVING = {"Output/Frames": "none", "Output/Report": "false", "Time/Steps": 30}
plain = runner.simulate(runner.BAR, MOVING)
for size in [1e-6, 1e6]:
    other = runner.simulate(runner.BAR, {
        **MOVING, "Mesh/Box size": f"{4 * size}, {12 * size}, {4 * size}", "Time/Step": 0.07 * size,
        "Loads/Gravity": f"0, 0, {-9.81 / size}", "Probes/Points": f"n28: {2 * size}, 0, {2 * size}"})
    difference = runner.largest_difference(plain.history(), other.history(), columns)
    runner.check(difference < 1e-8, f"size {size}: volumes differ by {difference}")
    scaled = [{c: v / size for c, v in row.items()} for row in other.probes()]
    difference = runner.largest_difference(plain.probes(), scaled, ["n28.ux", "n28.uy", "n28.uz"])
    runner.check(difference < 1e-8, f"size {size}: the motion differs by {difference}")

# A turned scene's answer turns along; with Gram-Schmidt rotations it does not, which is warned of.
a, k = 1.0, [1 / math.sqrt(14), 2 / math.sqrt(14), 3 / math.sqrt(14)]
K = [[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]]
R = [[(i == j) * math.cos(a) + math.sin(a) * K[i][j] + (1 - math.cos(a)) * k[i] * k[j] for j in range(3)] for i in range(3)]


def turn(vector):
    return [sum(R[i][j] * vector[j] for j in range(3)) for i in range(3)]


turned_scene = {**MOVING, "Mesh/Map": "; ".join(f"{r[0]}*x + {r[1]}*y + {r[2]}*z" for r in R),
                "Start/Velocity": "; ".join(map(str, turn([0, 0, -40]))),
                "Loads/Gravity": ", ".join(map(str, turn([0, 0, -9.81]))),
                "Probes/Points": "n28: " + ", ".join(map(str, turn([2, 0, 2])))}
for rotation, alike in [("polar", True), ("none", True), ("gram-schmidt", False)]:
    first = runner.simulate(runner.BAR, {**MOVING, "Corotation/Rotation": rotation})
    second = runner.simulate(runner.BAR, {**turned_scene, "Corotation/Rotation": rotation})
    worst = 0
    for one, two in zip(first.probes(), second.probes()):
        right = turn([one[f"n28.u{c}"] for c in "xyz"])
        worst = max(worst, *(abs(two[f"n28.u{c}"] - r) for c, r in zip("xyz", right)))
    motion = max(abs(row["n28.uz"]) for row in first.probes())
    runner.check((worst < 1e-8 * motion) == alike, f"{rotation}: the turned scene differs by {worst} of {motion}")
    runner.check(("depend on the axes" in " ".join(second.summary()["warnings"])) != alike, f"{rotation}: warnings")

# A start at nowhere is refused before anything is written.
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-")) / "nowhere"
for entry, text in [("Start/Displacement", "0; 0; 0/0"), ("Start/Displacement", "0; sqrt(-y); 0"), ("Start/Velocity", "1e200*1e200; 0; 0")]:
    status, _, error = runner.run(runner.BAR, "--output", folder, "--set", f"{entry}={text}")
    runner.check(status == 1 and entry in error and "finite" in error and not folder.exists(), f"{entry}={text}: {status} {error}")

# Every row of the matrix can be read; those without sense are refused.
status, output, error = runner.run("--check", runner.ROOT / "parameters" / "studies" / "extremes.prm")
refused = [line for line in output.splitlines() if ": refused: " in line]
runner.check(status == 0 and len(refused) == 3, output + error)
