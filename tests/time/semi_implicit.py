"""Semi-implicit methods: orders with matrices of any age, steps that are too long, what the matrix is made of, what is refused."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

ORDERS = {"imex3": 3, "imex4": 4, "imex5": 5}
QUIET = {"Output/Frames": "none", "Output/Report": "false"}
EXACT = {**QUIET, "Solver/Tolerance": 1e-12}
# It starts smoothly and bends by a metre.
SMOOTH = {**EXACT, "Start/Velocity": "0; 0; -0.14*(12-y)^2", "Loads/Gravity": "0, 0, 0", "Material/Mass": "lumped"}


def simulate(settings, ranks=1):
    return runner.simulate(runner.BAR, settings, ranks)


def place(results):
    last = results.probes()[-1]
    return [last[f"{name}.u{direction}"] for name in ("n0", "n28", "n56") for direction in "xyz"]


def apart(one, other):
    """The distance of two ends of the motion, over the motion."""
    return max(abs(a - b) for a, b in zip(place(one), place(other))) / max(abs(a) for a in place(other))


def steps(method, n, end=0.14, **more):
    return {"Time/Method": method, "Time/Step": end / n, "Time/Steps": n, **more}


def orders():
    """Whether the matrix is of each step, of each eighth or of the start, the error falls with the order of the method."""
    exact = simulate({**SMOOTH, "Time/Newton tolerance": 1e-12, **steps("esdirk5", 1200)})
    for method, order in ORDERS.items():
        for angle in (0, 1, 180):
            errors = [apart(simulate({**SMOOTH, **steps(method, n), "Time/Renewal angle": angle}), exact) for n in COUNTS[method]]
            found = [math.log(errors[0] / errors[1]) / math.log(COUNTS[method][1] / COUNTS[method][0])]
            print(f"{method}, angle {angle}: errors {errors}, orders {found}")
            slack = 0.3 if method == "imex5" else 0.15 # whose errors of 1e-11 are near to that of the reference
            runner.check(all(abs(value - order) < slack for value in found), f"{method}, angle {angle}: orders {found}")


# Waves that run through the bar let the order of longer steps swing about that of the method.
COUNTS = {"imex3": (800, 3200), "imex4": (100, 400), "imex5": (400, 800)}


def growth():
    """A step that is too long ends the run and says what helps; variable steps find theirs."""
    swung = {**QUIET, "Start/Velocity": "0; 0; -40"}
    exact = simulate({**swung, **steps("esdirk5", 800, 0.7)})
    for method in ORDERS:
        status, _, error = runner.run(runner.BAR, "--quiet", "--output", tempfile.mkdtemp(prefix="supple-"),
                                      *runner.overrides({**swung, **steps(method, 10, 0.7)}))
        print(error)
        runner.check(status == 2, f"{method}: exit status {status}: {error}")
        for words in ("Shorten the step (Time/Step)", "let it vary (Time/Variable steps = true)", method):
            runner.check(words in error, f"{method}: '{words}' is missing in {error}")
        variable = simulate({**swung, **steps(method, 10, 0.7), "Time/Variable steps": "true", "Time/Relative tolerance": 1e-3})
        error = apart(variable, exact)
        print(f"{method}, variable steps: error {error:.1e}")
        runner.check(error < 0.05, f"{method}, variable steps: error {error}")


def matrices():
    """One matrix serves many steps, and a linear scene one for all."""
    swung = {**EXACT, "Start/Velocity": "0; 0; -20"}
    exact = simulate({**swung, **steps("esdirk5", 800, 0.7)})
    built = {}
    for angle in (0, 5, 180):
        results = simulate({**swung, **steps("imex5", 320, 0.7), "Time/Renewal angle": angle})
        built[angle], error = results.summary()["built"]["factorizations"], apart(results, exact)
        print(f"renewed at {angle} degrees: {built[angle]} factorizations, error {error:.1e}")
        runner.check(error < 5e-3, f"angle {angle}: error {error}")
    runner.check(built[180] == 1 and 1 < built[5] < 100 and built[0] == 320, f"factorizations {built}")
    linear = {**swung, "Corotation/Rotation": "none"}
    results = simulate({**linear, **steps("imex4", 100, 0.7)})
    built = results.summary()["built"]
    runner.check(built["factorizations"] == 1 and built["rotations_computed"] == 0, f"{built}")
    error = apart(results, simulate({**linear, **steps("esdirk4", 100, 0.7)}))
    runner.check(error < 1e-9, f"linear: imex4 and esdirk4 have the same table, and differ by {error}")


def scenes():
    """Solvers, processes, patches, laws, pressure that follows: the motion is that of an implicit method."""
    base = {**EXACT, "Start/Velocity": "0; 0; -10", "Time/Newton tolerance": 1e-12}
    for what, settings in [
            ("multigrid", {"Solver/Method": "cg-amg"}),
            ("CHOLMOD", {"Solver/Method": "cholmod"}),
            ("patches", {"Material/Poisson ratio": 0.49, "Material/Volumetric locking cure": "patches"}),
            ("patches, multigrid", {"Material/Poisson ratio": 0.49, "Material/Volumetric locking cure": "patches",
                                    "Solver/Method": "cg-amg"}),
            ("Gram-Schmidt", {"Corotation/Rotation": "gram-schmidt"}),
            ("pressure", {"Loads/Pressure": "3e6*sin(4*t)^2", "Loads/Pressure on": 1}),
            ("linear, pressure that follows", {"Corotation/Rotation": "none", "Loads/Pressure": "3e6*sin(4*t)^2",
                                               "Loads/Pressure on": 1}),
            ("guarded", {"Time/Energy guard": "reject"})]:
        exact = simulate({**base, **settings, "Time/Energy guard": "off", **steps("esdirk5", 160, 0.35)})
        for name, more in [("fixed", {}), ("variable", {"Time/Variable steps": "true", "Time/Relative tolerance": 1e-5})]:
            if what == "guarded" and name == "variable" or "patches" in what and name == "fixed":
                continue # almost incompressible bodies need shorter steps than these
            error = apart(simulate({**base, **settings, **steps("imex5", 160, 0.35), **more}), exact)
            print(f"{what}, {name} steps: error {error:.1e}")
            runner.check(error < 1e-3, f"{what}, {name} steps: error {error}")
    # A slow force on a stiff body, which long steps follow from equilibrium to equilibrium.
    pushed = {**QUIET, "Material/Young modulus": 1e10, "Material/Mass": "lumped", "Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0",
              "Loads/Body force": "0; 0; -2e7*sin(pi*t/1.4)^2"}
    exact = simulate({**pushed, **steps("esdirk5", 640, 0.7)})
    for method in ("imex4", "imex5"):
        error = apart(simulate({**pushed, **steps(method, 10, 0.7), "Time/Variable steps": "true", "Time/Relative tolerance": 1e-2}), exact)
        print(f"pushed slowly, {method}: error {error:.1e}")
        runner.check(error < 3e-3, f"pushed slowly, {method}: error {error}")
    two = {**base, "Material/Poisson ratio": 0.4, "Material/Volumetric locking cure": "patches", **steps("imex5", 160, 0.35)}
    error = apart(simulate(two, ranks=2), simulate(two))
    print(f"two processes with patches: {error:.1e}")
    runner.check(error < 1e-8, f"two processes differ by {error}")
    # The second run with half the step tells the error.
    told = simulate({**base, **steps("imex3", 80, 0.35), "Time/Estimate error": "true"}).summary()["error_estimate"]["step_doubling"]
    exact = simulate({**base, **steps("esdirk5", 400, 0.35)})
    error = apart(simulate({**base, **steps("imex3", 80, 0.35)}), exact)
    print(f"error told {told['relative']:.1e}, at the end {error:.1e}")
    runner.check(0.3 * error < told["relative"] < 10 * error and told["order_of_method"] == 3, f"{told}, error {error}")


def refusals():
    """What does not go with these methods is refused, what says nothing is told."""
    status, _, error = runner.run(runner.BAR, "--check", *runner.overrides({"Time/Method": "imex4", "Corotation/Warp tolerance": 1}))
    runner.check(status == 1 and "Warp tolerance" in error and "Renewal angle" in error, f"{status}: {error}")
    status, _, error = runner.run(runner.BAR, "--check", *runner.overrides({"Time/Method": "imex4", "Time/Renewal angle": -1}))
    runner.check(status == 1 and "Renewal angle" in error, f"{status}: {error}")
    for method, entry in [("imex4", "Time/Tangent=frozen"), ("esdirk4", "Time/Renewal angle=3")]:
        status, output, error = runner.run(runner.BAR, "--check", "--set", f"Time/Method={method}", "--set", entry)
        runner.check(status == 0 and "no effect" in output, f"{entry}: {output}{error}")


PARTS = [orders, growth, matrices, scenes, refusals]

if __name__ == "__main__":
    dict((part.__name__, part) for part in PARTS)[sys.argv[2]]()
