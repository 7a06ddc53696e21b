"""Ids of elements and names of groups, as each format gives them: material ids, boundary ids, and what is said where an element
is in two groups. The bar of two materials has an exact answer."""

import pathlib
import struct
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))

# Two tetrahedra that share a face, with the ids 1 and 2; two triangles of their surface, with the ids 10 and 20.
VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
CELLS = [((1, 2, 3, 4), 1), ((2, 3, 4, 5), 2)]
FACES = [((1, 2, 3), 10), ((1, 2, 4), 20)]
MATERIALS, BOUNDARIES = "materials   1 (1), 2 (1)", "boundaries  0 (4), 10 (1), 20 (1)"

scene = folder / "scene.prm"
scene.write_text("# a mesh file\nsubsection Mesh\n  set Shape = file\nend\n")


def check(name, *settings):
    words = [word for setting in (f"Mesh/File={name}", *settings) for word in ("--set", setting)]
    return runner.run("--check", scene, *words)


def accepted(name, *words, settings=(), warnings=0):
    status, output, error = check(name, *settings)
    runner.check(status == 0, f"{name}: exit status {status}, {error}")
    for word in words:
        runner.check(word in output, f"{name}: '{word}' is missing in\n{output}")
    runner.check(output.count("warning") == warnings, f"{name}: {warnings} warning(s) were expected in\n{output}")
    return output


def refused(name, *words, settings=()):
    status, output, error = check(name, *settings)
    runner.check(status == 1 and output == "", f"{name}: exit status {status}, {output}{error}")
    for word in words:
        runner.check(word in error, f"{name}: '{word}' is missing in {error}")


def save(name, text):
    (folder / name).write_text(text)
    return name


def rows(items):
    return "".join(" ".join(map(str, item)) + "\n" for item in items)


def msh2(name, elements, names=(), vertices=VERTICES):
    """Version 2.2; elements: type, group, elementary number, vertices."""
    text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    if names:
        text += f"$PhysicalNames\n{len(names)}\n" + "".join(f'{d} {i} "{n}"\n' for d, i, n in names) + "$EndPhysicalNames\n"
    text += f"$Nodes\n{len(vertices)}\n" + rows((i, *v) for i, v in enumerate(vertices, 1)) + f"$EndNodes\n$Elements\n{len(elements)}\n"
    text += rows((i, kind, 2, group, entity, *nodes) for i, (kind, group, entity, nodes) in enumerate(elements, 1))
    return save(name, text + "$EndElements\n")


def binary2(name, elements, order):
    """The same, binary, each element in a block of its own."""
    data = b"$MeshFormat\n2.2 1 8\n" + struct.pack(order + "i", 1) + f"\n$EndMeshFormat\n$Nodes\n{len(VERTICES)}\n".encode()
    data += b"".join(struct.pack(order + "iddd", i, *v) for i, v in enumerate(VERTICES, 1))
    data += f"\n$EndNodes\n$Elements\n{len(elements)}\n".encode()
    for i, (kind, group, entity, nodes) in enumerate(elements, 1):
        data += struct.pack(f"{order}6i{len(nodes)}i", kind, 1, 2, i, group, entity, *nodes)
    (folder / name).write_bytes(data + b"\n$EndElements\n")
    return name


def msh1(name, elements, vertices=VERTICES):
    text = f"$NOD\n{len(vertices)}\n" + rows((i, *v) for i, v in enumerate(vertices, 1)) + f"$ENDNOD\n$ELM\n{len(elements)}\n"
    text += rows((i, kind, group, entity, len(nodes), *nodes) for i, (kind, group, entity, nodes) in enumerate(elements, 1))
    return save(name, text + "$ENDELM\n")


def msh4(name, volumes, blocks):
    """Version 4.1; volumes: entity -> groups; blocks: entity, numbers, cells. All vertices are of the first volume."""
    text = f"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 {len(volumes)}\n"
    text += rows((entity, 0, 0, 0, 1, 1, 1, len(groups), *groups, 0) for entity, groups in volumes.items()) + "$EndEntities\n"
    text += f"$Nodes\n1 {len(VERTICES)} 1 {len(VERTICES)}\n3 {min(volumes)} 0 {len(VERTICES)}\n"
    text += rows([(i,) for i in range(1, len(VERTICES) + 1)]) + rows(VERTICES) + "$EndNodes\n"
    n = sum(len(cells) for _, _, cells in blocks)
    text += f"$Elements\n{len(blocks)} {n} 1 {max(max(numbers) for _, numbers, _ in blocks)}\n"
    for entity, numbers, cells in blocks:
        text += f"3 {entity} 4 {len(cells)}\n" + rows((number, *cell) for number, cell in zip(numbers, cells))
    return save(name, text + "$EndElements\n")


