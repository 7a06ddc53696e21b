"""One mode of a linear bar through one-stage methods. The mode is computed here, from matrices assembled here.

With z = frequency times step, backward Euler multiplies c = q + i q'/frequency by 1/(1 + i z) in each step and the
midpoint rule by (1 - i z/2)/(1 + i z/2), so that the amplitude falls by 1/sqrt(1 + z^2) a step, or not at all.
"""

import itertools
import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

SIZE, CUBES = (1.0, 3.0, 1.5), 3  # m; along y; the end y = 0 is held
E, NU, RHO = 1e6, 0.3, 1000.0
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))


def bar():
    """Vertices and tetrahedra: six to a cube, along the paths from its first vertex to its last."""
    number = {point: k for k, point in enumerate(itertools.product((0, 1), range(CUBES + 1), (0, 1)))}
    vertices = [(i * SIZE[0], j * SIZE[1] / CUBES, k * SIZE[2]) for i, j, k in number]
    cells = []
    for j in range(CUBES):
        for order in itertools.permutations(range(3)):
            point = [0, j, 0]
            cell = [number[tuple(point)]]
            for direction in order:
                point[direction] += 1
                cell.append(number[tuple(point)])
            cells.append(cell if order in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] else [cell[1], cell[0], *cell[2:]])
    return vertices, cells


def write_mesh(path, vertices, cells):
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(vertices))]
    lines += [f"{k + 1} {x!r} {y!r} {z!r}" for k, (x, y, z) in enumerate(vertices)]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{k + 1} 4 2 0 1 " + " ".join(str(vertex + 1) for vertex in cell) for k, cell in enumerate(cells)]
    path.write_text("\n".join([*lines, "$EndElements", ""]))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def gradients(points):
    """Of the four linear shape functions, and the volume."""
    edges = [[b - a for a, b in zip(points[0], point)] for point in points[1:]]
    six = dot(edges[0], cross(edges[1], edges[2]))
    g = [[value / six for value in cross(edges[(k + 1) % 3], edges[(k + 2) % 3])] for k in range(3)]
    return [[-sum(values) for values in zip(*g)], *g], six / 6


def matrices(vertices, cells, lumped):
    n = 3 * len(vertices)
    K, M = ([[0.0] * n for _ in range(n)] for _ in range(2))
    lame, mu = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))
    for cell in cells:
        g, volume = gradients([vertices[vertex] for vertex in cell])
        for (a, first), (b, second) in itertools.product(enumerate(cell), repeat=2):
            mass = RHO * volume / 20 * (1 + (a == b)) * (not lumped) + RHO * volume / 4 * (lumped and a == b)
            for i, j in itertools.product(range(3), repeat=2):
                K[3 * first + i][3 * second + j] += volume * (
                    lame * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i] + (i == j) * mu * dot(g[a], g[b]))
                M[3 * first + i][3 * second + j] += mass * (i == j)
    free = [3 * k + i for k, vertex in enumerate(vertices) if vertex[1] > 0 for i in range(3)]
    return ([[A[row][column] for column in free] for row in free] for A in (K, M))


def solve(A, b):
    """Elimination; A is symmetric and positive definite."""
    A, b = [row[:] for row in A], b[:]
    n = len(b)
    for k in range(n):
        for row in range(k + 1, n):
            factor = A[row][k] / A[k][k]
            for column in range(k, n):
                A[row][column] -= factor * A[k][column]
            b[row] -= factor * b[k]
    for k in reversed(range(n)):
        b[k] = (b[k] - dot(A[k][k + 1:], b[k + 1:])) / A[k][k]
    return b


def first_mode(K, M):
    """By inverse iteration: the frequency [rad/s] and the largest entry set to one."""
    x = [1.0 + 0.1 * math.sin(k) for k in range(len(K))]
    for _ in range(60):
        x = solve(K, [dot(row, x) for row in M])
        x = [value / max(map(abs, x)) for value in x]
    K_x, M_x = ([dot(row, x) for row in A] for A in (K, M))
    square = dot(x, K_x) / dot(x, M_x)
    rest = max(abs(a - square * b) for a, b in zip(K_x, M_x)) / max(map(abs, K_x))
    runner.check(rest < 1e-11, f"the mode has a residual of {rest}")
    return math.sqrt(square), x


def expression(vertices, mode):
    """Nodal values as three expressions, zero between vertices."""
    free = [vertex for vertex in vertices if vertex[1] > 0]
    terms = [[f"({mode[3 * k + i]!r})*(x == {x!r} && y == {y!r} && z == {z!r})" for k, (x, y, z) in enumerate(free)]
             for i in range(3)]
    return "; ".join(" + ".join(sums) for sums in terms)


vertices, cells = bar()
write_mesh(folder / "bar.msh", vertices, cells)
(folder / "bar.prm").write_text("subsection Loads\nend\n")
worst = {}
for mass in ("consistent", "lumped"):
    frequency, mode = first_mode(*matrices(vertices, cells, mass == "lumped"))
    where = max(range(len(mode)), key=lambda k: abs(mode[k]))
    tip = [vertex for vertex in vertices if vertex[1] > 0][where // 3]
    for method, z in itertools.product(("backward euler", "implicit backward euler", "implicit midpoint"), (0.01, 0.3, 1, 10)):
        settings = {
            "Mesh/Shape": "file", "Mesh/File": folder / "bar.msh", "Material/Young modulus": E, "Material/Poisson ratio": NU,
            "Material/Density": RHO, "Material/Mass": mass, "Corotation/Rotation": "none", "Constraints/Clamped region": "y == 0",
            "Start/Displacement": expression(vertices, mode), "Time/Method": method, "Time/Step": repr(z / frequency),
            "Time/Steps": 20 if z <= 1 else 4, "Solver/Tolerance": 1e-12, "Time/Newton tolerance": 1e-12, "Output/Frames": "none",
            "Probes/Points": "tip: " + ", ".join(map(str, tip))}
        results = runner.simulate(folder / "bar.prm", settings)
        factor = (1 - 0.5j * z) / (1 + 0.5j * z) if method == "implicit midpoint" else 1 / (1 + 1j * z)
        if method != "implicit midpoint":
            runner.check(abs(abs(factor) - 1 / math.sqrt(1 + z * z)) < 1e-15, "the factor")
        energy = [row["kinetic"] + row["elastic"] for row in results.history()]
        probes = [row["tip.u" + "xyz"[where % 3]] for row in results.probes()]
        decay = max(abs(math.sqrt(after / before) / abs(factor) - 1) for before, after in zip(energy, energy[1:]))
        place = max(abs(value / probes[0] - (factor ** k).real) for k, value in enumerate(probes))
        worst[method] = max(worst.get(method, 0), decay)
        runner.check(abs(probes[0]) == 1.0, f"the tip starts at {probes[0]}")
        runner.check(decay < 1e-6, f"{method}, {mass} mass, z = {z}: a step's factor is wrong by {decay}")
        runner.check(place < 1e-6, f"{method}, {mass} mass, z = {z}: the tip is off by {place}")
for method, error in worst.items():
    print(f"{method}: the factor of every step is right to {error:.1e}")
