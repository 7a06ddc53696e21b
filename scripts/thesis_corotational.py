"""The figures of the 2016 thesis, chapters 5 and 7: bodies at its iterations, and volumes of cells over time, linear beside
corotational. Called by scripts/theses.sh.

Prints the tables of doc/corotational.md and draws doc/pictures/corotational-*.png. Runs are left in output/theses/corotational.
"""

import argparse
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot
import numpy
from vtk.util.numpy_support import vtk_to_numpy

import errors
import frames
import render
import scene_run
import volumes

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUTPUT = ROOT / "output" / "theses" / "corotational"
PICTURES = ROOT / "doc" / "pictures"
MODELS = {"linear": "none", "corotational": "polar"}
COLOURS = ["#b3192b", "#1f3a7a", "#d98a1f", "#2f7d4f", "#7b4fa6"]

# Body: scenes, figures of the thesis, and the iterations that they show, linear and corotational.
BODIES = {
    "bar-20": (("bar/small-linear", "bar/small"), None),
    "bar-40": (("bar/large-linear", "bar/large"), ([1, 3, 8, 35], [1, 3, 8, 35])),
    "mushroom": (("mushroom/mushroom-linear", "mushroom/mushroom"), ([1, 20, 40, 60], [1, 20, 50, 70])),
    "armadillo": (("armadillo/armadillo-linear", "armadillo/armadillo"), ([1, 16, 26, 40, 50, 63], [1, 15, 30, 45, 60, 75])),
}
FAR_END = {"bar-20": (2, 0.5, 2), "bar-40": (2, 0.5, 2)}    # a place whose cell is followed too: there the thesis sees the growth
LOOKS = {
    "bar-20": {}, "bar-40": {},
    "mushroom": {"outline": "silhouette", "camera": (-0.15, -1, 0.05)},
    "armadillo": {"outline": "silhouette", "camera": (-1.2, -0.8, 0.25)},
}
# Readings of the bar's data, of which the thesis prints its largest volumes, and what is set for each.
VARIANTS = {
    "as stated": {},
    "Gram-Schmidt rotations, as in the thesis": {"Corotation/Rotation": "gram-schmidt"},
    "mass lumped at the vertices": {"Material/Mass": "lumped"},
    "the same mass at each vertex": {"Material/Mass per vertex": 192000 / 81},
    "no weight": {"Loads/Gravity": "0, 0, 0"},
    "speed of the free end alone": {"Start/Velocity": "0; 0; if(y < 0.001, -{speed}, 0)"},
    "E times 1/((1 + nu)(1 - 2 nu)), for the factor that stands twice": {"Material/Young modulus": 100e6 / (1.33 * 0.34)},
    "E = 10 MPa": {"Material/Young modulus": 10e6},
    "E times ((1 + nu)(1 - 2 nu))^2, for that factor upside down": {"Material/Young modulus": 100e6 * (1.33 * 0.34) ** 2},
    "the same, mass lumped": {"Material/Young modulus": 100e6 * (1.33 * 0.34) ** 2, "Material/Mass": "lumped"},
    "the same, Gram-Schmidt rotations": {"Material/Young modulus": 100e6 * (1.33 * 0.34) ** 2, "Corotation/Rotation": "gram-schmidt"},
    "steps of 0.007 s": {"Time/Step": 0.007, "Time/Steps": 1000},
    "trbdf2, of second order": {"Time/Method": "trbdf2"},
    "twice the speed": {"Start/Velocity": "0; 0; -2*{speed}"},
}


def compute(supple, scene, name):
    """A run with each of its steps drawn, and another for its errors, as summaries."""
    path = ROOT / "parameters" / f"{scene}.prm"
    scene_run.run(supple, path, OUTPUT / name, {"Output/Frames": "every"})
    return scene_run.run(supple, path, OUTPUT / "errors", {"Time/Estimate error": "true"})[0]


def chosen_cells(body, folder, ratios):
    """Cells that tell most, by what they are: those that grow and shrink most, linear and corotational."""
    found = {}
    if body in FAR_END:
        middles = middles_of(folder)
        found[int(numpy.linalg.norm(middles - FAR_END[body], axis=1).argmin())] = "middle of the free end"
    for name, most in [("grows most", [ratio.max(axis=0).argmax() for ratio in ratios]),
                       ("shrinks most", [ratio.min(axis=0).argmin() for ratio in ratios])]:
        if most[0] == most[1]:
            found.setdefault(int(most[0]), name)
            continue
        for model, cell in zip(MODELS, most):
            found.setdefault(int(cell), f"{name}, {model}")
    return found


def middles_of(folder):
    """Where the middles of the cells are at rest."""
    rest = frames.at_rest(frames.read_grid(frames.read_frames(folder)[0][1]))
    vertices = vtk_to_numpy(rest.GetCells().GetConnectivityArray()).reshape(rest.GetNumberOfCells(), -1)
    return frames.places(rest)[vertices].mean(axis=1)


