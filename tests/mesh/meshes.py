"""Mesh files a user may bring: what is mended, what is said, what is refused."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))

# Two tetrahedra that share a face.
VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
CELLS = [(0, 1, 2, 3), (1, 2, 3, 4)]


def write(name, vertices=VERTICES, cells=CELLS, kind=4, numbers=None, surface=(), groups=(7, 7)):
    """A .msh file of version 2.2; surface: (boundary id, triangle)."""
    groups = [*groups, *[7] * len(cells)]
    elements = [(kind, group, cell) for group, cell in zip(groups, cells)] + [(2, boundary, triangle) for boundary, triangle in surface]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", len(vertices)]
    lines += [f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(vertices, 1)] + ["$EndNodes", "$Elements", len(elements)]
    lines += [f"{numbers[i] if numbers else i + 1} {kind} 2 {group} {group} {' '.join(str(v + 1) for v in element)}"
              for i, (kind, group, element) in enumerate(elements)]
    (folder / name).write_text("\n".join(map(str, lines)) + "\n$EndElements\n")
    return name


scene = folder / "scene.prm"
scene.write_text("# a mesh file\nsubsection Mesh\n  set Shape = file\nend\n"
                 "subsection Constraints\n  set Clamped region = z < 0.5\nend\n")


def check(name, *settings):
    """supple --check with this mesh file: exit status, output, error."""
    words = [word for setting in (f"Mesh/File={name}", *settings) for word in ("--set", setting)]
    return runner.run("--check", scene, *words)


def accepted(name, *words, settings=()):
    return runner.accepted(check(name, *settings), words, name)


def refused(name, *words, settings=()):
    error = runner.refused(check(name, *settings), ("Mesh/", *words), name)
    runner.check(len(error) < 600, error)


good = accepted(write("good.msh"), "2 tetrahedra, 5 vertices", "[0, 1] x [0, 1] x [0, 1] m", "materials   7 (2)",
                "pieces      1", "repaired    0")
runner.check("warning" not in good, good)
accepted("good.msh", "[0, 0.001] x [0, 0.001]", settings=["Mesh/Scale=1e-3"])

accepted(write("inverted.msh", cells=[(0, 2, 1, 3), CELLS[1]]), "1 inverted cell(s) were reoriented")
accepted(write("sliver.msh", vertices=VERTICES[:4] + [(0.34, 0.34, 0.34)]), "1 cell(s) are slivers",
         "the worst is cell 1 at (")
accepted(write("unused.msh", vertices=[*VERTICES, (5, 5, 5)]), "5 vertices", "1 vertex is in no cell")
accepted(write("double.msh", vertices=[*VERTICES, (1, 0, 0)], cells=[CELLS[0], (5, 2, 3, 4)]),
         "1 vertex lies at the place of another one")
apart = [(x + 3, y, z) for x, y, z in VERTICES[:4]]
accepted(write("pieces.msh", vertices=[*VERTICES, *apart], cells=[*CELLS, (5, 6, 7, 8)]),
         "in 2 pieces that do not hang together")
accepted("pieces.msh", "1 of the 2 pieces is not held anywhere: that of 1 cell in [3, 4] x [0, 1] x [0, 1] m.", settings=["Constraints/Clamped region=x < 0.1"])
status, _, error = check("pieces.msh", "Time/Problem=static", "Constraints/Clamped region=x < 0.1")
runner.check(status == 1 and "1 of the 2 pieces is not held anywhere: that of 1 cell" in error, error)

# Far from the origin the box around the body is told with the digits that show its size.
far = [(500000 + 10 * x, 5400000 + 4 * y, 300 + 4 * z) for x, y, z in VERTICES]
accepted(write("far.msh", vertices=far), "[500000, 500010] x [5400000, 5400004] x [300, 304] m", "from the origin", settings=["Constraints/Clamped region="])

outer, inner = (0, 1, 2), (1, 2, 3)
accepted(write("surface.msh", surface=[(3, outer), (4, inner)]), "3 (1)", "1 triangle(s) of groups lie inside")
accepted(write("twice.msh", surface=[(3, outer), (4, outer)]), "3 (1)", "1 triangle(s) belong to several groups")
accepted("good.msh", "8 (1)", "9 (3)", settings=["Mesh/Boundary regions=8: z == 0; 9: x + y + z >= 1"])
refused("good.msh", "no face of the surface", "z > 5", settings=["Mesh/Boundary regions=8: z > 5"])
refused("good.msh", "id: expression", settings=["Mesh/Boundary regions=top: z > 0"])

refused(write("flat.msh", vertices=[*VERTICES[:4], (0.5, 0.5, 0)]), "1 cell(s) are flat", "cell 1 at (")
refused(write("three.msh", vertices=[*VERTICES, (0.2, 0.2, -1), (0.2, 0.2, -2)],
              cells=[CELLS[0], (0, 2, 1, 5), (0, 2, 1, 6)]), "a face has three cells")
accepted(write("numbers.msh", numbers=[44, 44]), "2 tetrahedra, 5 vertices", "0.5 m^3")
refused(write("only-surface.msh", cells=[(1, 2, 3)], kind=2), "but no tetrahedra", "plane z = 0")

# Quadratic cells: Gmsh's order of the edges is 01 12 02 03 23 13. With order 1 the middles are left out, with a word.
corners = VERTICES[:4]
edges = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
middles = [tuple((a + b) / 2 for a, b in zip(corners[v], corners[w])) for v, w in edges]
ten = tuple(range(10))
accepted(write("quadratic.msh", vertices=[*corners, *middles], cells=[ten], kind=11), "1 tetrahedra, 4 vertices", "left out (Mesh/Order = 1)")
second = ["Mesh/Order=2"]
accepted("quadratic.msh", "1 quadratic tetrahedra, 4 vertices and 6 middles of edges", settings=second)
accepted("good.msh", "2 quadratic tetrahedra, 5 vertices and 9 middles of edges", settings=second)
far_off = [(0.5, 0, 1.5), *middles[1:]]
refused(write("folded.msh", vertices=[*corners, *far_off], cells=[ten], kind=11), "the curved edges of cell 0", "fold it", settings=second)
refused(write("two-middles.msh", vertices=[*VERTICES, *[(i / 20, 0.1, 0.1) for i in range(12)]],
              cells=[(0, 1, 2, 3, 5, 6, 7, 8, 9, 10), (1, 2, 3, 4, 11, 12, 13, 14, 15, 16)], kind=11), "has two nodes in its middle")
refused("quadratic.msh", "Mesh/Refine region", "curved", settings=[*second, "Mesh/Refine region=1"])

(folder / "garbage.msh").write_bytes(bytes(range(256)) * 20)
refused("garbage.msh", "garbage.msh")

# Cells of another kind are not lost without a word: a cube beside two tetrahedra.
cube = [(5 + (i in (1, 2, 5, 6)), i in (2, 3, 6, 7), i > 3) for i in range(8)]
write("cube.msh", vertices=[*VERTICES, *[tuple(map(float, corner)) for corner in cube]])
text = (folder / "cube.msh").read_text().replace("$Elements\n2\n", "$Elements\n3\n")
(folder / "cube.msh").write_text(text.replace("$EndElements", "3 5 2 7 7 6 7 8 9 10 11 12 13\n$EndElements"))
refused("cube.msh", "1 of the kind Hexahedron 8", "tetrahedra")

# Vertices keep the order of their numbers in the file, whatever entity they are on.
write("order.msh", vertices=[(0, 0, 1), (0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 1)], cells=[(1, 2, 3, 0), (2, 3, 0, 4)],
      surface=[(3, (2, 3, 4))])
for vertex, place in enumerate(["(0, 0, 1)", "(0, 0, 0)", "(1, 0, 0)", "(0, 1, 0)", "(1, 1, 1)"]):
    accepted("order.msh", f"vertex {vertex} at {place}", settings=[f"Probes/Points=a: vertex {vertex}"])

# Binary VTK.
accepted(runner.DATA / "meshes" / "legacy-binary.vtk", "12 tetrahedra, 12 vertices", "[0, 2] x [0, 1] x [0, 1] m")

# A text that is no mesh is not run as one of Gmsh's scripts.
(folder / "script.msh").write_text(f'SystemCall "touch {folder}/was-run";\n')
refused("script.msh", "not a mesh that Gmsh has written", "$MeshFormat")
runner.check(not (folder / "was-run").exists(), "the mesh file was run")
(folder / "cut.msh").write_text((folder / "good.msh").read_text()[:120])
refused("cut.msh", "cut.msh")
refused("missing.msh", "no such file")
for name, words in [("body.stl", ["surface", "no volume"]), ("body.e", ["scripts/convert-mesh.py", "meshio convert", "--output-format gmsh22"]),
                    ("body.inp", ["meshio convert"]), ("body.geo", [".geo is not known", ".msh"]), ("body.meshb", ["meshio convert"]),
                    ("body.vtu", ["none of VTK's XML files", "<VTKFile"]), ("body.pvtu", ["files of its parts"]),
                    ("body.dat", ["Nastran's bulk data", ".bdf"])]:
    (folder / name).write_text("solid\n")
    refused(name, *words)
for name, content, words in [("empty.msh", "", ["is empty"]), ("no-ending", "x", ["no ending", "Read are .msh"]),
                             ("body.MSH", "x", ["small letters"]), ("body.STL", "x", ["surface"]), ("body.obj", "x", ["surface"]),
                             ("body.ele", "x", ["TetGen", "meshio convert"]), ("old.vtk", "x", ["not a legacy VTK file"]),
                             ("xml.vtk", "<VTKFile type='UnstructuredGrid'>", ["ending .vtu"]),
                             ("legacy.vtu", "# vtk DataFile Version 3.0\n", ["ending .vtk"]),
                             ("new.vtk", "# vtk DataFile Version 6.0\nx\nBINARY\n", ["version 6.0", "meshio convert", "new.msh"]),
                             ("mark.msh", "\ufeff$MeshFormat\n2.2 0 8\n", ["byte order mark"]),
                             ("my body.med", "x", [f"meshio convert '{folder}/my body.med' '{folder}/my body.msh'"])]:
    (folder / name).write_text(content)
    refused(name, *words)
(folder / "one#two.msh").write_text((folder / "good.msh").read_text())
refused("one#two.msh", "one#two.msh", "begins a comment")
(folder / "folder.msh").mkdir()
refused("folder.msh", "is a folder")
status, _, error = runner.run("--check", scene)
runner.check(status == 1 and "Shape = file needs a mesh file" in error, error)

cylinder = ["--check", scene, "--set", "Mesh/Shape=hollow cylinder"]
for setting, words in [("Mesh/Cylinder inner radius=0.5", "smaller than the outer radius"),
                       ("Mesh/Cylinder sectors=4", "more sectors"), ("Mesh/Cylinder sectors=2", "3 or greater"),
                       ("Mesh/Cylinder rings=1", "2 or greater")]:
    status, _, error = runner.run(*cylinder, "--set", setting)
    runner.check(status == 1 and words in error, f"{setting}: {error}")

# Materials by id: the clamp bears the weight of both, and only ids that exist are taken.
write("materials.msh", groups=(1, 2))
light = {"Mesh/File": "materials.msh", "Time/Problem": "static", "Time/Steps": 1, "Loads/Gravity": "0, 0, -10",
         "Material/Density": 600, "Probes/Regions": "wall: z < 0.5"}
for exception, weight in [("", 10 * 600 * (1 / 6 + 1 / 3)), ("2: 1e6, 0.3, 900", 10 * (600 / 6 + 900 / 3))]:
    reaction = runner.simulate(scene, {**light, "Material/By id": exception}).probes()[-1]["wall.fz"]
    runner.check(abs(reaction - weight) < 1e-6 * weight, f"reaction {reaction} to the weight {weight}")
for text, words in [("3: 1e6, 0.3, 900", "no cell has the material id 3"), ("2: 1e6, 0.5, 900", "id: Young modulus"),
                    ("2: 1e6, 0.3", "id: Young modulus"), ("soft: 1, 0, 1", "id: Young modulus")]:
    status, _, error = check("materials.msh", f"Material/By id={text}")
    runner.check(status == 1 and words in error, f"{text}: {error}")

# A body from a file falls freely like any other.
settings = {"Mesh/File": "good.msh", "Constraints/Clamped region": "", "Loads/Gravity": "0, 0, -10", "Time/Steps": 10,
            "Probes/Points": "a: 1, 1, 1"}
fall = runner.simulate(scene, settings).probes()[-1]
runner.check(abs(fall["a.uz"] + 10 * 0.01**2 * 55) < 1e-9, f"fallen by {fall['a.uz']} m")

# A Gmsh that crashes on a damaged file does not take the program with it, on no process; another one may read it.
damaged = bytearray((runner.DATA / "meshes" / "ideas.unv").read_bytes())
damaged[1414:1419] = b"-9999"
(folder / "damaged.unv").write_bytes(damaged)
for ranks in (1, 2):
    status, _, error = runner.run("--check", scene, "--set", "Mesh/File=damaged.unv", ranks=ranks)
    runner.check(status == 0 or status == 1 and error.count("Mesh/File = damaged.unv: ") == 1, f"exit status {status}: {error}")

# The first process reads and checks a mesh; all know what it found, and its refusals are told once.
apart = [(x + 3, y, z) for x, y, z in VERTICES]
write("found.msh", vertices=VERTICES + apart + [(9, 9, 9)], cells=[(0, 2, 1, 3), CELLS[1]] + [tuple(v + 5 for v in cell) for cell in CELLS],
      surface=[(5, (0, 1, 2)), (6, (1, 2, 3))], groups=(1, 2, 3, 3))
status, alone, error = check("found.msh")
runner.check(status == 0 and "2 pieces" in alone + error and "inverted" in alone + error, alone + error)
status, together, error = runner.run("--check", scene, "--set", "Mesh/File=found.msh", ranks=2)
facts, shared = ([line for line in text.splitlines() if "process" not in line and "solver" not in line] for text in (alone, together))
runner.check(status == 0 and facts == shared, f"one process:\n{alone}two:\n{together}{error}")
write("flat.msh", vertices=VERTICES[:3] + [(1, 1, 0), (0, 0, 2)])
for name, words in [("flat.msh", "are flat"), ("nowhere.msh", "no such file")]:
    status, _, error = runner.run("--check", scene, "--set", f"Mesh/File={name}", ranks=2)
    runner.check(status == 1 and error.count(words) == 1, f"{name} on two processes: exit status {status}: {error}")

# A mesh cut into parts, whose cells at the cuts are told to the other parts too (ghosts), has each cell once.
accepted(runner.DATA / "meshes" / "ghosts.msh", "368 tetrahedra", settings=["Constraints/Clamped region="])
