"""Two layers of skin from the shape of its surface: the thesis's tables, what is right instead, and bad input."""

import csv
import math
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

SKIN = runner.ROOT / "parameters" / "skin"
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))


def identify(file, settings={}, ranks=1):
    """Runs an identification that must succeed; gives its table, as numbers."""
    results = runner.Results(tempfile.mkdtemp(prefix="supple-"))
    status, _, error = runner.run(file, "--quiet", "--output", results.folder, *runner.overrides(settings), ranks=ranks)
    runner.check(status == 0, f"{file}: exit status {status}: {error}")
    return results, results.table("identification.csv")


def printed(table, set_number):
    """{(rows of squares, ratio): printed error}"""
    with open(runner.DATA / "skin_tables.csv") as file:
        return {(int(row["rows"]), float(row["ratio"])): row["error"] for row in csv.DictReader(file)
                if row["table"] == table and int(row["set"]) == set_number}


def half_unit(text):
    """Half a unit of the last printed digit."""
    return 0.5 * 10.0 ** -len(text.partition(".")[2])


# Tables 3.3 to 3.5 whole, 3.6 to 3.8 in their first rows (later ones depend on what came before).
first_rows = {"Identification/Thicknesses": "0.375, 0.75"}
for file, tables, n_rows, settings in [("tables-3.3.prm", ["3.3"], 6, {}), ("tables-3.4.prm", ["3.4", "3.5"], 6, {}),
                                       ("tables-3.6.prm", ["3.6"], 12, first_rows), ("tables-3.7.prm", ["3.7", "3.8"], 12, first_rows)]:
    results, rows = identify(SKIN / file, settings)
    computed = {(round(row["thickness"] * n_rows / 4.5), row["ratio"]): row for row in rows}
    for table in tables:
        n_compared = 0
        for set_number in 1, 2:
            for pair, text in printed(table, set_number).items():
                if pair not in computed:
                    continue
                n_compared += 1
                value = computed[pair][f"error_{set_number}"]
                runner.check(abs(value - float(text)) <= half_unit(text) * (1 + 1e-6),
                             f"table {table}, set {set_number}, {pair}: printed {text}, computed {value}")
        n_expected = {"3.3": 90, "3.4": 90, "3.5": 10, "3.6": 36, "3.7": 36, "3.8": 4}[table]
        runner.check(n_compared == n_expected, f"table {table}: {n_compared} pairs")
    for row in rows:
        runner.check(abs(row["sum"] - row["error_1"] - row["error_2"]) < 1e-8, f"sum: {row}")
        runner.check(row["maximum"] == max(row["error_1"], row["error_2"]), f"maximum: {row}")
        runner.check(abs(row["root_of_squares"] - math.hypot(row["error_1"], row["error_2"])) < 1e-8, f"root: {row}")
    names = {path.name for path in results.folder.iterdir()}
    for name in "errors_set_1", "errors_set_2", "errors_root_of_squares", "profiles":
        runner.check({name + ".gp", name + ".svg", name + ".png"} <= names, f"no {name} in {names}")
    report = (results.folder / "identification.md").read_text()
    runner.check("root of squares : " in report and report.count("| thickness |") == 3, report)
    runner.check(len(results.table("profiles.csv")) == 18 + 12, "profiles.csv")

# A mesh with mirror image: left and right are the same, and both together too; a converged needle meets the first point.
mirror = {"Mesh/Rectangle split": "alternating", "Identification/Depth correction": "converged",
          "Identification/Start depths": "", "Identification/Error": "rms",
          "Identification/Thicknesses": "0.75, 1.5", "Identification/Elasticity ratios": "5, 20"}
sides = {}
for side in "left", "right", "both":
    results, sides[side] = identify(SKIN / "tables-3.3.prm", {**mirror, "Identification/Side": side})
    for row in results.table("profiles.csv"):
        if row["distance"] == 0.25:
            meets = max(abs(value - row["measured"]) for name, value in row.items() if name.startswith("computed"))
            runner.check(meets < 1e-8, f"{side}: the first point is missed by {meets}")
