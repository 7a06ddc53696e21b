"""The vein's tests as the thesis prints them: each scene has the numbers of its table, and tests 1 and 2 come to rest where an
independent model does. Data: data/vein. thesis_tests.csv has tables 4.1 to 4.5 of Valera (2002); thesis_rest.csv the extremes
of the cells' volume ratio and the mean displacement, six and eight decimals, after 1000 steps linear and 200 corotational."""

import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import run_folder
import runner

SCENES = runner.ROOT / "parameters" / "vein"
HELD = {"nothing": "", "top": "3", "bottom": "2", "both ends": "2, 3"}
ROTATION = {"linear": "none", "corotational": "polar"}
STATIC = {"Time/Problem": "static", "Time/Steps": 10, "Damping/Viscous": 0}
QUIET = {"Output/Frames": "none", "Output/Report": "false", "Space/Estimate error": "never"}


def table(name):
    with open(runner.DATA / "vein" / name) as file:
        return list(csv.DictReader(file))


def scene(test):
    return SCENES / f"thesis-{test}.prm"


def at_rest(test, held, model, settings=None):
    """Least and greatest volume ratio, and the mean displacement at the end."""
    results = runner.simulate(scene(test), {**QUIET, "Constraints/Clamped boundaries": HELD[held],
                                            "Corotation/Rotation": ROTATION[model], **(settings or {})})
    last, probes = results.history()[-1], results.probes()[-1]
    runner.check(last["kinetic"] < 1e-5 * max(1e-9, last["elastic"], results.history()[1]["elastic"]), f"test {test} still moves")
    return [last["min_volume_ratio"], last["max_volume_ratio"]], [probes["all.u" + axis] for axis in "xyz"]


def largest(found, expected):
    return max(abs(a - float(b)) for a, b in zip(found, expected))


# The scenes have the numbers that are printed, and the vertex goes where it should.
for row in table("thesis_tests.csv"):
    place = "" if row["vertex"] == "all" else "vertex: " + ", ".join(row[axis + "0"] for axis in "xyz")
    results = runner.simulate(scene(row["test"]), {**QUIET, "Time/Steps": 1, "Probes/Points": place})
    used = run_folder.parameters(results.folder)
    for entry, column in [("Material/Mass per vertex", "mass_per_vertex"), ("Damping/Viscous", "damping_per_vertex"), ("Time/Step", "dt"),
                          ("Material/Lame lambda", "lambda"), ("Material/Lame mu", "mu")]:
        runner.check(float(used[entry]) == float(row[column]), f"test {row['test']}: {entry} is {used[entry]}")
    runner.check(used["Corotation/Rotation"] == "none" and used["Constraints/Clamped boundaries"] == "", "not free and linear")
    if row["vertex"] == "all":
        continue
    runner.check(used["Motion/Of"] == f"vertex {row['vertex']}", f"test {row['test']}: {used['Motion/Of']}")
    moved = results.probes()[-1]
    found = [float(row[axis + "0"]) + moved[f"vertex.u{axis}"] for axis in "xyz"]
    off = largest(found, [row[axis + "1"] for axis in "xyz"])
    runner.check(off < 1e-6, f"test {row['test']}: the vertex is {off} from where it should be")    # places have six digits

# Tests 1 and 2 to the digits of the independent model. After 200 steps its corotational body of test 1 still swings by 2e-5: a
# longer run comes to the equilibrium of the static problem, which is as near to it as that swing.
worst = 0.0
for row in table("thesis_rest.csv"):
    swings = row["test"] == "1" and row["model"] == "corotational"
    steps = 200 if row["test"] == "2" and row["model"] == "corotational" else 1000
    ratios, mean = at_rest(row["test"], row["held"], row["model"], {"Time/Steps": steps})
    ratio = largest(ratios, [row["min_volume_ratio"], row["max_volume_ratio"]])
    motion = largest(mean, [row["centroid_" + axis] for axis in "xyz"])
    case = f"test {row['test']}, {row['held']} held, {row['model']}"
    runner.check(ratio < (5e-6 if swings else 6e-7), f"{case}: a volume ratio is off by {ratio}")
    runner.check(motion < (1.3e-5 if swings else 1.1e-8), f"{case}: the body is off by {motion}")
    worst = worst if swings else max(worst, motion)
    if row["held"] != "nothing":
        static = at_rest(row["test"], row["held"], row["model"], STATIC)
        runner.check(largest(ratios, static[0]) < 1e-9 and largest(mean, static[1]) < 1e-9, f"{case}: not the static equilibrium")

# A free corotational body ends as it was, only elsewhere; a free linear one that has turned has grown.
ratios, _ = at_rest(2, "nothing", "corotational", {"Time/Steps": 200})
runner.check(largest(ratios, [1, 1]) < 1e-9, f"free and corotational, but strained: {ratios}")

# Test 5: the force in its text turns cells inside out, that in its program does not; where it comes to rest follows by scale.
hard, soft = (at_rest(5, "both ends", "linear", {**STATIC, "Loads/Nodal force": f"0; 0; {force}*sin(10*pi*z/4.9)"}) for force in (10000, 1000))
runner.check(hard[0][0] < 0 < soft[0][0], f"test 5: {hard[0]}, {soft[0]}")
runner.check(abs(hard[1][2] / soft[1][2] - 10) < 1e-6, f"test 5: not linear, {hard[1][2]} and {soft[1][2]}")
print(f"mean displacements within {worst:.1e} of the independent model's")
