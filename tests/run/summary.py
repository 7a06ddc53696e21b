"""What a scene does not need is not built: summary.json says so."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

CELLS = 192


def built(**settings):
    summary = runner.simulate(runner.BAR, {key.replace("__", "/").replace("_", " "): value
                                           for key, value in settings.items()}).summary()
    return summary, summary["built"]


summary, corotational = built()
runner.check(corotational["rotations_computed"] == 101 * CELLS, "rotations: once at the start and once a step")
runner.check(corotational["factorizations"] == 100 == corotational["assemblies"], "one factorization a step")
runner.check(not corotational["damping_matrix"], "damping without damping")
runner.check(summary["cells"] == CELLS and summary["vertices"] == 81 and summary["dofs"] == 243, "sizes")
runner.check(summary["held"] == 27 and summary["steps"] == 100 and summary["status"] == "done", "run")
runner.check(summary["solver"]["max_relative_residual"] < 1e-10, "residual")
error = summary["error_estimate"]
runner.check(error["sum_of_local_errors"] > 0 and error["largest_motion"] > 3, "error estimate")

_, linear = built(Corotation__Rotation="none", Time__Steps=2000)
runner.check(linear["rotations_computed"] == 0, "rotations in a linear scene")
runner.check(linear["factorizations"] == 1 == linear["assemblies"], f"a linear scene: {linear}")

_, static = built(Corotation__Rotation="none", Time__Problem="static", Time__Steps=7,
                  Start__Velocity="0; 0; 0")
runner.check(not static["mass_matrix"], "mass in a static scene")
runner.check(static["factorizations"] == 1, "a linear static scene has one factorization for all load steps")

_, damped = built(Damping__Viscous=1)
runner.check(damped["damping_matrix"], "damping")

summary, silent = built(Output__Frames="none", Output__History="false")
runner.check(not silent["history"] and not silent["probes"] and silent["frames"] == 0, "output")
runner.check(not silent["energies_measured"] and "last" not in summary, "energies nobody asked for")
runner.check(not silent["parallel"] and silent["multigrid_hierarchies"] == 0, "messages, multigrid")

# Backward Euler's free estimate is a first order error: half the step, half of its sum.
smooth = {"Start/Velocity": "0; 0; 0", "Corotation/Rotation": "none", "Damping/Stiffness factor": 0.05}
sums = [runner.simulate(runner.BAR, {**smooth, "Time/Step": 0.01 / n, "Time/Steps": 100 * n})
        .summary()["error_estimate"]["sum_of_local_errors"] for n in (1, 2, 4)]
for coarse, fine in zip(sums, sums[1:]):
    runner.check(1.8 < coarse / fine < 2.2, f"the error estimates {sums} do not halve with the step")

warnings = runner.simulate(runner.BAR, {"Probes/Points": "tip: 9, 9, 9; end: 4, 0, 4.01", "Time/Steps": 1}).summary()["warnings"]
runner.check(len(warnings) == 1 and "Probe tip follows vertex 74" in warnings[0] and "outside of the body" in warnings[0], f"{warnings}")

# Cells far smaller or larger than at rest are told, with their size; where others are inside out that is told instead.
for settings, told, silent in [
        ({"Start/Displacement": "0; -0.6*y; 0"}, ["squeezed to 0.4 times their volume"], "swollen"),
        ({"Start/Displacement": "x; 0.2*y; 0"}, ["swollen to 2.4 times their volume"], "squeezed"),
        ({"Start/Displacement": "if(y < 6, 1.4, -0.6)*x; 0; 0"}, ["squeezed to 0.4", "and swollen to 2.4"], "inside out"),
        ({"Start/Displacement": "0; -1.5*y; 0"}, ["inside out"], "squeezed"),
        ({}, [], "their volume")]:
    warnings = runner.simulate(runner.BAR, {"Constraints/Clamped boundaries": "", "Start/Velocity": "0; 0; 0", "Time/Steps": 1,
                                            **settings}).summary()["warnings"]
    text = " ".join(warnings)
    runner.check(all(word in text for word in told) and silent not in text, f"{settings}: {warnings}")

# What is set in vain, and a body of which nothing is left to move.
for settings, words in [({"Motion/Displacement": "0; 0; 1"}, "Motion/Of, which says what moves, is empty"),
                        ({"Motion 3/Displacement": "0; 0; 1"}, "Motion 3/Of"),
                        ({"Output/Every": 3}, "Output/Frames is not every"), ({"Output/Interval": 3}, "Output/Frames is not interval"),
                        ({"Loads/Traction on": 1}, "Loads/Traction is 0"), ({"Loads/Pressure on": 1}, "Loads/Pressure is 0"),
                        ({"Loads/Nodal force on": "vertex 1"}, "Loads/Nodal force is 0"), ({"Mesh/File": "a.msh"}, "Mesh/Shape is not file"),
                        ({"Time/Longest step": 1}, "Time/Variable steps is false"), ({"Start/Rotation center": "1, 0, 0"}, "Start/Rotation is 0"),
                        ({"Output/Frames": "every", "Output/Motion": 0.1}, "Output/Frames is not adaptive"),
                        ({"Mesh/Cylinder height": 3}, "not hollow cylinder"), ({"Mesh/Rectangle split": "rising"}, "not rectangle"),
                        ({"Mesh/Scale": 3}, "not file"), ({"Time/Relative tolerance": 1e-5}, "Time/Variable steps is false"),
                        ({"Time/Maximum order": 1}, "not ida"), ({"Output/Frames": "none", "Probes/Profile every": 3}, "names none"),
                        ({"Material/Lame mu": 3}, "Young's modulus"), ({"Probes/Profile every": 3}, "Probes/Profiles names none"),
                        ({"Constraints/Clamped region": "x > -1", "Start/Velocity": "0; 0; 0"}, "All vertices"),
                        ({"Motion/Of": "all", "Constraints/Clamped boundaries": "", "Motion/Displacement": "0; 0; t"}, "All vertices"),
                        ({"Output/Every": 3, "Output/Frames": "every"}, ""), ({"Output/Every": 1}, ""), ({}, "")]:
    warnings = [text for text in runner.simulate(runner.BAR, {"Time/Steps": 1, **settings}).summary()["warnings"]
                if "it has no effect" in text or "All vertices" in text]
    runner.check(len(warnings) == bool(words) and all(words in text for text in warnings), f"{settings}: {warnings}")
