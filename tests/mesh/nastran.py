"""Nastran's bulk data as programs write it: fields, continuation lines, files in files; and what is refused because half of the
body would be missing."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
scene = folder / "scene.prm"
scene.write_text("# a mesh file\nsubsection Mesh\n  set Shape = file\nend\n")

VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
GRIDS = "".join(f"GRID,{i},,{x}.,{y}.,{z}.\n" for i, (x, y, z) in enumerate(VERTICES, 1))
CELLS = "CTETRA,1,1,1,2,3,4\nCTETRA,2,2,2,3,4,5\n"
FACES = "CTRIA3,3,10,1,2,3\nCTRIA3,4,20,1,2,4\n"
BODY = ["2 tetrahedra, 5 vertices", "0.5 m^3", "materials   1 (1), 2 (1)", "boundaries  0 (4), 10 (1), 20 (1)"]


def check(text, name="body.bdf"):
    (folder / name).write_text(text)
    return runner.run("--check", scene, "--set", f"Mesh/File={name}")


def accepted(text, words, warnings=0):
    output = runner.accepted(check(text), words, text)
    runner.check(output.count("warning") == warnings, output)


def refused(text, *words):
    runner.refused(check(text), words, text)


accepted("BEGIN BULK\n" + GRIDS + CELLS + FACES + "ENDDATA\n", BODY)
accepted(GRIDS + CELLS + FACES, BODY)
accepted(("SOL 101\nCEND\n$ a comment, CTETRA,9\nBegin Bulk\n" + GRIDS + CELLS + FACES + "ENDDATA\n").lower(), BODY)
accepted("BEGIN BULK\n" + GRIDS + CELLS + FACES, ["ENDDATA is missing: the file may be cut off"], warnings=1)

# Fields of 8 and 16 characters, tabs, numbers without E, ids of properties that are left out.
small = "".join(f"GRID    {i:8d}        {x:8.1f}{y:8.1f}{z:8.1f}\n" for i, (x, y, z) in enumerate(VERTICES, 1))
large = "".join(f"GRID*   {i:16d}{'':16s}{x:16.9E}{y:16.9E}*V{i}\n*V{i}     {z:16.9E}\n" for i, (x, y, z) in enumerate(VERTICES, 1))
cells = "".join("CTETRA  " + "".join(f"{n:8d}" for n in row) + "\n" for row in [(1, 1, 1, 2, 3, 4), (2, 2, 2, 3, 4, 5)])
faces = "CTRIA3\t3\t10\t1\t2\t3\nCTRIA3\t4\t20\t1\t2\t4\n"
accepted(small + cells + faces, BODY)
accepted(large + cells + faces, BODY)
accepted(GRIDS.replace("1.", "10.-1") + CELLS.replace("CTETRA,1,1,", "CTETRA,1,,") + FACES, BODY)
accepted(GRIDS + "CTETRA,1,1,1,2,3,4,,,+A\n+A,,,,\n" + "CTETRA,2,2,2,3,4,5\n" + FACES, BODY)

# Second order, however its lines are joined: the middles of the edges 12, 23, 13, 14, 24, 34 follow the vertices.
places = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0), (0, 0, 0.5), (0.5, 0, 0.5), (0, 0.5, 0.5)]
nodes = "".join(f"GRID    {i + 1:8d}        {x:8.3f}{y:8.3f}{z:8.3f}\n" for i, (x, y, z) in enumerate(places))
LEFT_OUT = ["1 tetrahedra, 4 vertices", "The nodes in the middles of the edges of the file are left out (Mesh/Order = 1)."]
for first, second in [("6", "               7       8       9      10"), ("6+", "+              7       8       9      10"),
                      ("6+C1", "+C1            7       8       9      10")]:
    line = f"CTETRA         1       1       1       2       3       4       5       {first}\n{second}\n"
    accepted(nodes + line, LEFT_OUT, warnings=1)
    accepted(nodes + "CTETRA,1,1,1,2,3,4,5,6,\n,7,8,9,10\n", LEFT_OUT, warnings=1)
    accepted(nodes + "CTETRA,1,1,1,2,3,4,5,6,+\n+,7,8,9,10\n", LEFT_OUT, warnings=1)
refused(nodes + "CTETRA,1,1,1,2,3,4,5,6,\n,7,,9,10\n", "in field 11 is not a whole number")
refused(GRIDS + CELLS + "CHEXA,9,1,1,2,3,4,5,6,+\n+,7,8\n", "1 of the kind CHEXA")
accepted(GRIDS + CELLS + FACES + "CQUAD4,9,7,1,2,3,4\n", ["Elements of the surface that are not read: 1 of the kind CQUAD4."], warnings=1)
accepted(GRIDS + CELLS + FACES + "RBE2,9,1,123,2,3\n", ["RBE2 (1)"], warnings=1)

# Between commas the mark may come early. A vertex with a sign is none.
accepted(GRIDS + "CTETRA,1,1,1,2,3,4,+\n+,\n" + "CTETRA,2,2,2,3,4,5,+A\n+A,,\n" + FACES, BODY)
accepted(GRIDS.replace("GRID,5,,1.,1.,1.", "GRID,5,,1.,1.,+1.") + CELLS + FACES, BODY)

# A mark may begin with any character; CBARAO and the like are no lines of the body; numbers may be large.
accepted(GRIDS + "CTETRA  1       1       1       2       3       4                       K1\n+1\n" + "CTETRA,2,2,2,3,4,5\n" + FACES, BODY)
accepted(GRIDS + CELLS + FACES + "CBAR,9,7,1,2,0.,0.,1.\nCBARAO,9,FR,0.5\n", ["CBARAO (1)"], warnings=1)
accepted(GRIDS.replace("GRID,5,", "GRID,80000000001,") + CELLS.replace(",5\n", ",80000000001\n") + FACES, BODY)
refused(GRIDS + "CTETRA,1,80000000001,1,2,3,4\n", "80000000001, is too large")

# Half of the mesh in another file, or all of it.
(folder / "half.bdf").write_text("GRID,5,,1.,1.,1.\nCTETRA,2,2,2,3,4,5\n")
whole = GRIDS.replace("GRID,5,,1.,1.,1.\n", "") + "CTETRA,1,1,1,2,3,4\n" + FACES
accepted("BEGIN BULK\n" + whole + "INCLUDE 'half.bdf'\nENDDATA\n", BODY)
accepted("BEGIN BULK\ninclude half.bdf\n" + whole + "ENDDATA\n", BODY)
(folder / "all.bdf").write_text(GRIDS + CELLS + FACES)
accepted("CEND\nBEGIN BULK\nINCLUDE \"all.bdf\"\nENDDATA\n", BODY)
(folder / "case.inc").write_text("CTETRA,9\nSUBCASE 1\n  LOAD = 2\n")
accepted("SOL 101\nCEND\nINCLUDE 'case.inc'\nBEGIN BULK\n" + GRIDS + CELLS + FACES + "ENDDATA\n", BODY)
(folder / "head.inc").write_text("CTETRA,9\nBEGIN BULK\n" + GRIDS)
accepted("SOL 101\nCEND\nINCLUDE 'head.inc'\n" + CELLS + FACES + "ENDDATA\n", BODY)
(folder / "mark.bdf").write_text("\ufeff" + GRIDS)
refused("BEGIN BULK\nINCLUDE 'mark.bdf'\n" + CELLS, "mark.bdf begins with a byte order mark")
refused("INCLUDE 'nowhere.bdf'\n" + whole, "line 1", "'nowhere.bdf' is not there")
refused("INCLUDE 'body.bdf'\n" + whole, "include each other")

# What would move vertices, lose elements, or mix them up.
refused(GRIDS.replace("GRID,5,,", "GRID,5,3,") + CELLS, "line 5", "coordinate system 3")
refused("GRDSET,,7\n" + GRIDS + CELLS, "coordinate system 7")
refused(GRIDS + "GRID,1,,5.,5.,5.\n" + CELLS, "vertex 1 is given twice")
refused(GRIDS + CELLS.replace("CTETRA,2", "CTETRA,1"), "element 1 is given twice")
refused(GRIDS + CELLS.replace("4,5", "4,x"), "'X' in field 7", "is not a whole number")
refused(GRIDS.replace("GRID,5,,1.", "GRID,5,,1.x") + CELLS, "is not a number")
refused(GRIDS + CELLS + "=,*(1),=\n", "repeat others")
refused(GRIDS + "CTETRA,1,1,1,2,3,4,5,6,+A\n+B,7,8,9,10\n", "not that of the line before it")
refused("GRID,1,,0.,0.,0.\n", "it has 1 vertex but no tetrahedra")
