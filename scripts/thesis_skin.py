"""The figures of the 2005 thesis, chapters 3 and 4: measurements, meshes, errors of its grids; and its plane skin turned about the
needle's axis beside skin that is computed in space. Called by scripts/theses.sh.

Prints the tables of doc/skin-figures.md and draws doc/pictures/skin-turned*.png, skin-surfaces.png, skin-models.png and
skin-errors.png. Runs are left in output/theses/skin.
"""

import argparse
import csv
import pathlib
import subprocess
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import errors
import frames
import render
import scene_run
import volumes

ROOT = pathlib.Path(__file__).resolve().parent.parent
SKIN = ROOT / "parameters" / "skin"
OUTPUT = ROOT / "output" / "theses" / "skin"
PICTURES = ROOT / "doc" / "pictures"
DEPTH, WIDTH, HEIGHT = 0.9e-3, 6e-3, 4.5e-3
MODELS = ["plane", "axisymmetric", "3d"]
NAMES = {"plane": "plane, turned", "axisymmetric": "axisymmetric", "3d": "tetrahedra"}
COLOURS = {"plane": "#b3192b", "axisymmetric": "#1f3a7a", "3d": "#2f7d4f", "corotational": "#d98a1f"}
YOUNG, POISSON = (0.2e6, 0.02e6), 0.48    # by material, as in turned-axisymmetric.prm
TABLES = {"3.3": 6, "3.4": 6, "3.6": 12, "3.7": 12}    # with the rows of squares of the mesh


class Body:
    """The last frame of a run: places at rest, displacements and cells, materials."""

    def __init__(self, folder):
        grid = frames.read_grid(frames.read_frames(folder)[-1][1])
        self.moved = frames.displacements(grid).astype(float)
        self.rest = frames.places(grid) - self.moved
        self.cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
        self.materials = vtk_to_numpy(grid.GetCellData().GetArray("material")).astype(int)


def profile(folder):
    """Vertices of the surface at the last step: places at rest x, z, and displacements [m]."""
    rows = scene_run.rows(folder / "profile_skin.csv")
    last = [row for row in rows if row["step"] == rows[-1]["step"]]
    return [numpy.array([row[a] - row["u" + a] for row in last]) for a in "xz"] + [numpy.array([row["u" + a] for row in last]) for a in "xyz"]


def depth_by_distance(folder):
    """Distance from the axis and depth of the surface to the right of it, after the deformation; of a block straight to the right."""
    x, z, ux, uy, _ = profile(folder)
    right = (x > -1e-9) & (abs(z) < 1e-9)
    order = numpy.argsort(x[right])
    return (x + ux)[right][order], -uy[right][order]


def energy_turned(body):
    """Elastic energy that the plane skin's displacements have if they are taken for those of a body around the axis: with the
    hoop strain, constant in each triangle."""
    half = [cell for cell in range(len(body.cells)) if body.rest[body.cells[cell], 0].min() > -1e-9]
    total = 0.
    for cell in half:
        corners, moved = body.rest[body.cells[cell], :2], body.moved[body.cells[cell], :2]
        matrix = numpy.column_stack([corners, numpy.ones(3)])
        gradient = numpy.linalg.solve(matrix, moved)[:2].T
        radius, outward = corners[:, 0].mean(), moved[:, 0].mean()
        strain = numpy.array([gradient[0, 0], gradient[1, 1], outward / radius, (gradient[0, 1] + gradient[1, 0]) / 2])
        young = YOUNG[body.materials[cell]]
        first, second = young * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), young / (2 * (1 + POISSON))
        density = first / 2 * strain[:3].sum() ** 2 + second * ((strain[:3] ** 2).sum() + 2 * strain[3] ** 2)
        total += density * 2 * numpy.pi * radius * abs(numpy.linalg.det(matrix)) / 2
    return total


