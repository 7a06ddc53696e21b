"""A static scene is refused if a piece of the body, or a part of one that hangs on a hinge, can still move; the message names what
can move and how. What is held by a joint is not refused, and has the right answer."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
CUBE = [(0, 1, 3, 7), (0, 1, 5, 7), (0, 2, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 4, 6, 7)]  # corners x + 2 y + 4 z


def write(name, *cubes):
    """Unit cubes with these corners of least coordinates; those at one place share vertices."""
    number, cells = {}, []
    for x, y, z in cubes:
        corners = [number.setdefault((x + i % 2, y + i // 2 % 2, z + i // 4), len(number) + 1) for i in range(8)]
        cells += [[corners[i] for i in cell] for cell in CUBE]
    text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(number)}\n"
    text += "".join(f"{i} {x} {y} {z}\n" for (x, y, z), i in number.items()) + f"$EndNodes\n$Elements\n{len(cells)}\n"
    text += "".join(f"{i} 4 2 1 1 {' '.join(map(str, cell))}\n" for i, cell in enumerate(cells, 1))
    (folder / name).write_text(text + "$EndElements\n")
    return name


scene = folder / "scene.prm"
scene.write_text("# cubes, the first of which is held at x = 0\nsubsection Mesh\n  set Shape = file\nend\n"
                 "subsection Time\n  set Problem = static\n  set Steps = 1\nend\n")


def settings_of(name, regions="1: x < 1e-9", **more):
    return {"Mesh/File": name, "Mesh/Boundary regions": regions, "Constraints/Clamped boundaries": 1, "Loads/Gravity": "0, 0, -9.81", **more}


def refused(settings, *words):
    for ranks in (1, 2):
        runner.refused(runner.run("--check", scene, *runner.overrides(settings), ranks=ranks), words, settings)


# One glued to a wall, the other standing on a smooth floor.
two = write("two.msh", (0, 0, 0), (3, 0, 0))
floor = "1: x < 1e-9; 2: x > 2.9 && z < 1e-9"
refused(settings_of(two, floor, **{"Constraints/Boundaries held along z": 2}),
        "3 of the 6 rigid motions of the piece of 6 cells in [3, 4] x [0, 1] x [0, 1] m are free (it can slide along x and y and turn about z)")
refused(settings_of(two, floor + "; 3: x > 2.9 && y < 1e-9", **{"Constraints/Boundaries held along z": 2, "Constraints/Boundaries held along y": 3}),
        "1 of the 6 rigid motions of the piece of 6 cells in [3, 4] x [0, 1] x [0, 1] m is free (it can slide along x)")
regions = floor + "; 3: x > 3.9; 4: x > 2.9 && y < 1e-9; 5: x > 2.9 && z > 0.99"
held = settings_of(two, regions, **{
    "Constraints/Boundaries held along z": 2, "Constraints/Boundaries held along y": 4, "Constraints/Boundaries held along x": 3,
    "Material/Poisson ratio": 0, "Loads/Gravity": "0, 0, 0", "Loads/Traction": "0; 0; -1000", "Loads/Traction on": 5, "Probes/Boundaries": "top: 5"})
lower = runner.simulate(scene, held).probes()[-1]["top.uz"]
runner.check(abs(lower + 1000 / 1e6) < 1e-9, f"a block that stands is pressed down by {-lower} m")

# Two cubes that share an edge, or a vertex.
hinge = write("hinge.msh", (0, 0, 0), (1, 0, 1))
refused(settings_of(hinge), "its part of 6 cells in [1, 2] x [0, 1] x [1, 2] m", "hinge", "turn about y")
joint = write("joint.msh", (0, 0, 0), (1, 1, 1))
refused(settings_of(joint), "its part of 6 cells in [1, 2] x [1, 2] x [1, 2] m", "turn about x, y and z")
runner.simulate(scene, settings_of(hinge, **{"Constraints/Boundaries held along z": 2, "Mesh/Boundary regions": "1: x < 1e-9; 2: x > 1.99"}))

# Around an axis a body has one rigid motion, in how many parts it ever hangs together.
def write_rings(name, *squares):
    """Unit squares with these corners of least coordinates, each of two triangles."""
    number, cells = {}, []
    for x, y in squares:
        a, b, c, d = [number.setdefault((x + i % 2, y + i // 2), len(number) + 1) for i in range(4)]
        cells += [[a, b, d], [a, d, c]]
    text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(number)}\n" + "".join(f"{i} {x} {y} 0\n" for (x, y), i in number.items())
    text += f"$EndNodes\n$Elements\n{len(cells)}\n" + "".join(f"{i} 2 2 1 1 {' '.join(map(str, cell))}\n" for i, cell in enumerate(cells, 1))
    (folder / name).write_text(text + "$EndElements\n")
    return name


ring = {"Plane/Model": "axisymmetric", "Loads/Gravity": "0, -9.81, 0"}
hung = write_rings("hung.msh", (1, 0), (2, 1))
refused(settings_of(hung, "", **{**ring, "Constraints/Clamped boundaries": ""}), "its one rigid motion, along its axis, is free")
runner.simulate(scene, settings_of(hung, "1: y < 1e-9", **ring))
rings = write_rings("rings.msh", (1, 0), (3, 0))
refused(settings_of(rings, "1: x < 2.1 && y < 1e-9", **ring), "1 of the 2 pieces is not held anywhere: that of 2 cells in [3, 4] x [0, 1] m")
refused(settings_of(rings, "1: x < 2.1 && y < 1e-9; 2: x > 2.9 && y < 1e-9", **{**ring, "Plane/Model": "plane strain", "Constraints/Boundaries held along y": 2}),
        "1 of the 3 rigid motions of the piece of 2 cells in [3, 4] x [0, 1] m is free (it can slide along x)")

# One cube alone; and a dynamic scene, which may fall.
one = write("one.msh", (0, 0, 0))
refused(settings_of(one, "1: z < 1e-9", **{"Constraints/Clamped boundaries": "", "Constraints/Boundaries held along z": 1}),
        "3 of its 6 rigid motions are free (it can slide along x and y and turn about z)")
refused(settings_of(one, "", **{"Constraints/Clamped boundaries": ""}), "6 of its 6 rigid motions are free")
refused(settings_of(one, "", **{"Constraints/Clamped boundaries": "", "Constraints/Clamped region": "abs(x - y) < 1e-9 && z < 1e-9"}),
        "1 of its 6 rigid motions is free (it can turn about (")
runner.simulate(scene, {**settings_of(two, floor), "Time/Problem": "dynamic", "Time/Steps": 2})
