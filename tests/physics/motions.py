"""Prescribed motions: they are followed exactly, their reactions and their work are right."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

free = {"Constraints/Clamped boundaries": "", "Start/Velocity": "0; 0; 0", "Probes/Boundaries": "end: 2",
        "Probes/Regions": "moved: y == 0", "Solver/Tolerance": 1e-12, "Output/Frames": "none"}


def balance(history):
    """How far total + dissipated - work strays, over the largest energy."""
    size = max(abs(row[name]) for row in history for name in ("kinetic", "elastic", "potential", "work"))
    sums = [row["total"] + row["dissipated"] - row["work"] for row in history]
    return max(abs(value - sums[0]) for value in sums) / size


# Moved as it falls by itself (backward Euler's parabola), a vertex bears no force.
fall = {**free, "Motion/Of": "vertex 0", "Motion/Displacement": "0; 0; if(t < 0.01, 0, -4.905*t*(t + 0.07))",
        "Time/Steps": 20} # from rest
probes = runner.simulate(runner.BAR, fall).probes()
for row in probes:
    runner.check(abs(row["n56.uz"] + 4.905 * row["time"] * (row["time"] + 0.07)) < 1e-8, "it does not fall freely")
    runner.check(abs(row["n0.fz"]) < 1e-2, f"a force of {row['n0.fz']} N on a body of 1.9 MN")

# All of it moved: no strain, and the force is mass times acceleration.
swing = {**free, "Motion/Of": "all", "Motion/Displacement": "sin(t); 0; 0", "Loads/Gravity": "0, 0, 0",
         "Probes/Regions": "body: y < 13", "Time/Steps": 30}
results = runner.simulate(runner.BAR, swing)
for row, last in zip(results.probes()[1:], results.probes()):
    force = 192000 * (row["body.vx"] - last["body.vx"]) / 0.07
    runner.check(abs(row["body.fx"] - force) < 1e-6 * 192000, f"force {row['body.fx']}, mass times acceleration {force}")
runner.check(max(row["elastic"] for row in results.history()) < 1e-6, "a rigid motion strains the body")

# The same with a mass of its own at each vertex, which gravity pulls at.
swing = {**swing, "Material/Mass per vertex": 50, "Loads/Gravity": "0, 0, -9.81"}
results = runner.simulate(runner.BAR, swing)
for row, last in zip(results.probes()[1:], results.probes()):
    force = 81 * 50 * (row["body.vx"] - last["body.vx"]) / 0.07
    runner.check(abs(row["body.fx"] - force) < 1e-6 * 4050, f"force {row['body.fx']}, mass times acceleration {force}")
    runner.check(abs(row["body.fz"] - 81 * 50 * 9.81) < 1e-6 * 4050, f"weight {row['body.fz']}")

# Clamped at one end, shaken at the other in one direction, with everything that can enter the balance.
for rotation in ["none", "gram-schmidt", "polar"]:
    for damping, mass, motion in [(0, 0, "free; free; 2*sin(3*t)"), (1, 0, "free; free; 2*sin(3*t)"),
                                  (1, 0, "0; 0.1*t; 2*sin(3*t)"), (1, 2000, "free; free; 2*sin(3*t)")]:
        shaken = {"Motion/Displacement": motion, "Corotation/Rotation": rotation, "Motion/Of": "region y == 0",
                  "Material/Mass per vertex": mass,
                  "Damping/Mass factor": 0.3 * damping,
                  "Damping/Stiffness factor": 0.002 * damping, "Damping/Viscous": 300 * damping,
                  "Loads/Body force": "1e4*cos(5*t); 0; 0", "Probes/Regions": "moved: y == 0",
                  "Solver/Tolerance": 1e-12, "Output/Frames": "none"}
        results = runner.simulate(runner.BAR, shaken)
        for row in results.probes():
            runner.check(abs(row["moved.uz"] - 2 * math.sin(3 * row["time"])) < 1e-12, "the motion is not followed")
        stray = balance(results.history())
        runner.check(stray < 1e-10, f"{rotation}, {damping}, {mass}, {motion}: energies out of balance by {stray}")
        two = runner.simulate(runner.BAR, shaken, ranks=2)
        columns = [name for name in results.probes()[0] if name != "step"]
        difference = runner.largest_difference(results.probes(), two.probes(), columns)
        runner.check(difference < 1e-8, f"one and two processes differ by {difference}")

# Turned at the start, a free body stays as it is: no strain, no force. About its clamp it winds back.
turned = {**free, "Loads/Gravity": "0, 0, 0", "Start/Rotation": "30, -80, 100", "Start/Rotation center": "1, 2, 3",
          "Probes/Regions": "", "Time/Steps": 5}
results = runner.simulate(runner.BAR, turned)
angle = math.sqrt(30**2 + 80**2 + 100**2)
axis = [30 / angle, -80 / angle, 100 / angle]
arm = [-1, -2, -3]
cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
along = sum(a * b for a, b in zip(axis, arm))
cross = [axis[1] * arm[2] - axis[2] * arm[1], axis[2] * arm[0] - axis[0] * arm[2], axis[0] * arm[1] - axis[1] * arm[0]]
for i, direction in enumerate("xyz"):
    expected = cosine * arm[i] + sine * cross[i] + (1 - cosine) * along * axis[i] - arm[i]
    found = results.probes()[-1]["n0.u" + direction]
    runner.check(abs(found - expected) < 1e-9, f"turned by {found} along {direction} instead of {expected}")
runner.check(max(row["elastic"] for row in results.history()) < 1e-15 * 1e8, "a turned body is strained")
wound = {"Start/Rotation": "0, 60, 0", "Start/Rotation center": "2, 0, 2", "Start/Velocity": "0; 0; 0", "Time/Steps": 100}
results = runner.simulate(runner.BAR, wound)
runner.check(results.history()[0]["elastic"] > 1e6, "wound up about its clamp it has energy")

# Static: pulled by a vertex, the reactions balance, and the work is that of a linear spring. What is moved is followed
# without being asked for, and the vertex that was taken is named.
pull = {"Motion/Of": "nearest to 2, 0, 2.1", "Motion/Displacement": "0; -0.1*t; 0", "Loads/Gravity": "0, 0, 0",
        "Time/Steps": 4}
results = runner.simulate(runner.STATIC, pull)
last = results.probes()[-1]
runner.check(abs(last["n28.uy"] + 0.1) < 1e-15 and last["n28.fy"] < -1e5, "the vertex is not pulled")
for column in ["ux", "uy", "uz", "fx", "fy", "fz"]:
    runner.check(last["motion." + column] == last["n28." + column], f"motion.{column}")
status, output, _ = runner.run("--check", runner.STATIC, *runner.overrides(pull))
runner.check("motion: vertex 28 at (2, 0, 2), 0.1 m from the point asked for" in output, output)
for direction in "xyz":
    net = last["n28.f" + direction] + last["clamp.f" + direction]
    runner.check(abs(net) < 1e-9 * abs(last["n28.fy"]), f"the reactions add up to {net} N")
runner.check(abs(results.history()[-1]["elastic"] / (0.5 * 0.1 * -last["n28.fy"]) - 1) < 1e-10, "elastic energy")
polar = runner.simulate(runner.STATIC, {**pull, "Corotation/Rotation": "polar"})
runner.check(abs(polar.probes()[-1]["n28.fy"] / last["n28.fy"] - 1) < 0.05, "polar and linear differ")

# A motion that jumps is no motion: that is said; ramps with kinks and a jump before the start are none.
for displacement, jumps in [("free; free; if(t > 0.1, 1, 0)", 1), ("free; free; min(t/0.1, 1)", 0), ("free; free; 0.3", 0)]:
    for method in ["backward euler", "esdirk4"]:
        moved = {**free, "Motion/Of": "region y == 0", "Motion/Displacement": displacement, "Time/Steps": 5, "Time/Method": method,
                 "Constraints/Clamped boundaries": 3}
        warnings = runner.simulate(runner.BAR, moved).summary()["warnings"]
        runner.check(sum("In 1 steps a prescribed motion jumps" in text for text in warnings) == jumps, f"{displacement}: {warnings}")

for entry, value, words in [("Of", "vertex 99", "indices go from 0 to 80"), ("Of", "tip", "nearest to X, Y, Z"),
                            ("Of", "boundary 9", "no boundary 9"), ("Of", "region x > 9", "no vertex"),
                            ("Of", "boundary 3", "held or moved already"), ("Displacement", "0; 0", "there must be 3"),
                            ("Displacement", "0; 0; x +", "Unexpected end"),
                            ("Displacement", "0; 0; 1/t", "not a finite number at time 0")]:
    settings = {"Motion/Of": "vertex 0", f"Motion/{entry}": value}
    status, _, error = runner.run("--check", runner.BAR, *runner.overrides(settings))
    runner.check(status == 1 and words in error, f"{entry} = {value}: {status} {error}")
