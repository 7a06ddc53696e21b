"""Commands, exit statuses, files and columns a user's scripts rely on."""

import json
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

status, output, _ = runner.run("--version")
runner.check(status == 0 and output.startswith("supple "), "--version")
status, output, _ = runner.run("--help")
runner.check(status == 0 and "--print-parameters" in output and "Exit status" in output, "--help")

# Every entry is documented with unit and range.
status, output, _ = runner.run("--print-parameters", "json")
runner.check(status == 0, "--print-parameters json")


def entries(tree, path=""):
    for name, node in tree.items():
        if isinstance(node, dict) and "documentation" in node:
            yield path + name, node
        elif isinstance(node, dict):
            yield from entries(node, path + name + "/")


documented = dict(entries(json.loads(output)))
runner.check(len(documented) > 30, f"{len(documented)} entries")
for entry, node in documented.items():
    runner.check("Unit: " in node["documentation"] and "Range: " in node["documentation"],
                 f"{entry} says nothing of its unit or range")
status, output, _ = runner.run("--print-parameters")
runner.check(status == 0 and "set Young modulus" in output and "Unit: Pa" in output, "--print-parameters")

# A check runs nothing and writes nothing.
status, output, _ = runner.run("--check", runner.BAR, "--output", folder / "check")
runner.check(status == 0 and "192 tetrahedra" in output and not (folder / "check").exists(), "--check")

# Files and columns.
results = runner.simulate(runner.BAR, {})
names = sorted(path.name for path in results.folder.iterdir())
runner.check(names == ["history.csv", "parameters.prm", "probes.csv", "report.html", "solution", "solution.pvd", "summary.json"],
             f"files {names}")
header = (results.folder / "history.csv").read_text().splitlines()[0]
runner.check(header == "step,time,dt,kinetic,elastic,potential,dissipated,total,work,px,py,pz,lx,ly,lz,"
             "min_volume_ratio,max_volume_ratio,inverted,newton_iterations,linear_iterations,seconds", header)
header = (results.folder / "probes.csv").read_text().splitlines()[0]
runner.check(header.startswith("step,time,n0.ux,n0.uy,n0.uz,n0.vx,n0.vy,n0.vz,n0.fx,n0.fy,n0.fz,n28.ux"), header)
runner.check(len(results.history()) == 101 == len(results.probes()), "a row per step and one for the start")
frame = (results.folder / "solution" / "frame_0001.vtu").read_text(errors="replace")
for field in ["displacement", "velocity", "volume_ratio", "von_mises_stress", "rotation_angle", "material"]:
    runner.check(f'Name="{field}"' in frame, f"{field} is not in the VTU")

# The parameters as used run the same scene again.
again = runner.simulate(results.folder / "parameters.prm", {})
runner.check(runner.largest_difference(results.probes(), again.probes(), ["n28.uz", "clamp.fz"]) == 0, "parameters.prm")

# A second run into the same folder leaves nothing of the first.
status, _, _ = runner.run(runner.BAR, "--quiet", "--output", results.folder, "--set", "Output/Frames=none",
                          "--set", "Probes/Points=", "--set", "Probes/Boundaries=")
left = sorted(path.name for path in results.folder.rglob("*"))
runner.check(status == 0 and left == ["history.csv", "parameters.prm", "report.html", "solution", "summary.json"], f"left: {left}")

# --quiet says nothing; without a terminal there is no progress line.
status, output, error = runner.run(runner.BAR, "--quiet", "--output", folder / "quiet")
runner.check((status, output, error) == (0, "", ""), f"--quiet says {output}{error}")
status, output, _ = runner.run(runner.BAR, "--output", folder / "loud")
runner.check("done: 100 steps" in output and "\r" not in output, output)

# Where results go by default, and by the scene.
here = subprocess.run([runner.SUPPLE, str(runner.BAR), "--quiet"], env=runner.ENVIRONMENT, cwd=folder, timeout=100 * runner.PATIENCE)
runner.check(here.returncode == 0 and (folder / "output" / "large" / "summary.json").exists(), "output/large")
status, _, _ = runner.run(runner.BAR, "--quiet", "--set", f"Output/Folder={folder}/named")
runner.check(status == 0 and (folder / "named" / "summary.json").exists(), "Output/Folder")

# Ctrl-C, a queue, a terminal that is closed: exit status 2, and complete files up to the last step.
command = [runner.SUPPLE, str(runner.BAR), "--output", str(folder / "interrupted"), "--set", "Time/Steps=100000000",
           "--set", "Output/Frames=every"]
for sent in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU]:
    process = subprocess.Popen(command, env=runner.ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               text=True)
    while not (folder / "interrupted" / "solution" / "frame_0020.vtu").exists():
        runner.check(process.poll() is None, "it ended by itself")
        time.sleep(0.05)
    os.kill(process.pid, sent)
    _, error = process.communicate(timeout=60 * runner.PATIENCE)
    runner.check(process.returncode == 2 and "Interrupted after step" in error, f"{process.returncode} {error}")
    stopped = runner.Results(folder / "interrupted")
    summary = stopped.summary()
    runner.check(summary["status"] == "interrupted", summary["status"])
    runner.check(len(stopped.history()) == summary["steps"] + 1 == len(stopped.probes()), "rows")
    runner.check(len(stopped.frame_times()) == summary["built"]["frames"], "frames")
    (folder / "interrupted" / "solution" / "frame_0020.vtu").unlink()

