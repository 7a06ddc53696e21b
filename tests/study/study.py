"""Studies: errors against known orders and exact values, rows of runs that fail, refusals, processes."""

import csv
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))


def write(name, **entries):
    """A study file; an entry's name is written with _ for blanks."""
    path = folder / f"{name}.prm"
    lines = [f"  set {entry.replace('_', ' ')} = {value}" for entry, value in entries.items()]
    path.write_text("\n".join(["subsection Study", *lines, "end", ""]))
    return path


def table(results):
    with open(results / "study.csv") as file:
        return list(csv.DictReader(file))


def study(name, ranks=1, arguments=(), **entries):
    """Runs a study that must succeed; gives its rows."""
    results = folder / f"{name}-{ranks}"
    status, _, error = runner.run(write(name, **entries), "--quiet", "--output", results, *arguments, ranks=ranks)
    runner.check(status == 0, f"{name}: exit status {status}: {error}")
    return table(results)


# Methods: a small bar that starts smoothly. The errors fall with the orders of the methods.
SMOOTH = ("Mesh/Box cubes = 1, 3, 1 | Start/Velocity = 0; 0; -0.14*(12-y)^2 | Loads/Gravity = 0, 0, 0 | "
          "Material/Mass = lumped | Time/Newton tolerance = 1e-12 | Solver/Tolerance = 1e-12 | Time/Step = 0.14 | Time/Steps = 1")
METHODS = ("backward euler: steps 0.14/1600, 0.14/3200; trbdf2: steps 0.14/100, 0.14/200; "
           "esdirk4: steps 0.14/80, 0.14/160; explicit3: steps 0.14/100, 0.14/200")
bar = dict(Scene=runner.BAR, Overrides=SMOOTH, Methods=METHODS, Quantities="final field, probes, energy, n28.uz",
           Reference="esdirk5: step 0.14/400", Repeats=1)
rows = study("orders", **bar)
for method, order in [("backward euler", 1), ("trbdf2", 2), ("esdirk4", 4), ("explicit3", 3)]:
    found = [float(row["order"]) for row in rows if row["method"] == method and row["order"]]
    runner.check(len(found) == 1 and abs(found[0] - order) < 0.15, f"{method}: orders {found}")
for row in rows:
    runner.check(row["status"] == "done" and float(row["seconds"]) > 0, f"{row}")
    for quantity in ["probes", "energy", "n28.uz"]:
        runner.check(0 < float(row["error_" + quantity]) < 10 * float(row["error_final_field"]) + 1e-4, f"{quantity}: {row}")
    front = [other for other in rows if float(other["error_final_field"]) <= float(row["error_final_field"])
             and float(other["seconds"]) <= float(row["seconds"]) and other is not row]
    runner.check((row["front"] == "1") == (not front), f"front: {row}")

results = folder / "orders-1"
words = (results / "study.md").read_text()
runner.check("its own error" in words and "0.1 % : " in words and "| backward euler | step 0.14/1600 |" in words, words)
runs = sorted(path.name for path in (results / "runs").iterdir())
runner.check(len(runs) == len(rows) and "trbdf2_step_0.14_100" in runs, f"{runs}")
history = runner.Results(results / "runs" / "trbdf2_step_0.14_100")
runner.check(len(history.history()) == 101 == len(history.probes()), "the history of a run")
for plot in ["work_precision", "convergence"]:
    script = (results / f"{plot}.gp").read_text()
    runner.check("explicit3" in script and "run time [s]" in script or plot == "convergence", script)
    for ending in ["svg", "png"]:
        runner.check((results / f"{plot}.{ending}").stat().st_size > 1000, f"{plot}.{ending}")

# Two processes give the same errors.
short = {**bar, "Methods": "backward euler: steps 0.14/10; esdirk4: tolerances 1e-3; explicit3: steps 0.14/50", "Reference": "trbdf2: step 0.14/20"}
for one, two in zip(study("short", **short), study("short", ranks=2, **short)):
    for column in one:
        if column.startswith("error"):
            one_error, two_error = float(one[column]), float(two[column])
            runner.check(abs(one_error - two_error) < 1e-4 * one_error + 1e-9, f"two processes: {one} {two}")

