"""The figures of the 2005 thesis, chapters 3 and 4: measurements, meshes, errors of its grids; and its plane skin turned about the
needle's axis beside skin that is computed in space. Called by scripts/theses.sh.

Writes the tables of doc/skin-figures.md and draws doc/pictures/skin-turned.png, skin-inside.png, skin-turned-curves.png,
skin-surfaces.png, skin-models.png and skin-errors.png. Runs are left in output/theses/skin.
"""

import argparse
import csv
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import errors
import frames
import pages
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
RED, BLUE, GREEN, AMBER = "#b3192b", "#1f3a7a", "#2f7d4f", "#d98a1f"
COLOURS = {"plane": RED, "axisymmetric": BLUE, "3d": GREEN, "corotational": AMBER}
YOUNG, POISSON = (0.2e6, 0.02e6), 0.48    # by material, as in turned-axisymmetric.prm
SQUARES = {6: "16, 6", 12: "32, 12"}    # of the thesis's meshes, by rows
PAIR = {6: {1: 0.017824, 2: 0.019866}, 12: {1: 0.0143, 2: 0.0179}}    # its errors of the best pair [mm], by rows and set
TABLES = {"3.3": ("3.19", 6), "3.4": ("3.20", 6), "3.6": ("3.24", 12), "3.7": ("3.25", 12)}    # with figure and rows of the mesh
RATIO_10 = {"3.4": "3.22", "3.7": "3.26"}    # the figure that shows this table at a ratio of 10


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


def depth_by_distance(folder, diagonal=False):
    """Distance from the axis and depth of the surface after the deformation: to the right of it, or along the diagonal of a block."""
    x, z, ux, uy, uz = profile(folder)
    chosen = (x > -1e-9) & (abs(z - (x if diagonal else 0)) < 1e-9)
    order = numpy.argsort(x[chosen])
    return numpy.hypot(x + ux, z + uz)[chosen][order], -uy[chosen][order]


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


def told(share):
    return errors.percent(share) if isinstance(share, float) else ""


def run_turned(supple):
    """Runs the three scenes, and the axisymmetric one with rotations and without a cure for locking. @return {name: force [N]}"""
    variants = {"corotational": {"Corotation/Rotation": "polar", "Time/Steps": 9}, "locking": {"Material/Volumetric locking cure": "none"}}
    names = {**NAMES, "plane": "plane, a strip of 1 mm", "corotational": "axisymmetric, corotational",
             "locking": "axisymmetric, nothing against locking"}
    forces, rows = {}, []
    for run, name in names.items():
        scene = "axisymmetric" if run in variants else run
        summary, probes = scene_run.run(supple, SKIN / f"turned-{scene}.prm", OUTPUT / run,
                                        {"Output/Frames": "every", **variants.get(run, {})})
        forces[run] = -probes["needle.fy"] * (4 if run == "3d" else 1)    # of a quarter
        space = summary["error_estimate"].get("space", {})
        rows.append([name, summary["cells"], f"{summary['seconds']['run']:.2g}", told(space.get("energy")), told(space.get("work"))])
    forces["turned"] = 2 * energy_turned(Body(OUTPUT / "plane")) / DEPTH
    names["turned"] = "plane, turned: by its energy"
    pages.put_table("skin-figures.md", ["skin", "force at 0.9 mm [N]", "part of the axisymmetric one"],
                    [[names[run], f"{force:.4f}", f"{force / forces['axisymmetric']:.2f}"] for run, force in forces.items()])
    pages.put_table("skin-figures.md", ["skin", "cells", "seconds", "error in space, of the stress", "of the force"], rows)
    elastic = scene_run.last_row(OUTPUT / "locking" / "history.csv")["elastic"]
    print(f"The same sum over the axisymmetric body with nothing against locking is {energy_turned(Body(OUTPUT / 'locking')) / elastic:.6f} "
          "of its energy.\n")
    return forces