# A failure: smaller steps are tried up to where no step helps; exit status 2, step and time named, complete files up to
# the last good step.
status, _, error = runner.run(runner.BAR, "--output", folder / "failed", "--set",
                              "Loads/Body force=if(t > 1, 1/0, 0); 0; 0")
runner.check(status == 2 and "from time 0.9999" in error and "finite" in error and "even in a step of" in error, error)
runner.check("terminate" not in error and len(error.splitlines()) == 1, error)
failed = runner.Results(folder / "failed")
rows = failed.history()
runner.check(abs(rows[14]["time"] - 0.98) < 1e-9 and rows[15]["dt"] < 0.02, "the step is not shortened")
runner.check(0.9999 < rows[-1]["time"] <= 1 and failed.frame_times()[-1] == rows[-1]["time"], "rows and frames")
runner.check(failed.summary()["status"].startswith(f"failed: Step {len(rows)} "), "status")
runner.check(failed.summary()["rejected_steps"] > 10, "steps were rejected")
status, _, error = runner.run(runner.BAR, "--output", folder / "failed", "--set", "Time/Retries=0", "--set",
                              "Loads/Body force=if(t > 1, 1/0, 0); 0; 0")
runner.check(status == 2 and "Step 15 (from time 0.98 on)" in error and "even" not in error, error)
runner.check("nan" not in (failed.folder / "history.csv").read_text(), "not-a-number in history.csv")

status, _, error = runner.run(runner.BAR, "--output", folder / "cg", "--set", "Solver/Method=cg-jacobi", "--set",
                              "Solver/Iterations=3", "--set", "Time/Retries=0")
runner.check(status == 2 and "Step 1 " in error and "3 iterations" in error, error)

status, _, error = runner.run(runner.BAR, "--output", folder / "newton", "--set", "Time/Problem=static", "--set",
                              "Time/Newton iterations=1", "--set", "Loads/Gravity=0, 0, -500", "--set",
                              "Start/Velocity=0; 0; 0", "--set", "Time/Steps=2")
runner.check(status == 2 and "out of balance" in error and "from load factor 0 on" in error, error)

status, _, error = runner.run(runner.STATIC, "--output", folder / "locked", "--set",
                              "Material/Poisson ratio=0.49999999999999")
runner.check(status == 2 and "too badly conditioned" in error, error)

# A disk that is full, or gone, in the middle of a run.
full = runner.BAR, "--output", folder / "gone", "--set", "Time/Steps=100000000", "--set", "Output/Frames=every"
process = subprocess.Popen([runner.SUPPLE, *map(str, full)], env=runner.ENVIRONMENT, stdout=subprocess.DEVNULL,
                           stderr=subprocess.PIPE, text=True)
while not (folder / "gone" / "solution" / "frame_0005.vtu").exists():
    runner.check(process.poll() is None, "it ended by itself")
    time.sleep(0.05)
(folder / "gone" / "solution").rename(folder / "elsewhere")
_, error = process.communicate(timeout=60 * runner.PATIENCE)
runner.check(process.returncode == 2 and "After step" in error and "can't be written" in error, error)
for frame in (folder / "elsewhere").glob("*.vtu"):
    runner.check(frame.read_bytes().rstrip().endswith(b"</VTKFile>"), f"{frame.name} is half written")

# Under nohup the end of the terminal ends nothing; nor does a reader of the screen that goes away.
command = ["nohup", runner.SUPPLE, str(runner.BAR), "--output", str(folder / "nohup"), "--set", "Time/Steps=2000"]
process = subprocess.Popen(command, env=runner.ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
while not (folder / "nohup" / "history.csv").exists():
    time.sleep(0.02)
process.send_signal(signal.SIGHUP)
_, error = process.communicate(timeout=60 * runner.PATIENCE)
runner.check(process.returncode == 0 and len(runner.Results(folder / "nohup").history()) == 2001, f"nohup: {process.returncode} {error}")
process = subprocess.Popen([runner.SUPPLE, str(runner.BAR), "--output", str(folder / "piped")], env=runner.ENVIRONMENT,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE)
process.stdout.readline()
process.stdout.close()
process.stderr.read()
runner.check(process.wait() == 0 and (folder / "piped" / "summary.json").exists(), f"| head -1: {process.returncode}")

# Of two runs in one folder the second is refused and touches nothing; what a dead run leaves behind keeps nobody out.
command = [runner.SUPPLE, str(runner.BAR), "--output", str(folder / "shared"), "--set", "Time/Steps=100000000"]
process = subprocess.Popen(command, env=runner.ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
while not (folder / "shared" / "history.csv").exists():
    time.sleep(0.02)
for arguments in [[], ["--set", "Checkpoint/Resume=auto"]]:
    status, _, error = runner.run(runner.BAR, "--output", folder / "shared", *arguments)
    runner.check(status == 1 and "Another run writes into the output folder" in error, f"{status} {error}")
rows = len((folder / "shared" / "history.csv").read_text().splitlines())
time.sleep(0.3)
runner.check(len((folder / "shared" / "history.csv").read_text().splitlines()) > rows, "the first run was disturbed")
process.kill()
process.wait()
status, _, error = runner.run(runner.BAR, "--quiet", "--output", folder / "shared")
runner.check(status == 0 and len(runner.Results(folder / "shared").history()) == 101, f"after a dead run: {status} {error}")
