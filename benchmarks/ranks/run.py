"""The corotational bar on several processes: time a step, iterations, messages.

    scripts/run.sh --version && python3 benchmarks/ranks/run.py [--refinement 8] [--ranks 1 2 4 8 16] [--repeat 5]

As benchmarks/bar otherwise. Times mean something only up to the number of processors; beyond, processes share them, and
what counts are iterations and messages. Messages are those of the process with most of them, as a step adds them: the
difference of a long run and a short one (messages.c, put before the MPI library).
"""

import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import timing

STEPS = 60
ROOT_MAY_RUN = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                "OMPI_MCA_btl": "^tcp,uct,openib,ofi"}


def launcher(n_ranks, binding):
    return ["mpirun", "-np", str(n_ranks), "--oversubscribe", "--bind-to", binding]


def counted(settings, n_ranks, program, folder):
    """Messages, their bytes, reductions and their bytes of one run."""
    result = pathlib.Path(folder) / "messages"
    extra = ["-x", f"LD_PRELOAD={folder}/messages.so", "-x", f"SUPPLE_MESSAGES={result}"]
    summary = timing.run("bar/small", settings, program, launcher(n_ranks, "none") + extra)
    return summary, [float(value) for value in result.read_text().split()]


def messages_a_step(settings, n_ranks, program):
    """The summary of the long run, and what counted() says, a step."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["mpicc", "-O2", "-shared", "-fPIC", pathlib.Path(__file__).with_name("messages.c"),
                        "-o", f"{folder}/messages.so"], check=True)
        _, short = counted({**settings, "Time/Steps": STEPS // 2}, n_ranks, program, folder)
        summary, long = counted(settings, n_ranks, program, folder)
    return summary, [(b - a) / (STEPS - STEPS // 2) for a, b in zip(short, long)]


def main():
    parser = timing.parser(__doc__)
    parser.add_argument("--refinement", type=int, default=8)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8, 16])
    arguments = parser.parse_args()
    os.environ.update(ROOT_MAY_RUN)
    n = arguments.refinement
    settings = {"Mesh/Box cubes": f"{2 * n}, {8 * n}, {2 * n}", "Time/Steps": STEPS, "Solver/Method": "cg-amg",
                "Solver/Tolerance": 1e-6}

    print("| ranks | bound to | ms a step | speed-up | iterations | messages a step | MB | reductions | MB |")
    print("|" + "---|" * 9)
    one = None
    for n_ranks in arguments.ranks:
        timed = n_ranks <= len(os.sched_getaffinity(0))
        summary, counts = messages_a_step(settings, n_ranks, arguments.program)
        for binding in ["none", "core"] if timed and n_ranks > 1 else ["none"]:
            if timed:
                summary = timing.median_run("bar/small", settings, arguments, launcher(n_ranks, binding))
            seconds = timing.seconds_a_step(summary)
            one = one or seconds
            print(f"| {n_ranks} | {binding} | " + (f"{1e3 * seconds:.1f} | {one / seconds:.2f}" if timed else "- | -") +
                  f" | {summary['solver']['iterations'] / STEPS:.1f} | {counts[0]:.0f} | {counts[1] / 1e6:.2f} | "
                  f"{counts[2]:.0f} | {counts[3] / 1e6:.2f} |", flush=True)


if __name__ == "__main__":
    main()
