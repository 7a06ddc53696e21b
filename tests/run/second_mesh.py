"""Space/Second mesh: the error in space by a run on another mesh is close to the true one, and costs nothing where nobody asks."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

TIP = "tip: 2, 0, 2"
SIZES = {2: "2, 6, 2", 4: "4, 12, 4", 8: "8, 24, 8"}
QUICK = {"Output/Frames": "none", "Output/Report": "false", "Probes/Boundaries": "", "Solver/Tolerance": 1e-10}


def second_mesh(results):
    return results.summary()["error_estimate"].get("second_mesh")


def static(n, **more):
    return runner.simulate(runner.STATIC, {**QUICK, "Mesh/Box cubes": SIZES[n], "Probes/Points": TIP, "Space/Estimate error": "never",
                                           **{key.replace("__", "/").replace("_", " "): value for key, value in more.items()}})


# At rest under its weight: the right value is of quadratic tetrahedra. Meshes of 4 or less cubes through the height are too
# coarse to tell an order.
RIGHT = -0.20637
for n in (4, 8):
    results = static(n, Space__Second_mesh="coarser")
    told, sag = second_mesh(results), results.probes()[-1]["tip.uz"]
    true_error = 1 - sag / RIGHT
    lacks = told["probes"]["tip.uz"]["at_the_end"] / RIGHT
    print(f"{n} cubes: {told}; the tip lacks {lacks:.4f}, truly {true_error:.4f}")
    runner.check(not told["at_least"] and "order" not in told, f"{n} cubes: {told}")
    runner.check(0.5 < lacks / true_error < 1.4, f"{n} cubes: tip {lacks} beside {true_error}")
    coarse = static(n // 2).probes()[-1]
    distance = sum((results.probes()[-1][f"tip.u{d}"] - coarse[f"tip.u{d}"]) ** 2 for d in "xyz") ** 0.5
    runner.check(0.999 * distance < told["distance"] < 1.2 * distance, f"the distance is that of two runs: {told} {distance}")
    p = told["order_assumed"]
    runner.check(abs(told["largest"] / (told["distance"] / (2**p - 1)) - 1) < 1e-12, f"{told}")
    rows = results.table("error.csv")
    runner.check(abs(rows[-1]["distance_of_meshes"] / told["distance"] - 1) < 1e-12 and "error" not in rows[0], f"{rows}")


# A cut mesh of all tetrahedra: its old vertices keep their numbers, and what is asked at a vertex stays there. The runs differ
# by what the two meshes differ by.
finer = static(4, Space__Second_mesh="finer", Loads__Gravity="0, 0, 0", Loads__Nodal_force="0; 0; -1e6", Loads__Nodal_force_on="nearest to 2, 0, 2")
told = second_mesh(finer)
lacks = told["probes"]["tip.uz"]["at_the_end"] / finer.probes()[-1]["tip.uz"]
runner.check(told["mesh"] == "cells half as large" and 0.1 < lacks < 1 and told["order_assumed"] == 1.6, f"finer: {told}")

# Generated shapes of every kind, layers, files, walls of a cylinder, triangles: both runs are the same scene.
ROOT = runner.ROOT / "parameters"
for scene, kind, settings in [
        ("validation/thick-cylinder.prm", "coarser", {}), ("validation/thick-cylinder.prm", "finer", {}), ("validation/cook.prm", "finer", {}),
        ("validation/l-bar.prm", "finer", {}), ("validation/ring.prm", "coarser", {})]:
    results = runner.simulate(ROOT / scene, {**QUICK, "Space/Second mesh": kind, **settings})
    told = second_mesh(results)
    print(scene, kind, told)
    runner.check(("order" in told) == (scene == "validation/ring.prm"), f"{scene}, {kind}: {told}")
    runner.check("failed" not in told and 0 < told["relative"] < 0.7, f"{scene}, {kind}: {told}")

# In motion: what a finer run differs by, with second order, is the true error nearly. Nothing of the run itself changes, and nothing is there unless
# asked for; on two processes it is the same.
SWING = {**QUICK, "Mesh/Box size": "1, 4, 1", "Mesh/Box cubes": "4, 16, 4", "Corotation/Rotation": "none", "Start/Velocity": "0; 0; 0",
         "Material/Young modulus": 1e7, "Probes/Points": "tip: 0, 0, 0", "Time/Method": "esdirk4", "Time/Step": 0.05, "Time/Steps": 30}
plain = runner.simulate(runner.BAR, SWING)
swing = runner.simulate(runner.BAR, {**SWING, "Space/Second mesh": "coarser"})
print(second_mesh(swing))
runner.check(second_mesh(plain) is None and plain.probes() == swing.probes() and not (plain.folder / "error.csv").exists(),
             "a second mesh changes the run, or is there unasked")
fine = runner.simulate(runner.BAR, {**SWING, "Mesh/Box cubes": "8, 32, 8", "Space/Estimate error": "never"})
short = runner.simulate(runner.BAR, {**SWING, "Space/Second mesh": "coarser", "Time/Steps": 9})
for results, known in [(swing, False), (short, True)]:
    told, rows = second_mesh(results), results.probes()
    true_error = 4 / 3 * max(sum((a[f"tip.u{d}"] - b[f"tip.u{d}"]) ** 2 for d in "xyz") ** 0.5 for a, b in zip(rows, fine.probes()))
    print(len(rows), told, true_error)
    runner.check(told["at_least"] != known and (0.6 if known else 0.3) < told["largest"] / true_error < (1.7 if known else 1), f"{told} beside {true_error} m")
two = second_mesh(runner.simulate(runner.BAR, {**SWING, "Space/Second mesh": "coarser"}, ranks=2))
first = second_mesh(swing)
runner.check(abs(two["largest"] / first["largest"] - 1) < 1e-7 and two["probes"].keys() == first["probes"].keys(), f"two processes: {two} {first}")

# What has no such mesh, or would be another body on it.
for settings, words in [
        ({"Mesh/Box cubes": "3, 12, 4"}, ["Space/Second mesh", "Mesh/Box cubes must be even", "finer"]),
        ({"Mesh/Refine region": "x", "Mesh/Box cubes": SIZES[4]}, ["Space/Second mesh", "refined where the scene says"]),
        ({"Mesh/Box cubes": SIZES[4], "Motion/Of": "vertex 1", "Motion/Displacement": "0; 0; -0.1"},
         ["Motion/Of", "vertex 1 is not on a mesh of cells twice as large"]),
        ({"Loads/Nodal force": "0; 0; -1"}, ["Space/Second mesh", "Loads/Nodal force", "each vertex has its own share"]),
        ({"Material/Mass per vertex": 1}, ["Material/Mass per vertex", "Material/Density"]),
        ({"Space/Second mesh": "twice"}, ["Space/Second mesh", "coarser", "finer"])]:
    folder = tempfile.mkdtemp(prefix="supple-")
    outcome = runner.run(runner.STATIC, "--output", folder, *runner.overrides({"Space/Second mesh": "coarser", **settings}))
    runner.refused(outcome, words, str(settings))
runner.refused(runner.run(runner.STATIC, *runner.overrides({"Mesh/Refine": "1 by n56.uz", "Loads/Nodal force": "0; 0; -1"})),
               ["Mesh/Refine", "each vertex has its own share"], "refined with a force on each vertex")
print("done")
