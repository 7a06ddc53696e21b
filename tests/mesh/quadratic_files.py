"""Tetrahedra of ten nodes in all formats that have them: each puts the middles of edges in an order of its own, and the volume of a
curved cell tells whether that was kept."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
scene = folder / "scene.prm"
scene.write_text("# a mesh file\nsubsection Mesh\n  set Shape = file\n  set Order = 2\nend\n")

CORNERS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]  # VTK's order
BULGES = [(0.02, -0.03, 0.01), (0.05, 0.02, -0.04), (-0.01, 0.03, 0.02), (0.03, 0.01, -0.02), (0.04, -0.02, 0.03), (-0.03, 0.05, 0.01)]
MIDDLES = [tuple((CORNERS[v][i] + CORNERS[w][i]) / 2 + bulge[i] for i in range(3)) for (v, w), bulge in zip(EDGES, BULGES)]
NODES = [*CORNERS, *MIDDLES]


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


def volume():
    """By the rule of four points."""
    a, b, total = 0.58541019662496852, 0.13819660112501050, 0.0
    for q in range(4):
        L = [a if k == q else b for k in range(4)]
        slopes = [[(4 * L[k] - 1) * x for x in CORNERS[k]] for k in range(4)]
        for (v, w), place in zip(EDGES, MIDDLES):
            for i in range(3):
                slopes[v][i] += 4 * L[w] * place[i]
                slopes[w][i] += 4 * L[v] * place[i]
        total += determinant(*[[slopes[k][i] - slopes[0][i] for i in range(3)] for k in (1, 2, 3)]) / 24
    return total


def rows(first=0):
    return [(i + first, *place) for i, place in enumerate(NODES)]


def lines(*parts):
    return "\n".join(map(str, parts)) + "\n"


ONE = [i + 1 for i in range(10)]
GMSH = [1, 2, 3, 4, 5, 6, 7, 8, 10, 9]
IDEAS = [1, 5, 2, 6, 3, 7, 8, 9, 10, 4]
words = lambda numbers: " ".join(map(str, numbers))
FILES = {
    "one.msh": lines("$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", 10, *[words(row) for row in rows(1)], "$EndNodes", "$Elements", 2,
                     f"1 9 2 3 3 {words([1, 3, 2, 7, 6, 5])}", f"2 11 2 7 7 {words(GMSH)}", "$EndElements"),
    "four.msh": lines("$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$Entities", "0 0 1 1", "1 0 0 0 1 1 1 1 3 0", "1 0 0 0 1 1 1 1 7 1 1",
                      "$EndEntities", "$Nodes", "1 10 1 10", "3 1 0 10", *ONE, *[words(place) for place in NODES], "$EndNodes", "$Elements",
                      "2 2 1 2", "2 1 9 1", f"1 {words([1, 3, 2, 7, 6, 5])}", "3 1 11 1", f"2 {words(GMSH)}", "$EndElements"),
    "old.vtk": lines("# vtk DataFile Version 2.0", "a cell", "ASCII", "DATASET UNSTRUCTURED_GRID", "POINTS 10 double",
                     *[words(place) for place in NODES], "CELLS 2 18", f"10 {words(range(10))}", "6 0 2 1 6 5 4", "CELL_TYPES 2", 24, 22,
                     "CELL_DATA 2", "SCALARS MaterialIds int 1", "LOOKUP_TABLE default", 7, 3),
    "grid.vtu": lines('<?xml version="1.0"?>', '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">', "<UnstructuredGrid>",
                      '<Piece NumberOfPoints="10" NumberOfCells="2">', "<Points>",
                      '<DataArray type="Float64" NumberOfComponents="3" format="ascii">', *[words(place) for place in NODES], "</DataArray>", "</Points>",
                      "<Cells>", f'<DataArray type="Int64" Name="connectivity" format="ascii">{words(range(10))} 0 2 1 6 5 4</DataArray>',
                      '<DataArray type="Int64" Name="offsets" format="ascii">10 16</DataArray>',
                      '<DataArray type="UInt8" Name="types" format="ascii">24 22</DataArray>', "</Cells>",
                      '<CellData><DataArray type="Int32" Name="MaterialIds" format="ascii">7 3</DataArray></CellData>', "</Piece>",
                      "</UnstructuredGrid>", "</VTKFile>"),
    "ideas.unv": lines("    -1", "  2411", *[line for number, x, y, z in rows(1) for line in (f"{number} 1 1 11", f"{x:.16E} {y:.16E} {z:.16E}")],
                       "    -1", "    -1", "  2412", "1 42 3 3 7 6", words([1, 7, 3, 6, 2, 5]), "2 118 7 7 7 10", words(IDEAS[:8]), words(IDEAS[8:]),
                       "    -1"),
    "medit.mesh": lines("MeshVersionFormatted 2", "Dimension 3", "Vertices", 10, *[f"{x} {y} {z} 0" for x, y, z in NODES], "TrianglesP2", 1,
                        "1 3 2 7 6 5 3", "TetrahedraP2", 1, f"{words(ONE)} 7", "End"),
    "nastran.bdf": lines("BEGIN BULK", *[f"GRID,{number},,{x:.6f},{y:.6f},{z:.6f}" for number, x, y, z in rows(1)], "CTETRA,2,7,1,2,3,4,5,6",
                         ",7,8,9,10", "ENDDATA"),
}
expected = volume()
runner.check(abs(expected - 1 / 6) > 0.005, f"the cell is hardly curved: {expected}")
for name, text in FILES.items():
    (folder / name).write_text(text)
    faces = [] if name == "nastran.bdf" else ["0 (3), 3 (1)"]
    output = runner.accepted(runner.run("--check", scene, "--set", f"Mesh/File={name}"),
                             ["1 quadratic tetrahedra, 4 vertices and 6 middles of edges", "7 (1)", *faces], name)
    found = float(output.split(" m^3")[0].split()[-1])
    runner.check(abs(found / expected - 1) < 2e-5, f"{name}: {found} m^3, expected {expected}")

mixed = FILES["one.msh"].replace("$Nodes\n10\n", "$Nodes\n11\n").replace("$EndNodes", "11 1 1 1\n$EndNodes").replace(
    "$Elements\n2\n", "$Elements\n3\n").replace("$EndElements", "3 4 2 7 7 2 3 4 11\n$EndElements")
(folder / "mixed.msh").write_text(mixed)
runner.refused(runner.run("--check", scene, "--set", "Mesh/File=mixed.msh"), ["Mesh/File", "both linear and quadratic tetrahedra", "cell 1"], "mixed")
