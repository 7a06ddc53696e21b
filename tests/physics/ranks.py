"""One and two processes give the same motion to 1e-8."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

PHYSICAL = ["time", "dt", "kinetic", "elastic", "potential", "dissipated", "total", "work", "px", "py", "pz", "lx",
            "ly", "lz", "min_volume_ratio", "max_volume_ratio", "inverted"]
settings = {"Solver/Tolerance": 1e-12, "Loads/Body force": "1e4*sin(10*t); 0; 0", "Damping/Mass factor": 0.1,
            "Damping/Stiffness factor": 1e-3, "Damping/Viscous": 100, "Constraints/Boundaries held along x": 4,
            "Probes/Regions": "tip: y < 0.1", "Time/Steps": 40}

for rotation in ["none", "gram-schmidt", "polar"]:
    settings["Corotation/Rotation"] = rotation
    one = runner.simulate(runner.BAR, settings)
    two = runner.simulate(runner.BAR, settings, ranks=2)
    history = runner.largest_difference(one.history(), two.history(), PHYSICAL)
    columns = [name for name in one.probes()[0] if name != "step"]
    probes = runner.largest_difference(one.probes(), two.probes(), columns)
    runner.check(history <= 1e-8, f"history.csv differs by {history}")
    runner.check(probes <= 1e-8, f"probes.csv differs by {probes}")
    runner.check(two.summary()["built"]["parallel"] and not one.summary()["built"]["parallel"], "parallel")
    shares, seconds = two.summary()["partition"], two.summary()["seconds_of_ranks"]
    runner.check("partition" not in one.summary() and "seconds_of_ranks" not in one.summary(), "one process has no partition")
    runner.check(0 < shares["cells"]["least"] <= 96 <= shares["cells"]["most"] < 192 and
                 shares["cells"]["least"] + shares["cells"]["most"] == 192, f"{shares}")
    runner.check(0 <= shares["ghost_vertices"]["least"] <= shares["ghost_vertices"]["most"] < 81, f"{shares}")
    runner.check(all(0 <= phase["mean"] <= phase["most"] for phase in seconds.values()) and seconds["solve"]["most"] > 0, f"{seconds}")
    runner.check(one.frame_times() == two.frame_times(), "the frames are at other times")
    print(f"{rotation}: history within {history:.1e}, probes within {probes:.1e}")

static = {"Time/Problem": "static", "Start/Velocity": "0; 0; 0", "Time/Steps": 2, "Solver/Tolerance": 1e-12, "Time/Newton tolerance": 1e-10}
one = runner.simulate(runner.BAR, static)
two = runner.simulate(runner.BAR, static, ranks=2)
probes = runner.largest_difference(one.probes(), two.probes(), ["n28.ux", "n28.uy", "n28.uz", "clamp.fz"])
runner.check(probes <= 1e-8, f"the static solutions differ by {probes}")
print(f"static: probes within {probes:.1e}")

# A process for each cell: some of them own no vertex, and METIS alone would leave one without a cell.
few = {"Mesh/Box cubes": "1, 1, 1", "Probes/Points": "tip: 0, 0, 0", "Solver/Tolerance": 1e-12, "Time/Steps": 5}
one = runner.simulate(runner.BAR, few)
six = runner.simulate(runner.BAR, few, ranks=6)
probes = runner.largest_difference(one.probes(), six.probes(), ["tip.ux", "tip.uy", "tip.uz"])
runner.check(probes <= 1e-8, f"six processes for six cells differ by {probes}")
print(f"six processes: probes within {probes:.1e}")

# Bodies large enough for coarse levels that are distributed too; in the second one half of the processes and more have nothing
# but held vertices or hardly anything else, and so no part of them.
large = {"Mesh/Box cubes": "12, 48, 12", "Solver/Tolerance": 1e-12, "Time/Steps": 3}
for name, settings, several in [("a large bar", {}, (2, 4)), ("a bar held by a third", {"Constraints/Clamped region": "y > 8.1"}, (8,))]:
    one = runner.simulate(runner.BAR, {**large, **settings})
    for ranks in several:
        found = runner.simulate(runner.BAR, {**large, **settings}, ranks=ranks)
        history = runner.largest_difference(one.history(), found.history(), PHYSICAL)
        probes = runner.largest_difference(one.probes(), found.probes(), [name for name in one.probes()[0] if name != "step"])
        runner.check(max(history, probes) <= 1e-8, f"{name} on {ranks} processes differs by {history}, {probes}")
        first, *rest = found.summary()["partition"]["coarse_levels"]
        runner.check(first["most"] < 0.7 * first["nodes"] and (first["least"] == 0) == (settings != {}), f"{first}")
        runner.check(all(level["least"] == level["most"] == level["nodes"] for level in rest), f"{rest}")
        print(f"{name} on {ranks}: history within {history:.1e}, probes within {probes:.1e}")

# What a process is told of its part of the mesh: materials, patches, boundaries by expressions, indices of vertices.
parts = {"Mesh/Layers": "6, 6", "Material/By id": "1: 5e6, 0.49, 1200", "Material/Poisson ratio": 0.49, "Material/Volumetric locking cure": "patches",
         "Material/Mass per vertex": 500, "Mesh/Boundary regions": "7: z > 3.9", "Loads/Traction on": 7,
         "Loads/Traction": "0; 0; -2e4", "Probes/Points": "tip: 2, 0, 2", "Probes/Boundaries": "clamp: 3; top: 7",
         "Solver/Tolerance": 1e-12, "Time/Steps": 10, "Time/Step": 0.02}
one = runner.simulate(runner.BAR, parts)
for ranks in (2, 4):
    several = runner.simulate(runner.BAR, parts, ranks=ranks)
    history = runner.largest_difference(one.history(), several.history(), PHYSICAL)
    probes = runner.largest_difference(one.probes(), several.probes(), [name for name in one.probes()[0] if name != "step"])
    runner.check(max(history, probes) <= 1e-8, f"a bar of two materials on {ranks} processes differs by {history}, {probes}")
    for fact in ("cells", "vertices", "dofs", "volume"):
        runner.check(one.summary()[fact] == several.summary()[fact], f"{fact} on {ranks} processes")
    print(f"two materials on {ranks}: history within {history:.1e}, probes within {probes:.1e}")
