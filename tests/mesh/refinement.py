"""Mesh/Refine region and Output/Mesh: what is cut and how far, walls that stay round, the mesh as a file, and what is refused."""

import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
CORNER = "0.5 - sqrt(x^2 + (y-12)^2 + z^2)"
BALL = {"Mesh/Refine region": CORNER, "Mesh/Refine region size": 0.5}


def checked(settings, scene=runner.STATIC):
    """What supple --check says of the body: cells, volume, quality of the worst cell."""
    status, output, error = runner.run("--check", scene, *runner.overrides(settings))
    runner.check(status == 0, f"{settings}: {error}")
    runner.check("warning" not in output, output)
    found = re.search(r"(\d+) (?:tetrahedra|triangles), .* m, (\S+) m\^3.*worst cell +(\S+),", output, re.DOTALL)
    return int(found[1]), float(found[2]), float(found[3])


def refused(settings, *words, scene=runner.STATIC):
    message = runner.refused(runner.run(scene, "--output", folder / "none", *runner.overrides(settings)), words, f"{settings}")
    runner.check(len(message) < 900 and not (folder / "none").exists(), message)


def mesh_of(settings, scene=runner.STATIC):
    """The file mesh.msh of a run: vertices, and (id, vertices) of tetrahedra, triangles and edges."""
    results = runner.simulate(scene, {"Output/Mesh": "true", "Output/Report": "false", **settings})
    lines = (results.folder / "mesh.msh").read_text().splitlines()
    nodes, elements = lines.index("$Nodes"), lines.index("$Elements")
    vertices = [tuple(map(float, line.split()[1:])) for line in lines[nodes + 2:lines.index("$EndNodes")]]
    kinds = {4: [], 2: [], 1: []}
    for line in lines[elements + 2:lines.index("$EndElements")]:
        _, kind, _, group, _, *corners = map(int, line.split())
        kinds[kind].append((group, [corner - 1 for corner in corners]))
    return results, vertices, kinds


# How far.
whole = "1"
plain = checked({})
runner.check(plain[:2] == (192, 192), f"{plain}")
once, twice = (checked({"Mesh/Refine region": whole, "Mesh/Refine region times": n}) for n in (1, 2))
runner.check(once[:2] == (8 * 192, 192) and twice[:2] == (64 * 192, 192) and twice[2] > 0.3, f"{once} {twice}")
fine = checked(BALL)
runner.check(192 < fine[0] < 2000 and fine[1] == 192 and fine[2] > 0.3, f"{fine}")
finer = checked({**BALL, "Mesh/Refine region size": 0.1})
runner.check(finer[0] > 4 * fine[0] and finer[2] > 0.3, f"{finer}")

# Materials, boundaries and edges of the refined mesh, and the same body read again.
layered = {**BALL, "Mesh/Layers": "6, 6", "Material/By id": "1: 5e7, 0.3, 1200"}
results, vertices, kinds = mesh_of(layered)
size = max(math.dist(vertices[a], vertices[b]) for _, cell in kinds[4] for a in cell for b in cell
           if any(math.dist(vertices[v], (0, 12, 0)) < 0.5 for v in cell))
runner.check(0.25 < size < 0.5 + 1e-9, f"edges up to {size}")
runner.check(all((sum(vertices[v][1] for v in cell) / 4 < 6) == (group == 1) for group, cell in kinds[4]), "materials have changed")
for group, axis, place in [(0, 0, 0), (1, 0, 4), (2, 1, 0), (3, 1, 12), (4, 2, 0), (5, 2, 4)]:
    faces = [face for of, face in kinds[2] if of == group]
    runner.check(faces and all(vertices[v][axis] == place for face in faces for v in face), f"boundary {group}")
again = runner.simulate(runner.STATIC, {**{key: layered[key] for key in layered if key.startswith("Material")},
                                        "Mesh/Shape": "file", "Mesh/File": results.folder / "mesh.msh", "Output/Report": "false"})
runner.check(again.summary()["cells"] == results.summary()["cells"], "another number of cells")
worst = runner.largest_difference(results.probes(), again.probes(), list(results.probes()[0]))
print(f"read again: probes within {worst:.1e}")
runner.check(worst < 1e-9, "another motion on the same mesh")

