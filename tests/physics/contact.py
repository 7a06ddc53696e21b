"""Tools that touch the body: Hertz's force, friction on an incline, impact, weight, and tools that stay outside whatever happens."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

CONTACT = runner.ROOT / "parameters" / "contact"
HERTZ, INCLINE, BOUNCE, SKIN = [CONTACT / f"{name}.prm" for name in ("hertz", "incline", "bounce", "needle-skin")]
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
quiet = {"Output/Frames": "none", "Output/Report": "false"}
CUBE = folder / "cube.prm"
CUBE.write_text("""# a soft cube above a floor
subsection Mesh
  set Box origin = 0, 0, 0.02
  set Box size   = 0.1, 0.1, 0.1
  set Box cubes  = 3, 3, 3
end
subsection Material
  set Young modulus = 1e5
  set Poisson ratio = 0.3
  set Density       = 1000
end
subsection Loads
  set Gravity = 0, 0, -9.81
end
subsection Tool floor
  set Shape = plane
end
subsection Time
  set Step  = 0.01
  set Steps = 60
end
""")
NEEDLE = folder / "needle.prm"
NEEDLE.write_text("""# a needle thinner than a cell is pushed into a block
subsection Mesh
  set Box origin = -0.05, -0.05, -0.1
  set Box size   = 0.1, 0.1, 0.1
  set Box cubes  = 4, 4, 4
end
subsection Material
  set Young modulus = 1e5
  set Poisson ratio = 0.3
  set Density       = 1000
end
subsection Constraints
  set Clamped boundaries = 4
end
subsection Tool needle
  set Shape    = capsule
  set Radius   = 0.001
  set Axis     = 0.02, 0, 0.1
  set Position = 0.005; 0.0035; 0.001 - min(t, 0.02)
end
subsection Time
  set Step  = 0.001
  set Steps = 22
end
""")


def simulate(scene, settings=None, ranks=1):
    results = runner.simulate(scene, {**quiet, **(settings or {})}, ranks=ranks)
    runner.check(all(row["min_gap"] > 0 for row in results.history()), f"{settings}: the body is within a tool")
    return results


def balance(history):
    """What is missing in the balance of energies, over the largest of them."""
    size = max(abs(row[name]) for row in history for name in ("kinetic", "elastic", "potential", "work", "dissipated"))
    start = history[0]["total"]
    return max(abs(row["total"] + row["dissipated"] + row["rubbed"] - row["work"] - start) for row in history) / size


# Hertz: the force of a sphere on a half-space goes with the depth to the power 1.5; the area that it touches.
hertz = simulate(HERTZ, {"Mesh/Box cubes": "12, 12, 12"})
for row in hertz.table("tool_sphere.csv")[2:]:
    exact = 36.630037 * row["time"] ** 1.5
    runner.check(abs(4 * row["fz"] / exact - 1) < 0.03, f"Hertz: {4 * row['fz']} N instead of {exact} N at {row['time']}")
