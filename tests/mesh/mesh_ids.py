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
    output = runner.accepted(check(name, *settings), words, name)
    runner.check(output.count("warning") == warnings, f"{name}: {warnings} warning(s) were expected in\n{output}")
    return output


def refused(name, *words, settings=()):
    runner.refused(check(name, *settings), words, name)


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

refused(save("twice.msh", whole.replace("$EndElements\n", "$EndElements\n$Elements\n1\n5 4 2 7 7 1 2 3 5\n$EndElements\n")), "two sections of elements")
refused(save("large.msh", whole.replace("1 4 2 1 1 1 2 3 4", "1 4 2 3000000000 1 1 2 3 4")), "3000000000 can't be an id", "2147483647 at most")
refused(save("version.msh", whole.replace("2.2 0 8", "3 0 8")), "version 3", "versions 1, 2 and 4 are read")
packed = (folder / "binary.msh").read_bytes()
for name, before, after, words in [("fewer-packed.msh", b"$Elements\n4", b"$Elements\n3", "announces 3 elements, but has more"),
                                   ("nodes-packed.msh", b"$Nodes\n5", b"$Nodes\n4", "announces 4 nodes, but has more")]:
    (folder / name).write_bytes(packed.replace(before, after))
    refused(name, words)

# Version 4: what is announced, and what is there; a node with two places.
def binary4(name, n_nodes=5, n_elements=2, numbers=(1, 2, 3, 4, 5), order="<"):
    data = b"$MeshFormat\n4.1 1 8\n" + struct.pack(order + "i", 1) + b"\n$EndMeshFormat\n$Entities\n" + struct.pack(order + "4Q", 0, 0, 0, 1)
    data += struct.pack(order + "i6dQiQ", 1, 0, 0, 0, 1, 1, 1, 1, 1, 0) + b"\n$EndEntities\n$Nodes\n" + struct.pack(order + "4QiiiQ", 1, n_nodes, 1, 5, 3, 1, 0, len(numbers))
    data += struct.pack(f"{order}{len(numbers)}Q", *numbers) + b"".join(struct.pack(order + "3d", *VERTICES[i]) for i in range(len(numbers)))
    data += b"\n$EndNodes\n$Elements\n" + struct.pack(order + "4QiiiQ", 1, n_elements, 1, 2, 3, 1, 4, 2)
    data += b"".join(struct.pack(order + "5Q", i, *cell) for i, (cell, _) in enumerate(CELLS, 1))
    (folder / name).write_bytes(data + b"\n$EndElements\n")
    return name


four = (folder / msh4("four.msh", {1: [1]}, [(1, [1, 2], [cell for cell, _ in CELLS])])).read_text()
accepted("four.msh", "materials   1 (2)")
accepted(binary4("four-packed.msh"), "materials   1 (2)")
refused(save("more.msh", four.replace("$Elements\n1 2 1 2\n3 1 4 2", "$Elements\n1 1 1 2\n3 1 4 1")), "announces 1 elements, but has more")
refused(save("more.msh", four.replace("$Elements\n1 2 1 2", "$Elements\n1 1 1 2")), "announces 1 elements, but has 2")
refused(save("fewer.msh", four.replace("$Elements\n1 2 1 2", "$Elements\n1 3 1 3")), "announces 3 elements, but has 2")
refused(save("nodes.msh", four.replace("$Nodes\n1 5 1 5", "$Nodes\n1 6 1 6")), "announces 6 nodes, but has 5")
refused(save("again.msh", four.replace("3\n4\n5\n", "3\n4\n4\n")), "node 4 is given twice, at two places")
refused(binary4("again-packed.msh", numbers=(1, 2, 3, 4, 4)), "node 4 is given twice, at two places")
refused(binary4("more-packed.msh", n_elements=1), "announces 1 elements, but has 2")
refused(binary4("nodes-packed.msh", n_nodes=4), "announces 4 nodes, but has 5")
old = "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n$Nodes\n1 5\n1 3 0 5\n"
old += rows((i, *v) for i, v in enumerate(VERTICES, 1)) + "$EndNodes\n$Elements\n1 2\n1 3 4 2\n" + rows((i, *cell) for i, (cell, _) in enumerate(CELLS, 1)) + "$EndElements\n"
accepted(save("old.msh", old), "materials   1 (2)")
refused(save("again.msh", old.replace("\n5 1 1 1\n", "\n4 1 1 1\n")), "node 4 is given twice, at two places")

