"""Time/Estimate error: the error by step doubling is close to the true one, and costs nothing where nobody asks."""

import math
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

SMOOTH = {"Start/Velocity": "0; 0; -0.14*(12-y)^2", "Loads/Gravity": "0, 0, 0", "Output/Frames": "none",
          "Probes/Points": "n0: 0, 0, 0; n2: 4, 0, 0; n54: 0, 0, 4; n56: 4, 0, 4"}
END = 0.14


def run(n_steps, **more):
    return runner.simulate(runner.BAR, {**SMOOTH, "Time/Step": END / n_steps, "Time/Steps": n_steps,
                                        **{key.replace("__", "/").replace("_", " "): value for key, value in more.items()}})


def largest_distance(first, second):
    """Of the followed vertices, which are among those that move most; the second run has more rows."""
    factor = (len(second) - 1) // (len(first) - 1)
    names = [column[:-3] for column in first[0] if column.endswith(".ux")]
    return max(sum((a[f"{name}.u{d}"] - b[f"{name}.u{d}"]) ** 2 for d in "xyz") ** 0.5
               for a, b in zip(first, second[::factor]) for name in names)


fine = run(1600, Time__Method="esdirk5").probes()
for method, n_steps in [("backward euler", 800), ("backward euler", 1600), ("trbdf2", 200), ("esdirk3", 100)]:
    results = run(n_steps, Time__Method=method, Time__Estimate_error="true")
    true_error = largest_distance(results.probes(), fine)
    estimate = results.summary()["error_estimate"]["step_doubling"]
    runner.check(abs(estimate["largest"] / true_error - 1) < 0.3, f"{method}: {estimate} beside {true_error} m")
    motion = results.summary()["error_estimate"]["largest_motion"]
    runner.check(abs(estimate["relative"] - estimate["largest"] / motion) < 1e-12, f"relative: {estimate}")
    rows = results.table("error.csv")
    largest = max(row["error"] for row in rows)
    runner.check(len(rows) == n_steps and abs(largest / estimate["largest"] - 1) < 1e-12 and
                 abs(rows[-1]["error"] / estimate["at_the_end"] - 1) < 1e-12, "error.csv")

# Where steps are too long a third run tells the order: near to that of the method it corrects the estimate, far below it the
# estimate is a lower bound.
for method, n_steps in [("backward euler", 25), ("backward euler", 10), ("backward euler", 5), ("trbdf2", 3)]:
    results = run(n_steps, Time__Method=method, Time__Estimate_error="true")
    doubling, motion = results.summary()["error_estimate"]["step_doubling"], results.summary()["error_estimate"]["largest_motion"]
    true_error = largest_distance(results.probes(), fine)
    print(f"{method}, {n_steps} steps: {doubling} beside {true_error} m of {motion} m")
    runner.check(("order" in doubling) == (doubling.get("by_second_run", doubling["largest"]) > 0.1 * motion), f"a third run: {doubling}")
    if doubling.get("at_least"):
        runner.check(0.5 * true_error < doubling["largest"] < 1.05 * true_error, f"at least {doubling} beside {true_error} m")
    else:
        runner.check(abs(doubling["largest"] / true_error - 1) < 0.35, f"{doubling} beside {true_error} m")
BEAM = {"Mesh/Box size": "0.3, 0.04, 0.04", "Mesh/Box cubes": "15, 2, 2", "Material/Young modulus": 1e6, "Material/Poisson ratio": 0.4,
        "Constraints/Clamped boundaries": 0, "Probes/Points": "tip: 0.3, 0.02, 0.02", "Loads/Gravity": "0, 0, -9.81",
        "Corotation/Rotation": "none", "Time/Estimate error": "true", "Output/Frames": "none"}
hanging = runner.simulate(runner.BAR, {**BEAM, "Time/Step": 0.005, "Time/Steps": 200})
right = runner.simulate(runner.BAR, {**BEAM, "Time/Estimate error": "false", "Time/Method": "esdirk5", "Time/Step": 0.005, "Time/Steps": 200})
doubling = hanging.summary()["error_estimate"]["step_doubling"]
true_error = max(abs(a["tip.uz"] - b["tip.uz"]) for a, b in zip(hanging.probes(), right.probes()))
runner.check(doubling["at_least"] and doubling["order"] < 0.7 and 0.5 * true_error < doubling["largest"] < true_error,
             f"a swing damped by its method: {doubling} beside {true_error} m")

# Steps that are longer than the swings take the whole motion at once, and so do half the steps: the energy tells it.
LONG = {"Mesh/Box size": "1, 4, 1", "Mesh/Box cubes": "2, 8, 2", "Material/Young modulus": 1e9, "Constraints/Clamped boundaries": 3,
        "Start/Velocity": "0; 0; 0", "Probes/Points": "tip: 0, 0, 0", "Output/Frames": "none", "Output/Report": "false", "Time/Steps": 10}
