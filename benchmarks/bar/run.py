"""Milliseconds a step of the corotational bar at four sizes, through the program's normal path and without output.

    scripts/run.sh --version && python3 benchmarks/bar/run.py [--repeat 3] [--sizes 1 2 4 8] [--methods auto]

Small bar (20 m/s) with polar rotations, backward Euler, dt = 0.07 s, relative tolerance 1e-6, one thread. Each size is
run several times; the run with the median time a step is shown. The table goes into README.md of this folder by hand.
"""

import pathlib
import resource
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import timing

PHASES = ["rotations", "forces", "assembly", "solver_setup", "solve"]
STEPS = {1: 100, 2: 60, 3: 40, 4: 30, 8: 10, 16: 5}


def main():
    parser = timing.parser(__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1, 2, 4, 8])
    parser.add_argument("--methods", nargs="+", default=["auto"])
    arguments = parser.parse_args()

    print("| tetrahedra | solver | steps/s | ms a step | " + " | ".join(PHASES) + " | rest | iterations | residual |")
    print("|" + "---|" * (len(PHASES) + 7))
    for refinement in arguments.sizes:
        for method in arguments.methods:
            settings = {"Mesh/Box cubes": f"{2 * refinement}, {8 * refinement}, {2 * refinement}",
                        "Time/Steps": STEPS[refinement], "Solver/Method": method, "Solver/Tolerance": 1e-6}
            summary = timing.median_run("bar/small", settings, arguments)
            steps, seconds = summary["steps"], summary["seconds"]
            phases = [1e3 * seconds[phase] / steps for phase in PHASES]
            total = 1e3 * timing.seconds_a_step(summary)
            cells = [str(summary["cells"]), summary["solver"]["name"], f"{1e3 / total:.4g}", f"{total:.4g}"]
            cells += [f"{value:.3g}" for value in phases + [total - sum(phases)]]
            cells += [f"{summary['solver']['iterations'] / steps:.1f}",
                      f"{summary['solver']['max_relative_residual']:.1e}"]
            print("| " + " | ".join(cells) + " |", flush=True)
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"\nLargest memory of a run: {peak:.0f} MB")


if __name__ == "__main__":
    main()
