"""Space/Estimate error: what a run tells of its error in space, where it tells none and why, and that it costs nothing where
nobody asks."""

import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import vtu


def space(results):
    return results.summary().get("error_estimate", {}).get("space")


def closing_line(scene, settings):
    folder = tempfile.mkdtemp(prefix="supple-")
    status, output, error = runner.run(scene, "--output", folder, *runner.overrides(settings))
    runner.check(status == 0, error)
    return "\n".join(line for line in output.splitlines() if line.startswith("error: "))


# In words.
MOVED = {"Loads/Gravity": "0, 0, 0", "Motion/Of": "boundary 2", "Motion/Displacement": "0; free; 0.1*t"}
SHORT = {"Time/Steps": 20, "Output/Report": "false"}
THREE = r"error: in time more than \d+ % of the motion \(half and a quarter of the step, order \S+ where it should be 1\)"
for scene, settings, pattern in [
        (runner.STATIC, {}, r"error: in space about \d\d % of n56\.uz \(mesh\)"),
        (runner.STATIC, {"Probes/Points": ""}, r"error: in space about \d\d % of the work of the loads \(mesh\)"),
        (runner.STATIC, MOVED, r"error: in space more than 50 % of the forces that move it \(mesh\)"),
        (runner.STATIC, {**MOVED, "Mesh/Box cubes": "8, 24, 8"}, r"error: in space about \d\S* % of the forces that move it \(mesh\)"),
        (runner.STATIC, {"Mesh/Box cubes": "1, 12, 1"}, r"error: in space more than \d\d % of \S+ \(mesh; too few cells through the body\)"),
        (runner.STATIC, {"Mesh/Box cubes": "1, 1, 1", "Probes/Points": "tip: 2, 0, 2"}, r"error: in space unknown, for the body has too few cells for an estimate"),
        (runner.STATIC, {"Space/Estimate error": "never"}, ""),
        (runner.BAR, {**SHORT, "Time/Step": 0.0005}, r"error: in time about \d\S* % of the motion \(sum of local errors\), in space .*"),
        (runner.BAR, {**SHORT, "Time/Method": "sdirk2"}, r"error: in space a swing too quick by \d\d % \(mesh\)"),
        (runner.BAR, SHORT, r"error: in time perhaps more than 50 % of the motion \(sum of local errors\), in space a swing too quick by \d\d % \(mesh\)"),
        (runner.BAR, {**SHORT, "Time/Estimate error": "true"},
         THREE + r", in space a swing too quick by \d\d % \(mesh\)"),
        (runner.BAR, {**SHORT, "Time/Estimate error": "true", "Space/Estimate error": "never"}, THREE)]:
    line = closing_line(scene, settings)
    runner.check(re.fullmatch(pattern, line), f"{settings}: {line}")
for choice, words in [("end", "in space estimated at the end"), ("frames", "at each frame"), ("never", "in space not estimated")]:
    status, output, _ = runner.run("--check", runner.STATIC, "--set", f"Space/Estimate error={choice}")
    runner.check(status == 0 and words in output, output)

# In numbers.
static = space(runner.simulate(runner.STATIC, {}))
runner.check(abs(static["energy"]**2 / static["work"] - 1) < 1e-12 and static["time"] == 1, f"{static}")
runner.check(abs((1 + static["frequency"])**2 * (1 - static["work"]) - 1) < 1e-12, f"{static}")
runner.check(all(0.3 < static["probes"][f"{name}.uz"] < 0.5 for name in ("n0", "n28", "n56")), f"{static}")
runner.check(not any(name.startswith("clamp") for name in static["probes"]), f"the error of what is held: {static}")
moved = space(runner.simulate(runner.STATIC, {**MOVED, "Mesh/Box cubes": "8, 24, 8"}))
runner.check(abs(moved["forces"] + moved["work"] / (1 - 2 * moved["work"])) < 1e-12 and not any(name.endswith((".ux", ".uz")) for name in moved.get("probes", {})), f"{moved}")

# The same on several processes.
exact = {"Corotation/Rotation": "polar", "Solver/Tolerance": 1e-13, "Time/Newton tolerance": 1e-13, "Mesh/Layers": "6, 6",
         "Material/By id": "1: 5e7, 0.3, 1200"}
