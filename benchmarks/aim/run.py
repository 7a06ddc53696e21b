"""What an aim finds in eight scenes: the run, its error as told and as an independent reference measures it, seconds of search.

    scripts/run.sh --version && python3 benchmarks/aim/run.py [--aim "1 %"] [--scenes bar-small vein] [--mesh]

The reference is esdirk4 with a tolerance of 1e-7 (the search takes esdirk5), whose distance from the one with 1e-8 is told; with
--mesh the aim is about the mesh too, and the reference is a run with quadratic cells on twice as fine a mesh as was found. The
table goes into doc/studies.md by hand.
"""

import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SWING = "Time/Steps = 20"
LIFTED = "Start/Velocity = 0; 0; 0"
SCENES = {
    "bar-small": ("bar/small", [SWING]),
    "bar-large": ("bar/large", [SWING]),
    "soft-bar": ("bar/small", [SWING, "Material/Young modulus = 1e5", LIFTED]),
    "stiff-bar": ("bar/small", [SWING, "Material/Young modulus = 1e10", LIFTED, "Loads/Gravity = 0, 0, 0",
                                "Loads/Body force = 0; 0; -2e7*sin(pi*t/1.4)^2"]),
    "vein": ("vein/test-2", ["Probes/Points = v330: 0.003, 0, 0.00119"]),
    "pulse": ("vein/pulse", ["Time/Steps = 160"]),
    "needle": ("skin/needle-plane", ["Time/Problem = dynamic", "Time/Step = 0.005", "Time/Steps = 20",
                                     "Motion/Displacement = free; -0.0018*sin(pi*min(t, 0.1)/0.2)^2; free",
                                     "Probes/Points = needle: 0, 0, 0; beside: 0.0015, 0, 0"]),
    "mushroom": ("mushroom/mushroom", ["Time/Steps = 20"]),  # a mesh from a file
}
# Of these the error in space is told too.
MESHES = {
    "bar, static": ("bar/static", []),
    "bar, swings": ("bar/small-linear", [SWING, LIFTED, "Probes/Points = tip: 2, 0, 2"]),
    "cylinder": ("validation/thick-cylinder", []),
    "needle": ("skin/needle-axisymmetric", ["Probes/Points = beside: 0.0015, 0, 0"]),
}


def call(program, *arguments):
    result = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: {result.stderr}")
    return result.stdout


def found(text, pattern):
    match = re.search(pattern, text)
    return match[1] if match else "-"


def measured(program, folder, scene, settings, entries):
    """The error of a run in time, and that of its reference, as a study measures them."""
    method = entries.pop("Time/Method")
    tolerance = entries.get("Time/Relative tolerance")
    run = f"tolerances {tolerance}" if tolerance else f"steps {entries['Time/Step']}"
    study = folder / "study.prm"
    study.write_text(f"subsection Study\n  set Scene = {ROOT}/parameters/{scene}.prm\n  set Overrides = {' | '.join(settings)}\n"
                     f"  set Methods = {method}: {run}\n  set Reference = esdirk4: tolerance 1e-7\n"
                     "  set Quantities = probes\n  set Repeats = 0\nend\n")
    output = call(program, study, "--output", folder / "study")
    with open(folder / "study" / "study.csv") as file:
        row = next(csv.DictReader(file))
    return float(row["error_probes"]), found(output, r"its own error: (\S+ %)")


def in_time(arguments, name):
    scene, settings = SCENES[name]
    folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-aim-"))
    sets = [word for setting in settings for word in ("--set", setting.replace(" = ", "=", 1))]
    text = call(arguments.program, ROOT / "parameters" / f"{scene}.prm", "--aim", arguments.aim, *sets, "--output", folder / "aim")
    entries = dict(item.split("=", 1) for item in found(text, r"Entries for the scene: (.*)").split(" | "))
    error, known = measured(arguments.program, folder, scene, settings, entries)
    return [name, found(text, r"soonest: (.*), [0-9.e-]+ s,"), found(text, r"soonest: .*, ([0-9.e-]+) s,"),
            found(text, r"Error in time (\S+ %)"), f"{100 * error:.3g} % (to {known})",
            found(text, r"The search took ([^,.]*(?:\.\d+ \w+)?)"), found(text, r"of which the reference (.*)\.")]


