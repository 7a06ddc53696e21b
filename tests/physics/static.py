"""Corotational equilibrium from tiny to large loads, and what a failed step leaves behind."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

linear = runner.simulate(runner.STATIC, {})
sag = linear.probes()[-1]["n28.uz"]

# The smaller the load, the closer to linear elasticity; round-off must not stop Newton's method.
for gravity in [9.81, 1, 1e-2, 1e-4, 1e-6]:
    for solver in ["ldlt", "cg-ml"]:
        results = runner.simulate(runner.STATIC, {"Corotation/Rotation": "polar", "Loads/Gravity": f"0, 0, -{gravity}",
                                                  "Solver/Method": solver, "Solver/Tolerance": 1e-10})
        found = results.probes()[-1]["n28.uz"] / (sag * gravity / 9.81)
        runner.check(abs(found - 1) < 5e-4 * gravity + 1e-5, f"gravity {gravity}, {solver}: {found} of the linear sag")

# A body that starts far from its equilibrium is measured as it is, and finds the same equilibrium.
start = {"Corotation/Rotation": "polar", "Start/Displacement": "0; 0; 0.05*(y - 12)*(y - 12)"}
bent = runner.simulate(runner.STATIC, start)
dynamic = runner.simulate(runner.STATIC, {**start, "Time/Problem": "dynamic", "Time/Steps": 1})
runner.check(bent.history()[0]["elastic"] == dynamic.history()[0]["elastic"], "the energy at the start")
straight = runner.simulate(runner.STATIC, {"Corotation/Rotation": "polar"})
difference = abs(bent.probes()[-1]["n28.uz"] - straight.probes()[-1]["n28.uz"])
runner.check(difference < 1e-7, f"another equilibrium, {difference} m away")
home = runner.simulate(runner.STATIC, {**start, "Loads/Gravity": "0, 0, 0"})
runner.check(abs(home.probes()[-1]["n28.uz"]) < 1e-9, "without a load it does not come home")

# A failed step leaves the state before it.
folder = tempfile.mkdtemp(prefix="supple-")
settings = {"Corotation/Rotation": "polar", "Loads/Gravity": "0, 0, -300", "Time/Steps": 4, "Output/Frames": "every",
            "Time/Newton iterations": 10, "Time/Tangent": "frozen"}
status, _, error = runner.run(runner.STATIC, "--output", folder, *runner.overrides(settings))
runner.check(status == 2 and "Step " in error, error)
failed = runner.Results(folder)
good = len(failed.history()) - 1
again = runner.simulate(runner.STATIC, {**settings, "Time/Newton iterations": 100})
runner.check(1 <= good < 4 and len(failed.frame_times()) == good + 1, f"{good} good steps")
name = f"solution/frame_{good:04}.vtu"
runner.check((failed.folder / name).read_bytes() == (again.folder / name).read_bytes(), "the last frame after a failure is not that of the last good step")

# The work of loads and of moved boundaries is what the body keeps, whatever the number of load steps.
bar = {"Corotation/Rotation": "none", "Loads/Gravity": "0, 0, 0", "Solver/Tolerance": 1e-12}
for name, settings in {"traction": {"Loads/Traction": "0; 1e5; 2e5", "Loads/Traction on": 1}, "body force": {"Loads/Body force": "0; 0; 1e3"},
                       "pressure": {"Loads/Pressure": 1e5, "Loads/Pressure on": 5, "Loads/Pressure follows": "false"},
                       "motion": {"Motion/Of": "region y < 0.01", "Motion/Displacement": "0; free; 0.1*t"},
                       "both": {"Motion/Of": "region y < 0.01", "Motion/Displacement": "0; free; 0.1*t", "Loads/Body force": "0; 0; -2e3"},
                       "gravity": {"Loads/Gravity": "0, 0, -9.81"}}.items():
    for steps in [1, 2, 7]:
        for last in runner.simulate(runner.STATIC, {**bar, **settings, "Time/Steps": steps}).history():
            stray = abs(last["total"] + last["dissipated"] - last["work"])
            runner.check(stray < 1e-8 * last["elastic"] + 1e-12, f"{name}, {steps} load steps: {last}")
        runner.check(last["elastic"] > 1e-3 and abs(last["potential"]) == (0 if name != "gravity" else -last["potential"]), f"{last}")

# Of large motions to the second order of the load step.
large = {"Corotation/Rotation": "polar", "Loads/Gravity": "0, 0, 0", "Motion/Of": "region y < 0.01", "Motion/Displacement": "0; free; 4*t"}
strays = []
for steps in [4, 8]:
    last = runner.simulate(runner.STATIC, {**large, "Time/Steps": steps}).history()[-1]
    strays.append(abs(last["work"] / last["elastic"] - 1))
runner.check(strays[0] < 0.05 and strays[1] < 0.5 * strays[0], f"the work of large motions is off by {strays}")