one = space(runner.simulate(runner.STATIC, exact))
for ranks in (2, 4):
    several = space(runner.simulate(runner.STATIC, exact, ranks=ranks))
    worst = max(abs(one[key] / several[key] - 1) for key in ("energy", "work", "frequency"))
    of_probes = max(abs(error / several["probes"][name] - 1) for name, error in one["probes"].items() if error is not None)
    print(f"{ranks} processes: energies within {worst:.1e}, probes within {of_probes:.1e}")
    runner.check(worst < 1e-10 and of_probes < 1e-10, f"{ranks} processes: {one} {several}")

# Cell by cell in the frames: the mean of the squares over the volume is that of the whole body.
for choice, n_without in [("frames", 1), ("end", None)]:
    results = runner.simulate(runner.BAR, {**SHORT, "Space/Estimate error": choice})
    fields = [vtu.Frame(file).of_cells.get("error_in_space") for file in sorted((results.folder / "solution").glob("*.vtu"))]
    runner.check(fields[-1] and sum(field is None for field in fields) == (n_without or len(fields) - 1), f"{choice}: frames without errors")
    mean = sum(error**2 for error in fields[-1]) / len(fields[-1])  # all cells are of one size
    runner.check(abs(mean / space(results)["energy"]**2 - 1) < 1e-5, f"{choice}: {mean} {space(results)}")
    header, *rows = (results.folder / "history.csv").read_text().splitlines()
    runner.check(header.endswith("seconds,space_error") == (choice == "frames"), header)
    if choice == "frames":
        told = [row.split(",")[-1] for row in rows]
        runner.check(told[0] == "" and sum(map(bool, told)) == len(fields) - 1, f"{told}")
        runner.check(abs(float(told[-1]) / space(results)["work"] - 1) < 1e-12, f"{told}")
    else:
        plain = results
never = runner.simulate(runner.BAR, {**SHORT, "Space/Estimate error": "never"})
runner.check(space(never) is None and never.probes() == plain.probes(), "an estimate nobody asked for, or another motion")
solves = [runner.simulate(runner.STATIC, {"Space/Estimate error": choice}).summary() for choice in ("never", "end")]
runner.check(all(summary["built"]["factorizations"] == 1 for summary in solves), "a linear scene is factored once")

# Where a number would mean nothing.
FLIGHT = {**SHORT, "Constraints/Clamped boundaries": "", "Loads/Gravity": "0, 0, 0"}
for scene, settings, words, probes in [
        (runner.BAR, {**FLIGHT, "Start/Velocity": "3; 0; 1"}, "no strain energy", 0),
        (runner.STATIC, {"Loads/Gravity": "0, 0, 0"}, "no strain energy", 0),
        (runner.BAR, {**FLIGHT, "Start/Velocity": "0; 0; 0", "Start/Displacement": "0; -1.5*y; 0", "Time/Step": 1e-6, "Time/Steps": 1}, "cells are inside out", 0),
        (runner.STATIC, {"Corotation/Rotation": "gram-schmidt"}, "no elastic energy", 0),
        (runner.STATIC, {"Loads/Nodal force": "0; 0; -5e5", "Loads/Nodal force on": "nearest to 2, 0, 2"}, "at a point", 2),
        (runner.STATIC, {**MOVED, "Motion/Of": "nearest to 2, 0, 2", "Motion/Displacement": "free; free; 0.1*t"}, "at a point", 2)]:
    results = runner.simulate(scene, settings)
    found = space(results)
    runner.check(words in found["unknown"] and "work" not in found and "energy" not in found, f"{settings}: {found}")
    runner.check(len([name for name in found.get("probes", {}) if name.endswith("uz")]) == probes, f"{settings}: {found}")

# Where a soft layer lies on a stiff one the traction jumps at the interface by what is wrong in the stiff one: that is no locking.
LAYERS = {"Mesh/Box size": "4, 1, 1", "Mesh/Box cubes": "16, 4, 4", "Mesh/Layers": "0.25, 0.75", "Material/Young modulus": 100, "Material/Poisson ratio": 0.42,
          "Material/By id": "1: 1e6, 0.3, 1000", "Constraints/Clamped boundaries": 0, "Loads/Gravity": "0, 0, 0", "Loads/Traction": "0; -1; 0",
          "Loads/Traction on": 2, "Probes/Points": "tip: 4, 0.5, 0.5", "Probes/Boundaries": ""}
told = space(runner.simulate(runner.STATIC, LAYERS))
runner.check("unknown" not in told and told.get("lock_ratio", 1) < 2 and 0.2 < told["probes"]["tip.uy"] < 0.5, f"two layers: {told}")
