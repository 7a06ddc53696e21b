"""The figures of the 2016 thesis, chapters 5 and 7: bodies at its iterations, and volumes of cells over time, linear beside
corotational. Called by scripts/theses.sh.

Writes the tables of doc/corotational.md and draws doc/pictures/corotational-*.png. Runs are left in output/theses/corotational.
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
import pages
import render
import scene_run
import volumes

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUTPUT = ROOT / "output" / "theses" / "corotational"
PICTURES = ROOT / "doc" / "pictures"
COLOURS = ["#b3192b", "#1f3a7a", "#d98a1f", "#2f7d4f", "#7b4fa6"]

# Body: scenes, and the iterations that the thesis's figures show, linear and corotational.
BODIES = {
    "bar-20": (("bar/small-linear", "bar/small"), None),
    "bar-40": (("bar/large-linear", "bar/large"), ([1, 3, 8, 35], [1, 3, 8, 35])),
    "mushroom": (("mushroom/mushroom-linear", "mushroom/mushroom"), ([1, 20, 40, 60], [1, 20, 50, 70])),
    "armadillo": (("armadillo/armadillo-linear", "armadillo/armadillo"), ([1, 16, 26, 40, 50, 63], [1, 15, 30, 45, 60, 75])),
}
# Scenes whose largest volume ratio the thesis prints: what it prints, and why another number comes out.
PRINTED = {
    "bar/small-linear": ("bar, f = 20, linear", "1.27", "below"),
    "bar/small": ("bar, f = 20, corotational", "1.27", "below"),
    "bar/large-linear": ("bar, f = 40, linear", "2.0245", "in the middle of the bar, in the thesis at its free end; below"),
    "bar/large": ("bar, f = 40, corotational", "1.45", "at the clamp, in the thesis in the same cell as the linear one; below"),
    "mushroom/mushroom-linear": ("mushroom, linear", "2.25, at the last iteration", "another body"),
    "armadillo/armadillo-linear": ("armadillo, linear", "6.335, at iteration 26", "another body; below"),
}
FAR_END = {"bar-20": (2, 0.5, 2), "bar-40": (2, 0.5, 2)}    # a place whose cell is followed too: there the thesis sees the growth
LOOKS = {
    "bar-20": {"range": (0.92, 1.08)},
    "bar-40": {"range": (0.88, 1.12)},
    "mushroom": {"range": (0, 2), "outline": "silhouette", "camera": (-0.15, -1, 0.05)},
    "armadillo": {"range": (0, 2), "outline": "silhouette", "camera": (-1.2, -0.8, 0.25), "width": 1400},
}
# Readings of the bar's data, of which the thesis prints its largest volumes, and what is set for each.
BARS = {
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
# Readings of the armadillo's data: how many times as large the body is, and what stands for 1 kg and for 1 N.
ARMADILLOS = {
    "as in the scene: 1000 kg/m^3, 18 and 9 kN/m^3, 5 m high": (1, 1000, 1000),
    "1 kg/m^3, 18 and 9 N/m^3, 5 m high": (1, 1, 1),
    "1 kg/m^3, 18 and 9 N/m^3, 50 m high": (10, 1, 1),
    "1 kg/m^3, 18 and 9 N/m^3, 500 m high: cells as large as in the thesis": (100, 1, 1),
    "1 kg/m^3, 18 and 9 kN/m^3, 5 m high": (1, 1, 1000),
    "1 kg/m^3, 18 and 9 kN/m^3, 15 m high": (3, 1, 1000),
    "1 kg/m^3, 18 and 9 kN/m^3, 50 m high": (10, 1, 1000),
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
        for model, cell in zip(scene_run.MODELS, most):
            found.setdefault(int(cell), f"{name}, {model}")
    return found


def middles_of(folder):
    """Where the middles of the cells are at rest."""
    rest = frames.at_rest(frames.read_grid(frames.read_frames(folder)[0][1]))
    vertices = vtk_to_numpy(rest.GetCells().GetConnectivityArray()).reshape(rest.GetNumberOfCells(), -1)
    return frames.places(rest)[vertices].mean(axis=1)


def draw_volumes(body, ratios, cells):
    """The volume of all cells over the iterations, thin, and of the chosen ones, bold."""
    figure, panels = matplotlib.pyplot.subplots(1, 2, figsize=(10, 4.2), sharex=True, sharey=True)
    for axes, ratio, name in zip(panels, ratios, scene_run.MODELS):
        steps = numpy.arange(len(ratio))
        volumes.draw_cells(axes, steps, ratio)
        for colour, (cell, what) in zip(COLOURS, cells.items()):
            axes.plot(steps, ratio[:, cell], color=colour, linewidth=1.4, label=f"cell {cell}: {what}")
        axes.set_title(f"{name}: {ratio.min():.3f} to {ratio.max():.3f}")
        axes.set_xlabel("iteration")
    panels[0].set_ylabel("volume / volume at rest")
    panels[0].legend(fontsize=8, loc="best")
    volumes.save(figure, PICTURES / f"corotational-volumes-{body}.png")


def rows_of_cells(body, folder, ratios, cells):
    """Where the chosen cells are, and how their volume changes."""
    rows = []
    for cell, what in cells.items():
        place = ", ".join(f"{x:.2f}" for x in middles_of(folder)[cell])
        rows.append([body, cell, place, what, *(f"{ratio[:, cell].min():.3f} to {ratio[:, cell].max():.3f}" for ratio in ratios)])
    return rows


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
              for row, (name, steps, grids) in enumerate(zip(scene_run.MODELS, iterations, drawing.grids))
              for column, (step, grid) in enumerate(zip(steps, grids))]
    drawing.write(PICTURES / f"corotational-{body}.png", places, (2, columns))


def largest_of(supple, scene, settings):
    """Largest volume ratio of a run, and its step."""
    folder = OUTPUT / "variant"
    scene_run.run(supple, ROOT / "parameters" / f"{scene}.prm", folder, {"Space/Estimate error": "never", **settings})
    largest = max(scene_run.rows(folder / "history.csv"), key=lambda row: row["max_volume_ratio"])
    return f"{largest['max_volume_ratio']:.3f} at {largest['step']:.0f}"


def try_bars(supple):
    """The rows of the table of readings: largest volume ratio at both speeds, linear and corotational."""
    rows = []
    for name, settings in BARS.items():
        found = []
        for speed in 20, 40:
            for rotation in scene_run.MODELS.values():
                rotations = "none" if rotation == "none" else settings.get("Corotation/Rotation", rotation)
                these = {"Start/Velocity": f"0; 0; -{speed}", **settings, "Corotation/Rotation": rotations}
                found.append(largest_of(supple, "bar/large", {entry: str(value).format(speed=speed) for entry, value in these.items()}))
        rows.append([name, *found])
    return rows


def try_armadillos(supple):
    """The rows of the table of readings of the armadillo: largest volume ratio, linear and corotational."""
    rows = []
    for name, (size, mass, force) in ARMADILLOS.items():
        settings = {"Mesh/Scale": 0.22 * size, "Constraints/Clamped region": f"z < {0.25 * size}", "Material/Density": mass,
                    "Loads/Body force": f"0; {-18 * force}; {-9 * force}", "Probes/Points": "", "Probes/Regions": ""}
        rows.append([name, *(largest_of(supple, f"armadillo/{scene}", settings) for scene in ("armadillo-linear", "armadillo"))])
    return rows


def main():
    supple = sys.argv[1]
    printed, chosen, runs = [], [], []
    for body, (scenes, iterations) in BODIES.items():
        folders = [OUTPUT / f"{body}-{model}" for model in scene_run.MODELS]
        summaries = [compute(supple, scene, folder.name) for scene, folder in zip(scenes, folders)]
        ratios = [volumes.volumes(folder)[1] for folder in folders]
        cells = chosen_cells(body, folders[0], ratios)
        draw_volumes(body, ratios, cells)
        draw_bodies(body, folders, iterations or [turning_points(folder) for folder in folders])
        chosen += rows_of_cells(body, folders[0], ratios, cells)
        for scene, summary, ratio in zip(scenes, summaries, ratios):
            largest = f"{ratio.max():.3f}, at iteration {ratio.max(axis=1).argmax()}"
            runs.append([scene, summary["cells"], f"{ratio.min():.3f}", largest, f"{summary['seconds']['run']:.2g}",
                         errors.in_time(summary), errors.in_space(summary)])
            if scene in PRINTED:
                name, there, why = PRINTED[scene]
                printed.append([name, there, largest, why])
    pages.put_table("corotational.md", ["largest volume ratio", "printed", "here", "why they differ"], printed)
    pages.put_table("corotational.md", ["body", "cell", "its middle at rest [m]", "what it does", "its volume ratio, linear",
                                        "corotational"], chosen)
    pages.put_table("corotational.md", ["scene", "cells", "smallest volume ratio", "largest", "seconds", "error in time",
                                        "error in space"], runs)
    pages.put_table("corotational.md", ["reading", "f = 20, linear", "corotational", "f = 40, linear", "corotational"],
                    try_bars(supple))
    pages.put_table("corotational.md", ["armadillo, reading", "linear", "corotational"], try_armadillos(supple))


if __name__ == "__main__":
    main()