# Where there is no gnuplot the study says so and goes on. (MPI looks for ssh.)
(folder / "bin").mkdir()
(folder / "bin" / "ssh").symlink_to("/bin/true")
(folder / "bin" / "orted").symlink_to("/usr/bin/orted")
status, output, error = runner.run(folder / "short.prm", "--output", folder / "plain", "--set", "Study/Histories=false",
                                   path=str(folder / "bin"))
runner.check(status == 0 and "gnuplot-nox" in output, f"{status} {output} {error}")
runner.check(not (folder / "plain" / "runs").exists() and (folder / "plain" / "work_precision.gp").exists(), "files")

# Exact values: a body in free fall. Backward Euler falls too far by a step's part of the way, the midpoint rule falls right.
fall = dict(Scene=runner.BAR, Overrides="Constraints/Clamped boundaries = | Start/Velocity = 0; 0; 0 | Time/Steps = 10",
            Methods="backward euler: steps 0.07, 0.07/2; implicit midpoint: steps 0.07", Exact="n28.uz: -9.81/2*t^2", Repeats=0)
rows = study("fall", **fall)
for row, right in zip(rows, [0.1, 0.05, 0]):
    runner.check(abs(float(row["error_n28.uz"]) - right) < 1e-6, f"{row}")

# A run that fails stays, with its reason and what it got to; a run without any sense stays too.
late = "Loads/Body force = if(t > 0.3, 1/0, 0); 0; 0"
rows = study("failure", Scene=runner.BAR, Overrides="Time/Steps = 10 | Time/Retries = 0", Repeats=1, Reference="esdirk4: step 0.07/4",
             Methods=f"backward euler [Loads/Gravity = 0, 0, -999]: steps 0.7, 0.07; backward euler [{late}]: steps 0.07; ida order 1: tolerances 1e-2")
runner.check([row["status"].split(":")[0] for row in rows] == ["done", "done", "failed", "done"], f"{rows}")
runner.check("finite" in rows[2]["status"] and rows[2]["steps"] == "4" and rows[2]["error_probes"] == "", f"{rows[2]}")
runner.check(float(rows[0]["error_probes"]) > 1, f"{rows[0]}")
runner.check("failed: Step 5" in (folder / "failure-1" / "study.md").read_text(), "the failure is not in study.md")

# Methods on levels: the error in time is that of the study of one level, the error in space is the same for all runs of a
# level, and the whole error lies between their difference and their sum.
MESHES = "coarse [Mesh/Box cubes=1, 3, 1]; fine [Mesh/Box cubes=2, 6, 2]"
both = dict(Scene=runner.BAR, Overrides=SMOOTH + " | Probes/Points = tip: 4, 0, 4", Methods="backward euler: steps 0.14/50; esdirk4: steps 0.14/50",
            Quantities="tip.uz", Reference="esdirk5: step 0.14/400", Repeats=0)
rows = study("meshes", **both, Levels=MESHES, Reference_level="finest [Mesh/Box cubes=4, 12, 4]")
runner.check([row["level"] for row in rows] == ["coarse", "coarse", "fine", "fine"], f"{rows}")
for row in rows:
    whole, space, in_time = (float(row[name]) for name in ("error_tip.uz", "error_in_space", "error_in_time"))
    runner.check(0.99 * abs(space - in_time) < whole < 1.05 * (space + in_time) and in_time > 0, f"{row}")
    runner.check("order" not in row and int(row["cells"]) == (18 if row["level"] == "coarse" else 144), f"{row}")
runner.check(rows[0]["error_in_space"] == rows[1]["error_in_space"] and
             float(rows[2]["error_in_space"]) < 0.7 * float(rows[0]["error_in_space"]), f"{rows}")
one = study("one-mesh", **{**both, "Overrides": both["Overrides"].replace("1, 3, 1", "2, 6, 2")})
for with_levels, alone in zip(rows[2:], one):
    runner.check(abs(float(with_levels["error_in_time"]) / float(alone["error_tip.uz"]) - 1) < 0.05, f"{with_levels} {alone}")
