"""Milliseconds a step of the corotational bar at five sizes, through the program's normal path and without output.

    scripts/run.sh --version && python3 benchmarks/bar/run.py [--repeat 5] [--sizes 1 2 4 8 16] [--methods auto]
                                                              [--plot doc/pictures/growth.svg]

Small bar (20 m/s) with polar rotations, backward Euler, dt = 0.07 s, relative tolerance 1e-6, one thread. Each size is
run several times; the run with the median time a step is shown. The table goes into README.md of this folder by hand.
"""

import math
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import timing

PHASES = ["rotations", "forces", "assembly", "solver_setup", "solve"]
STEPS = {1: 500, 2: 200, 3: 100, 4: 60, 8: 60, 16: 60}


def row(summary):
    """A line of the table."""
    steps, seconds = summary["steps"], summary["seconds"]
    phases = [1e3 * seconds[phase] / steps for phase in PHASES]
    total = 1e3 * timing.seconds_a_step(summary)
    cells = [str(summary["cells"]), summary["solver"]["name"], f"{1e3 / total:.4g}", f"{total:.4g}"]
    cells += [f"{value:.3g}" for value in phases + [total - sum(phases)]]
    cells += [f"{summary['solver']['iterations'] / steps:.1f}", f"{summary['solver']['max_relative_residual']:.1e}",
              f"{summary['peak_memory']:.0f}"]
    return "| " + " | ".join(cells) + " |"


def growth(runs):
    """Exponents of the time a step against the number of cells, from each size to the next."""
    lines = []
    for small, large in zip(runs, runs[1:]):
        exponent = (math.log(timing.seconds_a_step(large) / timing.seconds_a_step(small)) /
                    math.log(large["cells"] / small["cells"]))
        lines.append(f"{small['cells']} to {large['cells']} tetrahedra: time a step grows with the exponent {exponent:.2f}")
    return "\n".join(lines)


def plot(runs, picture):
    """Time a step against the number of tetrahedra, whole and by phase."""
    columns = [[run["cells"], timing.seconds_a_step(run)] +
               [run["seconds"][phase] / run["steps"] for phase in PHASES] for run in runs]
    data = "\n".join(" ".join(f"{value:.6g}" for value in column) for column in columns)
    curves = ["$data using 1:2 with linespoints lw 3 title 'a step'"]
    curves += [f"$data using 1:{3 + i} with linespoints title '{phase.replace('_', ' ')}'"
               for i, phase in enumerate(PHASES)]
    curves.append(f"{columns[-1][1]} * x / {columns[-1][0]} with lines dashtype 2 lc 'grey' title 'proportional to size'")
    script = (f"set terminal svg size 720, 480 background 'white'\nset output '{picture}'\n"
              f"set logscale xy\nset format xy '10^{{%L}}'\nset xlabel 'tetrahedra'\nset ylabel 'seconds'\n"
              f"set key left top\nset grid\n$data << end\n{data}\nend\nplot " + ", ".join(curves) + "\n")
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def main():
    parser = timing.parser(__doc__)
    parser.set_defaults(repeat=5)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1, 2, 4, 8, 16])
    parser.add_argument("--methods", nargs="+", default=["auto"])
    parser.add_argument("--plot", type=pathlib.Path, help="an .svg file to draw, by gnuplot")
    arguments = parser.parse_args()
    unknown = [str(size) for size in arguments.sizes if size not in STEPS]
    if unknown:
        parser.error(f"--sizes {' '.join(unknown)}: the sizes are {', '.join(map(str, STEPS))}")

    print("| tetrahedra | solver | steps/s | ms a step | " + " | ".join(PHASES) +
          " | rest | iterations | residual | MB |")
    print("|" + "---|" * (len(PHASES) + 8))
    for method in arguments.methods:
        runs = []
        for refinement in arguments.sizes:
            settings = {"Mesh/Box cubes": f"{2 * refinement}, {8 * refinement}, {2 * refinement}",
                        "Time/Steps": STEPS[refinement], "Solver/Method": method, "Solver/Tolerance": 1e-6}
            runs.append(timing.median_run("bar/small", settings, arguments))
            print(row(runs[-1]), flush=True)
        print(f"\n{growth(runs)}\n", flush=True)
        if arguments.plot:
            plot(runs, arguments.plot)


if __name__ == "__main__":
    main()
