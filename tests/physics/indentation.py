"""A needle pushes skin: the depth is prescribed, its force is the reaction, and the surface is written as a profile."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

SKIN = runner.ROOT / "parameters" / "skin"
PLANE, AROUND, SOLID = SKIN / "needle-plane.prm", SKIN / "needle-axisymmetric.prm", SKIN / "needle-3d.prm"
COLUMNS = ["step", "time", "vertex", "distance", "depth", "x", "y", "z", "ux", "uy", "uz"]
quiet = {"Output/Frames": "none", "Solver/Tolerance": 1e-12}


def balanced(row, moved, *held):
    """The reactions of the needle and of what holds the skin add up to nothing."""
    for direction in "xyz":
        net = sum(row[f"{name}.f{direction}"] for name in (moved, *held))
        runner.check(abs(net) < 1e-8 * abs(row[moved + ".fy"]), f"the reactions add up to {net} N along {direction}")


def last_profile(results, name="skin"):
    rows = results.table(f"profile_{name}.csv")
    runner.check(list(rows[0]) == COLUMNS, f"columns {list(rows[0])}")
    return [row for row in rows if row["step"] == rows[-1]["step"]]


# A cut through the skin: the curve of force against depth is a straight line, and its area is the energy.
regions = {"Probes/Regions": "held: (abs(x) > 0.00599 || y < -0.00449)"}
plane = runner.simulate(PLANE, {**quiet, **regions})
curve = plane.probes()
final = curve[-1]
runner.check(len(curve) == 19 and abs(final["needle.uy"] + 0.0018) < 1e-18, "the needle is not where it should be")
runner.check(final["needle.fy"] < 0, "the skin does not push back")
for row in curve:
    runner.check(abs(row["needle.fy"] - row["time"] * final["needle.fy"]) < 1e-10 * abs(final["needle.fy"]), "no straight line")
    runner.check(row["needle.fx"] == 0, "it should slide along the surface")
balanced(final, "needle", "held")
work = -0.5 * final["needle.fy"] * 0.0018
runner.check(abs(plane.history()[-1]["elastic"] / work - 1) < 1e-10, "energy of the skin and work of the needle")
runner.check(plane.summary()["built"]["factorizations"] == 1, "one factorization is enough")

# A strip of twice the thickness needs twice the force; a stiff lower layer more.
thick = runner.simulate(PLANE, {**quiet, "Plane/Thickness": 0.002}).probes()[-1]["needle.fy"]
runner.check(abs(thick / final["needle.fy"] - 2) < 1e-10, "thickness")
even = runner.simulate(PLANE, {**quiet, "Material/By id": ""}).probes()[-1]["needle.fy"]
runner.check(even < 2 * final["needle.fy"], "the lower layer does not count")

# Its profile: what was asked for, in order, as deep as the probe says, and with its mirror image.
rows = plane.table("profile_skin.csv")
runner.check(len(rows) == 19 * 17, f"{len(rows)} rows of 19 states with 17 vertices")
skin = last_profile(plane)
runner.check(all(a["x"] < b["x"] for a, b in zip(skin, skin[1:])), "not in the order of x")
for row, mirror in zip(skin, reversed(skin)):
    runner.check(row["depth"] == -row["uy"] and abs(row["distance"] - abs(row["x"])) < 1e-15, "depth or distance")
    runner.check(abs(row["y"] - row["uy"]) < 1e-15 and row["z"] == 0 and row["time"] == 1, "place or time")
    runner.check(abs(row["depth"] - mirror["depth"]) < 1e-12 and abs(row["x"] + mirror["x"]) < 1e-12, "no mirror image")
middle = skin[8]
runner.check(middle["vertex"] == 110 and abs(middle["depth"] - 0.0018) < 1e-15, f"under the needle: {middle}")
runner.check(skin[0]["depth"] == 0 == skin[-1]["depth"] and max(row["depth"] for row in skin) == middle["depth"], "shape")

# Fully prescribed it can't slide: on a mesh without mirror image that takes more force.
crooked = {**quiet, **regions, "Mesh/Rectangle split": "falling"}
sliding = runner.simulate(PLANE, crooked).probes()[-1]
fixed = runner.simulate(PLANE, {**crooked, "Motion/Displacement": "0; -0.0018*t; 0"}).probes()[-1]
runner.check(abs(sliding["needle.ux"]) > 1e-6 and fixed["needle.ux"] == 0 and fixed["needle.fx"] != 0, "sliding")
runner.check(fixed["needle.fy"] < sliding["needle.fy"], "fully held it should be stiffer")
for row in sliding, fixed:
    balanced(row, "needle", "held")

# Fewer profiles, other ones, and their center.
some = runner.simulate(PLANE, {**quiet, "Probes/Profiles": "skin: 3; below: 2", "Probes/Profile every": 7,
                               "Probes/Profile center": "0.001, 0, 0"})
runner.check(sorted({row["step"] for row in some.table("profile_skin.csv")}) == [0, 7, 14, 18], "steps of the profile")
for row in last_profile(some):
    runner.check(abs(row["distance"] - abs(row["x"] - 0.001)) < 1e-15, "distance from the center")
runner.check(all(row["depth"] == 0 for row in last_profile(some, "below")), "the bottom is held")

# What an earlier run left is gone, and without history there are no profiles.
status, _, error = runner.run(PLANE, "--quiet", "--output", some.folder, "--set", "Probes/Profiles=skin: 3")
runner.check(status == 0 and not (some.folder / "profile_below.csv").exists(), "an old profile is still there")
status, _, error = runner.run(PLANE, "--quiet", "--output", some.folder, "--set", "Output/History=false")
runner.check(status == 0 and not list(some.folder.glob("*.csv")), "tables that were not wanted")

# Around an axis and in a block: a patch as wide as the needle, pushed straight down while cells turn. Vertices on the axis
# stay on it; what holds the skin bears the force; one and two processes agree.
around = {**quiet, "Probes/Regions": "needle: y > -1e-9 && x < 0.000501; held: x > 0.00599 || y < -0.00449",
          "Time/Steps": 10}
block = {**quiet, "Mesh/Box cubes": "12, 6, 12", "Time/Steps": 2, "Motion/Of": "region y > -1e-9 && x^2 + z^2 < 0.0011^2",
         "Probes/Regions": "needle: y > -1e-9 && x^2 + z^2 < 0.0011^2; "
                           "held: y < -0.00449 || abs(x) > 0.00599 || abs(z) > 0.00599"}
for scene, settings, n_vertices in [(AROUND, around, 25), (SOLID, block, 13 * 13)]:
    one, two = (runner.simulate(scene, settings, ranks=ranks) for ranks in (1, 2))
    curve = one.probes()
    runner.check(all(a["needle.fy"] > b["needle.fy"] for a, b in zip(curve, curve[1:])), "deeper, but not harder")
    runner.check(abs(curve[-1]["needle.uy"] + 0.001) < 1e-15, "the needle is not where it should be")
    net = curve[-1]["needle.fy"] + curve[-1]["held.fy"]
    runner.check(abs(net) < 1e-6 * abs(curve[-1]["needle.fy"]), f"the reactions add up to {net} N")
    columns = [name for name in curve[0] if name != "step"]
    difference = runner.largest_difference(curve, two.probes(), columns)
    runner.check(difference < 1e-6, f"one and two processes differ by {difference}")
    skins = [last_profile(results) for results in (one, two)]
    runner.check(len(skins[0]) == n_vertices, f"{len(skins[0])} vertices")
    runner.check([row["vertex"] for row in skins[0]] == [row["vertex"] for row in skins[1]], "order on two processes")
    difference = runner.largest_difference(*skins, COLUMNS[3:])
    runner.check(difference < 1e-6, f"profiles of one and two processes differ by {difference}")
    for row in skins[0]:
        runner.check(abs(row["distance"] - math.hypot(row["x"], row["z"])) < 1e-15, "distance from the axis")
    rest = [math.hypot(row["x"] - row["ux"], row["z"] - row["uz"]) for row in skins[0]]
    runner.check(all(a <= b + 1e-12 for a, b in zip(rest, rest[1:])), "not in the order of the distance at rest")
    runner.check(abs(skins[0][0]["depth"] - 0.001) < 1e-15, "under the needle")
    if scene == AROUND:
        runner.check(skins[0][0]["ux"] == 0, "the axis opens")

# A single vertex in three dimensions, vertically only and fully.
for displacement, slides in [("free; -0.0005*t; free", True), ("0; -0.0005*t; 0", False)]:
    vertex = {**block, "Motion/Of": "nearest to 0, 0, 0", "Motion/Displacement": displacement, "Corotation/Rotation": "none",
              "Probes/Points": "needle: 0, 0, 0", "Probes/Regions": "held: y < -0.00449 || abs(x) > 0.00599 || abs(z) > 0.00599"}
    row = runner.simulate(SOLID, vertex).probes()[-1]
    runner.check((abs(row["needle.ux"]) > 1e-9) == slides and (abs(row["needle.fx"]) > 1e-9) != slides, f"sliding: {row}")
    balanced(row, "needle", "held")

# In and out in time: the needle takes back what the skin did not dissipate.
moving = {**quiet, "Time/Problem": "dynamic", "Time/Step": 0.01, "Time/Steps": 60, "Corotation/Rotation": "polar",
          "Motion/Displacement": "free; -0.0018*sin(pi*t/0.3)^2; free", "Damping/Stiffness factor": 0.01}
history = runner.simulate(PLANE, moving).history()
size = max(row["elastic"] for row in history)
stray = max(abs(row["total"] + row["dissipated"] - row["work"]) for row in history) / size
runner.check(stray < 1e-10 and history[-1]["work"] > 0.1 * size, f"energies out of balance by {stray}")

for scene, settings, words in [
        (PLANE, {"Motion/Of": "nearest to 0.02, 0, 0"}, ["outside the body", "[-0.006, 0.006] x [-0.0045, 0] m", "0.014"]),
        (PLANE, {"Motion/Of": "nearest to 0, 0, 0.001"}, ["outside the body"]),
        (SOLID, {"Motion/Of": "nearest to 0, 1, 0"}, ["outside the body"]),
        (PLANE, {"Motion/Of": "region y > -1e-9 && abs(x) < -1"}, ["no vertex"]),
        (PLANE, {"Motion/Of": "nearest to 0.006, 0, 0"}, ["held or moved already along y"]),
        (PLANE, {"Probes/Profiles": "skin: 7"}, ["no boundary 7"]),
        (PLANE, {"Probes/Profiles": "skin: top"}, ["'top' is no boundary id"]),
        (PLANE, {"Probes/Profiles": "3"}, ["name: value"]),
        (PLANE, {"Probes/Profiles": "a: 3; a: 2"}, ["given twice"]),
        (PLANE, {"Probes/Profile every": 0}, ["1 or greater"]),
        (PLANE, {"Probes/Profile center": "0, 0"}, ["three values"]),
        (PLANE, {"Mesh/Layers": "0.0005, 0.004"}, ["ends 0.0005 m below the top", "0.00075 m high"])]:
    status, _, error = runner.run("--check", scene, *runner.overrides(settings))
    runner.check(status == 1 and all(word in error for word in words), f"{settings}: {status} {error}")

# Interrupted by what can't be solved, the profile is whole up to the last good step.
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
status, _, error = runner.run(AROUND, "--quiet", "--output", folder, "--set", "Time/Newton iterations=9",
                              "--set", "Time/Tangent=frozen")
failed = runner.Results(folder)
steps = len(failed.probes())
runner.check(status == 2 and 1 < steps < 21, f"{status}: {error}")
runner.check(len(failed.table("profile_skin.csv")) == steps * 25, "the profile is not whole")

# The delivered needle at 2 mm: its force, and no cell inside out on the way.
delivered = runner.simulate(SKIN / "needle.prm", {"Output/Frames": "none", "Time/Steps": 31})
deepest = min(delivered.probes(), key=lambda row: row["tip.uy"])
runner.check(abs(deepest["time"] - 0.5) < 1e-9 and abs(deepest["tip.uy"] + 0.002) < 1e-9, f"not at 2 mm: {deepest}")
runner.check(abs(deepest["needle.fy"] / -0.1633 - 1) < 0.005, f"{deepest['needle.fy']} N instead of -0.1633 N")
runner.check(delivered.summary()["extremes"]["most_inverted"] == 0, "cells are inside out")

# A flat punch without friction on a half-space: its exact force, approached from above with an order of 1.5 and more.
PUNCH = runner.ROOT / "parameters" / "validation" / "flat-punch.prm"
exact = 2 * 0.001 * 0.2e6 * 0.0001 / (1 - 0.3**2)
errors = []
for cubes in 8, 16:
    force = -4 * runner.simulate(PUNCH, {**quiet, "Mesh/Box cubes": f"{cubes}, {cubes}, {cubes}"}).probes()[-1]["punch.fy"]
    errors.append(force / exact - 1)
runner.check(0 < errors[1] < 0.12 and math.log2(errors[0] / errors[1]) > 1.5, f"flat punch: errors {errors}")
