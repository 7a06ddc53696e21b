"""Time/Estimate error: the error by step doubling is close to the true one, and costs nothing where nobody asks."""

import pathlib
import sys

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
runner.check(status == 0 and "% of the motion" in output and "half the step" in output, output + error)

# Variable steps are compared where both runs have the same time: one that fails before knows no error, and tells none of 0.
failing = {**SMOOTH, "Time/Method": "esdirk4", "Time/Variable steps": "true", "Time/Estimate error": "true",
           "Loads/Body force": "if(t > 0.1, 1/0, 0); 0; 0"}
status, _, _ = runner.run(runner.BAR, "--quiet", "--output", results.folder, *runner.overrides(failing))
doubling = results.summary()["error_estimate"]["step_doubling"]
unknown = "no time in common" in doubling.get("failed", "") and "largest" not in doubling
runner.check(status == 2 and (unknown or doubling["largest"] > 0), f"{status} {doubling}")

status, _, error = runner.run(runner.STATIC, "--set", "Time/Estimate error=true")
runner.check(status == 1 and "Time/Estimate error = true" in error and "static" in error, error)