def compare_surfaces():
    """The table of depths beside those of the axisymmetric skin."""
    distances = numpy.linspace(0.5e-3, 6e-3, 1101)
    right = numpy.interp(distances, *depth_by_distance(OUTPUT / "axisymmetric"))
    rows = [["axisymmetric", f"{1e3 * numpy.interp(2e-3, distances, right):.3f}", "", "", ""]]
    for name, model, diagonal in [("plane, turned", "plane", False), ("tetrahedra, to the side", "3d", False),
                                  ("tetrahedra, along the diagonal", "3d", True)]:
        depth = numpy.interp(distances, *depth_by_distance(OUTPUT / model, diagonal))
        apart = abs(depth - right)
        rows.append([name, *(f"{1e3 * number:.3f}" for number in (numpy.interp(2e-3, distances, depth), apart.max(),
                                                                  distances[apart.argmax()], apart[distances > 0.75e-3].max()))])
    pages.put_table("skin-figures.md", ["surface", "depth at 2 mm [mm]", "largest difference from the axisymmetric one [mm]",
                                        "at a distance of [mm]", "largest difference beyond 0.75 mm [mm]"], rows)


def draw_curves(forces):
    """Depth by distance, differences from the axisymmetric surface, and force by depth."""
    figure, (surfaces, differences, needle) = matplotlib.pyplot.subplots(1, 3, figsize=(13, 4))
    distances = numpy.linspace(0.5e-3, 6e-3, 1101)
    right = numpy.interp(distances, *depth_by_distance(OUTPUT / "axisymmetric"))
    for model in MODELS:
        distance, depth = depth_by_distance(OUTPUT / model)
        surfaces.plot(1e3 * distance, -1e3 * depth, color=COLOURS[model], label=NAMES[model])
        if model != "axisymmetric":
            differences.plot(1e3 * distances, 1e3 * (numpy.interp(distances, distance, depth) - right), color=COLOURS[model],
                             label=NAMES[model])
    for run, colour, style, name in [("axisymmetric", BLUE, "-", "axisymmetric"), ("3d", GREEN, "-", "tetrahedra"),
                                     ("turned", RED, "-", "plane, turned: by its energy"), ("plane", RED, "--", "plane, a strip of 1 mm")]:
        needle.plot([0, 1e3 * DEPTH], [0, forces[run]], style, color=colour, label=name)
    rows = scene_run.rows(OUTPUT / "corotational" / "probes.csv")
    needle.plot([1e3 * DEPTH * row["time"] for row in rows], [-row["needle.fy"] for row in rows], color=AMBER,
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
    """The block's surface: places x, z at rest, and as height that of the profile at each point's distance from the axis."""
    distance, depth = depth_by_distance(folder)
    across = numpy.linspace(-1, 1, 65)
    across = WIDTH * across * (0.3 + 0.7 * across ** 2)    # close to the needle more of them
    x, z = numpy.meshgrid(across, across, indexing="ij")
    return x, z, -numpy.interp(numpy.hypot(x, z), distance, depth, right=0.)


def surface_of_block(folder):
    """The same of the block in tetrahedra, of which a quarter was computed."""
    x, z, _, uy, _ = profile(folder)
    heights = {(round(1e6 * a), round(1e6 * b)): height for a, b, height in zip(x, z, uy)}
    sides = sorted({round(1e6 * a) for a in x})
    across = numpy.array([-side for side in sides[:0:-1]] + sides)
    x, z = numpy.meshgrid(across, across, indexing="ij")
    return 1e-6 * x, 1e-6 * z, numpy.vectorize(lambda a, b: heights[abs(a), abs(b)])(x, z)


def surface_of(model, half):
    """Surface of the block or of its back half as places at rest, displacements and triangles."""
    x, z, height = (surface_of_block if model == "3d" else surface_of_revolution)(OUTPUT / model)
    if half:
        x, z, height = (numbers[:, :x.shape[1] // 2 + 1] for numbers in (x, z, height))
    numbers = numpy.arange(x.size).reshape(x.shape)
    quads = numpy.stack([numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]], axis=-1).reshape(-1, 4)
    none = numpy.zeros(x.size)
    return (numpy.column_stack([x.ravel(), none, z.ravel()]), numpy.column_stack([none, height.ravel(), none]),
            numpy.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def walls():
    """The four held sides of the block, in the same form."""
    corners = numpy.array([[x, y, z] for y in (0, -HEIGHT) for x, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    corners[:, [0, 2]] *= WIDTH
    triangles = [triangle for a in range(4) for b in [(a + 1) % 4] for triangle in ((a, b, b + 4), (a, b + 4, a + 4))]
    return corners, numpy.zeros((8, 3)), numpy.array(triangles)


def cut_of(model):
    """The cut through the axis, in the same form."""
    body = Body(OUTPUT / model)
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


def write_triangles(parts, file):
    """Parts of a body as one VTU file, which can be drawn."""
    rest, moved, triangles = parts[0]
    for more_rest, more_moved, more_triangles in parts[1:]:
        triangles = numpy.vstack([triangles, more_triangles + len(rest)])
        rest, moved = numpy.vstack([rest, more_rest]), numpy.vstack([moved, more_moved])
    used, triangles = numpy.unique(triangles, return_inverse=True)
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk((rest + moved)[used], deep=True))
    cells = vtk.vtkCellArray()
    for triangle in triangles.reshape(-1, 3):
        cells.InsertNextCell(3, [int(vertex) for vertex in triangle])
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(vtk.VTK_TRIANGLE, cells)
    displacement = numpy_to_vtk(moved[used], deep=True)
    displacement.SetName("displacement")
    grid.GetPointData().AddArray(displacement)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(grid)
    writer.Write()


def draw_bodies(rows, picture, **look):
    """Bodies of triangles, {name: parts} of each row, coloured by displacement."""
    files = []
    for row, bodies in enumerate(rows):
        files.append([(0, OUTPUT / f"{picture}-{row}-{column}.vtu") for column in range(len(bodies))])
        for (_, file), parts in zip(files[-1], bodies.values()):
            write_triangles(parts, file)
    columns = len(files[0])
    drawing = render.Drawing(files, argparse.Namespace(field="displacement", range=(0, DEPTH), title="displacement", outline="edges",
                                                       up=(0, 1, 0), enlarge=1, **look), columns)
    places = [(row, column, grid, name) for row, (grids, bodies) in enumerate(zip(drawing.grids, rows))
              for column, (grid, name) in enumerate(zip(grids, bodies))]
    drawing.write(PICTURES / f"{picture}.png", places, (len(rows), columns))


def draw_turned():
    """Figures 4.1 and 4.4: the block, the same cut open, and the cells inside."""
    blocks = {NAMES[model]: [surface_of(model, half=False), walls()] for model in MODELS}
    halves = {f"{NAMES[model]}, cut": [surface_of(model, half=True), cut_of(model)] for model in MODELS}
    draw_bodies([blocks, halves], "skin-turned", plain=True, camera=(0.25, 0.7, 1), width=1100)
    cuts = [{f"{NAMES[model]}, inside": [cut_of(model)]} for model in MODELS]
    draw_bodies(cuts, "skin-inside", plain=False, camera=(0, 0, 1), width=900)


class Thesis:
    """The thesis's plane skin under a single vertex, for a thickness of the upper layer in rows of squares and an elasticity ratio:
    displacements at 1 m of depth, for all is proportional to it."""

    def __init__(self, supple, n_rows, rows, ratio):
        thickness = rows * HEIGHT / n_rows
        layers = f"{thickness}, {HEIGHT - thickness}"
        self.folder = OUTPUT / f"thesis-{n_rows}-{rows}-{ratio:g}"
        scene_run.run(supple, SKIN / "thesis.prm", self.folder,
                      {"Output/Frames": "every", "Mesh/Rectangle squares": SQUARES[n_rows], "Mesh/Layers": layers,
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

    def places(self, depth):
        return self.body.rest + depth / 1e-3 * self.body.moved

    def area_ratios(self, depth):
        """Of each triangle its area over that at rest, negative if it is inside out."""
        corners, rest = (places[self.body.cells, :2] for places in (self.places(depth), self.body.rest))
        return numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / numpy.linalg.det(rest[:, 1:] - rest[:, :1])

    def lowest_of_interface(self, depth):
        return self.places(depth)[abs(self.body.rest[:, 1] - self.interface) < 1e-9, 1].min()


def measurements():
    with open(SKIN / "fingertip.csv") as file:
        rows = [(int(row["set"]), 1e-3 * float(row["distance"]), 1e-3 * float(row["depth"])) for row in csv.DictReader(file)]
    return {number: numpy.array([row[1:] for row in rows if row[0] == number]).T for number in (1, 2)}


def crosses(axes, points, sides=(1, -1)):
    """The measured points, and their mirror image."""
    distance, depth = 1e3 * points
    for side in sides:
        axes.plot(side * distance, -depth, "+", color=RED, markersize=6)


def draw_measurements(panel, number, points):
    """Figures 3.11 and 3.12."""
    distance, depth = 1e3 * points
    crosses(panel, points)
    panel.plot([*-distance[::-1], *distance], [*-depth[::-1], *-depth], color="#5b7fa6", linewidth=0.9)
    panel.set_title(f"3.11, 3.12: measurements, set {number}")


def draw_forms(supple, panel):
    """Figure 3.14."""
    for ratio, colour in [(511, BLUE), (1, AMBER)]:
        x, ux, uy = Thesis(supple, 6, 3, ratio).surface
        panel.plot(1e3 * x + 1.8 * ux, 1.8 * uy, color=colour, label=f"ratio {ratio}")
    panel.legend(fontsize=8)
    panel.set_title("3.14: two forms of the surface")


def draw_correction(supple, panels, points):
    """Figures 3.17 and 3.18, with their table."""
    model = Thesis(supple, 6, 3, 10)
    x, ux, uy = model.surface
    rows = []
    for panel, depth, figure, name, style in [(panels[0], points[1][0], "3.17", "before the correction", "--"),
                                              (panels[1], model.corrected(*points), "3.18", "after it", "-")]:
        for axes in (panel, panels[2]):
            axes.plot(1e3 * (x + depth * ux), 1e3 * depth * uy, style, color=BLUE, label=name)
        crosses(panel, points)
        panel.set_title(f"{figure}: {name}, {1e3 * depth:.3f} mm", fontsize=11)
        rows.append([name, f"{1e3 * depth:.4f}", f"{1e3 * model.error(depth, *points):.6f}"])
    crosses(panels[2], points)
    panels[2].set_xlim(-1.2, 1.2)
    panels[2].set_ylim(-2.3, -1.1)
    panels[2].legend(fontsize=8)
    panels[2].set_title("3.17, 3.18: their details")
    pages.put_table("skin-figures.md", ["3 of 6 rows, ratio 10, set 1", "depth of the needle [mm]", "error sqrt(sum e^2)/n [mm]"], rows)


def draw_surfaces(supple, measured):
    figure, axes = matplotlib.pyplot.subplots(2, 3, figsize=(13, 6.8))
    for panel, (number, points) in zip(axes[0], measured.items()):
        draw_measurements(panel, number, points)
    draw_forms(supple, axes[0, 2])
    draw_correction(supple, axes[1], measured[1])
    for panel in axes.ravel():
        panel.grid(alpha=0.3)
        panel.set_xlabel("distance in mm")
        panel.set_ylabel("height in mm")
    volumes.save(figure, PICTURES / "skin-surfaces.png")


def draw_mesh(axes, model, depth, title, points=None):
    places = 1e3 * model.places(depth)
    for material, colour in ((0, GREEN), (1, BLUE)):
        cells = model.body.cells[model.body.materials == material]
        axes.triplot(places[:, 0], places[:, 1], cells, color=colour, linewidth=0.4)
    if points is not None:
        crosses(axes, points)
    axes.axhline(-1e3 * HEIGHT, color="black", linewidth=0.8)
    axes.set_title(title, fontsize=10)
    axes.set_aspect("equal")
    axes.set_xlim(-6.3, 6.3)
    axes.set_ylim(-5.2, 0.4)


def draw_models(supple, measured):
    """Figures 3.8, 3.9, 3.21, 3.23 and 3.27, with their tables."""
    figure, axes = matplotlib.pyplot.subplots(4, 2, figsize=(9.6, 9))
    rows = []
    for column, (n_rows, rest, best) in enumerate([(6, "3.8", "3.23"), (12, "3.9", "3.27")]):
        model = Thesis(supple, n_rows, n_rows // 2, 10)
        draw_mesh(axes[0, column], model, 0, f"{rest}: {n_rows} rows, at rest")
        for row, (number, points) in enumerate(measured.items(), 1):
            depth = model.corrected(*points)
            draw_mesh(axes[row, column], model, depth, f"{best}: {n_rows} rows, set {number}, {1e3 * depth:.2f} mm", points)
            rows.append([SQUARES[n_rows].replace(", ", " x "), number, f"{1e3 * depth:.4f}", f"{1e3 * model.error(depth, *points):.6f}",
                         PAIR[n_rows][number], (model.area_ratios(depth) <= 0).sum()])
    pages.put_table("skin-figures.md", ["mesh", "set", "depth [mm]", "error sqrt(sum e^2)/n [mm]", "printed", "cells inside out"], rows)
    failing = Thesis(supple, 6, 5, 511)
    draw_mesh(axes[3, 0], failing, 1.8e-3, "3.21: 5 of 6 rows hard, ratio 511, 1.8 mm")
    draw_mesh(axes[3, 1], failing, 0.9e-3, "the same at 0.9 mm")
    rows = [[f"{1e3 * depth:.2f}", (failing.area_ratios(depth) <= 0).sum(), f"{failing.area_ratios(depth).min():.3f}",
             f"{1e3 * (failing.lowest_of_interface(depth) + HEIGHT):.3f}"] for depth in (0.6e-3, 0.75e-3, 0.9e-3, 1.8e-3)]
    pages.put_table("skin-figures.md", ["3.21, depth [mm]", "cells inside out", "smallest area ratio",
                                        "upper layer above the bone [mm]"], rows)
    volumes.save(figure, PICTURES / "skin-models.png")


def draw_grid(panel, rows, number, n_rows):
    """Errors over the elasticity ratio, a line for each thickness."""
    thicknesses = sorted({row["thickness"] for row in rows})
    colours = matplotlib.pyplot.get_cmap("viridis")
    for part, thickness in enumerate(thicknesses):
        curve = sorted((row["ratio"], row[f"error_{number}"]) for row in rows if row["thickness"] == thickness)
        panel.plot(*zip(*curve), color=colours(part / len(thicknesses)), linewidth=1.1, label=f"{part + 1}/{n_rows}")
    panel.set_xscale("log" if max(row["ratio"] for row in rows) > 100 else "linear")
    panel.set_xlabel("elasticity ratio")


def draw_thickness(panel, rows):
    """Errors over the thickness at a ratio of 10."""
    for number, colour in ((1, RED), (2, BLUE)):
        panel.plot(*zip(*sorted((row["thickness"] / 4.5, row[f"error_{number}"]) for row in rows if row["ratio"] == 10)),
                   "o-", color=colour, label=f"set {number}")
    panel.set_xlabel("thickness of the upper layer / 4.5 mm")
    panel.axhspan(0, 0.025, color=GREEN, alpha=0.12)
    panel.legend(fontsize=8)


def draw_errors(supple):
    """Figures 3.19, 3.20, 3.22, 3.24, 3.25 and 3.26: the errors of the thesis's grids, by its recipe."""
    figure, axes = matplotlib.pyplot.subplots(3, 4, figsize=(15, 10))
    for column, (table, (name, n_rows)) in enumerate(TABLES.items()):
        rows = scene_run.identify(supple, SKIN / f"tables-{table}.prm", OUTPUT / f"table-{table}")
        for panel, number in zip(axes[:, column], (1, 2)):
            draw_grid(panel, rows, number, n_rows)
            panel.set_title(f"{name} (table {table}), set {number}", fontsize=10)
        below = axes[2, column]
        if table in RATIO_10:
            draw_thickness(below, rows)
            below.set_title(f"{RATIO_10[table]}: ratio 10, {n_rows} rows", fontsize=10)
        else:
            below.axis("off")
            below.legend(*axes[0, column].get_legend_handles_labels(), title="upper layer, of all lines above and to the right",
                         loc="center", ncol=2)
    for panel in axes.ravel():
        panel.grid(alpha=0.3)
        panel.set_ylim(bottom=0)
        panel.set_ylabel("error in mm")
    volumes.save(figure, PICTURES / "skin-errors.png")


def main():
    supple = sys.argv[1]
    forces = run_turned(supple)
    compare_surfaces()
    draw_curves(forces)
    draw_turned()
    measured = measurements()
    draw_surfaces(supple, measured)
    draw_models(supple, measured)
    draw_errors(supple)


if __name__ == "__main__":
    main()
