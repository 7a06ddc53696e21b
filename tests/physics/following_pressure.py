"""Static equilibrium under pressure that follows the surface: what a ring bears, and what it does not."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
RING = folder / "ring.prm"
RING.write_text("""# a short ring between two smooth plates, blown up from inside
subsection Mesh
  set Shape                 = hollow cylinder
  set Cylinder inner radius = 0.5
  set Cylinder outer radius = 1
  set Cylinder height       = 0.2
  set Cylinder sectors      = 12
  set Cylinder rings        = 2
  set Cylinder layers       = 2
end
subsection Material
  set Young modulus = 1e6
  set Poisson ratio = 0.3
end
subsection Constraints
  set Boundaries held along z = 2, 3
end
subsection Motion
  set Of           = region x > 0.999 && abs(y) < 0.001
  set Displacement = 0; 0; free
end
subsection Motion 2
  set Of           = region x < -0.999 && abs(y) < 0.001
  set Displacement = free; 0; free
end
subsection Loads
  set Pressure    = 2e5
  set Pressure on = 0
end
subsection Time
  set Problem = static
  set Steps   = 1
end
subsection Output
  set Frames = none
  set Report = false
end
subsection Probes
  set Points = wall: 0.5, 0, 0.1
end
""")
LARGER = {"Mesh/Cylinder sectors": 24, "Mesh/Cylinder layers": 4}


def wall(settings, ranks=1):
    """The displacement of the inner wall [m]; no cell is inside out."""
    results = runner.simulate(RING, settings, ranks=ranks)
    runner.check(results.history()[-1]["inverted"] == 0, f"{settings}: cells inside out")
    return results.probes()[-1]["wall.ux"]


# What the ring bears does not depend on load steps, operator, processes and solver.
for settings, expected in [({"Loads/Pressure": 1e5}, 0.02669232), ({}, 0.06526872), ({"Loads/Pressure": 3e5}, 0.12596455)]:
    for more in [{}, {"Time/Steps": 2}, {"Time/Steps": 4}, {"Time/Tangent": "definite"}, {"Solver/Method": "cg-amg"}]:
        found = wall({**settings, **more})
        runner.check(abs(found - expected) < 2e-8, f"{settings}, {more}: {found} instead of {expected}")
found = wall({"Solver/Tolerance": 1e-12}, ranks=2)
runner.check(abs(found - 0.06526872) < 2e-8, f"on two processes: {found}")

# Linear elasticity too, where displacements are small; in the plane the wall of a ring moves by the same.
linear, polar = [wall({**LARGER, "Corotation/Rotation": rotation}) for rotation in ("none", "polar")]
runner.check(abs(linear / polar - 1) < 0.01, f"linear {linear}, polar {polar}")

# Beyond what the ring bears there is no equilibrium.
for settings in [{"Loads/Pressure": 1e7}, {"Loads/Pressure": 1e7, "Time/Steps": 5}, {"Loads/Pressure": 1e8, **LARGER},
                 {"Loads/Pressure": 1e6, "Corotation/Rotation": "none"}, {"Loads/Pressure": 1e8, "Corotation/Rotation": "none", "Time/Steps": 2},
                 {"Loads/Pressure": 1e7, "Corotation/Rotation": "gram-schmidt"}, {"Loads/Pressure": 1e7, "Time/Tangent": "frozen"},
                 {"Loads/Pressure": 5e5}]:
    status, _, error = runner.run(RING, "--quiet", "--output", folder / "blown", *runner.overrides(settings))
    runner.check(status == 2 and "no equilibrium was found" in error and "Loads/Pressure" in error, f"{settings}: {status} {error}")
    runner.check(abs(runner.Results(folder / "blown").probes()[-1]["wall.ux"]) < 1, f"{settings}: a state that is no equilibrium")
