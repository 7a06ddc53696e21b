"""The values in the frames, against probes at all vertices and against stresses computed here, cell by cell."""

import csv
import itertools
import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import vtu

with open(runner.DATA / "bar" / "nodes.csv") as file:
    NODES = [[float(x) for x in row[1:]] for row in list(csv.reader(file))[1:]]
E, NU = 100e6, 0.33
MU, LAMBDA = E / (2 + 2 * NU), E * NU / ((1 + NU) * (1 - 2 * NU))
FIELDS = ["material", "pressure", "rotation_angle", "volume_ratio", "von_mises_stress"]
SINGLE = 2e-6    # of numbers of 32 bits, and of what is computed from them
settings = {"Output/Frames": "every", "Output/Every": 15, "Time/Steps": 30}


def difference(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def inverse(A):
    """Of a matrix, by rows."""
    columns = list(zip(*A))
    rows = [cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])]
    det = dot(columns[0], rows[0])
    return [[x / det for x in row] for row in rows]


def determinant(A):
    return dot(A[0], cross(A[1], A[2]))


def product(A, B):
    return [[dot(row, column) for column in zip(*B)] for row in A]


def transpose(A):
    return [list(row) for row in zip(*A)]


def rotation(F):
    """The rotation of the polar decomposition, by Newton's method (Higham 1986)."""
    R = F
    for _ in range(30):
        R = [[(x + y) / 2 for x, y in zip(*rows)] for rows in zip(R, transpose(inverse(R)))]
    return R


def state(rest, now):
    """Volume ratio, von Mises stress, angle in degrees, pressure of a cell with these corners."""
    edges = [transpose([difference(x, corners[0]) for x in corners[1:]]) for corners in (rest, now)]
    F = product(edges[1], inverse(edges[0]))
    R = rotation(F)
    U = product(transpose(R), F)
    strain = [[(U[i][j] + U[j][i]) / 2 - (i == j) for j in range(3)] for i in range(3)]
    trace = sum(strain[i][i] for i in range(3))
    deviator = [[2 * MU * (strain[i][j] - (i == j) * trace / 3) for j in range(3)] for i in range(3)]
    mises = math.sqrt(1.5 * sum(x * x for row in deviator for x in row))
    cosine = (sum(R[i][i] for i in range(3)) - 1) / 2
    return determinant(F), mises, math.degrees(math.acos(min(1, cosine))), -(LAMBDA + 2 / 3 * MU) * trace


def node_of(point):
    """The vertex of the bar at rest that is here."""
    distance, node = min((math.dist(point, place), node) for node, place in enumerate(NODES))
    runner.check(distance < 1e-4, f"no vertex at {point}")
    return node


def near(value, exact, size, what):
    runner.check(abs(value - exact) <= SINGLE * size, f"{what}: {value} instead of {exact}")


def check_frame(frame, row, shift, fields):
    """Of one process, at a row of probes.csv; gives its cells by the vertices of the bar."""
    runner.check(sorted(frame.of_cells) == fields, f"fields of cells {sorted(frame.of_cells)}")
    runner.check(sorted(frame.of_points) == ["displacement", "velocity"], f"fields of points {sorted(frame.of_points)}")
    runner.check(frame.instant == {"CYCLE": row["step"], "TIME": row["time"]}, f"{frame.instant} instead of {row['time']}")
    nodes, places = [], []
    for point, u, v in zip(frame.points, frame.of_points["displacement"], frame.of_points["velocity"]):
        node = node_of([x - s - d for x, s, d in zip(point, shift, u)])
        exact = [row[f"n{node}.u{d}"] for d in "xyz"]
        places.append([x + d for x, d in zip(NODES[node], exact)])
        runner.check(math.dist(difference(point, shift), places[-1]) < 1e-8, f"vertex {node} is at {point}")
        for d in range(3):
            near(u[d], exact[d], 10, f"displacement of vertex {node}")
            near(v[d], row[f"n{node}.v{'xyz'[d]}"], 40, f"velocity of vertex {node}")
        nodes.append(node)
    runner.check(len(set(nodes)) == len(nodes), "a vertex stands twice")
    runner.check(set(frame.types) <= {10}, f"types {set(frame.types)}")
    for number, cell in enumerate(frame.cells):
        ratio, mises, angle, pressure = state([NODES[nodes[p]] for p in cell], [places[p] for p in cell])
        what = f"cell {number} at {row['time']} s: "
        near(frame.of_cells["volume_ratio"][number], ratio, 1, what + "volume ratio")
        near(frame.of_cells["von_mises_stress"][number], mises, E, what + "stress")
        near(frame.of_cells["pressure"][number], pressure, E, what + "pressure")
        near(math.cos(math.radians(frame.of_cells["rotation_angle"][number])), math.cos(math.radians(angle)), 1, what + "angle")
        runner.check(frame.of_cells["material"][number] == 0, what + "material")
    return [tuple(sorted(nodes[p] for p in cell)) for cell in frame.cells]


def check_run(ranks, shift=(0, 0, 0)):
    everywhere = "; ".join(f"n{i}: " + ", ".join(str(x + s) for x, s in zip(place, shift)) for i, place in enumerate(NODES))
    moved = {"Mesh/Map": "; ".join(f"{x} + {s}" for x, s in zip("xyz", shift))} if any(shift) else {}
    results = runner.simulate(runner.BAR, {**settings, **moved, "Probes/Points": everywhere}, ranks=ranks)
    rows, drawn, times = results.probes(), 0, results.frame_times()
    for number, time in enumerate(times):
        fields = sorted(FIELDS + ["error_in_space"]) if time == times[-1] else FIELDS  # estimated in the last state
        row = next(row for row in rows if abs(row["time"] - time) < 1e-9)
        name = f"frame_{number:04}"
        files = [f"{name}.{rank}.vtu" for rank in range(ranks)] if ranks > 1 else [f"{name}.vtu"]
        if ranks > 1:
            record = (results.folder / "solution" / f"{name}.pvtu").read_text()
            runner.check(re.findall('Source="(.*?)"', record) == files, f"{name}.pvtu names other files")
            for part, names in [("PPointData", ["displacement", "velocity"]), ("PCellData", fields), ("PPoints", ["Points"])]:
                found = re.findall('Name="(.*?)"', record.split(f"<{part}>")[1].split(f"</{part}>")[0])
                runner.check(sorted(found) == names, f"{part} of {name}.pvtu: {found}")
        cells = [check_frame(vtu.Frame(results.folder / "solution" / file), row, shift, fields) for file in files]
        runner.check(all(cells), "a process has no cells")
        cells = list(itertools.chain(*cells))
        runner.check(len(cells) == len(set(cells)) == 192, f"{len(cells)} cells, {len(set(cells))} different ones")
        drawn += 1
    runner.check(drawn == 3, f"{drawn} frames")
    print(f"{ranks} processes, {shift}: {drawn} frames")
    return results


one, again = check_run(1), check_run(1)
for file in sorted((one.folder / "solution").iterdir()):
    runner.check(file.read_bytes() == (again.folder / "solution" / file.name).read_bytes(), f"{file.name} differs in a second run")
check_run(2)
check_run(1, (1000000, -2000000, 0))
