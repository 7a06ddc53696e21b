"""The aim: a run whose error is below it, as an independent reference measures it; what can't be aimed at is refused."""

import csv
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
# A swing of a small bar, with lumped mass, so that explicit methods may win.
SWING = {"Mesh/Box cubes": "1, 3, 1", "Material/Mass": "lumped", "Time/Steps": 10, "Output/Frames": "none"}


def found(name, aim, settings, ranks=1, **more):
    """The entries that the search gives, and the error it tells."""
    results = folder / name
    words = [word for entry, value in more.items() for word in ("--set", f"Study/{entry.replace('_', ' ')}={value}")]
    status, output, error = runner.run(runner.BAR, "--aim", aim, *words, "--output", results, *runner.overrides(settings), ranks=ranks)
    runner.check(status == 0, f"{name}: exit status {status}: {error}")
    entries = re.search(r"Entries for the scene: (.*)", output)
    told = re.search(r"Error in time ([0-9.e-]+) %", output)
    for text in ("soonest: ", "Half the error takes", "The search took", "The error in space is not part of the aim"):
        runner.check(text in output, f"{name}: '{text}' is missing in {output}")
    runner.check(entries and told, output)
    with open(results / "study.csv") as file:
        rows = list(csv.DictReader(file))
    runner.check(len(rows) > 2 and (results / "study.md").exists() and (results / "report.html").exists(), f"{name}: {rows}")
    return dict(text.split("=", 1) for text in entries[1].split(" | ")), float(told[1]), rows


def error_of(settings, reference):
    """Of the displacement of the tip over time, over its largest."""
    run, right = runner.simulate(runner.BAR, settings).probes(), runner.simulate(runner.BAR, reference).probes()
    times = {row["time"]: row for row in right}
    size = max(abs(row["n28.uz"]) for row in right)
    last = max(times)
    at_end = abs(run[-1]["n28.uz"] - times[last]["n28.uz"])
    runner.check(abs(run[-1]["time"] - last) < 1e-9, "the runs end together")
    return at_end / size


FINE = {**SWING, "Time/Method": "esdirk4", "Time/Step": 0.07 / 200, "Time/Steps": 2000, "Time/Newton tolerance": 1e-10}
for name, aim in [("coarse", 5), ("fine", 0.1)]:
    entries, told, rows = found(name, f"{aim} %", SWING)
    true = 100 * error_of({**SWING, **entries}, FINE)
    print(f"{name}: {entries}, told {told} %, at the end {true} %")
    runner.check(told <= aim, f"{name}: it tells {told} %")
    runner.check(true <= aim, f"{name}: its error is {true} %")
    runner.check(any(row["status"] == "done" and row["front"] == "1" for row in rows), f"{rows}")

# Of a column, and with methods that are named.
entries, told, rows = found("named", "1 %", SWING, Aim_of="n28.uz", Methods="esdirk4; trbdf2")
runner.check(entries["Time/Method"] in ("esdirk4", "trbdf2"), f"{entries}")
runner.check({row["method"] for row in rows} <= {"esdirk4", "trbdf2"} and "error_n28.uz" in rows[0], f"{rows}")
# A study file says the same.
study = folder / "study.prm"
study.write_text(f"subsection Study\n  set Scene = {runner.BAR}\n  set Aim = 2 %\n  set Methods = imex4\n"
                 "  set Overrides = Mesh/Box cubes = 1, 3, 1 | Time/Steps = 10\nend\n")
status, output, error = runner.run(study, "--output", folder / "file")
runner.check(status == 0 and "2 % soonest: imex4" in output, f"{status} {output} {error}")
status, output, error = runner.run("--check", study)
runner.check(status == 0 and "imex4, fixed steps" in output, f"{status} {output} {error}")

# With the mesh: of a static scene, whose tip goes to -0.20637 m on a very fine mesh, and of one in motion.
def of_mesh(name, scene, aim, *settings):
    status, output, error = runner.run(scene, "--aim", aim, *settings, "--output", folder / name)
    runner.check(status == 0, f"{name}: exit status {status}: {error}")
    told = float(re.search(r"Error in space ([0-9.e-]+) %", output)[1])
    entries = re.search(r"Entries for the scene: (.*)", output)[1]
    meshes = folder / name / "meshes" # of a static scene there is nothing else
    with open((meshes if meshes.exists() else folder / name) / "study.csv") as file:
        rows = list(csv.DictReader(file))
    runner.check({row["level"][:6] for row in rows} == {"linear", "quadra"}, f"{name}: {rows}")
    return dict(text.split("=", 1) for text in entries.split(" | ")), told