for side in "left", "right":
    difference = runner.largest_difference(sides[side], sides["both"], list(sides["both"][0]))
    runner.check(difference < 1e-8, f"{side} differs from both by {difference}")
_, parallel = identify(SKIN / "tables-3.3.prm", {**mirror, "Identification/Side": "both"}, ranks=2)
difference = runner.largest_difference(sides["both"], parallel, list(parallel[0]))
runner.check(difference < 1e-7, f"one and two processes differ by {difference}")

# Made measurements: the surface of a known pair is found again, by the fit between the pairs of the grid too.
truth = {**mirror, "Identification/Overrides": "Mesh/Layer rows = 2, 4", "Identification/Side": "right"}
skin = runner.simulate(SKIN / "thesis.prm", {"Mesh/Layers": "0.0011, 0.0034", "Mesh/Layer rows": "2, 4", "Output/Frames": "none",
                                             "Mesh/Rectangle split": "alternating", "Motion/Displacement": "free; -0.0015*t; free",
                                             "Material/By id": "1: 12500, 0.48, 1000"})
made = folder / "made.csv"
surface = [row for row in skin.table("profile_skin.csv") if row["step"] == 1 and 0 < row["x"] < 0.0059]
made.write_text("set,distance,depth\n" + "".join(f"3,{row['x'] * 1e3:.12g},{row['depth'] * 1e3:.12g}\n" for row in surface))
fit = {**truth, "Identification/Measurements": made, "Identification/Fit": "true",
       "Identification/Thicknesses": "0.6, 1, 1.4", "Identification/Elasticity ratios": "5, 10, 20, 40"}
results, rows = identify(SKIN / "tables-3.3.prm", fit)
best = min(rows, key=lambda row: row["error_3"])
runner.check((best["thickness"], best["ratio"]) == (1, 20), f"{best}")
report = (results.folder / "identification.md").read_text()
line = next(line for line in report.splitlines() if "fit of set 3" in line)
thickness, ratio = float(line.split(" : ")[1].split(" mm and ")[0]), float(line.split(" mm and ")[1].split(",")[0])
runner.check(abs(thickness - 1.1) < 0.01 and abs(ratio - 16) < 0.3, line)

# Its range holds the best pair; a larger tolerance a larger range.
noisy = folder / "noisy.csv"
noisy.write_text("set,distance,depth\n" + "".join(
    f"3,{row['x'] * 1e3:.12g},{row['depth'] * 1e3 + 0.02 * (-1) ** i:.12g}\n" for i, row in enumerate(surface)))
