#!/usr/bin/env python3
"""Meshes of Cook's membrane, of a hollow sphere and of an L for the scenes of this folder.

    python3 mesh.py cook N FILE            N x N squares, each cut into two triangles
    python3 mesh.py cook-3d N FILE         N x N cubes, one layer, each cut into six tetrahedra
    python3 mesh.py sphere N FILE          an eighth of a hollow sphere: N layers of cubes, thinner inside, likewise
    python3 mesh.py l-bar N FILE           three unit cubes about an edge of 270 degrees, each of N x N x N cubes, likewise

The committed ones: cook 32 cook.msh, cook-3d 16 cook-3d.msh, sphere 12 sphere.msh, l-bar 3 l-bar.msh. But for the L, inner
vertices are moved a little at random, so that no result owes anything to a regular mesh.

Boundary ids: cook 1 left, 2 right, 3 the rest, 4 front and back; sphere 1 inside, 2 outside, 3, 4, 5 in x, y, z = 0; l-bar 1 in
y = 2, 2 in x = 2, 3 the rest.
"""

import itertools
import math
import random
import sys


def grid(n):
    """Vertices i, j, k of a grid of cubes (squares without the third) and the simplices of each."""
    dim = len(n)
    vertices = list(itertools.product(*(range(m + 1) for m in n)))
    number = {v: i for i, v in enumerate(vertices)}
    cells = []
    for corner in itertools.product(*(range(m) for m in n)):
        for order in itertools.permutations(range(dim)):
            path = [corner]
            for direction in order:
                path.append(tuple(c + (d == direction) for d, c in enumerate(path[-1])))
            cells.append([number[v] for v in path])
    return vertices, cells


def oriented(points, cell):
    """With a positive volume; the program would turn it around too, but warn."""
    rows = [[a - b for a, b in zip(points[v], points[cell[0]])] for v in cell[1:]]
    if len(cell) == 3:
        determinant = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    else:
        (a, b, c), (d, e, f), (g, h, i) = rows
        determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return cell if determinant > 0 else [*cell[:-2], cell[-1], cell[-2]]


def surface(cells):
    """The faces that one cell has."""
    count = {}
    for cell in cells:
        for face in itertools.combinations(cell, len(cell) - 1):
            count.setdefault(tuple(sorted(face)), []).append(face)
    return [faces[0] for faces in count.values() if len(faces) == 1]


def jitter(points, cells, width, free):
    """Moves the vertices that are not on the surface, in the directions that are free."""
    generator = random.Random(1)
    fixed = {v for face in surface(cells) for v in face if free is None or len(face) == 2}
    for v, point in enumerate(points):
        move = [width * generator.uniform(-1, 1) for _ in range(3)]
        if v not in fixed and (free is None or free(v)):
            points[v] = tuple(p + m * (d < (3 if free is None else 2)) for d, (p, m) in enumerate(zip(point, move)))


def write(name, points, cells, faces):
    """A .msh file of format 2.2; faces are (boundary id, vertices)."""
    kind = {2: 1, 3: 2, 4: 4}
    elements = [(kind[len(face)], group, face) for group, face in faces]
    elements += [(kind[len(cell)], 7, oriented(points, cell)) for cell in cells]
    with open(name, "w") as file:
        file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n")
        for i, point in enumerate(points, 1):
            file.write(f"{i} {' '.join(f'{x:.7g}' for x in point)}\n")
        file.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
        for i, (element, group, nodes) in enumerate(elements, 1):
            file.write(f"{i} {element} 2 {group} {group} {' '.join(str(v + 1) for v in nodes)}\n")
        file.write("$EndElements\n")


def cook(n, name, solid, moved=0.15):
    """Corners (0, 0), (48, 44), (48, 60), (0, 44) [mm]."""
    logical, cells = grid((n, n, 1) if solid else (n, n))
    points = []
    for v in logical:
        x, t = 48 * v[0] / n, v[1] / n
        low, high = 44 * x / 48, 44 + 16 * x / 48
        points.append((x, low + t * (high - low), 44 / n * v[2] if solid else 0.0))
    jitter(points, cells, moved * 16 / n, lambda v: all(0 < i < n for i in logical[v][:2]))

    def boundary(face):
        if solid and len({logical[v][2] for v in face}) == 1:
            return 4
        columns = {logical[v][0] for v in face}
        return 1 if columns == {0} else 2 if columns == {n} else 3

    write(name, points, cells, [(boundary(face), face) for face in surface(cells)])


def sphere(n, name, moved=0.1):
    """Radii 1 and 2, in three blocks that meet along the lines x = y, y = z, z = x."""
    m = 5 * n // 12
    logical, block_cells = grid((m, m, n))
    number, points, layer, cells = {}, [], [], []
    for s in range(3):
        of_block = []
        for i, j, k in logical:
            direction = [1.0, 1.0, 1.0]
            direction[(s + 1) % 3] = math.tan(i / m * math.pi / 4)
            direction[(s + 2) % 3] = math.tan(j / m * math.pi / 4)
            scale = 2**(k / n) / math.hypot(*direction)
            point = tuple(scale * d if d > 1e-12 else 0.0 for d in direction)
            key = tuple(round(x, 9) for x in point)
            if key not in number:
                number[key] = len(points)
                points.append(point)
                layer.append(k)
            of_block.append(number[key])
        cells += [[of_block[v] for v in cell] for cell in block_cells]
    faces = []
    for face in surface(cells):
        layers = {layer[v] for v in face}
        plane = next((d for d in range(3) if all(points[v][d] == 0 for v in face)), None)
        faces.append((3 + plane if plane is not None else 1 if layers == {0} else 2, face))
    jitter(points, cells, moved / n, None)
    write(name, points, cells, faces)


def l_bar(n, name):
    """The cubes from (0, 0, 0), (1, 0, 0) and (0, 1, 0)."""
    logical, cells = grid((2 * n, 2 * n, n))
    cells = [cell for cell in cells if any(all(logical[v][d] <= n for v in cell) for d in (0, 1))]
    used = sorted({v for cell in cells for v in cell})
    number = {v: i for i, v in enumerate(used)}
    cells = [[number[v] for v in cell] for cell in cells]
    points = [tuple(x / n for x in logical[v]) for v in used]

    def boundary(face):
        return next((group for group, d in ((1, 1), (2, 0)) if all(points[v][d] == 2 for v in face)), 3)

    write(name, points, cells, [(boundary(face), face) for face in surface(cells)])


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in ("cook", "cook-3d", "sphere", "l-bar"):
        sys.exit(__doc__)
    what, size, target = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    if what == "sphere":
        sphere(size, target)
    elif what == "l-bar":
        l_bar(size, target)
    else:
        cook(size, target, what == "cook-3d")