def run_turned(supple):
    """Runs of the three scenes, the axisymmetric one with rotations too; prints forces and errors."""
    print("| skin | cells | force at 0.9 mm [N] | seconds | stress, error in space | work, error in space |\n" + "|---" * 6 + "|")
    forces = {}
    for model in MODELS:
        summary, probes = scene_run.run(supple, SKIN / f"turned-{model}.prm", OUTPUT / model, {"Output/Frames": "every"})
        forces[model] = -probes["needle.fy"] * (4 if model == "3d" else 1)
        space = summary["error_estimate"].get("space", {})
        told = [errors.percent(space[name]) if isinstance(space.get(name), float) else "" for name in ("energy", "work")]
        print(f"| {NAMES[model]} | {summary['cells']} | {forces[model]:.4f} | {summary['seconds']['run']:.2g} | {told[0]} | {told[1]} |")
    summary, probes = scene_run.run(supple, SKIN / "turned-axisymmetric.prm", OUTPUT / "corotational",
                                    {"Corotation/Rotation": "polar", "Time/Steps": 9})
    print(f"| axisymmetric, corotational | {summary['cells']} | {-probes['needle.fy']:.4f} | {summary['seconds']['run']:.2g} | |")
    summary, probes = scene_run.run(supple, SKIN / "turned-axisymmetric.prm", OUTPUT / "locking",
                                    {"Output/Frames": "every", "Material/Volumetric locking cure": "none"})
    print(f"| axisymmetric, nothing against locking | {summary['cells']} | {-probes['needle.fy']:.4f} | {summary['seconds']['run']:.2g} | |")
    elastic = scene_run.last_row(OUTPUT / "locking" / "history.csv")["elastic"]
    turned = 2 * energy_turned(Body(OUTPUT / "plane")) / DEPTH
    print(f"\nForce by the energy of the turned displacements: {turned:.4f} N. The same sum over the axisymmetric body with nothing against "
          f"locking is {energy_turned(Body(OUTPUT / 'locking')) / elastic:.6f} of its energy.")
    return forces, turned


def draw_curves(forces, turned):
    """Depth by distance, differences from the axisymmetric surface, and force by depth."""
    figure, (surfaces, differences, needle) = matplotlib.pyplot.subplots(1, 3, figsize=(13, 4))
    curves = {model: depth_by_distance(OUTPUT / model) for model in MODELS}
    distances = numpy.linspace(0.5e-3, 6e-3, 111)
    right = numpy.interp(distances, *curves["axisymmetric"])
    print("\n| surface | largest difference from the axisymmetric one | at |\n|---|---|---|")
    for model in MODELS:
        surfaces.plot(1e3 * curves[model][0], -1e3 * curves[model][1], color=COLOURS[model], label=NAMES[model])
        if model != "axisymmetric":
            apart = numpy.interp(distances, *curves[model]) - right
            worst = abs(apart).argmax()
            differences.plot(1e3 * distances, 1e3 * apart, color=COLOURS[model], label=NAMES[model])
            print(f"| {NAMES[model]} | {1e3 * apart[worst]:.3f} mm | {1e3 * distances[worst]:.2f} mm |")
    axis = numpy.array([0, DEPTH])
    for model, force in [("axisymmetric", forces["axisymmetric"]), ("3d", forces["3d"])]:
        needle.plot(1e3 * axis, [0, force], color=COLOURS[model], label=NAMES[model])
    needle.plot(1e3 * axis, [0, turned], color=COLOURS["plane"], label="plane, turned: by its energy")
    needle.plot(1e3 * axis, [0, forces["plane"]], color=COLOURS["plane"], linestyle="--", label="plane, a strip of 1 mm")
    rows = scene_run.rows(OUTPUT / "corotational" / "probes.csv")
    needle.plot([1e3 * DEPTH * row["time"] for row in rows], [-row["needle.fy"] for row in rows], color=COLOURS["corotational"],
                label="axisymmetric, corotational")
    for axes, title, y in [(surfaces, "surface", "height in mm"), (differences, "deeper than axisymmetric", "difference in mm"),
                           (needle, "resistance", "force in N")]:
        axes.set_title(title)
        axes.set_xlabel("depth of the needle in mm" if axes is needle else "distance from the axis in mm")
        axes.set_ylabel(y)
        axes.grid(alpha=0.3)
        axes.legend(fontsize=8)
    volumes.save(figure, PICTURES / "skin-turned-curves.png")


def surface_of_revolution(folder):
    """The back half of the block's surface, its heights those of the profile at each point's distance from the axis."""
    distance, depth = depth_by_distance(folder)
    across = numpy.linspace(-1, 1, 33)
    across = WIDTH * across * (0.3 + 0.7 * across ** 2)    # close to the needle more of them
    x, z = numpy.meshgrid(across, across[across <= 1e-9], indexing="ij")
    down = numpy.interp(numpy.hypot(x, z), distance, depth, right=0.)
    return x, z, -down


def surface_of_block(folder):
    x, z, _, uy, _ = profile(folder)
    heights = {(round(1e6 * a), round(1e6 * b)): height for a, b, height in zip(x, z, uy)}
    sides = sorted({round(1e6 * a) for a in x})
    across = numpy.array([-side for side in sides[:0:-1]] + sides)
    x, z = numpy.meshgrid(across, across[across <= 0], indexing="ij")
    down = numpy.vectorize(lambda a, b: heights[abs(a), abs(b)])(x, z)
    return 1e-6 * x, 1e-6 * z, down


