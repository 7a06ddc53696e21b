"""Jumps and kinks of loads and motions, and frames at intervals: variable steps end there."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
PLAIN = {"Output/Frames": "none", "Output/Report": "false", "Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0",
         "Constraints/Clamped boundaries": "", "Time/Variable steps": "true", "Time/Step": 0.02, "Time/Steps": 50}
METHODS = [{"Time/Method": "sdirk2"}, {"Time/Method": "trbdf2"}, {"Time/Method": "esdirk4"}, {"Time/Method": "imex5"},
           {"Time/Method": "explicit4", "Material/Mass": "lumped"}, {"Time/Method": "ida"}]


def times(results):
    return [row["time"] for row in results.history()]


def ends_at(results, instants, what):
    for instant in instants:
        runner.check(min(abs(time - instant) for time in times(results)) < 1e-9, f"{what}: no step ends at {instant}")


# A free bar of 192 m^3 at rest is struck for 4 ms: the momentum is that of the blow, whatever the method.
for text, instants in [("if(t > 0.5 && t < 0.504, 1e4, 0)", (0.5, 0.504)), ("1e4*(abs(t - 0.502) <= 0.002)", (0.5, 0.504)),
                       ("if(2*t > 1, 1e4, 0) - if(t >= 0.504, 1e4, 0)", (0.5, 0.504))]:
    for method in METHODS:
        results = runner.simulate(runner.BAR, {**PLAIN, **method, "Loads/Body force": f"0; 0; {text}"})
        momentum, expected = results.history()[-1]["pz"], 1e4 * 192 * 0.004
        print(f"{text}, {method['Time/Method']}: momentum {momentum}, {len(times(results))} rows")
        runner.check(abs(momentum / expected - 1) < 1e-6, f"{text}, {method}: momentum {momentum}, not {expected}")
        ends_at(results, instants, f"{text}, {method}")
        runner.check(not results.summary()["warnings"], f"{text}, {method}: {results.summary()['warnings']}")
        last = results.history()[-1]
        runner.check(abs(last["total"] + last["dissipated"] - last["work"]) < 1e-9 * last["kinetic"], f"{method}: out of balance")
        # Backward differentiation begins anew with order 1, which moves a body that is pushed from rest too far.
        runner.check(method["Time/Method"] == "ida" or abs(last["dissipated"]) < 1e-3 * last["kinetic"], f"{method}: dissipated {last['dissipated']}")

# A motion with kinks, and a load with many jumps.
moved = {**PLAIN, "Motion/Of": "region y == 0", "Motion/Displacement": "free; free; 0.1*min(t/0.13, 1)", "Probes/Regions": "end: y == 0"}
for method in METHODS:
    results = runner.simulate(runner.BAR, {**moved, **method, "Time/Steps": 10})
    ends_at(results, [0.13], f"kink, {method}")
    for row in results.probes():
        if row["time"] > 0.13 + 1e-9:
            runner.check(abs(row["end.vz"]) < 1e-6, f"{method}: it moves on after the kink, {row['end.vz']}")
steps = runner.simulate(runner.BAR, {**PLAIN, "Time/Method": "trbdf2", "Loads/Body force": "0; 0; 1e3*(floor(t/0.07) - 2*floor(t/0.14))", "Time/Steps": 20})
ends_at(steps, [0.07 * k for k in range(1, 6)], "a square wave")

# Fixed steps can't: they warn.
fixed = runner.simulate(runner.BAR, {**PLAIN, "Time/Method": "backward euler", "Time/Variable steps": "false",
                                     "Loads/Body force": "0; 0; if(t > 0.501 && t < 0.504, 1e4, 0)"})
runner.check(any("stepped over" in text for text in fixed.summary()["warnings"]), f"{fixed.summary()['warnings']}")

# Frames at intervals are at their times.
for method in METHODS:
    results = runner.simulate(runner.BAR, {**PLAIN, **method, "Constraints/Clamped boundaries": 4, "Loads/Gravity": "0, 0, -9.81",
                                           "Output/Frames": "interval", "Output/Interval": 0.03, "Time/Steps": 10})
    found = results.frame_times()
    runner.check(len(found) == 8 and all(abs(time - 0.03 * k) < 1e-9 for k, time in enumerate(found[:7])), f"{method}: frames at {found}")
