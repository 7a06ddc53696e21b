"""One and two threads of a process give the same motion to 1e-8, on one process and on two; two runs with the same number give
the same digits; a run that goes on from a checkpoint ends where the whole one does. Small bodies stay on one thread."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

PHYSICAL = ["time", "kinetic", "elastic", "potential", "dissipated", "total", "work", "px", "py", "pz", "lx", "ly", "lz",
            "min_volume_ratio", "max_volume_ratio", "inverted"]
# 32928 tetrahedra: each of two processes has enough for two threads.
settings = {"Mesh/Box cubes": "14, 28, 14", "Solver/Tolerance": 1e-12, "Damping/Stiffness factor": 1e-3, "Time/Steps": 6}


def simulate(threads, ranks=1, **more):
    run = runner.simulate(runner.BAR, {**settings, **more, "Solver/Threads": threads}, ranks=ranks)
    used = run.summary()["threads"]
    runner.check(used == threads, f"{used} threads instead of {threads}")
    return run


def compare(name, one, other, bound):
    columns = [column for column in one.probes()[0] if column != "step"]
    history = runner.largest_difference(one.history(), other.history(), PHYSICAL)
    probes = runner.largest_difference(one.probes(), other.probes(), columns)
    runner.check(max(history, probes) <= bound, f"{name}: history.csv differs by {history}, probes.csv by {probes}")
    print(f"{name}: history within {history:.1e}, probes within {probes:.1e}")


one, two = simulate(1), simulate(2)
compare("two threads", one, two, 1e-8)
compare("two threads again", two, simulate(2), 0.)
compare("two processes of two threads", one, simulate(2, ranks=2), 1e-8)
compare("three threads, Gram-Schmidt", simulate(1, **{"Corotation/Rotation": "gram-schmidt"}),
        simulate(3, **{"Corotation/Rotation": "gram-schmidt"}), 1e-8)

with tempfile.TemporaryDirectory() as folder:
    kept = {**settings, "Checkpoint/Every": 3, "Checkpoint/Resume": "auto"}
    for name, parts in {"whole": [(6, 2)], "parts": [(3, 2), (6, 2)], "others": [(3, 2), (6, 1)]}.items():
        for steps, threads in parts:
            status, _, error = runner.run(runner.BAR, "--quiet", "--output", pathlib.Path(folder) / name,
                                          *runner.overrides({**kept, "Time/Steps": steps, "Solver/Threads": threads}))
            runner.check(status == 0, error)
    whole, parts, others = [runner.Results(pathlib.Path(folder) / name) for name in ("whole", "parts", "others")]
    compare("from a checkpoint", whole, parts, 1e-9)  # the solver is an iterative one
    solves = [run.summary()["solver"]["solves"] for run in (whole, others)]
    runner.check(solves[1] < solves[0], f"the other number of threads began anew: {solves} solutions")
    compare("from a checkpoint, on one thread", whole, others, 1e-8)

few = runner.simulate(runner.BAR, {"Solver/Threads": 2, "Time/Steps": 2}).summary()["threads"]
runner.check(few == 1, f"192 tetrahedra on {few} threads")
