"""When frames are written. Every vertex of the bar is followed by a probe, so that no motion between frames can hide."""

import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

with open(runner.DATA / "bar" / "nodes.csv") as file:
    vertices = list(csv.reader(file))[1:]
everywhere = "; ".join(f"n{i}: {x}, {y}, {z}" for i, x, y, z in vertices)
diameter = math.sqrt(4**2 + 12**2 + 4**2)


def farthest(row, other):
    """The largest distance between a vertex's places in two rows of probes.csv."""
    return max(math.dist([row[f"n{v[0]}.u{d}"] for d in "xyz"], [other[f"n{v[0]}.u{d}"] for d in "xyz"])
               for v in vertices)


for fraction in [0.02, 0.1]:
    results = runner.simulate(runner.BAR, {"Output/Motion": fraction, "Probes/Points": everywhere})
    rows = results.probes()
    times = results.frame_times()
    shown = [i for i, row in enumerate(rows) if any(abs(row["time"] - time) < 1e-9 for time in times)]
    runner.check(shown[0] == 0 and shown[-1] == len(rows) - 1, "first and last state are not written")
    runner.check(len(shown) == len(times) < len(rows), f"{len(times)} frames of {len(rows)}")
    for begin, end in zip(shown, shown[1:]):
        for i in range(begin + 1, end):
            moved = farthest(rows[i], rows[begin])
            runner.check(moved <= fraction * diameter, f"step {i} has moved by {moved} m since the last frame")
    files = sorted(file.name for file in (results.folder / "solution").iterdir())
    runner.check(files == [f"frame_{i:04}.vtu" for i in range(len(times))], f"files {files}")
    print(f"motion {fraction}: {len(times)} frames of {len(rows)}")

rest = runner.simulate(runner.BAR, {"Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0"})
runner.check(len(rest.frame_times()) == 2, f"a body at rest has {len(rest.frame_times())} frames")

limit = runner.simulate(runner.BAR, {"Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0",
                                     "Output/Longest interval": 1.4})
runner.check(len(limit.frame_times()) == 6, f"longest interval: {limit.frame_times()}")

some = runner.simulate(runner.BAR, {"Output/Frames": "every", "Output/Every": 30})
runner.check([round(time / 0.07) for time in some.frame_times()] == [0, 30, 60, 90, 100], "every 30 steps")

spaced = runner.simulate(runner.BAR, {"Output/Frames": "interval", "Output/Interval": 1})
runner.check([round(time / 0.07) for time in spaced.frame_times()] == [0, 15, 29, 43, 58, 72, 86, 100],
             f"interval of 1 s: {spaced.frame_times()}")

none = runner.simulate(runner.BAR, {"Output/Frames": "none"})
runner.check(not (none.folder / "solution.pvd").exists() and not list((none.folder / "solution").glob("*")),
             "there are frames though none were wanted")