def cut_of(folder, model):
    """The triangles of the cut through the axis: places at rest, displacements, triangles."""
    body = Body(folder)
    triangles = body.cells
    if model == "3d":
        faces = numpy.vstack([body.cells[:, corners] for corners in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])])
        triangles = faces[(abs(body.rest[faces, 2]) < 1e-9).all(axis=1)]
    rest, moved = body.rest, body.moved
    if model != "plane":
        mirror = numpy.array([-1, 1, 1])
        rest, moved = numpy.vstack([rest, rest * mirror]), numpy.vstack([moved, moved * mirror])
        triangles = numpy.vstack([triangles, triangles[:, ::-1] + len(body.rest)])
    return rest, moved, triangles


def write_half(model, file):
    """Surface and cut as one body that can be drawn."""
    x, z, down = (surface_of_block if model == "3d" else surface_of_revolution)(OUTPUT / model)
    numbers = numpy.arange(x.size).reshape(x.shape)
    quads = numpy.stack([numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]], axis=-1).reshape(-1, 4)
    triangles = numpy.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    rest = numpy.column_stack([x.ravel(), numpy.zeros(x.size), z.ravel()])
    moved = numpy.column_stack([numpy.zeros(x.size), down.ravel(), numpy.zeros(x.size)])
    cut_rest, cut_moved, cut = cut_of(OUTPUT / model, model)
    triangles = numpy.vstack([triangles, cut + len(rest)])
    rest, moved = numpy.vstack([rest, cut_rest]), numpy.vstack([moved, cut_moved])
    used, triangles = numpy.unique(triangles, return_inverse=True)
    rest, moved, triangles = rest[used], moved[used], triangles.reshape(-1, 3)
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(rest + moved, deep=True))
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    cells = vtk.vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, [int(vertex) for vertex in triangle])
    grid.SetCells(vtk.VTK_TRIANGLE, cells)
    array = numpy_to_vtk(moved, deep=True)
    array.SetName("displacement")
    grid.GetPointData().AddArray(array)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(grid)
    writer.Write()


def draw_turned():
    files = []
    for model in MODELS:
        files.append(OUTPUT / f"half-{model}.vtu")
        write_half(model, files[-1])
    look = argparse.Namespace(field="displacement", range=(0, DEPTH), title="displacement", plain=True, outline="edges",
                              camera=(0.25, 0.7, 1), up=(0, 1, 0), width=1100, enlarge=1)
    drawing = render.Drawing([[(0, file) for file in files]], look, 3)
    places = [(0, column, grid, NAMES[model]) for column, (grid, model) in enumerate(zip(drawing.grids[0], MODELS))]
    drawing.write(PICTURES / "skin-turned.png", places, (1, 3))


class Thesis:
    """The thesis's plane skin under a single vertex, for a thickness of the upper layer in rows of squares and an elasticity ratio:
    displacements at 1 m of depth, for all is proportional to it."""

    def __init__(self, supple, n_rows, rows, ratio):
        thickness = rows * HEIGHT / n_rows
        layers = f"{thickness}, {HEIGHT - thickness}"
        self.folder = OUTPUT / f"thesis-{n_rows}-{rows}-{ratio:g}"
        scene_run.run(supple, SKIN / "thesis.prm", self.folder,
                      {"Output/Frames": "every", "Mesh/Rectangle squares": "16, 6" if n_rows == 6 else "32, 12", "Mesh/Layers": layers,
                       "Material/By id": f"1: {0.2e6 / ratio}, 0.48, 1000", "Space/Estimate error": "never"})
        self.body = Body(self.folder)
        x, _, ux, uy, _ = profile(self.folder)
        self.surface = numpy.array([x, ux / 1e-3, uy / 1e-3])
        self.interface = -thickness

    def heights(self, depth, distance):
        """Of the left half of the surface, as the thesis compares it, and linear between deformed vertices."""
        x, ux, uy = self.surface
        left = x < 1e-9
        places, down = -(x + depth * ux)[left][::-1], (depth * uy)[left][::-1]
        return numpy.interp(distance, places, down)

    def corrected(self, distance, measured):
        """The depth for which the surface goes through the first point."""
        depth = measured[0]
        for _ in range(50):
            depth -= -self.heights(depth, distance[0]) - measured[0]
        return depth

    def error(self, depth, distance, measured):
        return numpy.sqrt(((self.heights(depth, distance) + measured) ** 2).sum()) / len(measured)