extents = []
for tolerance in 0.05, 0.1, 0.2:
    results, rows = identify(SKIN / "tables-3.3.prm", {**fit, "Identification/Measurements": noisy,
                                                       "Identification/Fit tolerance": tolerance})
    line = next(line for line in (results.folder / "identification.md").read_text().splitlines() if "fit of set 3" in line)
    pair, extent = line.split(" : ")[1].split("; within")
    thickness, ratio = float(pair.split(" mm and ")[0]), float(pair.split(" mm and ")[1].split(",")[0])
    words = extent.replace(";", " ").split()
    low, high, soft, stiff = (float(words[i + 1]) for i, word in enumerate(words) if word in ("from", "to"))
    runner.check(low <= thickness * 1.01 and thickness <= high * 1.01 and soft <= ratio * 1.01 and ratio <= stiff * 1.01, line)
    runner.check(float(pair.split(", ")[1].split()[0]) <= min(row["error_3"] for row in rows) * 1.0001, f"{line}: worse than the grid")
    extents.append((high - low, stiff - soft))

    # An end that the search cut off says so.
    with open(results.folder / "fits.csv") as file:
        ends = [row for row in csv.DictReader(file) if row["pair"] != "best"]
    at = lambda number, bounds: any(abs(float(number) / bound - 1) < 1e-3 for bound in bounds)
    cut = [(at(row["thickness"], (0.6, 1.4)), at(row["ratio"], (5, 40))) for row in ends]
    words_of = {(False, False): "", (True, False): " (at the bound of the thickness)", (False, True): " (at the bound of the ratio)",
                (True, True): " (at the bounds of thickness and ratio)"}
    thin, thick, soft, hard = (words_of[pair] for pair in cut)
    pattern = rf"from [\d.]+{re.escape(thin)} to [\d.]+ mm{re.escape(thick)} and from [\d.]+{re.escape(soft)} to [\d.]+{re.escape(hard)}(;|$)"
    runner.check(re.search(pattern, line), f"{line} does not fit to {pattern}")

    # The error at each end of the range, computed anew: the best one and the tolerance, or less at a bound. Beside the end,
    # along the other coordinate, it is not less, and farther out it is more.
    with open(results.folder / "fits.csv") as file:
        points = {row["pair"]: {name: float(row[name]) for name in ("thickness", "ratio", "error")} for row in csv.DictReader(file)}
    best = points.pop("best")["error"]
    runner.check(sorted(points) == ["greatest ratio", "least ratio", "thickest", "thinnest"], f"{points}")
    n_inside = 0
    for name, point in points.items():
        sign = 1 if name in ("thickest", "greatest ratio") else -1
        along = name in ("thinnest", "thickest")                  # the thickness is at its end
        at_bound = any(abs(point["thickness" if along else "ratio"] / bound - 1) < 1e-3 for bound in ((0.6, 1.4) if along else (5, 40)))
        scales = [1 - 0.05, 1, 1 + 0.05]
        thicknesses = [point["thickness"] * s for s in ([1, 1 + 0.02 * sign] if along else scales)]
        ratios = [point["ratio"] * s for s in (scales if along else [1, 1 + 0.02 * sign])]
        _, near = identify(SKIN / "tables-3.3.prm", {**fit, "Identification/Measurements": noisy, "Identification/Fit": "false",
                                                     "Identification/Thicknesses": ", ".join(map(repr, sorted(thicknesses))),
                                                     "Identification/Elasticity ratios": ", ".join(map(repr, sorted(ratios)))})
        errors = {(round(row["thickness"], 6), round(row["ratio"], 5)): row["error_3"] for row in near}
        error_at = lambda thickness, ratio: errors[round(thickness, 6), round(ratio, 5)]
        here = error_at(point["thickness"], point["ratio"])
        runner.check(abs(here / point["error"] - 1) < 1e-6, f"{name}: {here} instead of {point}")
        if at_bound:
            runner.check(here <= (1 + tolerance) * best * 1.002, f"{name} at a bound: {here}, best {best}")
            continue
        n_inside += 1
        runner.check(abs(here / ((1 + tolerance) * best) - 1) < 0.002, f"{name}: {here / best} times the best, tolerance {tolerance}")
        beside = [error_at(t, r) for t in (thicknesses[:1] if along else thicknesses) for r in (ratios if along else ratios[:1])]
        runner.check(here <= min(beside) * 1.002, f"{name}: {beside} beside {here}")
        outside = [error_at(t, r) for t in (thicknesses[1:] if along else thicknesses) for r in (ratios if along else ratios[1:])]
        runner.check(min(outside) > here, f"{name}: {outside} outside of {here}")
    runner.check(n_inside >= 3 or tolerance > 0.1, f"{n_inside} ends inside the bounds: {points}")
runner.check(extents[0][0] < extents[1][0] < extents[2][0] and extents[0][1] < extents[1][1] < extents[2][1], f"{extents}")

# Interrupted or failed, it leaves what it has, with a note.
stopped = folder / "stopped"
process = subprocess.Popen([runner.SUPPLE, str(SKIN / "fit-plane-strain.prm"), "--output", str(stopped), "--quiet"],
                           env=runner.ENVIRONMENT, stderr=subprocess.PIPE, text=True)
while process.poll() is None and not (stopped / "identification.csv").exists():
    time.sleep(0.1)
