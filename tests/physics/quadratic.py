"""Quadratic tetrahedra (Mesh/Order = 2) in whole runs: known numbers, and the same run by all ways that must agree."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

CANTILEVER = runner.ROOT / "parameters" / "validation" / "cantilever.prm"
ELASTICA = runner.ROOT / "parameters" / "validation" / "elastica.prm"
CYLINDER = runner.ROOT / "parameters" / "validation" / "thick-cylinder.prm"
ORDER = {"Mesh/Order": 2}
BENT = {"Corotation/Rotation": "polar", "Start/Velocity": "0; 0; -40"}


def bar(cubes, **entries):
    settings = {**ORDER, "Mesh/Box cubes": cubes, "Solver/Tolerance": 1e-11}
    return runner.simulate(runner.STATIC, {**settings, **entries})


def near(value, expected, part, what):
    runner.check(abs(value / expected - 1) < part, f"{what}: {value}, expected {expected}")


SAG = -0.201458618 # n28.uz of 144 cells [m]

# The bar under its weight at rest: its end sinks by 0.20637 m, and the loads do 165397 J along it.
for cubes, sag, work in [("2, 6, 2", SAG, 160545.58), ("4, 12, 4", -0.204786034, 163822.06)]:
    for solver in ["ldlt", "cholmod", "cg-amg", "cg-ml", "cg-jacobi"] if cubes == "2, 6, 2" else ["cholmod", "cg-amg"]:
        results = bar(cubes, **{"Solver/Method": solver})
        near(results.probes()[-1]["n28.uz"], sag, 2e-7, f"{cubes} cubes, {solver}: sag")
        near(2 * results.history()[-1]["elastic"], work, 1e-7, f"{cubes} cubes, {solver}: work of the loads")
        near(results.probes()[-1]["clamp.fz"], 1000 * 9.81 * 192, 1e-9, f"{cubes} cubes, {solver}: reaction")

# Loads of the same resultant, whatever they act on; a dead traction and a pressure on a face are the same.
plain = bar("2, 6, 2", **{"Loads/Gravity": "0, 0, 0", "Loads/Body force": "0; 0; -9810"})
near(plain.probes()[-1]["n28.uz"], SAG, 1e-8, "body force")
pushed = {"Loads/Gravity": "0, 0, 0", "Loads/Pressure": 1e4, "Loads/Pressure on": 5, "Loads/Pressure follows": "false"}
pulled = {"Loads/Gravity": "0, 0, 0", "Loads/Traction": "0; 0; -1e4", "Loads/Traction on": 5}
by_pressure, by_traction = (bar("2, 6, 2", **loads).probes()[-1] for loads in (pushed, pulled))
near(by_pressure["n28.uz"], by_traction["n28.uz"], 1e-9, "pressure and traction")
near(by_pressure["clamp.fz"], 1e4 * 4 * 12, 1e-9, "reaction to the pressure")

# A pressure that follows the surface: with its derivatives Newton's method finds what the same pressure finds without.
follower = {**ORDER, "Corotation/Rotation": "polar", "Loads/Gravity": "0, 0, 0", "Loads/Pressure": 1e6, "Loads/Pressure on": 5,
            "Mesh/Box cubes": "1, 4, 1", "Time/Newton tolerance": 1e-10, "Solver/Tolerance": 1e-12, "Time/Steps": 2}
consistent = runner.simulate(runner.STATIC, follower)
frozen = runner.simulate(runner.STATIC, {**follower, "Time/Tangent": "frozen", "Time/Newton iterations": 500})
near(consistent.probes()[-1]["n0.uz"], frozen.probes()[-1]["n0.uz"], 1e-7, "pressure that follows, by two tangents")

# Bent far around by a weight at its tip: the exact solution within .06 %.
elastica = runner.simulate(ELASTICA, {**ORDER, "Mesh/Shape": "box", "Mesh/Box size": "1, 0.02, 0.02", "Mesh/Box cubes": "20, 1, 1",
                                      "Material/Young modulus": 1.2e7, "Loads/Traction": "0; -4000; 0", "Time/Steps": 20,
                                      "Probes/Points": "tip: 1, 0.01, 0.01", "Output/Frames": "none", "Time/Newton iterations": 100})
for factor, depth in [(0.1, 0.30172), (0.2, 0.49346), (0.5, 0.71379), (1, 0.81061)]:
    row = min(elastica.probes(), key=lambda row: abs(row["time"] - factor))
    near(-row["tip.uy"], depth, 6e-4, f"elastica at {factor}")


# The cantilever swings: with the consistent and with the lumped mass.
def frequency(results, column):
    """From the first upward passage through zero to the last one."""
    rows, passages = results.probes(), []
    for before, after in zip(rows, rows[1:]):
        if before[column] < 0 <= after[column]:
            part = before[column] / (before[column] - after[column])
            passages.append(before["time"] + part * (after["time"] - before["time"]))
    return (len(passages) - 1) / (passages[-1] - passages[0])


for mass, error in [("consistent", 1.0105), ("lumped", 1.0088)]:
    swing = runner.simulate(CANTILEVER, {**ORDER, "Mesh/Box cubes": "10, 1, 1", "Material/Mass": mass, "Solver/Tolerance": 1e-10})
    near(frequency(swing, "tip.uz"), 0.50924 * error, 2e-3, f"frequency with the {mass} mass")

# The fastest oscillation, which stable explicit steps depend on: 2 / 7.11e-4 s.
text = runner.accepted(runner.run("--check", CANTILEVER, *runner.overrides({
    **ORDER, "Mesh/Box cubes": "10, 1, 1", "Material/Mass": "lumped", "Time/Method": "explicit2", "Time/Step": 1e-4})), ["stable step"], "explicit")
near(float(text.split("fastest oscillation at rest has ")[1].split()[0]), 2812.5, 1e-3, "fastest oscillation")

# A cylinder under pressure from inside, nodes on its curved walls.
cylinder = runner.simulate(CYLINDER, {**ORDER, "Output/Frames": "none"})
near(cylinder.probes()[-1]["inner.ux"], 1.906667e-3, 1e-3, "inner wall of a cylinder")
near(cylinder.summary()["volume"], 0.4 * 3 * math.pi, 1e-4, "volume of a cylinder")

# Free fall begins with g everywhere, whatever the mass, and a free body keeps its momenta.
for mass in ["consistent", "lumped"]:
    fall = runner.simulate(runner.BAR, {**ORDER, "Mesh/Box cubes": "1, 3, 1", "Material/Mass": mass, "Constraints/Clamped boundaries": "",
                                        "Start/Velocity": "0; 0; 0", "Time/Steps": 5, "Solver/Tolerance": 1e-13, "Probes/Boundaries": ""})
    end = fall.probes()[-1]
    for probe in ["n0", "n28", "n56"]:
        near(end[f"{probe}.vz"], -9.81 * end["time"], 1e-9, f"free fall with the {mass} mass, {probe}")
    spun = runner.simulate(runner.BAR, {**ORDER, "Mesh/Box cubes": "1, 3, 1", "Material/Mass": mass, "Constraints/Clamped boundaries": "",
                                        "Start/Velocity": "5; -y; 10*x", "Time/Steps": 20, "Loads/Gravity": "0, 0, 0",
                                        "Solver/Tolerance": 1e-13, "Probes/Boundaries": ""}).history()
    size = max(abs(spun[0][p]) for p in ("px", "py", "pz"))
    for p in ("px", "py", "pz"):
        runner.check(abs(spun[-1][p] - spun[0][p]) < 1e-9 * size, f"{p} of a free body: {spun[0][p]}, {spun[-1][p]}")

# All implicit methods go the same way; energy is kept by the one that keeps it.
swing = {**ORDER, **BENT, "Mesh/Box cubes": "1, 4, 1", "Time/Step": 0.0025, "Time/Steps": 40, "Solver/Tolerance": 1e-11, "Time/Newton tolerance": 1e-9}
ends = {}
for method in ["backward euler", "implicit backward euler", "implicit midpoint", "trbdf2", "sdirk2", "esdirk4", "ida"]:
    entries = {"Time/Variable steps": "true", "Time/Relative tolerance": 1e-6} if method == "ida" else {}
    ends[method] = runner.simulate(runner.BAR, {**swing, **entries, "Time/Method": method}).probes()[-1]["n28.uz"]
for method, end in ends.items():
    near(end, ends["esdirk4"], 0.05 if "euler" in method else 5e-3, method)

# Turned cells alone are renewed within a warp tolerance.
kept = runner.simulate(runner.BAR, {**swing, "Corotation/Warp tolerance": 0.2, "Time/Method": "backward euler"})
near(kept.probes()[-1]["n28.uz"], ends["backward euler"], 3e-3, "warp tolerance")
built = kept.summary()["built"]
runner.check(built["cells_warped"] < 0.9 * built["rotations_computed"], f"{built}")

# The same on several processes and threads.
PHYSICAL = ["time", "kinetic", "elastic", "potential", "total", "work", "px", "py", "pz", "lx", "ly", "lz", "min_volume_ratio",
            "max_volume_ratio", "inverted"]
parts = {**ORDER, **BENT, "Mesh/Box cubes": "2, 6, 2", "Time/Steps": 8, "Solver/Tolerance": 1e-12, "Probes/Regions": "tip: y < 0.1",
         "Mesh/Layers": "6, 6", "Material/By id": "1: 5e7, 0.4, 1200", "Loads/Pressure": 1e4, "Loads/Pressure on": 1,
         "Mesh/Boundary regions": "7: z > 3.9", "Loads/Traction on": 7, "Loads/Traction": "0; 0; -2e4"}
for entries in [{}, {"Time/Method": "implicit midpoint", "Time/Newton tolerance": 1e-11, "Solver/Method": "cg-amg"}]:
    one = runner.simulate(runner.BAR, {**parts, **entries})
    for ranks in (2, 4):
        several = runner.simulate(runner.BAR, {**parts, **entries}, ranks=ranks)
        history = runner.largest_difference(one.history(), several.history(), PHYSICAL)
        probes = runner.largest_difference(one.probes(), several.probes(), [name for name in one.probes()[0] if name != "step"])
        runner.check(max(history, probes) <= 1e-8, f"{ranks} processes differ by {history}, {probes}")
        for fact in ("cells", "vertices", "dofs", "volume"):
            runner.check(one.summary()[fact] == several.summary()[fact], f"{fact} on {ranks} processes")

# A run goes on from a checkpoint as if nothing had been.
through = runner.simulate(runner.BAR, {**parts, "Corotation/Warp tolerance": 0.5, "Checkpoint/Every": 3, "Time/Steps": 8})
status, _, error = runner.run(runner.BAR, "--quiet", "--output", through.folder / "again", *runner.overrides(
    {**parts, "Corotation/Warp tolerance": 0.5, "Checkpoint/Every": 3, "Time/Steps": 4}))
runner.check(status == 0, error)
status, _, error = runner.run(runner.BAR, "--quiet", "--output", through.folder / "again", *runner.overrides(
    {**parts, "Corotation/Warp tolerance": 0.5, "Checkpoint/Every": 3, "Time/Steps": 8}))
runner.check(status == 0, error)
resumed = runner.Results(through.folder / "again")
difference = runner.largest_difference(through.probes(), resumed.probes(), ["n28.ux", "n28.uy", "n28.uz", "n28.vz", "clamp.fz"])
runner.check(difference < 1e-12, f"the run that goes on differs by {difference}")
print("quadratic tetrahedra: all as expected")