def measurements():
    with open(SKIN / "fingertip.csv") as file:
        rows = [(int(row["set"]), 1e-3 * float(row["distance"]), 1e-3 * float(row["depth"])) for row in csv.DictReader(file)]
    return {number: numpy.array([row[1:] for row in rows if row[0] == number]).T for number in (1, 2)}


def crosses(axes, points, both=True):
    distance, depth = 1e3 * points
    axes.plot(distance, -depth, "+", color="#b3192b", markersize=6)
    if both:
        axes.plot(-distance, -depth, "+", color="#b3192b", markersize=6)


def draw_surfaces(supple, measured):
    """Figures 3.11, 3.12, 3.14, 3.17 and 3.18."""
    figure, axes = matplotlib.pyplot.subplots(2, 3, figsize=(13, 6.4))
    for panel, number in zip(axes[0], (1, 2)):
        crosses(panel, measured[number])
        distance, depth = 1e3 * measured[number]
        panel.plot([*-distance[::-1], *distance], [*-depth[::-1], *-depth], color="#5b7fa6", linewidth=0.9)
        panel.set_title(f"3.11, 3.12: measurements, set {number}")
    for ratio, colour, form in [(511, "#1f3a7a", "511"), (1, "#d98a1f", "1")]:
        model = Thesis(supple, 6, 3, ratio)
        x, ux, uy = model.surface
        axes[0, 2].plot(1e3 * x + 1.8 * ux, 1.8 * uy, color=colour, label=f"ratio {form}")
    axes[0, 2].legend(fontsize=8)
    axes[0, 2].set_title("3.14: two forms of the surface")
    model, points = Thesis(supple, 6, 3, 10), measured[1]
    depth = model.corrected(*points)
    x, ux, uy = model.surface
    print("\n| 3 of 6 rows, ratio 10, set 1 | depth of the needle [mm] | error sqrt(sum e^2)/n [mm] |\n|---|---|---|")
    for panel, d, name in zip(axes[1], (points[1][0], depth), ("3.17: before the correction", "3.18: after it")):
        panel.plot(1e3 * (x + d * ux), 1e3 * d * uy, color="#1f3a7a")
        crosses(panel, points, both=False)
        crosses(panel, points * numpy.array([[-1], [1]]), both=False)
        panel.set_title(f"{name}: {1e3 * d:.3f} mm deep")
        print(f"| {name[6:]} | {1e3 * d:.4f} | {1e3 * model.error(d, *points):.6f} |")
    for d, style, name in ((points[1][0], "--", "before"), (depth, "-", "after")):
        axes[1, 2].plot(1e3 * (x + d * ux), 1e3 * d * uy, style, color="#1f3a7a", label=name)
    crosses(axes[1, 2], points)
    axes[1, 2].set_xlim(-1.2, 1.2)
    axes[1, 2].set_ylim(-2.3, -1.1)
    axes[1, 2].legend(fontsize=8)
    axes[1, 2].set_title("3.17, 3.18: their details")
    for panel in axes.ravel():
        panel.grid(alpha=0.3)
        panel.set_xlabel("mm")
    volumes.save(figure, PICTURES / "skin-surfaces.png")


def draw_mesh(axes, model, depth, title, points=None):
    places = 1e3 * (model.body.rest + depth / 1e-3 * model.body.moved)
    for material, colour in ((0, "#b3192b"), (1, "#1f3a7a")):
        cells = model.body.cells[model.body.materials == material]
        axes.triplot(places[:, 0], places[:, 1], cells, color=colour, linewidth=0.4)
    if points is not None:
        crosses(axes, points)
    axes.axhline(-1e3 * HEIGHT, color="black", linewidth=0.8)
    axes.set_title(title, fontsize=10)
    axes.set_aspect("equal")
    axes.set_xlim(-6.3, 6.3)


