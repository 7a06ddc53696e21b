"""The energy guard: what rises is counted, and steps that raise the energy are done again."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

fast = {"Start/Velocity": "0; 0; -400", "Output/Frames": "none", "Solver/Tolerance": 1e-12}


def rises(history):
    """Steps in which total - work rose."""
    balance = [row["total"] - row["work"] for row in history]
    size = max(abs(value) for value in balance)
    return sum(after > before + 1e-9 * size for before, after in zip(balance, balance[1:]))


off = runner.simulate(runner.BAR, fast)
runner.check(rises(off.history()) > 0, "frozen rotations at 400 m/s raise the energy")
runner.check(off.summary()["extremes"]["energy_rises"] == rises(off.history()), "the count of the summary")
runner.check(not any("energy" in text for text in off.summary()["warnings"]), "a warning nobody asked for")

warned = runner.simulate(runner.BAR, {**fast, "Time/Energy guard": "warn"})
runner.check("the total energy rose" in " ".join(warned.summary()["warnings"]), "no warning")
runner.check(warned.history()[-1]["total"] == off.history()[-1]["total"], "a warning changes the motion")

guarded = runner.simulate(runner.BAR, {**fast, "Time/Energy guard": "reject"})
runner.check(rises(guarded.history()) == 0 and guarded.summary()["rejected_steps"] > 0, "the energy rises")
runner.check(guarded.history()[-1]["time"] > 6.999, "it did not come to its end")

# With work from outside, and moved vertices, nothing is rejected that need not be.
shaken = {"Start/Velocity": "0; 0; 0", "Motion/Of": "region y == 0", "Motion/Displacement": "0; 0; sin(3*t)",
          "Time/Steps": 40, "Output/Frames": "none", "Time/Energy guard": "reject"}
plain = runner.simulate(runner.BAR, {**shaken, "Time/Energy guard": "off"})
guarded = runner.simulate(runner.BAR, shaken)
runner.check(guarded.summary()["rejected_steps"] == 0, "steps were rejected")
difference = runner.largest_difference(plain.history(), guarded.history(), ["total", "work", "dissipated"])
runner.check(difference < 1e-9, f"the guard changes the motion by {difference}")

# A load that ends with a step: it has ended in the solution where it has in the work.
ending = {"Start/Velocity": "0; 0; 0", "Corotation/Rotation": "none", "Loads/Gravity": "0, 0, 0",
          "Loads/Body force": "0; 0; if(t < 3.5, -9810, 0)", "Output/Frames": "none", "Time/Energy guard": "reject"}
summary = runner.simulate(runner.BAR, ending).summary()
runner.check(summary["extremes"]["energy_rises"] == 0 and summary["rejected_steps"] == 0, f"a load that ends: {summary}")

status, _, error = runner.run("--check", runner.BAR, *runner.overrides(
    {"Time/Energy guard": "reject", "Time/Method": "ida"}))
runner.check(status == 1 and "only fixed steps can be done again" in error, error)

# Energy from nowhere in one step, which damping takes away again until the end, is told; and after a restart too.
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
pressed = {"Mesh/Box size": "0.05, 0.02, 0.005", "Mesh/Box cubes": "10, 4, 1", "Material/Young modulus": 1e7, "Material/Poisson ratio": 0.4,
           "Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0", "Constraints/Clamped boundaries": 0, "Loads/Pressure on": 5,
           "Probes/Points": "", "Probes/Boundaries": "", "Output/Frames": "none", "Time/Step": 0.05, "Time/Steps": 4, "Checkpoint/Every": 2}
for pressure, told in [(1e4, "it is not to be trusted"), (3e3, "")]:
    entries = {**pressed, "Loads/Pressure": f"{pressure}*min(t/0.05, 1)"}
    for more in [{}, {"Time/Steps": 6, "Checkpoint/Resume": "auto"}]:
        status, _, error = runner.run(runner.BAR, "--quiet", "--output", folder / f"{pressure}", *runner.overrides({**entries, **more}))
        runner.check(status == 0, error)
        results = runner.Results(folder / f"{pressure}")
        warnings = [text for text in results.summary()["warnings"] if "The time stepping added" in text]
        runner.check(bool(warnings) == bool(told) and all(told in text for text in warnings), f"{pressure} Pa: {warnings}")
        rows = results.history()
        gained = max(max(row["dissipated"] for row in rows[:i + 1]) - rows[i]["dissipated"] for i in range(len(rows)))
        found = results.summary()["extremes"]["energy_gained"]
        runner.check(abs(found - gained) <= 1e-9 * rows[-1]["elastic"], f"{pressure} Pa: {found} J instead of {gained} J")
