"""Quadratic tetrahedra: what runs tell of their error in space, meshes that adapt to it, and patches of almost incompressible
bodies."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import vtu

CYLINDER = runner.ROOT / "parameters" / "validation" / "thick-cylinder.prm"
QUIET = {"Mesh/Order": 2, "Output/Frames": "none", "Output/Report": "false"}
SAG = -0.20637 # n28.uz of the bar under its weight, what finer and finer meshes tend to [m]


def told(results):
    return results.summary()["error_estimate"]["space"]


# The sag of the bar: what is told is near to what is true.
for cubes, part in [("1, 3, 1", 0.1), ("2, 6, 2", 0.1), ("4, 12, 4", 0.2)]:
    results = runner.simulate(runner.STATIC, {**QUIET, "Mesh/Box cubes": cubes})
    error, true = told(results)["probes"]["n28.uz"], 1 - results.probes()[-1]["n28.uz"] / SAG
    print(f"bar of {cubes} cubes: told {100 * error:.2f} %, true {100 * true:.2f} %")
    runner.check(abs(error / true - 1) < part, f"bar of {cubes} cubes: {error} is told, {true} is true")

# Where loads act on faces the error of the energy is told: too much, where all is smooth.
results = runner.simulate(CYLINDER, {**QUIET, "Mesh/Cylinder layers": 2, "Mesh/Cylinder sectors": 16})
exact = 2 * math.pi * 0.4 * 1.3e-3 * (0.4 + 4) / 3 # p times the inner wall times its displacement, twice the elastic energy
true, error = 1 - 2 * results.history()[-1]["elastic"] / exact, told(results)["work"]
print(f"cylinder: told {100 * error:.2f} %, true {100 * true:.2f} % of the work")
runner.check(0.8 * true < error < 20 * true and 0 < true < 0.01, f"cylinder: {error} is told, {true} is true")

# Refined where the probe needs it, it errs less than uniform cells that have more nodes.
adapted = runner.simulate(runner.STATIC, {**QUIET, "Mesh/Box cubes": "2, 6, 2", "Mesh/Refine": "3 by n28.uz"})
uniform = runner.simulate(runner.STATIC, {**QUIET, "Mesh/Box cubes": "4, 12, 4"})
errors = [abs(1 - results.probes()[-1]["n28.uz"] / SAG) for results in (adapted, uniform)]
print(f"adapted {adapted.summary()['dofs']} unknowns {100 * errors[0]:.3f} %, uniform {uniform.summary()['dofs']} {100 * errors[1]:.3f} %")
runner.check(errors[0] < errors[1] and adapted.summary()["dofs"] < uniform.summary()["dofs"], f"errors {errors}")

# A second mesh: of cells twice as large, and of linear cells on the same vertices, which err more.
swing = {**QUIET, "Start/Velocity": "0; 0; 0", "Time/Method": "esdirk4", "Time/Step": 0.035, "Time/Steps": 10}
reference = runner.simulate(runner.BAR, {**swing, "Mesh/Box cubes": "8, 24, 8"}).probes()[-1]["n28.uz"]
for kind, bound in [("coarser", 2), ("linear", 100)]:
    results = runner.simulate(runner.BAR, {**swing, "Mesh/Box cubes": "4, 12, 4", "Space/Second mesh": kind})
    second = results.summary()["error_estimate"]["second_mesh"]
    true = abs(1 - results.probes()[-1]["n28.uz"] / reference)
    print(f"second mesh {kind}: told {100 * second['relative']:.2f} %, true {100 * true:.2f} %")
    runner.check(0.5 * true < second["relative"] < bound * true, f"second mesh {kind}: {second}, {true} is true")
    runner.check(second.get("at_most", False) == (kind == "linear"), f"{second}")
runner.refused(runner.run("--check", runner.BAR, "--set", "Space/Second mesh=linear"), ["Space/Second mesh", "quadratic"], "linear of linear cells")

# A cylinder that is almost incompressible, with patches: displacement and pressure, by all solvers and on several processes.
soft = {**QUIET, "Output/Frames": "every", "Mesh/Cylinder layers": 2, "Mesh/Cylinder sectors": 16, "Mesh/Cylinder rings": 2,
        "Material/Poisson ratio": 0.4999, "Material/Volumetric locking cure": "patches", "Solver/Tolerance": 1e-11}
wall, pressure = (1 + 0.4999) * 1e-3 * (1 - 2 * 0.4999 + 4) / 3, -2 * 0.4999 * (1 + 1e-4 / 3) / 3
ends = {}
for solver, ranks in [("ldlt", 1), ("cholmod", 1), ("cg-amg", 1), ("cg-amg", 2), ("cg-amg", 3), ("cg-jacobi", 2)]:
    results = runner.simulate(CYLINDER, {**soft, "Solver/Method": solver}, ranks)
    ends[solver, ranks] = results.probes()[-1]["inner.ux"]
    runner.check(abs(ends[solver, ranks] / ends["ldlt", 1] - 1) < 1e-8, f"{solver} on {ranks} processes: {ends}")
    if ranks > 1:
        continue
    frame = vtu.Frame(sorted((results.folder / "solution").glob("*.vtu"))[-1])
    pressures = frame.of_cells["pressure"]
    runner.check(abs(ends[solver, ranks] / wall - 1) < 1e-3, f"inner wall {ends[solver, ranks]}, expected {wall}")
    runner.check(all(abs(p / pressure - 1) < 0.03 for p in pressures), f"pressure {min(pressures)} to {max(pressures)}, expected {pressure}")

# With large turns: the same motion by the two measures of volume, and energy kept by the method that keeps it.
turned = {**QUIET, "Mesh/Box cubes": "1, 4, 1", "Corotation/Rotation": "polar", "Start/Velocity": "0; 0; -30", "Time/Step": 0.0025,
          "Time/Steps": 40, "Material/Poisson ratio": 0.49, "Material/Volumetric locking cure": "patches", "Solver/Tolerance": 1e-11,
          "Time/Newton tolerance": 1e-10, "Time/Method": "implicit midpoint", "Output/Energy guard": "off"}
del turned["Output/Energy guard"]
results = runner.simulate(runner.BAR, turned)
total = [row["total"] - row["work"] for row in results.history()]
runner.check(max(total) - min(total) < 0.02 * max(row["kinetic"] for row in results.history()), f"energy {min(total)} to {max(total)}")
trace = runner.simulate(runner.BAR, {**turned, "Material/Volume change": "trace"})
near = [run.probes()[-1]["n28.uz"] for run in (results, trace)]
runner.check(abs(near[0] / near[1] - 1) < 0.05, f"measures of volume: {near}")
runner.refused(runner.run("--check", CYLINDER, *runner.overrides({**soft, "Material/Poisson ratio": -0.2})),
               ["Volumetric locking cure", "above 0"], "patches of a material that cannot lock")

# A slender beam that is bent far around in one load step for each tenth, a fifth and a half of the load, is where it is in many.
elastica = {**QUIET, "Mesh/Shape": "box", "Mesh/Box size": "1, 0.02, 0.02", "Mesh/Box cubes": "20, 1, 1", "Material/Young modulus": 1.2e7,
            "Loads/Traction": "0; -4000; 0", "Probes/Points": "tip: 1, 0.01, 0.01"}
tips = [runner.simulate(runner.ROOT / "parameters" / "validation" / "elastica.prm", {**elastica, "Time/Steps": steps}).probes()[-1]["tip.uy"]
        for steps in (2, 5, 20)]
print(f"elastica in 2, 5, 20 load steps: {tips}")
runner.check(all(abs(tip / tips[-1] - 1) < 1e-6 for tip in tips), f"elastica in 2, 5, 20 load steps: {tips}")