ONE_ENTITY = [(4, group, 1, cell) for cell, group in CELLS] + [(2, group, 1, face) for face, group in FACES]
accepted(msh2("two.msh", ONE_ENTITY), MATERIALS, BOUNDARIES)
accepted(msh1("one.msh", ONE_ENTITY), MATERIALS, BOUNDARIES)
accepted(msh1("no-entity.msh", [(kind, group, 0, nodes) for kind, group, _, nodes in ONE_ENTITY]), MATERIALS, BOUNDARIES)
accepted(msh2("no-group.msh", [(kind, 0, 1, nodes) for kind, _, _, nodes in ONE_ENTITY]), "materials   0 (2)", "boundaries  0 (6)")
accepted(msh2("some.msh", [(4, 1, 1, CELLS[0][0]), (4, 0, 1, CELLS[1][0])]), "materials   0 (1), 1 (1)")
accepted(binary2("binary.msh", ONE_ENTITY, "<"), MATERIALS, BOUNDARIES)
accepted(binary2("swapped.msh", ONE_ENTITY, ">"), MATERIALS, BOUNDARIES)

# Version 2 with the parts that the elements are in, blank lines, lines that end with CR LF, and comments; and what is not whole.
whole = (folder / "two.msh").read_text()
accepted(save("parts.msh", whole.replace("4 2 1 1 ", "4 4 1 0 1 2 ")), MATERIALS, BOUNDARIES)
accepted(save("blank.msh", whole.replace("$Nodes\n5\n", "$Nodes\n5\n\n").replace("$EndElements", "\n$EndElements")), MATERIALS, BOUNDARIES)
packed = (folder / "binary.msh").read_bytes().replace(b"\n$End", b"$End")
(folder / "packed.msh").write_bytes(packed)
accepted("packed.msh", MATERIALS, BOUNDARIES)
accepted(save("windows.msh", whole.replace("\n", "\r\n")), MATERIALS, BOUNDARIES)
accepted(save("comments.msh", "$Comments\nmade by hand\n$EndComments\n" + whole), MATERIALS, BOUNDARIES)
accepted(save("later.msh", whole.replace("$EndMeshFormat\n", "$EndMeshFormat\n$Later\n1 2\n$EndLater\n")), MATERIALS, BOUNDARIES)
refused(save("fewer.msh", whole.replace("$Elements\n4\n", "$Elements\n5\n")), "announces 5 elements, but has 4")
refused(save("more.msh", whole.replace("$Elements\n4\n", "$Elements\n3\n")), "announces 3 elements, but has more")
refused(save("nodes.msh", whole.replace("$Nodes\n5\n", "$Nodes\n6\n")), "announces 6 nodes, but has 5")
refused(save("again.msh", whole.replace("\n5 1 1 1\n", "\n4 1 1 1\n")), "node 4 is given twice")
refused(save("nowhere.msh", whole.replace("2 3 4 5\n", "2 3 4 6\n")), "node 6, which is not in the file")
refused(save("three.msh", whole.replace("1 4 2 1 1 1 2 3 4\n", "1 4 2 1 1 1 2 3\n")), "element 1 has 3 nodes", "should be 4")
refused(save("word.msh", whole.replace("2 1 0 0\n", "2 1 0 o\n")), "'2 1 0 o'")

# An element in two groups: the least id counts, and it is said.
accepted(msh2("twice.msh", [*ONE_ENTITY, (4, 5, 2, CELLS[0][0])]), MATERIALS, "1 cell(s) belong to two physical volumes", warnings=1)
refused(msh2("again.msh", [*ONE_ENTITY, (4, 2, 1, CELLS[1][0]), (4, 2, 1, CELLS[1][0])]), "given twice")
accepted(msh4("overlap.msh", {1: [1], 2: [1, 2]}, [(1, [1], [CELLS[0][0]]), (2, [2], [CELLS[1][0]])]),
         "materials   1 (2)", "1 cell(s) belong to two physical volumes", warnings=1)