def draw_volumes(body, folders):
    """The volume of all cells over the iterations, thin, and of some, bold."""
    ratios = [volumes.volumes(folder)[1] for folder in folders]
    cells = chosen_cells(body, folders[0], ratios)
    figure, panels = matplotlib.pyplot.subplots(1, 2, figsize=(10, 4.2), sharex=True, sharey=True)
    for axes, ratio, name in zip(panels, ratios, MODELS):
        steps = numpy.arange(len(ratio))
        lines = numpy.stack(numpy.broadcast_arrays(steps[:, None], ratio), axis=2).transpose(1, 0, 2)
        axes.add_collection(matplotlib.collections.LineCollection(lines, colors="#9fb2c8", linewidths=0.4, alpha=0.35))
        for colour, (cell, what) in zip(COLOURS, cells.items()):
            axes.plot(steps, ratio[:, cell], color=colour, linewidth=1.4, label=f"cell {cell}: {what}")
        axes.set_title(f"{name}: {ratio.min():.3f} to {ratio.max():.3f}")
        axes.set_xlabel("iteration")
        axes.set_xlim(0, len(ratio) - 1)
        axes.grid(alpha=0.3)
    panels[0].set_ylabel("volume / volume at rest")
    panels[0].legend(fontsize=8, loc="best")
    volumes.save(figure, PICTURES / f"corotational-volumes-{body}.png")
    for cell, what in cells.items():
        x, y, z = middles_of(folders[0])[cell]
        print(f"| {body} | {cell} | {x:.2f}, {y:.2f}, {z:.2f} | {what} | "
              + " | ".join(f"{ratio[:, cell].min():.3f} to {ratio[:, cell].max():.3f}" for ratio in ratios) + " |", flush=True)
    return ratios


def turning_points(folder):
    """The first four steps at which the middle of the bar's free end turns back."""
    heights = [row["n28.uz"] for row in scene_run.rows(folder / "probes.csv")]
    turns = [step for step in range(1, len(heights) - 1)
             if (heights[step] - heights[step - 1]) * (heights[step + 1] - heights[step]) <= 0]
    return turns[:4]


def draw_bodies(body, folders, iterations):
    """Linear above corotational, each at its iterations, coloured by volume ratio."""
    drawn = [[frames.read_frames(folder)[step] for step in steps] for folder, steps in zip(folders, iterations)]
    look = argparse.Namespace(field="volume_ratio", range=None, title=None, plain=False, outline="edges", camera=None, up=None,
                              width=1200, enlarge=1)
    vars(look).update(LOOKS[body])
    columns = len(iterations[0])
    drawing = render.Drawing(drawn, look, columns)
    places = [(row, column, grid, f"{name}, {step}")
              for row, (name, steps, grids) in enumerate(zip(MODELS, iterations, drawing.grids))
              for column, (step, grid) in enumerate(zip(steps, grids))]
    drawing.write(PICTURES / f"corotational-{body}.png", places, (2, columns))


def extremes_of(supple, settings):
    """Largest volume ratio of a run, and its step."""
    folder = OUTPUT / "variant"
    scene_run.run(supple, ROOT / "parameters" / "bar" / "large.prm", folder, {"Space/Estimate error": "never", **settings})
    history = scene_run.rows(folder / "history.csv")
    largest = max(history, key=lambda row: row["max_volume_ratio"])
    return f"{largest['max_volume_ratio']:.3f} at {largest['step']:.0f}"


def try_variants(supple):
    print("\n| reading | f = 20, linear | corotational | f = 40, linear | corotational |\n" + "|---" * 5 + "|")
    for name, settings in VARIANTS.items():
        found = []
        for speed in 20, 40:
            for rotation in MODELS.values():
                rotations = "none" if rotation == "none" else settings.get("Corotation/Rotation", rotation)
                these = {"Start/Velocity": f"0; 0; -{speed}", **settings, "Corotation/Rotation": rotations}
                found.append(extremes_of(supple, {entry: str(value).format(speed=speed) for entry, value in these.items()}))
        print(f"| {name} | " + " | ".join(found) + " |", flush=True)


def main():
    supple = sys.argv[1]
    table = []
    print("| body | cell | its middle at rest [m] | what it does | its volume ratio, linear | corotational |\n" + "|---" * 6 + "|")
    for body, (scenes, iterations) in BODIES.items():
        folders = [OUTPUT / f"{body}-{model}" for model in MODELS]
        summaries = [compute(supple, scene, folder.name) for scene, folder in zip(scenes, folders)]
        for scene, summary, ratio in zip(scenes, summaries, draw_volumes(body, folders)):
            step = int(ratio.max(axis=1).argmax())
            table.append(f"| {scene} | {summary['cells']} | {ratio.min():.3f} | {ratio.max():.3f} at {step} | "
                         f"{summary['seconds']['run']:.2g} | {errors.in_time(summary)} | {errors.in_space(summary)} |")
        draw_bodies(body, folders, iterations or [turning_points(folder) for folder in folders])
    print("\n| scene | cells | smallest volume ratio | largest, at iteration | seconds | error in time | in space |\n" + "|---" * 7 + "|")
    print("\n".join(table), flush=True)
    try_variants(supple)


if __name__ == "__main__":
    main()