time.sleep(2)
process.send_signal(signal.SIGINT)
_, error = process.communicate(timeout=100)
runner.check(process.returncode == 2 and "Interrupted after" in error, f"{process.returncode} {error}")
report = (stopped / "identification.md").read_text()
runner.check("**Not complete. Interrupted after" in report and "| thickness | 1.5 |" in report, report)
runner.check('"note":"Not complete. Interrupted after' in (stopped / "report.html").read_text(), "its page does not say so")
n_pairs = len(runner.Results(stopped).table("identification.csv"))
runner.check(f"after {n_pairs} pairs" in error, f"{n_pairs} {error}")
if n_pairs > 0:
    runner.check({"errors_set_1.svg", "profiles.png", "profiles.csv"} <= {path.name for path in stopped.iterdir()}, "no plots")

# What can be wrong, each told in one message with its place.
right = {"Scene": SKIN / "thesis.prm", "Measurements": SKIN / "fingertip.csv", "Thicknesses": "0.75, 1.5",
         "Elasticity ratios": "5, 10"}
n_refused = 0


def refused(*words, arguments=(), measurements=None, **entries):
    settings = {**right, **{name.replace("_", " "): value for name, value in entries.items()}}
    if measurements is not None:
        settings["Measurements"] = "wrong.csv"
        (folder / "wrong.csv").write_text(measurements)
    path = folder / "wrong.prm"
    path.write_text("subsection Identification\n" + "".join(f"set {name} = {value}\n" for name, value in settings.items()) + "end\n")
    global n_refused
    n_refused += 1
    how = ["--check"] if n_refused % 2 else []    # a run says the same
    status, output, error = runner.run(*how, path, "--output", folder / "out", *arguments)
    where = f"{entries} {measurements}: exit status {status}\n{output}{error}"
    runner.check(status == 1 and output == "" and not (folder / "out").exists() and len(error) < 1200, where)
    for word in words:
        runner.check(word in error, f"'{word}' is missing in {where}")


head = "set,distance,depth\n"
refused("wrong.prm:3", "no such file", Measurements="no-such.csv")
refused("needs measurements", Measurements="")
refused("wrong.csv:1", "set,distance,depth", measurements="1,0.25,1.8\n")
refused("wrong.csv:1", "no measurement", measurements=head)
refused("wrong.csv:3", "'deep'", "must be a number", measurements=head + "1,0.25,1.8\n1,0.5,deep\n")
refused("wrong.csv:3", "the depth is 30 mm", "4.5 mm high", measurements=head + "1,0.25,1.8\n1,0.5,30\n1,0.75,1\n")
refused("wrong.csv:3", "1 value(s)", measurements=head + "1,0.25,1.8\n1\n")
refused("wrong.csv:2", "found 5 values, the first line has 3", "decimals need a point", measurements=head + "1,0,25,1,8\n1,0,5,1,7\n")
refused("wrong.csv:1", "characters; at most 4000 are read", measurements="1," * 1200000)
refused("wrong.prm", "Identification/Side", "set Side = right", arguments=["--set", "Probes/Profile center=-0.006, 0, 0"])
refused("wrong.csv:3", "not nearer", "Sort", measurements=head + "1,0.5,1.8\n1,0.25,1.7\n1,0.75,1.6\n")
refused("wrong.csv:3", "-0.1", "negative", measurements=head + "1,0.25,1.8\n1,0.5,-0.1\n1,0.75,0.1\n")
refused("wrong.csv:2", "depth is 0 at the first point", measurements=head + "1,0.25,0\n1,0.5,0\n1,0.75,0\n")
refused("wrong.csv:3", "2 point(s)", "at least 3", measurements=head + "1,0.25,1.8\n1,0.5,1.7\n")
refused("wrong.csv:4", "7 mm", "outside the model", "6 mm to the left", measurements=head + "1,0.25,1.8\n1,0.5,1.7\n1,7,0.1\n")
refused("wrong.prm", "no set 3", Sets="1, 3")
refused("wrong.prm:4", "Mesh/Layers", "ends 0.0008 m below the top", "0.00075 m high", Thicknesses="0.75, 0.8")
refused("wrong.prm:4", "leaves nothing", Thicknesses="0.75, 4.5")
refused("wrong.prm:4", "ascend", Thicknesses="1.5, 0.75")
refused("wrong.prm:5", "ascend", Elasticity_ratios="10, 10")
refused("Elasticity ratios", "nothing is there", Elasticity_ratios="")
refused("wrong.prm:5", "greater than 0", Elasticity_ratios="0, 10")
refused("Start depths", "for each of the 2 sets", Depth_correction="thesis")
refused("wrong.prm:6", "needs none", Start_depths="1, 2")
refused("Fit", "Layer rows", Fit="true")
refused("Fit", "converged", Fit="true", Depth_correction="thesis", Start_depths="1, 1")
refused("Fit", "at least two", Fit="true", Thicknesses="0.75")
refused("Profile", "'nail'", Profile="nail")
refused("an identification needs a scene", Scene="")
refused("no such parameter file", Scene="no-such.prm")
refused("Corotation/Rotation", "proportional", arguments=["--set", "Corotation/Rotation=polar"])
for setting in ("Time/Steps=3", "Mesh/Layers=0.001, 0.0035"):
    refused(f'supple: --set "{setting}": it would change nothing', arguments=["--set", setting])