def tip_of(program, scene, settings, probe_folder):
    sets = [word for setting in settings for word in ("--set", setting.replace(" = ", "=", 1))]
    call(program, ROOT / "parameters" / f"{scene}.prm", "--quiet", "--set", "Output/Frames=none", "--set", "Output/Report=false", *sets,
         "--output", probe_folder)
    points = re.search(r"set Points *= (.*)", (probe_folder / "parameters.prm").read_text())[1]
    names = re.findall(r"([^\s;:]+):", points)
    with open(probe_folder / "probes.csv") as file:
        return [{key: float(value) for key, value in row.items() if key.split(".")[0] in names} for row in csv.DictReader(file)]


def distance(run, right):
    """Of the displacements of all points at the end, over the largest motion."""
    columns = [key for key in right[0] if re.fullmatch(r".*\.u[xyz]", key)]
    size = max(abs(row[key]) for row in right for key in columns)
    return max(abs(run[-1][key] - right[-1][key]) for key in columns) / size


def with_mesh(arguments, name):
    scene, settings = MESHES[name]
    folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-aim-"))
    sets = [word for setting in settings for word in ("--set", setting.replace(" = ", "=", 1))]
    text = call(arguments.program, ROOT / "parameters" / f"{scene}.prm", "--aim", arguments.aim, "--set", "Study/Aim with mesh=true", *sets,
                "--output", folder / "aim")
    entries = found(text, r"(?s:.*)Entries for the scene: (.*)").split(" | ")
    finer = [re.sub(r"=(.*)", lambda counts: "=" + ", ".join(str(2 * int(n)) for n in counts[1].split(",")), entry)
             if entry.split("=")[0] in ("Mesh/Box cubes", "Mesh/Cylinder sectors", "Mesh/Cylinder layers", "Mesh/Rectangle squares") else entry for entry in entries]
    finer = [re.sub(r"rings=(\d+)", lambda n: f"rings={2 * (int(n[1]) - 1) + 1}", entry) for entry in finer]
    finer = [entry for entry in finer if not entry.startswith("Mesh/Order")] + ["Mesh/Order=2"]
    settings = [setting for setting in settings if setting.split(" = ")[0] not in {entry.split("=")[0] for entry in entries}]
    run = tip_of(arguments.program, scene, settings + entries, folder / "run")
    right = tip_of(arguments.program, scene, settings + finer, folder / "right")
    return [name, found(text, r"soonest: (.*?), \d+ cells"), found(text, r"(\d+) cells"), found(text, r"cells, (\S+) s"),
            found(text, r"Error in time (\S+ %)"), found(text, r"Error in space (\S+ %)"), f"{100 * distance(run, right):.3g} %",
            found(text, r"The search took ([^,.]*(?:\.\d+ \w+)?)")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build" / "supple", help="another build")
    parser.add_argument("--aim", default="1 %")
    parser.add_argument("--mesh", action="store_true", help="with the error of the mesh")
    parser.add_argument("--scenes", nargs="+")
    arguments = parser.parse_args()
    titles = (["scene", "soonest", "cells", "seconds", "in time", "in space, told", "at the end, measured", "search"] if arguments.mesh else
              ["scene", "soonest", "seconds", "error told", "measured", "search", "of it the reference"])
    print("| " + " | ".join(titles) + " |\n" + "|" + "---|" * len(titles))
    for name in arguments.scenes or (MESHES if arguments.mesh else SCENES):
        cells = with_mesh(arguments, name) if arguments.mesh else in_time(arguments, name)
        print("| " + " | ".join(map(str, cells)) + " |", flush=True)


if __name__ == "__main__":
    main()
