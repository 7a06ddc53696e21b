"""What means nothing with a law by an energy is refused, with the place and what to take instead."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
MOVING = {"Material/Law": "neo-hookean", "Time/Method": "trbdf2", "Time/Steps": 1}


def refused(changes, *words):
    settings = {**MOVING, **changes}
    outcome = runner.run(runner.BAR, "--output", folder / "results", *runner.overrides(settings))
    runner.refused(outcome, words, str(settings))


def accepted(changes, *words):
    outcome = runner.run("--check", runner.BAR, *runner.overrides({**MOVING, **changes}))
    return runner.accepted(outcome, words, str(changes))


for law in ("fixed corotated", "neo-hookean", "stable neo-hookean", "st venant-kirchhoff", "mooney-rivlin"):
    accepted({"Material/Law": law}, law)
    refused({"Material/Law": law, "Time/Method": "backward euler"}, "Time/Method", "backward euler", law, "implicit backward euler or trbdf2")
for method in ("imex3", "imex4", "imex5"):
    refused({"Time/Method": method}, "Time/Method", method, "rotations that are held", "esdirk3")
for method in ("implicit backward euler", "implicit midpoint", "sdirk2", "trbdf2", "esdirk3", "esdirk4", "esdirk5", "ida"):
    accepted({"Time/Method": method})
accepted({"Time/Method": "explicit4", "Material/Mass": "lumped", "Time/Step": 0.001})
accepted({"Time/Problem": "static", "Time/Method": "backward euler", "Start/Velocity": "0; 0; 0"})

for rotation in ("none", "gram-schmidt"):
    refused({"Corotation/Rotation": rotation}, "Corotation/Rotation", "no rotations", "neo-hookean", "corotational")
refused({"Corotation/Warp tolerance": 1}, "Corotation/Warp tolerance", "no rotations", "must be 0")
refused({"Time/Tangent": "frozen"}, "Time/Tangent", "auto, consistent or definite")
refused({"Damping/Stiffness factor": 0.1}, "Damping/Stiffness factor", "Mass factor")
refused({"Material/Volumetric locking cure": "patches", "Material/Volume change": "trace"}, "Material/Volume change", "determinant")
refused({"Material/Law": "hencky"}, "corotational", "neo-hookean", "mooney-rivlin")
refused({"Material/Law": "fixed corotated", "Material/Poisson ratio": -0.1}, "Material/Law", "-0.1", "neo-hookean")
refused({"Material/Mooney ratio": -1}, "0 or greater")
plane = {"Mesh/Shape": "rectangle", "Constraints/Clamped boundaries": 0, "Loads/Gravity": "0, 0, 0", "Start/Velocity": "0; 0; 0",
         "Probes/Points": "", "Probes/Boundaries": ""}
for model in ("plane strain", "axisymmetric"):
    accepted({**plane, "Plane/Model": model})
refused({**plane, "Plane/Model": "plane stress"}, "Material/Law", "plane stress", "plane strain")

# Said, but not refused.
accepted({"Material/Law": "st venant-kirchhoff"}, "crushed")
accepted({"Material/Mooney ratio": 1}, "Material/Mooney ratio", "it has no effect")