def draw_models(supple, measured):
    """Figures 3.8, 3.9, 3.21, 3.23 and 3.27."""
    figure, axes = matplotlib.pyplot.subplots(4, 2, figsize=(9.6, 8))
    meshes = {n_rows: Thesis(supple, n_rows, n_rows // 2, 10) for n_rows in (6, 12)}
    print("\n| mesh | set | depth [mm] | error sqrt(sum e^2)/n [mm] | in the order of the tables |\n|---|---|---|---|---|")
    for column, (n_rows, model) in enumerate(meshes.items()):
        draw_mesh(axes[0, column], model, 0, f"{'3.8' if n_rows == 6 else '3.9'}: {n_rows} rows, at rest")
        for row, (number, points) in enumerate(measured.items(), 1):
            depth = model.corrected(*points)
            draw_mesh(axes[row, column], model, depth, f"{'3.23' if n_rows == 6 else '3.27'}: {n_rows} rows, set {number}, {1e3 * depth:.2f} mm",
                      points)
            printed = {(6, 1): 0.017824, (6, 2): 0.019866, (12, 1): 0.0143, (12, 2): 0.0179}[n_rows, number]
            print(f"| {2 * n_rows + 4 if n_rows == 6 else 32} x {n_rows} | {number} | {1e3 * depth:.4f} | "
                  f"{1e3 * model.error(depth, *points):.6f} | {printed} |")
    failing = Thesis(supple, 6, 5, 511)
    draw_mesh(axes[3, 0], failing, 1.8e-3, "3.21: 5 of 6 rows hard, ratio 511, 1.8 mm")
    draw_mesh(axes[3, 1], failing, 0.9e-3, "the same at 0.9 mm")
    for depth in (0.6e-3, 0.75e-3, 0.9e-3, 1.8e-3):
        places = failing.body.rest + depth / 1e-3 * failing.body.moved
        corners = places[failing.body.cells, :2]
        rest = failing.body.rest[failing.body.cells, :2]
        ratios = numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / numpy.linalg.det(rest[:, 1:] - rest[:, :1])
        print(f"3.21: at {1e3 * depth:.2f} mm {int((ratios <= 0).sum())} cells inside out, smallest area ratio {ratios.min():.3f}, "
              f"lowest vertex of the lower layer's top {1e3 * places[abs(failing.body.rest[:, 1] - failing.interface) < 1e-9, 1].min():.3f} mm")
    volumes.save(figure, PICTURES / "skin-models.png")


def draw_errors(supple):
    """Figures 3.19, 3.20, 3.22, 3.24, 3.25 and 3.26: the errors of the thesis's grids, by its recipe."""
    figure, axes = matplotlib.pyplot.subplots(3, 4, figsize=(15, 10))
    colours = matplotlib.pyplot.get_cmap("viridis")
    for column, (table, n_rows) in enumerate(TABLES.items()):
        folder = OUTPUT / f"table-{table}"
        subprocess.run([supple, str(SKIN / f"tables-{table}.prm"), "--quiet", "--output", str(folder)], check=True)
        rows = scene_run.rows(folder / "identification.csv")
        thicknesses = sorted({row["thickness"] for row in rows})
        for line, number in enumerate((1, 2)):
            panel = axes[line, column]
            for part, thickness in enumerate(thicknesses):
                curve = sorted((row["ratio"], row[f"error_{number}"]) for row in rows if row["thickness"] == thickness)
                panel.plot(*zip(*curve), color=colours(part / len(thicknesses)), linewidth=1.1,
                           label=f"{round(thickness * n_rows / 4.5)}/{n_rows}")
            figure_number = {"3.3": "3.19", "3.4": "3.20", "3.6": "3.24", "3.7": "3.25"}[table]
            panel.set_title(f"{figure_number} (table {table}), set {number}", fontsize=10)
            panel.set_xscale("log" if table in ("3.3", "3.6") else "linear")
            panel.set_xlabel("elasticity ratio")
        axes[0, column].legend(fontsize=7, title="upper layer", title_fontsize=7, ncol=2)
        if table in ("3.4", "3.7"):
            panel = axes[2, 0 if table == "3.4" else 1]
            for number, colour in ((1, "#b3192b"), (2, "#1f3a7a")):
                panel.plot(*zip(*sorted((row["thickness"] / 4.5, row[f"error_{number}"]) for row in rows if row["ratio"] == 10)),
                           "o-", color=colour, label=f"set {number}")
            panel.set_title(f"{'3.22' if table == '3.4' else '3.26'}: ratio 10, {n_rows} rows", fontsize=10)
            panel.set_xlabel("thickness of the upper layer / 4.5 mm")
            panel.axhspan(0, 0.025, color="#2f7d4f", alpha=0.12)
            panel.legend(fontsize=8)
    for panel in axes.ravel():
        panel.grid(alpha=0.3)
        panel.set_ylim(bottom=0)
        panel.set_ylabel("error in mm")
    axes[2, 2].axis("off")
    axes[2, 3].axis("off")
    volumes.save(figure, PICTURES / "skin-errors.png")


def main():
    supple = sys.argv[1]
    forces, turned = run_turned(supple)
    draw_curves(forces, turned)
    draw_turned()
    measured = measurements()
    draw_surfaces(supple, measured)
    draw_models(supple, measured)
    draw_errors(supple)


if __name__ == "__main__":
    main()
