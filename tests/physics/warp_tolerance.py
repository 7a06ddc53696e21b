"""Corotation/Warp tolerance: cells keep their part of the matrix until they have turned by more; forces never wait."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

FINE = {"Output/Frames": "none", "Solver/Tolerance": 1e-12}
PROBES = [f"n28.{kind}{axis}" for kind in "uv" for axis in "yz"]


def run(settings, ranks=1):
    return runner.simulate(runner.BAR, {**FINE, **settings}, ranks=ranks)


def warped(results):
    """Part of the cells of all steps that were warped."""
    built = results.summary()["built"]
    return built["cells_warped"] / built["rotations_computed"]


def difference(first, second):
    return runner.largest_difference(first.probes(), second.probes(), PROBES)


# The error goes down with the tolerance, and is far below that of the step.
exact = run({})
runner.check(warped(exact) > 0.98, f"without a tolerance {warped(exact)} of the cells are warped")
half_step = run({"Time/Step": 0.035, "Time/Steps": 200}).probes()[::2]
of_step = runner.largest_difference(exact.probes(), half_step, PROBES)
bounds = {1e-6: 1e-7, 0.1: 1e-3, 1: 1e-2}
parts = []
for angle, bound in bounds.items():
    kept = run({"Corotation/Warp tolerance": angle})
    parts.append(warped(kept))
    error = difference(exact, kept)
    runner.check(error < bound and (angle == 1e-6 or error > 1e-12), f"{angle} degrees: error {error}")
    runner.check(error < 0.2 * of_step, f"{angle} degrees: error {error}, of the step {of_step}")
    print(f"{angle} degrees: {parts[-1]:.3f} of the cells warped, error {error:.1e}; of the step {of_step:.1e}")
runner.check(parts[0] > parts[1] > parts[2] and parts[2] < 0.5, f"parts that are warped: {parts}")

# At rest nothing is taken anew, and rest is the same: forces know the rotations of the moment.
still = {"Time/Steps": 400, "Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, -200", "Damping/Mass factor": 3}
exact, kept = run(still), run({**still, "Corotation/Warp tolerance": 0.5})
end = [max(abs(a[name] - b[name]) for name in PROBES[:2]) for a, b in zip(exact.probes(), kept.probes())]
runner.check(end[-1] < 1e-7 < max(end), f"at the end {end[-1]}, on the way {max(end)}")
runner.check(abs(exact.probes()[-1]["n28.uz"]) > 1, "the bar should bend")
runner.check(warped(kept) < 0.05, f"{warped(kept)} of the cells were warped")

# All else as ever: multigrid, two processes, Gram-Schmidt rotations, an axis, a body without rotations.
for settings in [{"Solver/Method": "cg-amg", "Mesh/Box cubes": "4, 8, 4"}, {"Corotation/Rotation": "gram-schmidt"},
                 {"Time/Method": "trbdf2", "Time/Tangent": "frozen", "Time/Newton tolerance": 1e-11},
                 {"Damping/Stiffness factor": 0.002}]:
    settings = {**settings, "Time/Steps": 30}
    exact, kept = run(settings), run({**settings, "Corotation/Warp tolerance": 0.2})
    runner.check(difference(exact, kept) < 3e-3 and warped(kept) < 0.9 * warped(exact), f"{settings}: {difference(exact, kept)}")
    two = run({**settings, "Corotation/Warp tolerance": 0.2}, ranks=2)
    runner.check(difference(kept, two) < 1e-8, f"{settings}: two processes differ by {difference(kept, two)}")
linear = run({"Corotation/Rotation": "none", "Corotation/Warp tolerance": 1, "Time/Steps": 10})
runner.check(difference(linear, run({"Corotation/Rotation": "none", "Time/Steps": 10})) == 0, "linear elasticity differs")

for settings, words in [({"Time/Method": "implicit backward euler"}, "Time/Tangent = frozen"),
                        ({"Time/Problem": "static", "Start/Velocity": "0; 0; 0"}, "static"),
                        ({"Material/Volumetric locking cure": "patches"}, "locking cure"), ({}, "0 or greater")]:
    angle = 1 if settings else -1
    status, _, error = runner.run(runner.BAR, "--check", *runner.overrides({**settings, "Corotation/Warp tolerance": angle}))
    runner.check(status == 1 and words in error and "Warp tolerance" in error, f"exit status {status}: {error}")