accepted(msh4("anew.msh", {1: [1], 2: [2]}, [(1, [1], [CELLS[0][0]]), (2, [1], [CELLS[1][0]])]), MATERIALS)
overlap = [(2, 20, 1, FACES[0][0]), (2, 20, 1, FACES[1][0])]
accepted(msh2("faces.msh", [*ONE_ENTITY, *overlap]), BOUNDARIES, "1 triangle(s) belong to two physical surfaces", warnings=1)

# Medit, Nastran, VTK.
medit = "MeshVersionFormatted 2\nDimension 3\n# vertices\nVertices\n5\n" + rows((*v, 0) for v in VERTICES)
medit += "Tetrahedra 2\n" + rows((*cell, i) for cell, i in CELLS) + "Triangles\n2\n" + rows((*face, i) for face, i in FACES) + "Corners 1\n1\nEnd\n"
accepted(save("two.mesh", medit), MATERIALS, BOUNDARIES)
accepted(save("negative.mesh", medit.replace("1 2 3 4 1\n", "1 2 3 4 -1\n")), "materials   0 (1), 2 (1)", "negative reference", warnings=1)
refused(save("short.mesh", medit[:medit.index("Triangles")].replace("Tetrahedra 2", "Tetrahedra 3")), "ends before all tetrahedra")
refused(save("long.mesh", medit.replace("Tetrahedra 2", "Tetrahedra 1")), "more tetrahedra than the 1")
refused(save("hexahedra.mesh", medit.replace("Corners 1\n1\n", "Hexahedra 1\n1 2 3 4 5 1 2 3 0\n")), "1 of the kind Hexahedron 8")

vtk = "# vtk DataFile Version {}\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n{}POINTS 5 double\n" + rows(VERTICES) + "{}"
cells = "CELLS 4 18\n" + rows((len(nodes), *[v - 1 for v in nodes]) for nodes, _ in CELLS + FACES) + "CELL_TYPES 4\n10 10 5 5\n"
ids = "CELL_DATA 4\nSCALARS {} int 1\nLOOKUP_TABLE default\n1 2 10 20\n"
accepted(save("two.vtk", vtk.format("3.0", "", "") + cells + ids.format("medit")), MATERIALS, BOUNDARIES)
accepted(save("stress.vtk", vtk.format("3.0", "", "") + cells + ids.format("stress")), "materials   0 (2)", "stress", warnings=1)
metadata = "\nMETADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1.7\n\n"
field = "FIELD FieldData 1\nTIME 1 1 double\n0.5\n"
fields = "POINT_DATA 5\nSCALARS p double\nLOOKUP_TABLE default\n1 2 3 4 5\nCELL_DATA 4\nFIELD FieldData 2\ns 3 4 double\n" + "0 0 0\n" * 4
fields += metadata + "MaterialIds 1 4 int\n1 2 10 20\n"
accepted(save("paraview.vtk", vtk.format("4.2", field, metadata) + cells + fields), MATERIALS, BOUNDARIES)
new = "CELLS 5 14\nOFFSETS vtktypeint64\n0 4 8 11 14\nCONNECTIVITY vtktypeint64\n" + rows([v - 1 for v in nodes] for nodes, _ in CELLS + FACES)
accepted(save("five.vtk", vtk.format("5.1", "", metadata) + new + "CELL_TYPES 4\n10 10 5 5\n" + ids.format("MaterialIds")), MATERIALS, BOUNDARIES)
refused(save("short.vtk", vtk.format("3.0", "", "") + cells.replace("CELLS 4 18", "CELLS 5 18")), "announces 5 cells")
text = "FIELD FieldData 1\nnames 1 2 string\nof%20one\ntwo words\n"
accepted(save("strings.vtk", vtk.format("3.0", text, "") + cells + ids.format("mat_id")), MATERIALS, BOUNDARIES)
accepted(save("negative.vtk", vtk.format("3.0", "", "") + cells + ids.format("medit").replace("1 2 10", "-1 2 10")),
         "materials   0 (1), 2 (1)", "negative id", warnings=1)
ghosts = "CELL_DATA 4\nFIELD FieldData 1\nvtkGhostType 1 4 unsigned_char\n0 1 0 0\n"
accepted(save("ghosts.vtk", vtk.format("4.2", "", "") + cells + ghosts), "1 tetrahedra", "1 ghost cell(s)", warnings=2)
refused(save("neither.vtk", "# vtk DataFile Version 3.0\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"), "ASCII or BINARY")
refused(save("surface.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"), "POLYDATA", "UNSTRUCTURED_GRID")