words = (folder / "meshes-1" / "study.md").read_text()
runner.check("in space" in words and "The mesh of the reference has an error of its own" in words and "| coarse | esdirk4 | step 0.14/50 |" in words, words)

# Levels: a thick cylinder against Lame's solution, second order; and against a finer run.
CYLINDER = runner.ROOT / "parameters" / "validation" / "thick-cylinder.prm"


def cylinder(sectors, layers):
    return f"[Mesh/Cylinder sectors = {sectors} | Mesh/Cylinder layers = {layers} | Mesh/Cylinder height = {0.8 / layers}]"


lame = dict(Scene=CYLINDER, Repeats=0, Columns="inner: inner.ux; solves: summary solver/solves",
            Levels=f"0.25 {cylinder(16, 2)}; 0.125 {cylinder(32, 4)}; 0.0625 {cylinder(64, 8)}")
rows = study("lame", **lame, Exact="inner: 1.906667e-3")
orders = [float(row["order"]) for row in rows[1:]]
runner.check(all(abs(order - 2) < 0.3 for order in orders), f"orders {orders}")
runner.check([float(row["solves"]) for row in rows] == [1, 1, 1] and float(rows[2]["error_inner"]) < 0.012, f"{rows}")
rows = study("finer", **{**lame, "Levels": f"coarse {cylinder(16, 2)}; fine {cylinder(32, 4)}"},
             Reference=f"finer {cylinder(64, 8)}", Variants="linear [Corotation/Rotation = none]; polar [Corotation/Rotation = polar]")
runner.check([row["variant"] for row in rows] == ["linear", "linear", "polar", "polar"], f"{rows}")
runner.check(rows[0]["order"] == "" == rows[2]["order"] and float(rows[1]["order"]) > 1.5, f"{rows}")

# Cases: numbers of each, a verdict, and rows of those that are refused or fail.
rows = study("cases", Scene=runner.BAR, Overrides="Time/Steps = 20",
             Columns="sag: smallest n28.uz; rises: falls dissipated; inverted: largest inverted; f: frequency n28.uz; first: first time; "
                     "soon: at 0.07*2 n28.uz; never: at 99 n28.uz",
             Cases="plain []; at rest [Start/Velocity = 0; 0; 0]; locked [Material/Poisson ratio = 0.5]; "
                   f"broken [{late} | Time/Retries = 0]; swings [Time/Step = 0.007 | Time/Steps = 300 | Time/Method = esdirk4]",
             Right_if="sag < -1 && rises <= 2 && inverted == 0", Exact="first: 0", Repeats=0)
runner.check([row["verdict"] for row in rows] == ["right", "wrong", "refused", "failed", "right"], f"{rows}")
runner.check("less than 0.5" in rows[2]["status"] and rows[2]["sag"] == "", f"{rows[2]}")
runner.check(float(rows[1]["sag"]) > -0.3 and float(rows[3]["steps"]) == 4, f"{rows[1]} {rows[3]}")
second = runner.Results(folder / "cases-1" / "runs" / "plain").probes()[2]
runner.check(second["time"] == 0.14 and abs(float(rows[0]["soon"]) - second["n28.uz"]) < 1e-9, f"{rows[0]} {second}")
runner.check(rows[0]["never"] == "", f"{rows[0]}")
runner.check(1 < float(rows[4]["f"]) < 2 and float(rows[4]["error_first"]) == 0, f"{rows[4]}")

# A case's own condition, numbers of the row above, and runs that are wrong but warned of it.
moved = "[Start/Displacement = 0; 0; 1 | Time/Steps = 1 | Corotation/Rotation = %s]"
told = "sag > 99 or %swarning depend on the axes"
rows = study("conditions", Scene=runner.BAR, Overrides="Time/Steps = 1", Columns="sag: first n28.uz", Right_if="sag == 0", Repeats=0,
             Cases=f"plain []; moved {moved % 'polar'}; own {moved % 'polar'}: abs(sag - above_sag) < 1e-9; first []: above_sag == 1; "
                   f"warned {moved % 'gram-schmidt'}: {told % ''}; still {moved % 'gram-schmidt'}: {told % 'sag == 1 with '}; "
                   f"less {moved % 'gram-schmidt'}: {told % 'sag == 2 with '}; unwarned {moved % 'polar'}: {told % ''}")
