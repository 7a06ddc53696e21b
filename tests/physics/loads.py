"""Traction, pressure and nodal forces against exact solutions, on one process and two."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

CYLINDER = runner.ROOT / "parameters" / "validation" / "thick-cylinder.prm"

# Lame's thick-walled cylinder in plane strain: the error falls at second order.
EXACT = 1.906667e-3
errors = []
for refinement in [1, 2, 4]:
    finer = {"Mesh/Cylinder sectors": 32 * refinement, "Mesh/Cylinder layers": 4 * refinement,
             "Mesh/Cylinder height": 0.4 / refinement}
    dead = runner.simulate(CYLINDER, finer).probes()[-1]["inner.ux"]
    errors.append(abs(dead / EXACT - 1))
orders = [math.log2(coarse / fine) for coarse, fine in zip(errors, errors[1:])]
runner.check(min(orders) > 1.85 and errors[-1] < 0.004, f"errors {errors}, orders {orders}")
follower = runner.simulate(CYLINDER, {**finer, "Loads/Pressure follows": "true"}).probes()[-1]["inner.ux"]
runner.check(abs(follower / EXACT - 1) < 0.005, f"follower pressure {follower}, exact for dead pressure {EXACT}")
runner.check(abs(follower / dead - 1) < 0.005, f"follower pressure {follower}, dead pressure {dead}")
print(f"errors {errors}, orders {orders}, follower over dead {follower / dead}")
runner.check(follower > dead * (1 + 1e-4), "the pressure does not follow the widening wall")

# A bar between planes of symmetry, pulled with 1e5 Pa: exact for linear tetrahedra.
symmetric = {"Constraints/Clamped boundaries": "", "Constraints/Boundaries held along x": 0,
             "Constraints/Boundaries held along y": 2, "Constraints/Boundaries held along z": 4,
             "Loads/Gravity": "0, 0, 0", "Probes/Points": "far: 4, 12, 4", "Probes/Boundaries": "end: 2; side: 0"}
pulled = {**symmetric, "Loads/Traction": "0; 1e5; 0", "Loads/Traction on": 3}
pressed = {**symmetric, "Loads/Pressure": "1e5", "Loads/Pressure on": "0, 1, 2, 3, 4, 5", "Loads/Pressure follows": "false"}
E, NU = 100e6, 0.33
for settings, expected, force in [
        (pulled, [-NU * 1e5 / E * 4, 1e5 / E * 12, -NU * 1e5 / E * 4], -1e5 * 16),
        (pressed, [-(1 - 2 * NU) * 1e5 / E * length for length in (4, 12, 4)], 0)]:
    for ranks in [1, 2]:
        last = runner.simulate(runner.STATIC, {**settings, "Solver/Tolerance": 1e-12}, ranks=ranks).probes()[-1]
        for direction, value in zip("xyz", expected):
            found = last["far.u" + direction]
            runner.check(abs(found / value - 1) < 1e-9, f"{direction}: {found} instead of {value} on {ranks} ranks")
        runner.check(abs(last["end.fy"] - force) < 1e-3, f"reaction {last['end.fy']} instead of {force}")

# Nodal forces: the clamp bears their sum.
nodal = {"Loads/Nodal force": "1000; 0; 10*y", "Loads/Gravity": "0, 0, 0", "Loads/Nodal force on": "region y < 1"}
last = runner.simulate(runner.STATIC, nodal).probes()[-1]
runner.check(abs(last["clamp.fx"] + 9 * 1000) < 1e-4 and abs(last["clamp.fz"]) < 1e-4, f"nodal forces: {last}")

# Pressure all around does not move a free body, wherever it has turned to.
spinning = {"Constraints/Clamped boundaries": "", "Loads/Gravity": "0, 0, 0", "Start/Velocity": "2*(y - 6); -2*(x - 2); 0",
            "Loads/Pressure": "1e6*sin(9*t)", "Loads/Pressure on": "0, 1, 2, 3, 4, 5", "Time/Steps": 40,
            "Solver/Tolerance": 1e-12}
one, two = (runner.simulate(runner.BAR, spinning, ranks=ranks).history() for ranks in (1, 2))
largest = max(abs(row["lz"]) for row in one)
runner.check(max(abs(row[p]) for row in one for p in ("px", "py", "pz")) < 1e-9 * largest, "pressure moves the body")
runner.check(runner.largest_difference(one, two, ["lz", "elastic", "kinetic", "work", "dissipated"]) < 1e-8, "ranks")
start = one[0]["total"]
stray = max(abs(row["total"] + row["dissipated"] - row["work"] - start) for row in one) / start
runner.check(stray < 1e-10, f"energies out of balance by {stray}")

# Gravity that changes in time is a body force; its potential and the work of its change balance.
plain = {"Start/Velocity": "0; 0; 0", "Time/Steps": 40, "Solver/Tolerance": 1e-12, "Probes/Points": "tip: 2, 0, 2"}
ramp = "9.81*min(t/0.4, 1)"
falls = runner.simulate(runner.BAR, {**plain, "Loads/Gravity": f"0; 0; -{ramp}"})
pushed = runner.simulate(runner.BAR, {**plain, "Loads/Gravity": "0, 0, 0", "Loads/Body force": f"0; 0; -1000*{ramp}"})
for one, two in zip(falls.probes(), pushed.probes()):
    runner.check(abs(one["tip.uz"] - two["tip.uz"]) < 1e-9, f"at {one['time']}: gravity {one['tip.uz']}, body force {two['tip.uz']}")
runner.check(abs(falls.probes()[-1]["tip.uz"]) > 0.01, "gravity moves nothing")
for method in ["backward euler", "trbdf2"]:
    rows = runner.simulate(runner.BAR, {**plain, "Loads/Gravity": f"0; 0; -{ramp}", "Time/Method": method}).history()
    largest = max(row["kinetic"] + row["elastic"] for row in rows)
    stray = max(abs(row["total"] + row["dissipated"] - row["work"]) for row in rows) / largest
    runner.check(stray < 1e-9, f"{method}: energies out of balance by {stray}")
    runner.check(rows[-1]["work"] < -1e-3 * largest, f"{method}: the change of gravity does no work")
    runner.check(rows[-1]["dissipated"] > 0, f"{method}: dissipated {rows[-1]['dissipated']}")
constant = [runner.simulate(runner.BAR, {**plain, "Loads/Gravity": gravity}).history() for gravity in ("0, 0, -9.81", "0; 0; -9.81")]
runner.check(runner.largest_difference(*constant, ["potential", "elastic", "kinetic"]) == 0, "expressions differ from numbers")

for settings, words in [({"Loads/Pressure": 1}, "acts nowhere"), ({"Loads/Traction": "1; 0; 0"}, "acts nowhere"),
                        ({"Loads/Pressure": 1, "Loads/Pressure on": 9}, "no boundary 9"),
                        ({"Loads/Pressure": "x; 1", "Loads/Pressure on": 1}, "found 2"),
                        ({"Loads/Nodal force": "1; 0; 0", "Loads/Nodal force on": "vertex 99"}, "from 0 to 80"),
                        ({"Loads/Traction": "1/x; 0; 0", "Loads/Traction on": 0}, "not finite"),
                        ({"Loads/Gravity": "0; 0; -1/t"}, "not a finite"), ({"Loads/Gravity": "0; -9.81"}, "found 2"),
                        ({"Loads/Gravity": "0, 0, -min(t, 1)"}, "three expressions")]:
    status, _, error = runner.run("--check", runner.BAR, *runner.overrides(settings))
    runner.check(status == 1 and words in error, f"{settings}: {status} {error}")

# A pulse between the ends of fixed steps is told; what steps follow is not.
still = {"Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0", "Output/Frames": "none", "Time/Step": 0.02, "Time/Steps": 50}
pulse = "if(t > 0.501 && t < 0.505, 1e6, 0)"  # variable steps find it, and a smooth one
smooth = "1e6*exp(-((t - 0.503)/0.001)^2)"
moved = {"Motion/Of": "boundary 1", "Constraints/Clamped boundaries": 0}
for settings, told in [({"Loads/Body force": f"0; 0; {pulse}"}, "Loads/Body force rises and falls by 1e+06"),
                       ({"Loads/Body force": f"0; 0; {smooth}", "Time/Method": "esdirk4", "Time/Variable steps": "true"}, ""),
                       ({"Loads/Body force": f"0; 0; {smooth}", "Time/Method": "ida"}, ""),
                       ({"Loads/Body force": f"0; 0; {pulse}", "Time/Method": "esdirk4", "Time/Variable steps": "true"}, ""),
                       ({"Loads/Body force": f"0; 0; {pulse}", "Time/Method": "ida"}, ""),
                       ({"Loads/Traction": f"0; 0; 1e7 - x*{pulse}", "Loads/Traction on": 1}, "Loads/Traction"),
                       ({"Loads/Pressure": "1e3*exp(-((t - 0.51)/0.002)^2)", "Loads/Pressure on": 1}, "Loads/Pressure"),
                       ({"Loads/Nodal force": "0; 0; sin(300*t)"}, "Loads/Nodal force"),
                       ({"Loads/Gravity": f"0; 0; -1e-6*{pulse}"}, "Loads/Gravity"),
                       ({"Loads/Body force": f"0; 0; if(x > 0.2 && x < 0.8, {pulse}, 0)"}, "Loads/Body force"),
                       ({"Loads/Body force": f"0; 0; if(y > 9 && y < 10 && z < 1, {pulse}, 0)"}, "Loads/Body force"),
                       ({**moved, "Motion/Displacement": f"free; free; 1e-8*{pulse}"}, "Motion/Displacement"),
                       ({"Loads/Body force": f"0; 0; {pulse}", "Time/Step": 0.001, "Time/Steps": 520}, ""),
                       ({"Loads/Body force": "0; 0; 1e3*sin(20*t) + if(t > 0.55, 1e3, 0)"}, ""),
                       ({"Loads/Gravity": "0; 0; -9.81*min(t/0.1, 1)"}, "")]:
    warnings = [text for text in runner.simulate(runner.BAR, {**still, **settings}).summary()["warnings"] if "rises and falls" in text]
    runner.check(bool(warnings) == bool(told) and all(told in text for text in warnings), f"{settings}: {warnings}")
