"""The bar against an independent model at each of 100 steps: three vertices (metres) and the extremes of the cells'
volume ratio, to 1e-6. Data: data/bar, nine decimals."""

import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

rotation, solver = sys.argv[2:]
method = {"none": "linear", "gram-schmidt": "gs", "polar": "polar"}[rotation]

results = runner.simulate(runner.BAR, {"Start/Velocity": "0; 0; -20", "Corotation/Rotation": rotation,
                                       "Solver/Method": solver, "Solver/Tolerance": 1e-12,
                                       "Output/Frames": "none"})
probes, history = results.probes(), results.history()

n_compared = 0
motion = volume = 0.0
with open(runner.DATA / "bar" / "tip_f20.csv") as file:
    for row in csv.DictReader(file):
        if row["method"] == method:
            for direction in "xyz":
                found = probes[int(row["step"])][f"n{row['node']}.u{direction}"]
                motion = max(motion, abs(found - float(row["u" + direction])))
                n_compared += 1
with open(runner.DATA / "bar" / "volume_f20.csv") as file:
    for row in csv.DictReader(file):
        if row["method"] == method:
            now = history[int(row["step"])]
            volume = max(volume, abs(now["max_volume_ratio"] - float(row["vmax"])),
                         abs(now["min_volume_ratio"] - float(row["vmin"])))
            n_compared += 2

runner.check(n_compared == 100 * (9 + 2), f"{n_compared} numbers compared")
runner.check(motion <= 1e-6, f"a vertex is off by {motion} m")
runner.check(volume <= 1e-6, f"a volume ratio is off by {volume}")

# What the body had at the start is there, or was dissipated, or was done as work.
start = history[0]["total"]
balance = max(abs(row["total"] + row["dissipated"] - row["work"] - start) for row in history) / start
runner.check(balance <= 1e-10, f"energies are out of balance by {balance}")
if rotation != "gram-schmidt":
    rises = [row for row, last in zip(history[1:], history) if row["total"] > last["total"] + 1e-10 * start]
    runner.check(not rises, f"the total energy rises in {len(rises)} steps")
print(f"vertices within {motion:.1e} m, volume ratios within {volume:.1e}, energy balance {balance:.1e}")