verdicts = ["right", "wrong", "right", "right", "warned", "warned", "wrong", "wrong"]
runner.check([row["verdict"] for row in rows] == verdicts, f"{rows}")
words = (folder / "conditions-1" / "study.md").read_text()
runner.check(words.count("They depend on the axes") == 3 and "command line" not in words, words)
rows = study("unmoved", Scene=runner.BAR, Overrides="Time/Steps = 1", Columns="sag: first n28.uz", Repeats=0,
             Cases="lonely []: above_sag == 0; fine []: sag < 1", arguments=["--set", "Time/Steps=2"])
runner.check([row["verdict"] for row in rows] == ["wrong", "right"] and rows[0]["steps"] == "2", f"{rows}")
runner.check("Set on the command line: `Time/Steps=2`" in (folder / "unmoved-1" / "study.md").read_text(), "the command line")

# A check builds all and writes nothing.
status, output, error = runner.run("--check", folder / "cases.prm", "--output", folder / "checked")
runner.check(status == 0 and "locked: refused: " in output and "broken: can be run" in output, output + error)
runner.check(not (folder / "checked").exists(), "a check wrote something")

# What can be wrong.
right = dict(Scene=runner.BAR, Methods="trbdf2: steps 0.07", Reference="esdirk4: step 0.07")


def refused(*words, line=True, **entries):
    path = write("wrong", **{**right, **entries})
    status, output, error = runner.run(path, "--output", folder / "wrong")
    where = f"{entries}: exit status {status}\n{output}{error}"
    runner.check(status == 1 and output == "" and not (folder / "wrong").exists() and len(error) < 2000, where)
    for word in [*words, *(["wrong.prm:"] if line else [])]:
        runner.check(word in error, f"'{word}' is missing in {where}")


refused("a study needs a scene", Scene="")
refused("no such parameter file", Scene="no-such.prm")
refused("Study/Methods", "more than one", Cases="a []")
refused("Study/Methods", "none of", Methods="")
refused("Study/Methods", "neither", Reference="")
refused("Study/Methods", "not both", Exact="n28.uz: 0")
refused("wrong.prm:3", "Time/Method=trbdf3", "trbdf2", Methods="trbdf3: steps 0.07")
refused("steps", "tolerances", Methods="trbdf2: 0.07")
refused("steps", "tolerances", Methods="trbdf2")
refused("step 0.03 of trbdf2 does not divide the 7 s", "7/233 does", Methods="trbdf2: steps 0.07, 0.03")
refused("'-1'", "positive", Methods="trbdf2: steps -1")
refused("nonsense", Methods="trbdf2: steps nonsense")
refused("there twice", Methods="trbdf2: steps 0.07; trbdf2: steps 0.07")
refused("ida has variable steps", Methods="ida order 2: steps 0.07")
refused("Variable steps", "no error estimate", Methods="backward euler: tolerances 1e-2")
refused("name [Section/Entry=value", Methods="trbdf2 [Time/Step=1: steps 0.07")
refused("wrong.prm:3", "Time/Stop", Methods="trbdf2 [Time/Stop = 1]: steps 0.07")
refused("wrong.prm:5", "Material/Density=-1", "greater than 0", Overrides="Material/Density=-1")
refused("Study/Overrides", "Section/Entry=value", Overrides="nonsense", line=False)
refused("one method with one step", Reference="esdirk4: steps 0.07, 0.035")
refused("'height' is no column", "n28.ux", Quantities="height")
refused("follows no point", "Probes/Points", Overrides="Probes/Points =", line=False)
refused("'n0.u' is no column", Columns="a: n0.u")
refused("form", Columns="a: mean n0.ux")
refused("Study/Columns", "soon", Columns="a: at soon n0.ux")
refused("means something else", Columns="x: n0.ux")
refused("needs Columns", Right_if="a > 0")
refused("Right if", "b", Columns="a: n0.ux", Right_if="b > 0")
refused("wrong.prm:", "Study/Cases", "b", Methods="", Reference="", Columns="a: n0.ux", Cases="one []: b > 0")
refused("b", Columns="a: n0.ux", Right_if="a > 0 or b > 0 with warning depend")
refused("is no column", Exact="sag: 0", Reference="")
refused("levels need Columns", Methods="", Levels="1 []")
refused("cases need Columns", Methods="", Reference="", Cases="a []")
refused("is no name in Study/Columns", Methods="", Reference="", Cases="a []", Columns="a: n0.ux", Exact="b: 1")
refused("they go with Levels", Variants="a []")
refused("Reference level on which it is run", Levels="1 []")
refused("goes with Methods and Levels together", Reference_level="1 []")
refused("on another mesh there are other vertices", Levels="1 []", Reference_level="2 []", Quantities="final field")
refused("it must be one mesh", Levels="1 []", Reference_level="2 []; 3 []")
refused("one run, or two", Methods="", Levels="1 []", Columns="a: n0.ux", Reference="a []; b []; c []")
refused("static", Scene=runner.STATIC)
refused("Targets", Targets="none")
refused("Study", "Stop", Stop="1")