# Names of groups pass through, in the plane as well.
cook = runner.ROOT / "parameters" / "validation" / "cook.prm"
results, vertices, kinds = mesh_of({"Mesh/Refine region": "x - 0.04"}, cook)
runner.check(not kinds[4] and len(kinds[2]) > 0 and len(kinds[1]) > 0, "no triangles")
status, output, error = runner.run("--check", cook, *runner.overrides({"Mesh/File": results.folder / "mesh.msh", "Mesh/Scale": 1}))
_, before, _ = runner.run("--check", cook)
groups = [next((line for line in text.splitlines() if line.startswith("  groups")), "") for text in (before, output)]
runner.check(status == 0 and groups[0] == groups[1], f"{groups} {error}")

# Round walls: of the generator, and of a map.
vein = runner.ROOT / "parameters" / "vein" / "test-1.prm"
_, vertices, kinds = mesh_of({"Mesh/Refine region": "z - 0.02", "Time/Steps": 1, "Material/Mass per vertex": 0, "Damping/Viscous": 0}, vein)
radii = {group: [math.hypot(*vertices[v][:2]) for of, face in kinds[2] if of == group for v in face] for group in (0, 1)}
runner.check(all(max(of) - min(of) < 1e-12 for of in radii.values()) and len(radii[0]) > 15 * 21 * 6, "the walls are not round")
flat = mesh_of({"Time/Steps": 1}, vein)[1]
runner.check(len(vertices) > len(flat), "nothing was refined")
ring = {"Mesh/Box origin": "1, 0, 0", "Mesh/Box size": "1, 1.5, 1", "Mesh/Box cubes": "2, 3, 2", "Mesh/Map": "x*cos(y); x*sin(y); z",
        "Mesh/Refine region": "0.4 - z", "Mesh/Refine region times": 2, "Probes/Points": "", "Probes/Boundaries": ""}
_, vertices, kinds = mesh_of(ring)
for group, radius in ((0, 1), (1, 2)):
    runner.check(all(abs(math.hypot(*vertices[v][:2]) - radius) < 1e-12 for of, face in kinds[2] if of == group for v in face), "not round")

# Other programs read the file.
readers = [python for python in (sys.executable, "/usr/bin/python3")
           if subprocess.run([python, "-c", "import meshio"], capture_output=True).returncode == 0]
if readers:
    code = (f"import meshio; mesh = meshio.read({str(results.folder / 'mesh.msh')!r}); "
            "print(len(mesh.points), sum(len(block.data) for block in mesh.cells if block.type == 'triangle'))")
    printed = subprocess.run([readers[0], "-c", code], capture_output=True, text=True).stdout.split("\n")
    n_vertices, n_cells = map(int, printed[-2].split())
    runner.check(n_cells == results.summary()["cells"] and n_vertices == results.summary()["vertices"], f"meshio: {printed}")
else:
    print("meshio is not installed: no other program has read the mesh")

# Bad input.
refused({"Mesh/Refine region": "x - 5"}, "Mesh/Refine region", "at no vertex", "[0, 4] x [0, 12] x [0, 4] m")
refused({"Mesh/Refine region": "x +"}, "Mesh/Refine region")
refused({"Mesh/Refine region": "x - t"}, "Mesh/Refine region", "does not depend on t")
refused({"Mesh/Refine region": whole, "Mesh/Refine region times": 12}, "about 1.3e+13 cells", "Mesh/Refine most cells", "2000000")
refused({"Mesh/Refine region": whole, "Mesh/Refine region size": 1e-5}, "Mesh/Refine region", "cells", "Mesh/Refine most cells")
refused({**BALL, "Mesh/Refine most cells": 200}, "cells", "Mesh/Refine most cells = 200")
refused({"Mesh/Refine region times": 0, "Mesh/Refine region": whole}, "Mesh/Refine region times", "1 or greater")
refused({"Mesh/Refine region size": -1, "Mesh/Refine region": whole}, "Mesh/Refine region size", "0 or greater")
_, output, _ = runner.run("--check", runner.STATIC, "--set", "Mesh/Refine region times=2")
runner.check("Mesh/Refine region times" in output and "has no effect, for Mesh/Refine region is empty" in output, output)
