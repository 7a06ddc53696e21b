"""What a user can say of plane bodies, layers and mesh files of triangles: what is told and what is refused."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
scene = folder / "scene.prm"
scene.write_text("# a rectangle\nsubsection Mesh\n  set Shape = rectangle\n  set Rectangle size = 4, 3\n"
                 "  set Rectangle squares = 4, 6\nend\nsubsection Constraints\n  set Clamped boundaries = 2\nend\n")


def check(settings, ranks=1):
    return runner.run("--check", scene, *runner.overrides(settings), ranks=ranks)


def accepted(settings, *words):
    return runner.accepted(check(settings), words, settings)


def refused(settings, *words):
    error = runner.refused(check(settings), words, settings)
    runner.check(len(error) < 700 and error.startswith("supple: "), error)


plain = accepted({}, "48 triangles, 35 vertices in [0, 4] x [0, 3] m, 12 m^3", "0 (6), 1 (6), 2 (4), 3 (4)",
                 "70, of which 10 are held", "plane strain, 1 m thick, corotational")
runner.check("warning" not in plain, plain)
accepted({"Plane/Model": "plane stress", "Plane/Thickness": 0.5}, "6 m^3", "plane stress, 0.5 m thick")
accepted({"Plane/Model": "axisymmetric"}, "150.796 m^3", "axisymmetric, corotational", "70, of which 16 are held")
for split, worst in [("falling", "0.69282"), ("rising", "0.69282"), ("alternating", "0.69282")]:
    accepted({"Mesh/Rectangle split": split}, "48 triangles", worst)

# What nature holds counts neither as unknown nor as support.
static = {"Time/Problem": "static", "Constraints/Clamped boundaries": ""}
refused(static, "3 of its 3 rigid motions are free", "Hold a boundary")
refused({**static, "Constraints/Boundaries held along y": 2}, "1 of its 3 rigid motions is free")
refused({**static, "Constraints/Clamped region": "x == 0 && y == 0"}, "1 of its 3 rigid motions is free")
refused({**static, "Plane/Model": "axisymmetric"}, "its one rigid motion, along its axis, is free")
refused({**static, "Plane/Model": "axisymmetric", "Constraints/Boundaries held along x": 1}, "along its axis, is free")
accepted({**static, "Plane/Model": "axisymmetric", "Constraints/Boundaries held along y": 2})
accepted({**static, "Constraints/Boundaries held along x": 0, "Constraints/Boundaries held along y": 2})
accepted({"Constraints/Boundaries held along z": "2, 3", "Constraints/Clamped region": "z == 0 && y > 2.9"})

# What does not fit a plane.
refused({"Constraints/Clamped boundaries": 5}, "no boundary 5", "3 (4 faces)")
for entry, value in [("Loads/Gravity", "0, 0, -9.81"), ("Loads/Body force", "0; 0; x"), ("Loads/Nodal force", "1; 0; 1"),
                     ("Start/Velocity", "0; 0; -40"), ("Start/Displacement", "0; 0; 0.1*x"),
                     ("Motion/Displacement", "0; 0; 0.1*t"), ("Loads/Traction", "0; 0; 1")]:
    refused({entry: value, "Motion/Of": "boundary 3", "Loads/Traction on": 3}, entry, "--set", "in the plane z = 0",
            "third component must be 0")
refused({"Start/Rotation": "10, 0, 0"}, "Start/Rotation", "turns about z alone")
accepted({"Start/Rotation": "0, 0, 10", "Motion/Of": "boundary 3", "Motion/Displacement": "free; -t; 0"})
refused({"Probes/Points": "tip: 1, 1"}, "is no point")

# What does not fit around an axis.
around = {"Plane/Model": "axisymmetric"}
refused({**around, "Mesh/Rectangle origin": "-1, 0"}, "Mesh/Rectangle origin", "can't be negative", "-1 m")
refused({**around, "Mesh/Rectangle origin": "-9, 0"}, "can't be negative", "-9 m")
refused({**around, "Plane/Thickness": 2}, "Plane/Thickness", "leave the thickness at 1")
refused({**around, "Loads/Gravity": "1, -9.81, 0"}, "Loads/Gravity", "along x")
refused({**around, "Start/Rotation": "0, 0, 30"}, "Start/Rotation", "can't be turned")
refused({**around, "Motion/Of": "boundary 3", "Motion/Displacement": "0.1*t; free; free"}, "on the axis and stay there")
accepted({**around, "Motion/Of": "boundary 3", "Motion/Displacement": "0; -t; 0"})
accepted({**around, "Motion/Of": "boundary 3", "Motion/Displacement": "free; -t; free"})
refused({**around, "Motion/Of": "all", "Motion/Displacement": "0; -t; free"}, "held or moved already")

# Plane bodies are of triangles.
refused({"Mesh/Shape": "box", "Plane/Model": "axisymmetric"}, "Plane/Model", "this one has tetrahedra")
refused({"Mesh/Shape": "box", "Plane/Thickness": 0.1}, "Plane/Thickness", "this one has tetrahedra")
refused({"Plane/Model": "shell"}, "plane strain, plane stress, axisymmetric")
refused({"Plane/Thickness": 0}, "greater than 0")
refused({"Mesh/Rectangle size": "1, 0"}, "two values", "greater than 0")
refused({"Mesh/Rectangle squares": "1, 1, 1"}, "two values", "1 or greater")
refused({"Mesh/Rectangle squares": "10000, 10000"}, "2e7 squares")
refused({"Mesh/Rectangle split": "crossed"}, "falling, rising, alternating")
refused({"Material/Poisson ratio": 0.5}, "less than 0.5")

# Linear triangles lock as tetrahedra do, but not where they can give way along z.
accepted({"Material/Poisson ratio": 0.49}, "Linear triangles are too stiff")
accepted({**around, "Material/Poisson ratio": 0.49}, "Linear triangles are too stiff")
gives_way = accepted({"Plane/Model": "plane stress", "Material/Poisson ratio": 0.49})
runner.check("stiff" not in gives_way, gives_way)

# Layers from the top: rows are 0.5 m high.
accepted({"Mesh/Layers": "0.5, 2.5"}, "materials   0 (8), 1 (40)")
accepted({"Mesh/Layers": "1, 0.5, 1.5"}, "materials   0 (16), 1 (8), 2 (24)")
accepted({"Mesh/Layers": "3"}, "materials   0 (48)")
box = {"Mesh/Shape": "box", "Mesh/Box size": "4, 3, 2", "Mesh/Box cubes": "4, 6, 2"}
accepted({**box, "Mesh/Layers": "0.5, 2.5"}, "materials   0 (48), 1 (240)")
refused({"Mesh/Layers": "0.7, 2.3"}, "Mesh/Layers", "ends 0.7 m below the top", "0.5 m high")
refused({"Mesh/Layers": "0.5, 2"}, "2.5 m thick together", "3 m high")
refused({**box, "Mesh/Layers": "0.5, 3"}, "3.5 m thick together", "3 m high")
refused({"Mesh/Layers": "0.5, -1"}, "greater than 0")
refused({"Mesh/Shape": "hollow cylinder", "Mesh/Layers": "0.5, 0.5"}, "only a box and a rectangle have layers")
refused({"Mesh/Layers": "0.5, 2.5", "Material/By id": "2: 1e6, 0.3, 1000"}, "no cell has the material id 2")
top = {**static, "Mesh/Layers": "0.5, 2.5", "Constraints/Clamped region": "y < 2.9", "Time/Steps": 1,
       "Loads/Gravity": "0, -10, 0", "Material/Density": 600, "Probes/Boundaries": "top: 3",
       "Probes/Regions": "bottom: y < 2.9"}
for exception, weight in [("", 10 * 600 * 12), ("0: 1e6, 0.3, 900", 10 * (900 * 2 + 600 * 10)),
                          ("1: 1e6, 0.3, 900", 10 * (600 * 2 + 900 * 10))]:
    reaction = runner.simulate(scene, {**top, "Material/By id": exception}).probes()[-1]["bottom.fy"]
    runner.check(abs(reaction - weight) < 1e-6 * weight, f"reaction {reaction} to the weight {weight}")

status, _, error = check({"Mesh/Rectangle squares": "1, 1"}, ranks=4)
runner.check(status == 1 and error.count("4 processes are too many for 2 cells") == 1, error)


def write(name, vertices, triangles, curves=(), kind=2):
    """A .msh file of version 2.2: triangles (material, vertices), curves (boundary id, vertices)."""
    elements = [(kind, *triangle) for triangle in triangles] + [(1, *curve) for curve in curves]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", len(vertices)]
    lines += [f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(vertices, 1)] + ["$EndNodes", "$Elements", len(elements)]
    lines += [f"{i} {kind} 2 {group} {group} {' '.join(str(v + 1) for v in nodes)}"
              for i, (kind, group, nodes) in enumerate(elements, 1)]
    (folder / name).write_text("\n".join(map(str, lines)) + "\n$EndElements\n")
    return {"Mesh/Shape": "file", "Mesh/File": name, "Constraints/Clamped boundaries": ""}


# Mesh files of triangles: a square of two, the first the wrong way round.
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
HALVES = [(3, (0, 2, 1)), (4, (0, 2, 3))]
square = write("square.msh", SQUARE, HALVES, [(5, (0, 1)), (6, (2, 3))])
accepted(square, "2 triangles, 4 vertices in [0, 1] x [0, 1] m, 1 m^3", "0 (2), 5 (1), 6 (1)", "3 (1), 4 (1)",
         "1 inverted cell(s) were reoriented", "worst cell  0.866025")
accepted({**square, "Mesh/Scale": 1e-3, "Plane/Model": "axisymmetric"}, "[0, 0.001] x [0, 0.001] m, 3.14159e-09 m^3")
accepted({**square, "Mesh/Boundary regions": "8: x == 1"}, "0 (1), 5 (1), 6 (1), 8 (1)")
accepted({**square, "Material/By id": "4: 1e6, 0.3, 900"})
accepted(write("inside.msh", SQUARE, HALVES, [(5, (0, 2))]), "1 edge(s) of groups lie inside")
accepted(write("twice.msh", SQUARE, HALVES, [(5, (0, 1)), (6, (0, 1))]), "1 edge(s) belong to several groups")
apart = [(x + 3, y, z) for x, y, z in SQUARE[:3]]
accepted(write("pieces.msh", [*SQUARE, *apart], [*HALVES, (3, (4, 5, 6))]), "in 2 pieces that do not hang together")
accepted(write("sliver.msh", [*SQUARE, (0.5, 1.01, 0)], [*HALVES, (3, (3, 2, 4))]), "1 cell(s) are slivers")
refused(write("flat.msh", [*SQUARE, (0.5, 1, 0)], [*HALVES, (3, (3, 2, 4))]), "1 cell(s) are flat, that is without area")
refused(write("three.msh", [*SQUARE, (2, 0.5, 0)], [*HALVES, (3, (0, 2, 4))]), "a face has three cells")
refused(write("surface.msh", [*SQUARE[:3], (0, 1, 0.1)], HALVES), "no tetrahedra", "only if all vertices lie in the plane")
refused(write("quadratic.msh", [*SQUARE[:3], (0.5, 0, 0), (1, 0.5, 0), (0.5, 0.5, 0)], [(3, (0, 1, 2, 3, 4, 5))], kind=9),
        "quadratic", "of order 1")
refused({**write("beyond.msh", [(x - 0.5, y, z) for x, y, z in SQUARE], HALVES), "Plane/Model": "axisymmetric"}, "Mesh/File",
        "can't be negative")

# Each half bears its own weight: materials and curves are those of the file.
weight = {**square, "Time/Problem": "static", "Time/Steps": 1, "Loads/Gravity": "0, -10, 0", "Material/Density": 600,
          "Constraints/Clamped boundaries": 5, "Probes/Boundaries": "low: 5", "Material/By id": "4: 1e6, 0.3, 900"}
low = runner.simulate(scene, {**weight, "Probes/Points": "a: 0, 0, 0"}).probes()[-1]["low.fy"]
runner.check(abs(low - 10 * (300 + 450)) < 1e-6 * low, f"reaction {low}")