both = folder / "both.prm"
both.write_text(write("wrong", **right).read_text() + "\nsubsection Time\n  set Step = 1\nend\n")
status, _, error = runner.run(both)
runner.check(status == 1 and "both.prm:7: subsection Time beside Study" in error and "Overrides" in error, error)
status, _, error = runner.run(runner.BAR, "--set", "Study/Repeats=1")
runner.check(status == 1 and "Study" in error, error)

# Runs of a study begin anew, whatever the scene says of checkpoints: the second time the numbers are the same.
for _ in range(2):
    rows = study("anew", Scene=runner.BAR, Overrides="Time/Steps=4 | Checkpoint/Every=2 | Checkpoint/Resume=auto", Histories="true",
                 Cases="a []", Columns="begin: first time")
    runner.check(float(rows[0]["begin"]) == 0, f"{rows}")

# What is wrong with an entry of the command line is its fault, not that of the study; what changes nothing is refused.
levels = write("levels-of-time", Scene=runner.BAR, Levels="1 [Time/Step=0.07]; 2 [Time/Step = 0.035]", Columns="a: n0.ux", Exact="a: 1")
cases = write("some-cases", Scene=runner.BAR, Cases="a [Time/Step=0.07]; b []", Columns="a: n0.ux")
methods = write("methods", **right)
for path, setting, words in [
        (methods, "Time/Step=-1", 'supple: --set "Time/Step=-1": '),
        (methods, "Time/Stp=1", 'supple: --set "Time/Stp=1": there is no entry Time/Stp; did you mean'),
        (methods, "Time/Step=0.03", "supple: --set: Time/Step = 0.03 does not go with "),
        (methods, "Time/Method=ida", 'supple: --set "Time/Method=ida": it would change nothing'),
        (methods, "Probes/Points=", "supple: --set: Probes/Points = "),
        (methods, "Probes/Regions=a b", "supple: --set: Probes/Regions = a b: "),
        (methods, "Time/Problem=static", "(--set: Time/Problem = static)"),
        (methods, "Study/Reference=esdirk6: step 0.07", "supple: --set: Study/Reference: "),
        (levels, "Time/Step=0.01", 'supple: --set "Time/Step=0.01": it would change nothing'),
        (levels, "Probes/Points=", "supple: --set: Probes/Points = ")]:
    status, _, error = runner.run("--check", path, "--set", setting)
    runner.check(status == 1 and words in error, f"{setting}: {error}")
status, _, error = runner.run("--check", cases, "--set", "Time/Step=0.01")
runner.check(status == 0, error)
refused("'n28.uxx' is no column", "did you mean 'n28.ux'?", Quantities="n28.uxx")