# An element in two groups: the least id counts, and it is said.
accepted(msh2("twice.msh", [*ONE_ENTITY, (4, 5, 2, CELLS[0][0])]), MATERIALS, "1 cell(s) belong to several groups", warnings=1)
refused(msh2("again.msh", [*ONE_ENTITY, (4, 2, 1, CELLS[1][0]), (4, 2, 1, CELLS[1][0])]), "given twice")
accepted(msh4("overlap.msh", {1: [1], 2: [1, 2]}, [(1, [1], [CELLS[0][0]]), (2, [2], [CELLS[1][0]])]),
         "materials   1 (2)", "1 cell(s) belong to several groups", warnings=1)
accepted(msh4("anew.msh", {1: [1], 2: [2]}, [(1, [1], [CELLS[0][0]]), (2, [1], [CELLS[1][0]])]), MATERIALS)
overlap = [(2, 20, 1, FACES[0][0]), (2, 20, 1, FACES[1][0])]
accepted(msh2("faces.msh", [*ONE_ENTITY, *overlap]), BOUNDARIES, "1 triangle(s) belong to several groups; the least id counts", warnings=1)

# Medit, Nastran, VTK.
medit = "MeshVersionFormatted 2\nDimension 3\n# vertices\nVertices\n5\n" + rows((*v, 0) for v in VERTICES)
medit += "Tetrahedra 2\n" + rows((*cell, i) for cell, i in CELLS) + "Triangles\n2\n" + rows((*face, i) for face, i in FACES) + "Corners 1\n1\nEnd\n"
accepted(save("two.mesh", medit), MATERIALS, BOUNDARIES)
accepted(save("negative.mesh", medit.replace("1 2 3 4 1\n", "1 2 3 4 -1\n")), "materials   0 (1), 2 (1)", "negative reference", warnings=1)
refused(save("short.mesh", medit[:medit.index("Triangles")].replace("Tetrahedra 2", "Tetrahedra 3")), "ends before all tetrahedra")
refused(save("long.mesh", medit.replace("Tetrahedra 2", "Tetrahedra 1")), "more tetrahedra than the 1")
refused(save("hexahedra.mesh", medit.replace("Corners 1\n1\n", "Hexahedra 1\n1 2 3 4 5 1 2 3 0\n")), "1 of the kind Hexahedron 8")

refused(save("vertices.mesh", medit.replace("Tetrahedra 2", "0.3 0.3 0.3 0\nTetrahedra 2")), "more vertices than the 5")
refused(save("again.mesh", medit.replace("Corners 1\n1\n", "Vertices 1\n2 2 2 0\n")), "two sections of vertices")
refused(save("large.mesh", medit.replace("1 2 3 4 1\n", "1 2 3 4 3000000000\n")), "3000000000 can't be an id")
refused(save("part.mesh", medit.replace("1 2 3 4 1\n", "1 2 3 4 1.5\n")), "1.5 can't be an id")
accepted(save("two-billion.mesh", medit.replace("1 2 3 4 1\n", "1 2 3 4 2000000000\n")), "2 (1), 2000000000 (1)")
for cells in ("TetrahedraP3", "PrismsQ2", "PyramidsP2", "HexahedraQ3", "Polyhedra"):
    refused(save("kinds.mesh", medit.replace("Corners 1\n1\n", f"{cells} 1\n1 2 3 4 5 1 2 3 4 5 7\n")), f"1 of the kind {cells.lower()}")
accepted(save("surface.mesh", medit.replace("Corners 1\n1\n", "QuadrilateralsQ3 1\n1 2 3 4 5 1 2 3 4 5 7\n")), "not read: 1 of the kind quadrilateralsq3", warnings=1)

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
refused(save("few.vtk", vtk.format("3.0", "", "") + cells + "CELL_DATA 2\nSCALARS medit int 1\nLOOKUP_TABLE default\n1 2\n"), "medit has 2 values for 4 cells")
other = "SCALARS region int 1\nLOOKUP_TABLE default\n{}\n"
zeros = ids.format("material").replace("1 2 10 20", "0 0 0 0")
accepted(save("zeros.vtk", vtk.format("3.0", "", "") + cells + zeros + other.format("1 2 10 20")), MATERIALS, BOUNDARIES)
accepted(save("fields.vtk", vtk.format("3.0", "", "") + cells + ids.format("material") + other.format("1 1 1 1")), MATERIALS, BOUNDARIES,
         "material is taken, not region", warnings=1)