# Names of groups stand for their numbers wherever those do.
NAMES = [(3, 1, "soft"), (3, 2, "hard"), (2, 10, "clamp"), (2, 20, "pulled face")]
msh2("names.msh", ONE_ENTITY, NAMES)
accepted("names.msh", "held; 1 process", "10 (1)", settings=["Constraints/Clamped boundaries=clamp"])
accepted(msh2("signs.msh", ONE_ENTITY, [*NAMES[:2], (2, 10, "clamp#1")]), "The group clamp#1 has a #", warnings=1)
unv = "    -1\n  2411\n" + "".join(f"{i:10d}         1         1        11\n{x:25.16E}{y:25.16E}{z:25.16E}\n" for i, (x, y, z) in enumerate(VERTICES, 1))
unv += "    -1\n    -1\n  2412\n"
for number, (nodes, _) in enumerate(FACES + CELLS, 1):
    unv += f"{number:10d}{91 if len(nodes) == 3 else 111:10d}         2         1         7{len(nodes):10d}\n" + "".join(f"{v:10d}" for v in nodes) + "\n"
unv += "    -1\n    -1\n  2467\n"
for number, (name, member) in enumerate([("clamp", 1), ("pulled face", 2), ("soft", 3), ("hard", 4)], 1):
    unv += f"{number:10d}" + "         0" * 6 + f"         1\n{name}\n         8{member:10d}         0         0\n"
save("salome.unv", unv + "    -1\n")
accepted(save("zero.unv", unv.replace("         1         0         0         0         0         0         0         1\nclamp",
                                       "         0" * 7 + "         1\nclamp") + "    -1\n"), "clamp (boundary ")
accepted("salome.unv", "materials   3 (1), 4 (1)", "boundaries  0 (4), 1 (1), 2 (1)", "clamp", "hard")
refused(save("cut.unv", unv[:-41]), "ends within")
refused(save("cut.unv", unv[:-30]), "4 whole numbers")
for name in ("names.msh", "salome.unv"):
    refused(name, "'clmp' is no boundary id", "clamp", settings=["Constraints/Clamped boundaries=clmp"])
    refused(name, "id: Young modulus", settings=["Material/By id=harder: 1e7, 0.3, 1000"])
    by_name = {"Mesh/File": name, "Time/Problem": "static", "Time/Steps": 1, "Constraints/Clamped boundaries": "clamp",
               "Material/By id": "hard: 1e7, 0.3, 1000", "Loads/Traction": "0; 0; 100", "Loads/Traction on": "pulled face",
               "Probes/Boundaries": "end: pulled face", "Probes/Points": "tip: 1, 1, 1"}
    numbers = (10, 20, 2) if name == "names.msh" else (1, 2, 4)
    by_number = {**by_name, "Constraints/Clamped boundaries": numbers[0], "Loads/Traction on": numbers[1],
                 "Probes/Boundaries": f"end: {numbers[1]}", "Material/By id": f"{numbers[2]}: 1e7, 0.3, 1000"}
    named, numbered = (runner.simulate(scene, settings).probes()[-1] for settings in (by_name, by_number))
    runner.check(named == numbered and abs(named["tip.uz"]) > 0., f"{name}: {named}, by numbers {numbered}")

# A bar of four cubes, the left half a hundred times as stiff: pulled by 1000 Pa it becomes 2 F/E1 + 2 F/E2 longer.
BAR = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in range(5)]
CUBE = [(0, 1, 6, 16), (0, 1, 11, 16), (0, 5, 6, 16), (0, 5, 15, 16), (0, 10, 11, 16), (0, 10, 15, 16)]
bar = [(4, 1 + (x > 1), 1, [v + x + 1 for v in cell]) for x in range(4) for cell in CUBE]
for name in (msh2("bar2.msh", bar, vertices=BAR), msh1("bar1.msh", bar, vertices=BAR)):
    pulled = {"Mesh/File": name, "Mesh/Boundary regions": "1: x < 1e-9; 2: x > 3.999", "Material/Young modulus": 1e5, "Material/Poisson ratio": 0,
              "Material/By id": "1: 1e7, 0, 1000", "Constraints/Clamped boundaries": 1, "Loads/Traction": "1000; 0; 0", "Loads/Traction on": 2,
              "Time/Problem": "static", "Time/Steps": 1, "Probes/Boundaries": "end: 2"}
    longer = runner.simulate(scene, pulled).probes()[-1]["end.ux"]
    runner.check(abs(longer - 0.0202) < 1e-9, f"{name}: the end moves by {longer} m")