# What is set on the command line goes to all runs; what is printed as parameters stays a scene.
rows = study("orders", arguments=["--set", "Study/Methods=trbdf2: steps 0.07/20", "--set", "Time/Steps=2", "--set", "Time/Step=0.007"],
             **bar | {"Reference": "esdirk4: step 0.007"})
runner.check(len(rows) == 1 and rows[0]["steps"] == "4", f"{rows}")
status, output, _ = runner.run("--print-parameters")
runner.check("#   set Right if" in output, "the entries of a study are not printed")
(folder / "printed.prm").write_text(output)
status, _, error = runner.run("--check", folder / "printed.prm")
runner.check(status == 0, error)

# Ctrl-C leaves the table of what was done.
path = write("long", Scene=runner.BAR, Repeats=1, Overrides="Time/Steps=10", Reference="trbdf2: step 0.07",
             Methods="backward euler: steps 0.7, 0.07, 0.07/10000000")
process = subprocess.Popen([runner.SUPPLE, str(path), "--output", str(folder / "long")], env=runner.ENVIRONMENT,
                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
while not (folder / "long" / "study.csv").exists() or len(table(folder / "long")) < 2:
    runner.check(process.poll() is None, "it ended by itself")
    time.sleep(0.05)
time.sleep(0.2)
os.kill(process.pid, signal.SIGINT)
_, error = process.communicate(timeout=60 * runner.PATIENCE)
runner.check(process.returncode == 2 and "after 2 of 3 runs" in error, f"{process.returncode} {error}")
runner.check(len(table(folder / "long")) == 2 and (folder / "long" / "study.md").exists(), "the table")

# A reference that fails ends the study.
status, _, error = runner.run(write("lost", **{**right, "Reference": f"esdirk4 [{late}]: step 0.07", "Overrides": "Time/Retries=0"}),
                              "--output", folder / "lost")
runner.check(status == 2 and "The reference" in error and "failed" in error, error)

# What does not move in the reference, nor in the run, has no error.
rows = study("still", **{**right, "Overrides": "Constraints/Clamped boundaries= | Motion/Of=all | Time/Steps=2"})
runner.check(rows and all(float(row["error_probes"]) == 0 for row in rows), f"{rows}")

# A study whose scene is refused leaves the tables of an earlier one as they are.
still = folder / "still-1"
earlier = {path: path.read_bytes() for path in still.iterdir() if path.is_file()}
for scene, words in [("Constraints/Clamped boundaries=9", "no boundary 9"), ("Start/Velocity=0; 0; -1e155", "too large")]:
    status, _, error = runner.run(write("still", **{**right, "Overrides": scene}), "--output", still)
    runner.check(status == 1 and words in error, f"{status} {error}")
    runner.check(earlier == {path: path.read_bytes() for path in still.iterdir() if path.is_file()}, f"{scene}: tables are changed")

# A study of which no run is done and right has failed; its table is complete.
for name, cases, words in [("all failed", "a [Loads/Gravity=1e308,0,0]; b [Loads/Gravity=0,1e308,0]", "None of the 2 runs"),
                           ("all refused", "a [Mesh/Box size=1, 1]", "refused"), ("one is done", "a [Loads/Gravity=1e308,0,0]; b", "")]:
    path = write(name.replace(" ", "-"), Scene=runner.BAR, Repeats=0, Overrides="Time/Steps=4", Cases=cases, Columns="w: n28.uz")
    status, _, error = runner.run(path, "--output", folder / name)
    runner.check(status == (2 if words else 0) and words in error, f"{name}: {status} {error}")
    runner.check(len(table(folder / name)) == cases.count(";") + 1, f"{name}: rows")
path = write("all-wrong", Scene=runner.BAR, Repeats=0, Overrides="Time/Steps=4", Cases="a; b", Columns="w: n28.uz", Right_if="w > 1000")
status, _, error = runner.run(path, "--output", folder / "all-wrong")
runner.check(status == 2 and "done and right" in error and "wrong" in error, f"{status} {error}")