refused("Time/Problem", "static", arguments=["--set", "Time/Problem=dynamic"])
refused("Loads/Gravity", "needle alone", arguments=["--set", "Loads/Gravity=0, -9.81, 0"])
refused("Motion/Of", "outside the body", arguments=["--set", "Motion/Of=nearest to 0.02, 0, 0"])
for center, words in ("0.02, 0, 0", ["outside the body", "between x = -0.006 and 0.006"]), ("0, 0, 0.001", ["no vertices straight"]):
    refused("Probes/Profile center", *words, arguments=["--set", "Probes/Profile center=" + center])
refused("Mesh/Layer rows", "7 rows together", "6", arguments=["--set", "Mesh/Layer rows=3, 4"])
refused("Mesh/Layer rows", "one for each", arguments=["--set", "Mesh/Layer rows=6"])
refused("Mesh/Map", "inside out", arguments=["--set", "Mesh/Map=abs(x); y; z"])
refused("wrong.prm", "Stop", Stop="1")
status, _, error = runner.run(SKIN / "tables-3.3.prm", "--output", folder / "up", "--quiet", "--set", "Motion/Displacement=free; 0.001*t; free")
runner.check(status == 1 and "does not go down" in error, f"{status} {error}")
status, _, error = runner.run(SKIN / "tables-3.3.prm", "--output", folder / "beside", "--quiet", "--set", "Motion/Of=nearest to 0.003, 0, 0",
                              "--set", "Probes/Profile center=-0.006, 0, 0", "--set", "Identification/Side=right")
runner.check(status == 1 and "Probes/Profile center" in error and "x = 0.003" in error and "Motion/Displacement" not in error, f"{status} {error}")
status, _, error = runner.run(SKIN / "tables-3.3.prm", "--output", folder / "beside", "--quiet", "--set", "Motion/Of=nearest to 0.003, 0, 0",
                              "--set", "Identification/Thicknesses=0.75")
runner.check(status == 1 and "Probes/Profile center" in error and "more at x = 0.003" in error, f"{status} {error}")

# What spreadsheets write: a byte order mark, further columns, empty fields at the end.
lines = (SKIN / "fingertip.csv").read_text().splitlines()
plain, other = (folder / name for name in ("plain.csv", "other.csv"))
plain.write_text("\n".join(lines))
other.write_text("\n".join(["\ufeff" + lines[0] + ",remark"] + [line + (",good" if i % 2 else ",,") for i, line in enumerate(lines[1:])]), encoding="utf-8")
first, second = (identify(SKIN / "tables-3.3.prm", {"Identification/Measurements": path, "Identification/Thicknesses": "0.75"})[1]
                 for path in (plain, other))
runner.check(first == second, "the same measurements, as a spreadsheet writes them, give something else")
