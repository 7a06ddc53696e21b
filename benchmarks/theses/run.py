"""Steps a second of the theses' bodies, linear and corotational, beside the theses' frames a second.

    scripts/run.sh --version && python3 benchmarks/theses/run.py [--repeat 5] [--seconds 2] [--bodies bar vein]

Each scene as it is, but without output, on one thread, and with so many steps that a run takes the seconds asked for.
It is run several times; the run with the median time a step is shown. The table goes into README.md of this folder by
hand.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import timing

LINEAR = {"Corotation/Rotation": "none"}
SWINGING = {"Motion/Displacement": "0.001*(1 - cos(20*pi*t)); 0; 0"}  # a vein at rest is cheaper
# Body: vertices and tetrahedra in the thesis; then for each model the scene, what is set in it, frames a second there.
BODIES = {
    "bar": (81, 192, [("bar/large-linear", {}, 372), ("bar/large", {}, 12)]),
    "mushroom": (219, 656, [("mushroom/mushroom-linear", {}, 109), ("mushroom/mushroom", {}, 2)]),
    "armadillo": (285, 787, [("armadillo/armadillo-linear", {}, 101), ("armadillo/armadillo", {}, 2)]),
    "vein": (660, 1890, [("vein/test-2", {**SWINGING, **LINEAR}, 17), ("vein/test-2", SWINGING, None)]),
}
TRIAL = 100  # steps that tell how many more a run must have


def measure(scene, settings, arguments):
    """summary.json of the median run, long enough."""
    trial = timing.run(scene, {**settings, "Time/Steps": TRIAL}, arguments.program)
    steps = max(TRIAL, math.ceil(arguments.seconds / timing.seconds_a_step(trial)))
    return timing.median_run(scene, {**settings, "Time/Steps": steps}, arguments)


def three_digits(number):
    """21789 as 21800."""
    return f"{float(f'{number:.3g}'):g}"


def main():
    parser = timing.parser(__doc__)
    parser.add_argument("--seconds", type=float, default=2, help="how long a run takes at least, roughly")
    parser.add_argument("--bodies", nargs="+", choices=BODIES, default=list(BODIES))
    arguments = parser.parse_args()

    titles = ["body", "model", "vertices", "tetrahedra", "ms a step", "frames a second",
              "the thesis's vertices", "its tetrahedra", "its frames a second"]
    print("| " + " | ".join(titles) + " |\n" + "|" + "---|" * len(titles))
    for body in arguments.bodies:
        vertices, tetrahedra, scenes = BODIES[body]
        for model, (scene, settings, frames) in zip(["linear", "corotational"], scenes):
            summary = measure(scene, settings, arguments)
            seconds = timing.seconds_a_step(summary)
            cells = [body, model, summary["vertices"], summary["cells"], f"{1e3 * seconds:.3g}", three_digits(1 / seconds),
                     vertices, tetrahedra, frames or "-"]
            print("| " + " | ".join(map(str, cells)) + " |", flush=True)


if __name__ == "__main__":
    main()