names = "CELL_DATA 4\nFIELD FieldData 2\nname 1 4 string\nu\nv\nw\nx\nMaterialIds 1 4 int\n1 2 10 20\n"
accepted(save("words.vtk", vtk.format("3.0", "", "") + cells + names), MATERIALS, BOUNDARIES)
for kind, letter, least in (("unsigned_char", "B", 200), ("unsigned_short", "H", 40000), ("unsigned_int", "I", 500000000), ("unsigned_long", "Q", 600000000)):
    data = b"# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n" + b"".join(struct.pack(">3d", *v) for v in VERTICES)
    data += b"\nCELLS 4 18\n" + b"".join(struct.pack(f">{len(n) + 1}i", len(n), *[v - 1 for v in n]) for n, _ in CELLS + FACES)
    data += b"\nCELL_TYPES 4\n" + struct.pack(">4i", 10, 10, 5, 5) + f"\nCELL_DATA 4\nSCALARS material {kind} 1\nLOOKUP_TABLE default\n".encode()
    (folder / "unsigned.vtk").write_bytes(data + struct.pack(f">4{letter}", 1, least, 10, 20) + b"\n")
    accepted("unsigned.vtk", f"materials   1 (1), {least} (1)", BOUNDARIES)
refused(save("neither.vtk", "# vtk DataFile Version 3.0\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"), "ASCII or BINARY")
refused(save("surface.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"), "POLYDATA", "UNSTRUCTURED_GRID")

# Names of groups stand for their numbers wherever those do.
NAMES = [(3, 1, "soft"), (3, 2, "hard"), (2, 10, "clamp"), (2, 20, "pulled face")]
msh2("names.msh", ONE_ENTITY, NAMES)
accepted("names.msh", "held; 1 process", "10 (1)", settings=["Constraints/Clamped boundaries=clamp"])
accepted(msh2("signs.msh", ONE_ENTITY, [*NAMES[:2], (2, 10, "clamp#1")]), "The group clamp#1 has a #", warnings=1)
# A number is an id, whatever name a group has; a group of several of one name is not taken alone.
msh2("numbers.msh", ONE_ENTITY, [(2, 10, "20"), (2, 20, "10"), (3, 1, "2"), (3, 2, "1"), (2, 30, "30")])
accepted("numbers.msh", "A group with the id 20 has the name 10", "A group with the id 1 has the name 2", warnings=4)
fall = {"Mesh/File": "numbers.msh", "Loads/Gravity": "0, 0, -9.81", "Time/Steps": 2, "Probes/Points": "c: vertex 2; d: vertex 3",
        "Material/By id": "1: 1e6, 0.3, 1000; 2: 1e7, 0.3, 1000"}
held = {boundary: runner.simulate(scene, {**fall, "Constraints/Clamped boundaries": boundary}).probes()[-1] for boundary in (10, 20)}
runner.check(held[10]["c.uz"] == 0. and held[10]["d.uz"] < 0. and held[20]["c.uz"] < 0. and held[20]["d.uz"] == 0., f"held are {held}")
msh2("same.msh", ONE_ENTITY, [(2, 10, "wall"), (2, 20, "wall")])
accepted("same.msh", "Several groups have the name wall", warnings=1)
refused("same.msh", "'wall' is no boundary id, and no single group", settings=["Constraints/Clamped boundaries=wall"])
msh2("hidden.msh", [*ONE_ENTITY, (2, 5, 2, FACES[0][0])], [(2, 10, "clamp"), (2, 5, "skin")])
refused("hidden.msh", "no face of the surface has the id 10 of the group clamp", "another group of a lesser id", settings=["Constraints/Clamped boundaries=clamp"])
msh2("digits.msh", ONE_ENTITY, [(2, 10, "2nd wall"), (2, 20, "-foot"), (3, 1, "3d")])
accepted("digits.msh", settings=["Constraints/Clamped boundaries=2nd wall, -foot", "Material/By id=3d: 1e6, 0.3, 1000"])
for setting in ("Motion/Of=boundary +", "Motion/Of=boundary 10, +", "Probes/Boundaries=a: +", "Constraints/Clamped boundaries=+"):
    refused("two.msh", "'+' is no boundary id", settings=[setting, "Motion/Displacement=0; 0; t"])