entries, told = of_mesh("mesh", runner.STATIC, "5 %")
true = 100 * abs(runner.simulate(runner.STATIC, entries).probes()[-1]["n28.uz"] / -0.20637 - 1)
print(f"static: {entries}, told {told} %, true {true:.2f} %")
runner.check(told <= 5 and true <= 5, f"static: told {told} %, true {true} %")
CALM = ["--set", "Study/Aim with mesh=true", "--set", "Time/Steps=10", "--set", "Corotation/Rotation=none", "--set", "Start/Velocity=0; 0; 0"]
entries, told = of_mesh("mesh in motion", runner.BAR, "30 %", "--set", "Study/Methods=trbdf2; esdirk4", *CALM)
runner.check(entries["Time/Method"] in ("trbdf2", "esdirk4") and "Mesh/Box cubes" in entries and told < 30, f"in motion: {entries}, told {told} %")
fine = {**SWING, "Time/Steps": 10, "Corotation/Rotation": "none", "Start/Velocity": "0; 0; 0", "Material/Mass": "consistent"}
run = runner.simulate(runner.BAR, {**fine, **entries}).probes()
right = runner.simulate(runner.BAR, {**fine, "Mesh/Order": 2, "Mesh/Box cubes": "4, 16, 4", "Time/Method": "esdirk4", "Time/Steps": 40, "Time/Step": 0.07 / 4}).probes()
true = 100 * abs(run[-1]["n28.uz"] - right[-1]["n28.uz"]) / max(abs(row["n28.uz"]) for row in right)
print(f"in motion: {entries}, told {told} %, at the end {true:.2f} %")
runner.check(true <= 30, f"in motion: {true} %")

# Where nothing moves there is no error.
for name, arguments in [("rest", [runner.STATIC, "--set", "Loads/Gravity=0, 0, 0"]),
                        ("rest in motion", [runner.BAR, "--set", "Loads/Gravity=0, 0, 0", "--set", "Start/Velocity=0; 0; 0", "--set", "Time/Steps=10"])]:
    status, output, error = runner.run(*arguments, "--aim", "1 %", "--output", folder / name)
    runner.check(status == 2 and "nothing moves" in error, f"{name}: {status} {output} {error}")

# What is no aim, or none of a run in motion.
for words, arguments in [
        (["percentage", "0.01"], [runner.BAR, "--aim", "0.01"]),
        (["percentage"], [runner.BAR, "--aim", "-1 %"]),
        (["percentage"], [runner.BAR, "--aim", "80 %"]),
        (["--aim", "must follow"], [runner.BAR, "--aim"]),
        (["n29.uz", "n28.uz"], [runner.BAR, "--aim", "1 %", "--set", "Study/Aim of=n29.uz"]),
        (["Aim of", "without an Aim"], [study, "--set", "Study/Aim=", "--set", "Study/Aim of=n28.uz"]),
        (["static", "no methods"], [runner.STATIC, "--aim", "1 %", "--set", "Study/Methods=imex4"]),
        (["Mesh/Refine", "Space/Aim"], [runner.STATIC, "--aim", "1 %", "--set", "Space/Aim=0.01"]),
        (["tells of the computation"], [runner.STATIC, "--aim", "1 %", "--set", "Study/Aim of=seconds"]),
        (["follows no point"], [runner.STATIC, "--aim", "1 %", "--set", "Probes/Points="]),
        (["another mesh"], [runner.BAR, "--aim", "1 %", "--set", "Study/Aim with mesh=true", "--set", "Study/Aim of=final field"]),
        (["without an Aim"], [study, "--set", "Study/Aim=", "--set", "Study/Aim with mesh=true"]),
        (["steps 0.1", "methods alone"], [study, "--set", "Study/Methods=imex4: steps 0.1"]),
        (["Reference", "Aim"], [study, "--set", "Study/Reference=esdirk5: step 0.01"]),
        (["Method"], [study, "--set", "Study/Methods=imex9"])]:
    status, output, error = runner.run(*arguments, "--output", folder / "refused")
    print(error.strip())
    runner.check(status == 1 and all(word in error for word in words), f"{arguments[1:]}: {status} {error}")
    runner.check(not (folder / "refused").exists(), f"{arguments[1:]}: something was written")
