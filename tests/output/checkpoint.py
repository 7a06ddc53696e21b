"""A run that was stopped, or killed at any moment, goes on as if nothing had happened."""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import vtu

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
ALWAYS = {"Solver/Tolerance": 1e-12, "Output/Motion": 0.05, "Checkpoint/Every": 7, "Checkpoint/Resume": "auto"}


def mesh_scene(where, materials, inner=0.25, boundary=7, unused=0):
    """A scene with a mesh file: a tetrahedron about a vertex inside, cut into four, two of each material, after some vertices
    that no cell has."""
    where.mkdir(exist_ok=True)
    vertices = [(9, 9, i) for i in range(unused)] + [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (inner, 0.25, 0.25)]
    cells = [(5, 2, 3, 4), (1, 5, 3, 4), (1, 2, 5, 4), (1, 2, 3, 5)]
    elements = [(4, materials[i // 2], *cell) for i, cell in enumerate(cells)] + [(2, boundary, 2, 3, 4)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", len(vertices),
             *[f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(vertices, 1)]]
    lines += ["$EndNodes", "$Elements", 5, *[f"{i} {kind} 2 {tag} {tag} {' '.join(str(unused + v) for v in nodes)}"
                                             for i, (kind, tag, *nodes) in enumerate(elements, 1)], "$EndElements"]
    (where / "body.msh").write_text("\n".join(map(str, lines)) + "\n")
    scene = where / "scene.prm"
    scene.write_text("# a mesh file\nsubsection Mesh\n  set Shape = file\n  set File = body.msh\nend\n"
                     "subsection Material\n  set By id = 2: 1e7, 0.3, 1000\nend\n"
                     "subsection Constraints\n  set Clamped region = z < 1e-9\nend\n"
                     "subsection Loads\n  set Gravity = 0, 0, -10\nend\n")
    return scene


def largest_difference(whole, parts):
    """Of two tables; displacements, velocities and forces of probes are each measured by their largest component."""
    runner.check(len(whole) == len(parts), f"{len(whole)} and {len(parts)} rows")
    columns = [name for name in whole[0] if not name.endswith(("seconds", "iterations"))]
    quantity = {name: name[:-1] if "." in name else name for name in columns}
    size = {}
    for name in columns:
        largest = max(abs(row[name]) for row in whole)
        size[quantity[name]] = max(largest, size.get(quantity[name], 1e-9))
    return max(abs(a[name] - b[name]) / size[quantity[name]] for a, b in zip(whole, parts) for name in columns)


def compare(whole, parts, what, tolerance=1e-12):
    """Every row of the tables, the times of the frames."""
    for table in ("history.csv", "probes.csv"):
        difference = largest_difference(whole.table(table), parts.table(table))
        runner.check(difference <= tolerance, f"{what}: {table} differs by {difference}")
    runner.check(whole.frame_times() == parts.frame_times(), f"{what}: frames")
    for frame in range(len(whole.frame_times())):
        runner.check(any((parts.folder / "solution").glob(f"frame_{frame:04}.*vtu")), f"{what}: a frame is missing")


def run(name, settings, ranks=1):
    status, _, error = runner.run(runner.BAR, "--quiet", "--output", folder / name, *runner.overrides(settings), ranks=ranks)
    return status, error


# Stopped by its own end, then made longer: with all that is kept over steps.
cases = {"polar": {}, "linear": {"Corotation/Rotation": "none"},
         "moved": {"Motion/Of": "region y == 0", "Motion/Displacement": "free; free; 2*sin(3*t)", "Start/Velocity": "0; 0; 0",
                   "Damping/Stiffness factor": 0.002, "Damping/Mass factor": 0.1},
         "trbdf2": {"Time/Method": "trbdf2", "Time/Step": 0.01, "Time/Newton tolerance": 1e-13},
         "kept": {"Corotation/Warp tolerance": 0.5},
         "kept multigrid": {"Corotation/Warp tolerance": 3, "Solver/Method": "cg-amg", "Mesh/Box cubes": "4, 8, 4"}, "multigrid": {"Solver/Method": "cg-amg", "Mesh/Box cubes": "4, 8, 4"},
         "static": {"Time/Problem": "static", "Start/Velocity": "0; 0; 0"},
         "midpoint": {"Time/Method": "implicit midpoint", "Time/Step": 0.01},
         "trbdf2 moved": {"Time/Method": "trbdf2", "Time/Step": 0.01, "Motion/Of": "region y == 0",
                          "Motion/Displacement": "free; free; 2*sin(3*t)", "Start/Velocity": "0; 0; 0"},
         "variable": {"Time/Method": "trbdf2", "Time/Variable steps": "true", "Time/Step": 0.01, "Time/Relative tolerance": 1e-3,
                      "Time/Steps": 20},
         "imex": {"Time/Method": "imex4", "Time/Step": 0.01, "Time/Renewal angle": 5},
         "imex variable": {"Time/Method": "imex5", "Time/Variable steps": "true", "Time/Step": 0.01, "Time/Relative tolerance": 1e-3,
                           "Time/Steps": 20, "Time/Renewal angle": 5},
         "explicit": {"Time/Method": "explicit4", "Time/Variable steps": "true", "Time/Step": 0.002, "Material/Mass": "lumped", "Time/Steps": 20},
         "ida": {"Time/Method": "ida", "Time/Step": 0.005, "Time/Relative tolerance": 1e-3, "Time/Steps": 20}}
SIGNALS = {"kept": [signal.SIGTERM, signal.SIGKILL]}     # of the others, chance takes one
for name, case, how in [(name, case, how) for name, case in cases.items()
                        for how in SIGNALS.get(name, [random.choice([signal.SIGTERM, signal.SIGKILL])])]:
    shutil.rmtree(folder / name, ignore_errors=True)
    settings = {**ALWAYS, "Time/Steps": 40, **case}
    whole = runner.simulate(runner.BAR, {**settings, "Checkpoint/Resume": "never", "Checkpoint/Every": 0})
    often = runner.simulate(runner.BAR, {**settings, "Checkpoint/Resume": "never", "Checkpoint/Every": 5})
    compare(whole, often, f"{name}, a checkpoint after each fifth step", 0)
    parts = {**settings, "Output/Folder": "elsewhere"}
    process = subprocess.Popen([runner.SUPPLE, str(runner.BAR), "--quiet", "--output", str(folder / name),
                                *runner.overrides({**settings, "Output/Frames": "adaptive"})],
                               env=runner.ENVIRONMENT, stderr=subprocess.DEVNULL)
    history = folder / name / "history.csv"
    while process.poll() is None and not (history.exists() and history.read_text().count("\n") > 12):
        time.sleep(0.002)
    process.send_signal(how)
    process.wait()
    for ranks in [2 if name == "polar" else 1, 1]:
        status, error = run(name, parts, ranks)
        runner.check(status == 0, error)
    compare(whole, runner.Results(folder / name), name, 1e-8 if name == "polar" else 1e-12)

# kill -9 at random instants, several times in one run.
settings = {**ALWAYS, "Time/Steps": 16000, "Output/Frames": "interval", "Output/Interval": 28}
whole = runner.simulate(runner.BAR, {**settings, "Checkpoint/Resume": "never"})
kills = 0


def rows():
    history = folder / "killed" / "history.csv"
    return history.read_text().count("\n") if history.exists() else 0


for kills in range(1, 11):
    process = subprocess.Popen([runner.SUPPLE, str(runner.BAR), "--quiet", "--output", str(folder / "killed"),
                                *runner.overrides(settings)], env=runner.ENVIRONMENT, start_new_session=True)
    smallest = None    # a run that goes on first cuts what was written after its checkpoint
    deadline = time.monotonic() + 60 * runner.PATIENCE
    while time.monotonic() < deadline and process.poll() is None:
        now = rows()
        smallest = now if smallest is None or now < smallest else smallest
        if now > smallest + 15:
            break
        time.sleep(0.001)
    grown = process.poll() is None and rows() > smallest
    time.sleep(random.uniform(0, 0.05))
    alive = process.poll() is None
    os.killpg(process.pid, signal.SIGKILL) if alive else None
    process.wait()
    runner.check(grown and alive, f"kill {kills}: the run had made no step, or had ended")
status, error = run("killed", settings)
runner.check(status == 0, error)
compare(whole, runner.Results(folder / "killed"), f"killed {kills} times")
print(f"killed {kills} times")

# The same while each step writes a frame: those that are there are whole, and in the end they are those of a run that was not
# killed, byte for byte.
settings = {**ALWAYS, "Time/Steps": 200, "Output/Frames": "every"}
whole = runner.simulate(runner.BAR, {**settings, "Checkpoint/Resume": "never"})
solution = folder / "drawn" / "solution"


def n_frames():
    return len(list(solution.glob("*.vtu"))) if solution.exists() else 0


for kills in range(1, 6):
    before = max(0, n_frames() - 14)
    process = subprocess.Popen([runner.SUPPLE, str(runner.BAR), "--quiet", "--output", str(folder / "drawn"),
                                *runner.overrides(settings)], env=runner.ENVIRONMENT)
    while process.poll() is None and n_frames() < before + 35:
        time.sleep(0.002)
    process.kill()
    process.wait()
    for file in solution.glob("*.vtu"):
        vtu.Frame(file)
status, error = run("drawn", settings)
runner.check(status == 0, error)
for file in [whole.folder / "solution.pvd", *(whole.folder / "solution").iterdir()]:
    drawn = folder / "drawn" / file.relative_to(whole.folder)
    runner.check(file.read_bytes() == drawn.read_bytes(), f"{file.name} is not that of the run that was not killed")
names = [sorted(file.name for file in results.iterdir()) for results in (whole.folder / "solution", solution)]
runner.check(names[0] == names[1], f"files {names[1]}")

# What does not fit is refused and left as it is.
file = folder / "polar" / "checkpoint.cbor"
good = file.read_bytes()
status, error = run("polar", {**ALWAYS, "Time/Steps": 60, "Material/Young modulus": 2e8})
runner.check(status == 1 and "another scene" in error and "Young modulus" in error, error)
runner.check(file.read_bytes() == good, "the checkpoint was touched")

# The mesh file may have been exchanged: another material of a cell, a vertex that has moved within the body, an id of a face.
swapped = mesh_scene(folder / "mesh", materials=(1, 2))
settings = {"Checkpoint/Every": 2, "Checkpoint/Resume": "auto"}
runs = ["--quiet", "--output", str(folder / "mesh" / "output")]
status, _, error = runner.run(swapped, *runs, *runner.overrides({**settings, "Time/Steps": 4}))
runner.check(status == 0, error)
for what, changes in [("materials", {"materials": (2, 1)}), ("vertices", {"inner": 0.3}), ("ids", {"boundary": 8})]:
    mesh_scene(folder / "mesh", **{"materials": (1, 2), **changes})
    status, _, error = runner.run(swapped, *runs, *runner.overrides({**settings, "Time/Steps": 8}))
    runner.check(status == 1 and "another scene" in error and "checksum" in error, f"{what}: exit status {status}, {error}")
mesh_scene(folder / "mesh", materials=(1, 2))
for ranks in (1, 2):
    status, _, error = runner.run(swapped, *runs, *runner.overrides({**settings, "Time/Steps": 8 * ranks}), ranks=ranks)
    runner.check(status == 0, error)

# Vertices that no cell has count in the indices by which a checkpoint knows the others.
lone = mesh_scene(folder / "lone", materials=(1, 2), unused=30000)
status, _, error = runner.run(lone, "--quiet", "--output", folder / "lone" / "whole", *runner.overrides({"Time/Steps": 8}))
runner.check(status == 0, error)
for steps in (4, 8):
    status, _, error = runner.run(lone, "--quiet", "--output", folder / "lone" / "parts",
                                  *runner.overrides({**settings, "Time/Steps": steps}))
    runner.check(status == 0, error)
difference = largest_difference(*[runner.Results(folder / "lone" / name).history() for name in ("whole", "parts")])
runner.check(difference <= 1e-12, f"after lone vertices: {difference}")

file.write_bytes(good[:1000] + b"x" + good[1001:])
status, error = run("polar", {**ALWAYS, "Time/Steps": 60})
runner.check(status == 0, f"the one before is whole: {error}")
warnings = runner.Results(folder / "polar").summary()["warnings"]
runner.check(any("checkpoint.previous.cbor; checkpoint.cbor is damaged" in text for text in warnings), str(warnings))
for name in ("checkpoint.cbor", "checkpoint.previous.cbor"):
    (folder / "polar" / name).write_bytes(b"supple checkpoint 1\n12\nxyz")
status, error = run("polar", {**ALWAYS, "Time/Steps": 60})
runner.check(status == 1 and "another version" in error, error)
for name in ("checkpoint.cbor", "checkpoint.previous.cbor"):
    (folder / "polar" / name).write_bytes(b"supple checkpoint 1\n")
status, error = run("polar", {**ALWAYS, "Time/Steps": 60})
runner.check(status == 1 and "damaged" in error, error)
status, error = run("polar", {**ALWAYS, "Time/Steps": 60, "Checkpoint/Resume": "never"})
runner.check(status == 0, error)

# Frames may be asked for later: they begin where the run is gone on with, at step 14.
settings = {"Checkpoint/Every": 7, "Checkpoint/Resume": "auto", "Time/Steps": 20}
status, error = run("frames", {**settings, "Output/Frames": "none"})
runner.check(status == 0 and not (folder / "frames" / "solution.pvd").exists(), error)
status, error = run("frames", {**settings, "Time/Steps": 40})
runner.check(status == 0, error)
times = [row["time"] for row in runner.Results(folder / "frames").table("history.csv")]
frames = runner.Results(folder / "frames").frame_times()
runner.check(len(times) == 41 and all(a < b for a, b in zip(times, times[1:])), f"rows at {times}")
runner.check(abs(min(frames) - times[14]) < 1e-9 and abs(max(frames) - times[40]) < 1e-9, f"frames at {frames}")
for steps, kind in [(50, "none"), (60, "adaptive")]:
    status, error = run("frames", {**settings, "Time/Steps": steps, "Output/Frames": kind})
    runner.check(status == 0, error)
later = runner.Results(folder / "frames").frame_times()
runner.check(later[0] == frames[0] and later[-1] > frames[-1], f"frames at {later}, before at {frames}")
runner.check(all(a < b for a, b in zip(later, later[1:])), f"frames at {later}")

# Rows that were done are not lost: an end before them is refused, and nothing is touched.
settings = {"Checkpoint/Every": 7, "Checkpoint/Resume": "auto", "Output/Frames": "none"}
status, error = run("fewer", {**settings, "Time/Steps": 20})
runner.check(status == 0, error)
before = {path: path.read_bytes() for path in (folder / "fewer").iterdir()}
for steps in (10, 16, 19):
    status, error = run("fewer", {**settings, "Time/Steps": steps})
    runner.check(status == 1 and "Time/Steps" in error and "has come to" in error, f"{steps} steps: {status} {error}")
    runner.check(before == {path: path.read_bytes() for path in (folder / "fewer").iterdir()}, f"{steps} steps: files were touched")
for steps in (20, 21):
    status, error = run("fewer", {**settings, "Time/Steps": steps})
    runner.check(status == 0 and len(runner.Results(folder / "fewer").history()) == steps + 1, f"{steps} steps: {error}")
frames_alone = {**settings, "Output/History": "false", "Output/Frames": "every"}
status, error = run("frames alone", {**frames_alone, "Time/Steps": 20})
status, error = run("frames alone", {**frames_alone, "Time/Steps": 15, "Checkpoint/Resume": "auto"})
runner.check(status == 1 and "Time/Steps" in error and len(list((folder / "frames alone" / "solution").iterdir())) == 21, f"frames alone: {error}")