accepted(msh2("great.msh", [(4, 1234567, 1, CELLS[0][0])]), settings=["Material/By id=1234567: 1e6, 0.3, 1000"], warnings=1)

unv = "    -1\n  2411\n" + "".join(f"{i:10d}         1         1        11\n{x:25.16E}{y:25.16E}{z:25.16E}\n" for i, (x, y, z) in enumerate(VERTICES, 1))
unv += "    -1\n    -1\n  2412\n"
for number, (nodes, _) in enumerate(FACES + CELLS, 1):
    unv += f"{number:10d}{91 if len(nodes) == 3 else 111:10d}         2         1         7{len(nodes):10d}\n" + "".join(f"{v:10d}" for v in nodes) + "\n"
unv += "    -1\n    -1\n  2467\n"
for number, (name, member) in enumerate([("clamp", 1), ("pulled face", 2), ("soft", 3), ("hard", 4)], 1):
    unv += f"{number:10d}" + "         0" * 6 + f"         1\n{name}\n         8{member:10d}         0         0\n"
save("salome.unv", unv + "    -1\n")
accepted(save("zero.unv", unv.replace("         1         0         0         0         0         0         0         1\nclamp",
                                       "         0" * 7 + "         1\nclamp") + "    -1\n"), "clamp (boundary 3)", "The group clamp has the number 0", warnings=1)
accepted("salome.unv", "materials   3 (1), 4 (1)", "boundaries  0 (4), 1 (1), 2 (1)", "clamp", "hard")


def grouped(*groups):
    """The same with groups of these numbers, names and members."""
    text = unv[:unv.index("  2467\n")] + "  2467\n"
    for number, name, members in groups:
        text += f"{number:10d}" + "         0" * 6 + f"{len(members):10d}\n{name}\n" + "".join(f"         8{m:10d}         0         0\n" for m in members)
    return text + "    -1\n"


# Numbers of groups are those of faces, or of cells; two groups of one number are told, and members that are nothing.
accepted(save("spaces.unv", grouped((1, "clamp", [1]), (1, "soft", [3]), (2, "load", [2]), (2, "hard", [4]))), MATERIALS, "boundaries  0 (4), 1 (1), 2 (1)")
accepted(save("clash.unv", grouped((1, "clamp", [1]), (1, "load", [2]), (4, "soft", [3]))), "1 (1), 2 (1)",
         "The groups clamp and load have the same number 1; load gets the id 2", warnings=1)
accepted(save("lists.unv", grouped((1, "clamp", [1]), (1, "clamp", [2]), (4, "soft", [3]))), "boundaries  0 (4), 1 (2)")
accepted(save("nothing.unv", grouped((1, "clamp", [1, 99]), (4, "soft", [3]))), "The group clamp names 1 element(s) that are not in the file", warnings=1)
refused(save("large.unv", grouped((3000000000, "clamp", [1]))), "3000000000 can't be an id")

# Without groups, the material or else the property, whichever differs, of faces and of cells by themselves.
def unv_ids(name, *pairs):
    """Property and material of each element."""
    lines = unv[:unv.index("    -1\n    -1\n  2467\n")].split("\n")
    heads = [i for i, line in enumerate(lines) if line.endswith(("         7         3", "         7         4"))]
    for i, (prop, material) in zip(heads, pairs):
        lines[i] = lines[i][:20] + f"{prop:10d}{material:10d}" + lines[i][40:]
    return save(name, "\n".join(lines) + "    -1\n")


accepted(unv_ids("property.unv", (5, 0), (6, 0), (1, 3), (2, 3)), MATERIALS, "5 (1), 6 (1)")
accepted(unv_ids("material.unv", (5, 0), (5, 0), (7, 1), (8, 2)), MATERIALS, "boundaries  0 (4), 5 (2)")
system = "    -1\n  2420\n         1\nPart\n         1         1         8\nCS1\n    1.0 0.0 0.0\n 0.0 1.0 0.0\n 0.0 0.0 1.0\n 0.0 0.0 0.0\n    -1\n"
for text in (system + unv + "    -1\n", unv + "    -1\n" + system):
    refused(save("system.unv", text), "line ", "coordinate system 1")
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
