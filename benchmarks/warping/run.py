"""What `Corotation/Warp tolerance` saves, and what it costs in accuracy.

    scripts/run.sh --version && python3 benchmarks/warping/run.py [--repeat 3]

Each scene without output, on one thread, by the tolerances in turn. The error is the largest difference of a probe's
displacement from that without a tolerance, over its largest value; beside it stands what half the step changes. The
table goes into README.md of this folder by hand.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import timing

QUICK = {"Solver/Tolerance": 1e-6}
SWINGING = {"Motion/Displacement": "0.001*(1 - cos(20*pi*t)); 0; 0"}
POKED = {"Material/Volumetric locking cure": "none", "Probes/Profiles": ""}
# Body: scene, settings, step [s], number of steps, a probe.
BODIES = {
    "bar, 192 tetrahedra": ("bar/large", {}, 0.07, 100, "0, 0, 0"),
    "bar, 12288 tetrahedra": ("bar/large", {**QUICK, "Mesh/Box cubes": "8, 32, 8"}, 0.07, 60, "0, 0, 0"),
    "mushroom": ("mushroom/mushroom", QUICK, 0.07, 100, "0, 0, 6.5"),
    "armadillo": ("armadillo/armadillo", QUICK, 0.01, 200, "0, -1.452, 3.586"),
    "vein, swinging": ("vein/test-2", {**QUICK, **SWINGING}, 0.005, 200, "0.004, 0, 0.01"),
    "skin under a needle, no cure": ("skin/needle", {**QUICK, **POKED}, 1 / 60, 60, "0.001, 0, 0"),
}
TOLERANCES = [0, 0.01, 0.1, 1]


def difference(first, second):
    """Largest distance between two lists of points, over the largest of the first."""
    return max(map(math.dist, first, second)) / max(math.hypot(*point) for point in first)


def main():
    arguments = timing.parser(__doc__).parse_args()
    titles = ["body", "tolerance, degrees", "cells warped", "ms a step", "times as fast", "error", "of the step"]
    print("| " + " | ".join(titles) + " |\n" + "|" + "---|" * len(titles))
    for body, (scene, settings, step, steps, point) in BODIES.items():
        def motion(more):
            rows = timing.run(scene, {**settings, **more, "Probes/Points": f"p: {point}", "Output/History": "true"}, arguments.program,
                              table="probes.csv")["table"]
            return [[float(row[f"p.u{axis}"]) for axis in "xyz"] for row in rows]

        exact = motion({"Time/Step": step, "Time/Steps": steps})
        of_step = difference(exact, motion({"Time/Step": step / 2, "Time/Steps": 2 * steps})[::2])
        whole = None
        for tolerance in TOLERANCES:
            kept = {"Time/Step": step, "Time/Steps": steps, "Corotation/Warp tolerance": tolerance}
            summary = timing.median_run(scene, {**settings, **kept}, arguments)
            seconds, built = timing.seconds_a_step(summary), summary["built"]
            whole = whole or seconds
            cells = [body, f"{tolerance:g}", f"{100 * built['cells_warped'] / built['rotations_computed']:.0f} %",
                     f"{1e3 * seconds:.3g}", f"{whole / seconds:.2f}",
                     f"{difference(exact, motion(kept)):.1e}" if tolerance else "", f"{of_step:.1e}" if not tolerance else ""]
            print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