for method, step in [("backward euler", 1), ("esdirk3", 10)]:
    for doubled in ("true", "false"):
        folder = tempfile.mkdtemp(prefix="supple-")
        settings = {**LONG, "Time/Method": method, "Time/Step": step, "Time/Estimate error": doubled}
        status, output, error = runner.run(runner.BAR, "--output", folder, *runner.overrides(settings))
        runner.check(status == 0 and re.search(r"error: in time .*more than (4\d|50) % of the motion", output), f"{method}, {step} s: {output}{error}")

# Fixed steps sum up what the embedded formula says, as variable steps do: in one step the two agree, and the error falls with
# the order of the embedded formula at least (the body starts without force).
def local_error(method, step, **more):
    settings = {**SMOOTH, "Time/Method": method, "Time/Step": step, "Time/Steps": 1, "Time/Newton tolerance": 1e-13,
                **{key.replace("__", "/").replace("_", " "): value for key, value in more.items()}}
    return runner.simulate(runner.BAR, settings).summary()["error_estimate"]["sum_of_local_errors"]


LOOSE = {"Time__Variable_steps": "true", "Time__Relative_tolerance": 0.9, "Time__Displacement_tolerance": 1e6, "Time__Velocity_tolerance": 1e9}
for method, order in [("sdirk2", 2), ("trbdf2", 3), ("esdirk3", 3), ("esdirk4", 4), ("esdirk5", 5)]:
    fixed, variable = local_error(method, 1e-3), local_error(method, 1e-3, **LOOSE)
    runner.check(abs(fixed / variable - 1) < 1e-2, f"{method}: {fixed}, {variable} m")
    if order < 5:  # where the error is above round-off
        observed = math.log2(local_error(method, 4e-4) / local_error(method, 2e-4))
        runner.check(observed > order - 0.5, f"{method}: order {observed}")
runner.check(local_error("implicit midpoint", 1e-3) is None, "implicit midpoint has no embedded formula")

# Variable steps are compared at the end.
for method in ["esdirk4", "ida"]:
    tolerances = {"Time__Method": method, "Time__Variable_steps": "true", "Time__Relative_tolerance": 1e-4}
    results = run(50, **tolerances, Time__Estimate_error="true")
    estimate = results.summary()["error_estimate"]["step_doubling"]
    last, right = results.probes()[-1], fine[-1]
    true_error = max(sum((last[f"{n}.u{d}"] - right[f"{n}.u{d}"]) ** 2 for d in "xyz") ** 0.5 for n in ["n0", "n2", "n54", "n56"])
    runner.check(0.5 < estimate["at_the_end"] / true_error < 2.5, f"{method}: {estimate} beside {true_error} m")
    runner.check(len(results.table("error.csv")) == 1, f"{method}: error.csv")

# It changes nothing of the run itself, and is not there unless asked for.
plain, estimated = run(100), run(100, Time__Estimate_error="true")
runner.check(plain.probes() == estimated.probes(), "the run itself is another one")
runner.check("step_doubling" not in plain.summary()["error_estimate"] and not (plain.folder / "error.csv").exists(),
             "an estimate nobody asked for")
built, again = plain.summary()["built"], estimated.summary()["built"]
runner.check(built == again, f"{built} {again}")

# On two processes it is the same.
two = runner.simulate(runner.BAR, {**SMOOTH, "Time/Estimate error": "true", "Time/Step": END / 100, "Time/Steps": 100,
                                   "Solver/Tolerance": 1e-12}, ranks=2)
first, second = (results.summary()["error_estimate"]["step_doubling"]["largest"] for results in (estimated, two))
runner.check(abs(first - second) < 1e-6 * first, f"two processes: {first}, {second}")

# A second run that fails leaves the first one its results.
failing = {**SMOOTH, "Time/Step": 0.07, "Time/Steps": 10, "Time/Retries": 0, "Loads/Body force": "if(abs(t - 0.105) < 0.01, 1/0, 0); 0; 0"}
results = runner.simulate(runner.BAR, {**failing, "Time/Estimate error": "true"})
summary = results.summary()
runner.check(summary["status"] == "done" and "finite" in summary["error_estimate"]["step_doubling"]["failed"], f"{summary}")
status, output, error = runner.run(runner.BAR, "--output", results.folder, "--set", "Time/Estimate error=true", *runner.overrides(SMOOTH))
runner.check(status == 0 and "% of the motion" in output and "half and a quarter of the step" in output, output + error)

# Variable steps are compared where both runs have the same time: one that fails before knows no error, and tells none of 0.
failing = {**SMOOTH, "Time/Method": "esdirk4", "Time/Variable steps": "true", "Time/Estimate error": "true",
           "Loads/Body force": "if(t > 0.1, 1/0, 0); 0; 0"}
status, _, _ = runner.run(runner.BAR, "--quiet", "--output", results.folder, *runner.overrides(failing))
doubling = results.summary()["error_estimate"]["step_doubling"]
unknown = "no time in common" in doubling.get("failed", "") and "largest" not in doubling
runner.check(status == 2 and (unknown or doubling["largest"] > 0), f"{status} {doubling}")

status, _, error = runner.run(runner.STATIC, "--set", "Time/Estimate error=true")
runner.check(status == 1 and "Time/Estimate error = true" in error and "static" in error, error)
