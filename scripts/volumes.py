"""Draws the volume of all cells over time, as a part of the volume at rest, of two runs side by side.

    scripts/volumes.sh OUTPUT_A OUTPUT_B PICTURE.png [--names linear corotational]

A thin line for each cell, the smallest and largest of all cells in bold. The numbers come from the VTU files; for all
steps, run the scenes with --set "Output/Frames=every".
"""

import argparse
import pathlib

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot
import numpy
from PIL import Image

import frames


def volumes(folder):
    """Times, and the volume ratio of each cell (columns) at each time (rows)."""
    times, rows = [], []
    for time, file in frames.read_frames(folder):
        rows.append(frames.values(frames.read_grid(file), "volume_ratio"))
        times.append(time)
    return numpy.array(times), numpy.array(rows)


def draw_cells(axes, times, ratios):
    """A thin line for each cell."""
    lines = numpy.stack(numpy.broadcast_arrays(times[:, None], ratios), axis=2).transpose(1, 0, 2)
    axes.add_collection(matplotlib.collections.LineCollection(lines, colors="#5b7fa6", linewidths=0.4, alpha=0.35))
    axes.set_xlim(times[0], times[-1])
    axes.grid(alpha=0.3)


def draw(axes, times, ratios, name):
    draw_cells(axes, times, ratios)
    axes.plot(times, ratios.max(axis=1), color="#b3192b", linewidth=1.8)
    axes.plot(times, ratios.min(axis=1), color="#1f3a7a", linewidth=1.8)
    axes.axhline(1, color="black", linewidth=0.6)
    axes.set_title(f"{name}: {ratios.min():.3f} to {ratios.max():.3f}")
    axes.set_xlabel("time in s")


def save(figure, file):
    """As PNG of few colours, which are enough and make a small file."""
    figure.tight_layout()
    figure.savefig(file, dpi=100)
    image = Image.open(file).convert("RGB")
    image.quantize(64, Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE).save(file, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=pathlib.Path, nargs=2, help="output folders of two runs")
    parser.add_argument("picture", type=pathlib.Path, help="PNG file to write")
    parser.add_argument("--names", nargs=2, default=("linear", "corotational"), help="what the runs are called")
    arguments = parser.parse_args()

    figure, both = matplotlib.pyplot.subplots(1, 2, figsize=(10, 4.2), sharex=True, sharey=True)
    for axes, folder, name in zip(both, arguments.folders, arguments.names):
        times, ratios = volumes(folder)
        draw(axes, times, ratios, name)
        print(f"{folder}: {ratios.shape[1]} cells, {len(times)} frames, "
              f"smallest {ratios.min():.4f}, largest {ratios.max():.4f}")
    both[0].set_ylabel("volume / volume at rest")
    save(figure, arguments.picture)


if __name__ == "__main__":
    main()
