#!/usr/bin/env python3
"""Turns a mesh file of any format that meshio reads into a .msh file of version 2.2, with ids and names of groups.

convert-mesh.py FILE [OUTPUT.msh]        needs python3-meshio (apt-get install python3-meshio python3-h5py python3-netcdf4)

Ids are those of a field of cells of a known name; or else groups of cells (sets of Abaqus and Exodus, families of MED); or else
blocks. Names of groups become names of physical groups. `meshio convert` drops the last two.
"""

import argparse
import pathlib
import sys

try:
    import meshio
    import numpy
except ImportError:
    sys.exit("convert-mesh.py needs meshio: apt-get install python3-meshio python3-h5py python3-netcdf4")

KINDS = {"vertex": 15, "line": 1, "triangle": 2, "quad": 3, "tetra": 4, "hexahedron": 5, "wedge": 6, "pyramid": 7, "line3": 8,
         "triangle6": 9, "quad9": 10, "tetra10": 11, "hexahedron27": 12, "quad8": 16, "hexahedron20": 17, "wedge15": 18}
DIMENSIONS = {"vertex": 0, "line": 1, "line3": 1, "triangle": 2, "triangle6": 2, "quad": 2, "quad8": 2, "quad9": 2}
FIELDS = ["gmsh:physical", "medit:ref", "nastran:ref", "tetgen:ref", "avsucd:material", "cell_tags", "MaterialIds", "f"]


def field_of(mesh):
    """Name and values, block by block, of the field that has ids."""
    for name in FIELDS:
        blocks = mesh.cell_data.get(name)
        if blocks is not None and all(numpy.asarray(block).ndim == 1 for block in blocks):
            return name, [numpy.asarray(block).astype(int) for block in blocks]
    return "", []


def family_names(mesh):
    """Of MED: the groups of each family, by its number, which is negative."""
    return {abs(number): " ".join(names) for number, names in getattr(mesh, "cell_tags", {}).items()}


def ids_of(mesh):
    """For each block the ids of each cell; and (dimension, id, name) of groups."""
    dimensions = [DIMENSIONS.get(block.type, 3) for block in mesh.cells]
    name, field = field_of(mesh)
    if field:
        families = family_names(mesh) if name == "cell_tags" else {}
        names = {(dimension, number, families[number]) for dimension, ids in zip(dimensions, field)
                 for number in set(map(int, numpy.abs(ids))) if number in families}
        names |= {(int(value[1]), int(value[0]), key) for key, value in mesh.field_data.items() if len(value) == 2}
        return [[[abs(int(number))] for number in ids] for ids in field], sorted(names)
    groups, names = [[[] for _ in block.data] for block in mesh.cells], set()
    for number, (key, blocks) in enumerate(sorted((mesh.cell_sets or {}).items()), 1):
        for block, members in enumerate(blocks):
            for cell in numpy.asarray([] if members is None else members, int):
                groups[block][cell].append(number)
                names.add((dimensions[block], number, key))
    if not names:
        groups = [[[number]] * len(block.data) for number, block in enumerate(mesh.cells, 1)]
    return groups, sorted(names)


def write(mesh, path):
    ids, names = ids_of(mesh)
    points = numpy.zeros((len(mesh.points), 3))
    points[:, :mesh.points.shape[1]] = mesh.points
    with path.open("w") as file:
        file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        if names:
            file.write(f"$PhysicalNames\n{len(names)}\n" + "".join(f'{d} {i} "{n}"\n' for d, i, n in names) + "$EndPhysicalNames\n")
        file.write(f"$Nodes\n{len(points)}\n" + "".join(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points.tolist(), 1)))
        file.write("$EndNodes\n")
        # A cell in two groups stands there twice.
        elements = [(KINDS[block.type], group, cell + 1) for block, groups in zip(mesh.cells, ids)
                    for cell, of_cell in zip(block.data, groups) for group in of_cell or [0]]
        file.write(f"$Elements\n{len(elements)}\n" + "".join(f"{i} {kind} 2 {group} {group} {' '.join(map(str, nodes))}\n"
                                                             for i, (kind, group, nodes) in enumerate(elements, 1)) + "$EndElements\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path, nargs="?")
    arguments = parser.parse_args()
    output = arguments.output or arguments.file.with_suffix(".msh")
    if output.exists() and output.samefile(arguments.file):
        sys.exit(f"{output} would be written over")
    mesh = meshio.read(arguments.file)
    unknown = sorted({block.type for block in mesh.cells} - set(KINDS))
    if unknown:
        sys.exit(f"{arguments.file}: cells of the kind {', '.join(unknown)} are not converted")
    write(mesh, output)
    print(f"{output}: {len(mesh.points)} vertices, " + ", ".join(f"{len(block.data)} {block.type}" for block in mesh.cells))


if __name__ == "__main__":
    main()
