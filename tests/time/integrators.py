"""Every integrator against a fine run of another: integrators.py PROGRAM PART, PART being one of the functions below that
have no arguments."""

import json
import math
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

ORDERS = {"backward euler": 1, "implicit backward euler": 1, "implicit midpoint": 2, "sdirk2": 2, "trbdf2": 2, "esdirk3": 3,
          "esdirk4": 4, "esdirk5": 5, "imex3": 3, "imex4": 4, "imex5": 5, "explicit2": 2, "explicit3": 3, "explicit4": 4, "explicit5": 5}
FIXED = {name: ({"Time/Method": name}, order) for name, order in ORDERS.items()}
VARIABLE = {f"variable {name}": ({"Time/Method": name, "Time/Variable steps": "true"}, order)
            for name, order in ORDERS.items() if name[-1] in "2345"}
VARIABLE.update({f"ida {order}": ({"Time/Method": "ida", "Time/Maximum order": order}, order) for order in (1, 2)})
METHODS = {**FIXED, **VARIABLE}
# One of each kind; what tells the others of a kind apart is their table, which convergence() tests.
SOME = ["backward euler", "implicit backward euler", "implicit midpoint", "trbdf2", "esdirk4", "imex4", "explicit2", "explicit4",
        "variable trbdf2", "variable imex5", "variable explicit4", "ida 1", "ida 2"]

# All solutions to round-off, so that what is left is the error in time.
EXACT = {"Output/Frames": "none", "Solver/Tolerance": 1e-12, "Time/Newton tolerance": 1e-12}
STILL = {**EXACT, "Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0"}
# A push that sets in and ends smoothly bends the bar by half a metre.
PUSHED = {**STILL, "Loads/Body force": "0; 0; -4e4*sin(pi*t/0.4)^4"}
DURATION = 0.4


def settings_of(name, steps=40, tolerance=1e-3, duration=DURATION):
    """A method over a duration, with lumped mass where it needs it."""
    settings = {**METHODS[name][0], "Time/Step": duration / steps, "Time/Steps": steps, "Time/Relative tolerance": tolerance}
    return {**settings, "Material/Mass": mass_of(name)}


def mass_of(name):
    return "lumped" if "explicit" in name else "consistent"


def simulate(settings, ranks=1):
    """A run of the bar that must reach its end."""
    results = runner.simulate(runner.BAR, settings, ranks)
    end, expected = results.probes()[-1]["time"], settings["Time/Step"] * settings["Time/Steps"]
    runner.check(abs(end / expected - 1) < 1e-9, f"{settings['Time/Method']}: it ends at {end}")
    return results


def place(results, names=("n0", "n28", "n56")):
    """Where the probes are at the end."""
    last = results.probes()[-1]
    return [last[f"{name}.u{direction}"] for name in names for direction in "xyz"]


def distance(first, second):
    return max(abs(a - b) for a, b in zip(first, second))


def relative(first, second):
    return distance(first, second) / max(abs(value) for value in second)


def references(scene, steps=200):
    """The end of the motion by a fine run of esdirk5, by mass matrix."""
    fine = {**scene, **settings_of("esdirk5", steps)}
    return {mass: place(simulate({**fine, "Material/Mass": mass})) for mass in ("consistent", "lumped")}


def balance(history):
    """How far total + dissipated - work strays, over the largest energy."""
    size = max(abs(row[name]) for row in history for name in ("kinetic", "elastic", "potential", "work"))
    sums = [row["total"] + row["dissipated"] - row["work"] for row in history]
    return max(abs(value - sums[0]) for value in sums) / size


def convergence():
    """With fixed steps the error falls at the order of the method."""
    steps = {"backward euler": 80, "implicit backward euler": 80, "sdirk2": 80, "esdirk5": 40, "imex3": 160, "imex4": 80, "imex5": 80,
             "explicit2": 1200, "explicit3": 300,
             "explicit4": 400, "explicit5": 240}
    for rotation, methods in [("polar", FIXED), ("none", ["backward euler", "esdirk4", "explicit4"])]:
        scene = {**PUSHED, "Corotation/Rotation": rotation}
        exact = references(scene, 400)
        for name in methods:
            errors = [distance(place(simulate({**scene, **settings_of(name, steps.get(name, 20) * refinement)})),
                               exact[mass_of(name)]) for refinement in (1, 2)]
            order = math.log2(errors[0] / errors[1])
            print(f"{rotation}, {name}: errors {errors[0]:.1e}, {errors[1]:.1e} m, order {order:.2f}")
            if errors[0] > 1e-10: # the reference has errors, too
                # Loads of time are in the explicit part of semi-implicit methods: waves show more. semi_implicit.py tests orders.
                slack = 1. if "imex" in name else 0.3
                runner.check(order > ORDERS[name] - slack, f"{rotation}, {name}: order {order}, errors {errors}")
            runner.check(errors[0] < 0.1, f"{rotation}, {name}: error {errors[0]}")


def error_bound(order, tolerance):
    """Of displacements over the largest one. What a step may err by adds up over steps whose length goes with the
    (p+1)-st root of it."""
    return (5 if order == 1 else 1.6) * tolerance ** (order / (order + 1))


def tolerances():
    """With variable steps the error falls with the tolerance, and two integrators agree as far as it asks."""
    exact = references(PUSHED)
    size = max(abs(value) for value in exact["consistent"])
    ends, counts = {}, {}
    for name, (_, order) in VARIABLE.items():
        errors = []
        for tolerance in (1e-3, 1e-4, 1e-5):
            results = simulate({**PUSHED, **settings_of(name, tolerance=tolerance)})
            ends[name, tolerance], counts[name, tolerance] = place(results), results.summary()["steps"]
            errors.append(distance(place(results), exact[mass_of(name)]) / size)
            runner.check(errors[-1] < error_bound(order, tolerance), f"{name}: error {errors[-1]} at {tolerance}")
        print(f"{name}: relative errors {', '.join(f'{error:.1e}' for error in errors)}")
        # (An explicit method may be held to the stable step and be better than asked.)
        runner.check(errors[-1] < 0.3 * errors[0] or errors[0] < 1e-5, f"{name}: errors {errors}")

    # Two codes, two formulas, one motion. The tolerance bounds what each step may err by, not the sum over the steps, of
    # which there are about tolerance^(-1/(p+1)): they differ by more than it, and the more so the smaller it is.
    for tolerance in (1e-3, 1e-4, 1e-5):
        for order in (1, 2):
            for arkode in ("variable trbdf2", "variable esdirk4"):
                apart = distance(ends[f"ida {order}", tolerance], ends[arkode, tolerance]) / size
                steps = counts[f"ida {order}", tolerance]
                print(f"tolerance {tolerance}: ida of order {order} and {arkode} differ by {apart:.1e}, {apart / tolerance:.0f} "
                      f"times the tolerance, {apart / tolerance / steps:.3f} of it for each of the {steps} steps of ida")
                runner.check(apart < error_bound(order, tolerance), f"ida {order}, {arkode}: {apart} at {tolerance}")
                runner.check(apart < 2 * steps * tolerance, f"ida {order}, {arkode}: {apart} after {steps} steps of {tolerance}")

    # A blow that is short beside the step tried first is not stepped over.
    blow = {**STILL, "Loads/Body force": "0; 0; -1e6*exp(-((t - 0.1)/0.01)^2)"}
    exact = place(simulate({**blow, **settings_of("esdirk5", 400)}))
    for name in ("variable sdirk2", "variable esdirk4", "ida 2"):
        error = relative(place(simulate({**blow, **settings_of(name, tolerance=1e-5)})), exact)
        runner.check(error < 1e-2, f"{name}: a short blow, error {error}")


def energies():
    """What the books say of each method."""
    free = {**EXACT, "Constraints/Clamped boundaries": "", "Loads/Gravity": "0, 0, 0", "Corotation/Rotation": "none",
            "Start/Velocity": "2*sin(y/4); 3*x; y*z/8"}
    history = simulate({**free, **settings_of("implicit midpoint", 100, duration=2)}).history()
    start = history[0]["kinetic"]
    stray = max(abs(row["kinetic"] + row["elastic"] - start) for row in history) / start
    runner.check(stray < 1e-8, f"implicit midpoint loses {stray} of the energy of a linear body")
    print(f"implicit midpoint, linear: energy within {stray:.1e}")

    # What the method takes away disappears with the step; what damping takes away is the same in all. (With lumped mass
    # it is another body.)
    start = {**EXACT, "Start/Velocity": "0; 0; -20*(1 - y/12)^2", "Loads/Body force": "0; 1e5*sin(20*t); 0"}
    damped = {**start, "Damping/Mass factor": 3, "Damping/Stiffness factor": 0.002, "Damping/Viscous": 300}
    for name in SOME:
        order = METHODS[name][1]
        lost = []
        for scene, refinement in [(start, 1), (start, 4), (damped, 4)]:
            steps = {"explicit2": 600}.get(name, 100)
            settings = settings_of(name, steps * refinement, 1e-4 / refinement ** 2, duration=0.1)
            history = simulate({**scene, **settings}).history()
            runner.check(balance(history) < 1e-10, f"{name}: out of balance by {balance(history)}")
            lost.append(history[-1]["dissipated"] / history[0]["total"])
        print(f"{name}: dissipated of the energy at the start {lost[0]:.6f}, {lost[1]:.6f}, damped {lost[2]:.6f}")
        limit = 0.03 if order == 1 else 5e-4
        runner.check(abs(lost[1]) < limit and abs(lost[1]) < abs(lost[0]) + 1e-5, f"{name}: dissipated {lost}")
        expected = 0.433274 if mass_of(name) == "lumped" else 0.422159
        runner.check(abs(lost[2] - expected) < limit, f"{name}: damping dissipates {lost[2]}, not {expected}")


def rigid_motions():
    """Moved as a whole, smoothly and with kinks, a body has no strain, and mass times acceleration as reaction."""
    inertia = {**STILL, "Constraints/Clamped boundaries": "", "Motion/Of": "all", "Probes/Regions": "body: y < 13"}
    for displacement, velocity in [("sin(3*t)", lambda t: 3 * math.cos(3 * t)),
                                   ("min(t/0.1, 1)", lambda t: 10 if t < 0.1 + 1e-9 else 0)]:
        for name in ["backward euler", "esdirk4", "imex5", "explicit4", "ida 2"]:
            moved = {**inertia, **settings_of(name, 10, duration=0.2), "Motion/Displacement": f"{displacement}; 0; 0"}
            results = simulate(moved)
            probes, history = results.probes(), results.history()
            for now, last in zip(probes[1:], probes):
                force = 192000 * (now["body.vx"] - last["body.vx"]) / (now["time"] - last["time"])
                runner.check(abs(now["body.fx"] - force) < 1e-6 * 192000, f"{name}: force {now['body.fx']}, not {force}")
            size = max(row["kinetic"] for row in history)
            runner.check(max(row["elastic"] for row in history) < 1e-12 * size, f"{name}: a rigid motion strains the body")
            runner.check(balance(history) < 1e-12, f"{name}: out of balance by {balance(history)}")
            if name != "backward euler": # which dissipates, and whose velocity is that of its step
                error = max(abs(row["body.vx"] - velocity(row["time"])) for row in probes)
                runner.check(error < 1e-8, f"{name}: velocity wrong by {error}")
                lost = max(abs(row["dissipated"]) for row in history) / size
                runner.check(lost < 1e-10, f"{name}: {lost} dissipated in a rigid motion")


def motions():
    """The bar is shaken: one trajectory and one work by all methods, and nothing lost in a jerk."""
    rigid_motions()
    shaken = {**STILL, "Probes/Points": "n28: 2, 6, 2", "Probes/Regions": "moved: y == 0"}
    jerk = {"Motion/Of": "region y == 0", "Motion/Displacement": "free; free; sin(3*t)"}
    two = {"Motion/Of": "region y == 0", "Motion/Displacement": "free; 0.5*sin(4*t)^2; free", "Motion 2/Of": "vertex 40",
           "Motion 2/Displacement": "sin(5*t)^2; free; free"}
    for label, motion, methods in [("a jerk", jerk, SOME), ("two motions", two, ["backward euler", "trbdf2", "imex4", "explicit4", "ida 2"])]:
        scene = {**shaken, **motion}
        exact = {}
        for mass in ("consistent", "lumped"):
            results = simulate({**scene, **settings_of("variable esdirk4", tolerance=1e-7), "Material/Mass": mass})
            exact[mass] = (place(results, ["n28"]), results.history()[-1]["work"])
        for name in methods:
            order = METHODS[name][1]
            results = simulate({**scene, **settings_of(name, {"explicit2": 1200}.get(name, 300), 1e-5)})
            history = results.history()
            end, work = exact[mass_of(name)]
            apart, error = relative(place(results, ["n28"]), end), abs(history[-1]["work"] / work - 1)
            print(f"{label}, {name}: place within {apart:.1e}, work within {error:.1e}")
            limit = 0.06 if order == 1 else 3e-3
            runner.check(apart < limit and error < limit, f"{label}, {name}: place off by {apart}, work by {error}")
            runner.check(balance(history) < 1e-10, f"{label}, {name}: out of balance by {balance(history)}")
            size = max(row["kinetic"] for row in history)
            jump = abs(history[1]["dissipated"]) / size
            runner.check(jump < (1e-2 if order == 1 else 1e-3), f"{label}, {name}: {jump} dissipated in the first step")
            if order > 1:
                lost = abs(history[-1]["dissipated"]) / size
                runner.check(lost < 0.05, f"{label}, {name}: {lost} dissipated")
            if order > 1 and label == "a jerk":
                error = max(abs(row["moved.vz"] - 3 * math.cos(3 * row["time"])) for row in results.probes())
                runner.check(error < 1e-7, f"{name}: velocity wrong by {error}")


def loads():
    """Damping of all kinds, pressure that follows and a body force in time: one motion by all methods."""
    scene = {**STILL, "Damping/Mass factor": 2, "Damping/Stiffness factor": 0.002, "Damping/Viscous": 1000,
             "Loads/Pressure": "3e6*sin(4*t)^2", "Loads/Pressure on": 1, "Loads/Body force": "0; 2e5*sin(6*t); 4e4*(1 - cos(9*t))"}
    exact = references(scene)
    for name in SOME:
        apart = relative(place(simulate({**scene, **settings_of(name, {"explicit2": 1200}.get(name, 300), 1e-5)})),
                         exact[mass_of(name)])
        print(f"damped and pressed, {name}: within {apart:.1e}")
        runner.check(apart < (0.03 if METHODS[name][1] == 1 else 1e-3), f"{name}: off by {apart}")


def fails(settings):
    """A run that must end with exit status 2, and leave files that are complete."""
    folder = tempfile.mkdtemp(prefix="supple-")
    settings = {**settings, "Output/Frames": "every"}
    status, _, error = runner.run(runner.BAR, "--quiet", "--output", folder, *runner.overrides(settings))
    name = settings["Time/Method"]
    runner.check(status == 2 and "the forces are not finite" in error, f"{name}: exit status {status}, {error}")
    results = runner.Results(folder)
    history, frames = results.history(), results.frame_times()
    runner.check(results.summary()["status"].startswith("failed: Step "), f"{name}: {results.summary()['status']}")
    runner.check(len(results.probes()) == len(history) == len(frames), f"{name}: {len(history)} rows, {len(frames)} frames")
    runner.check(abs(frames[-1] - history[-1]["time"]) < 1e-9, f"{name}: the last frame is not that of the last row")
    runner.check(abs(results.summary()["last"]["elastic"] / history[-1]["elastic"] - 1) < 1e-12, f"{name}: the last energy")
    return results


def frame(results, number):
    return (results.folder / "solution" / f"frame_{number:04}.vtu").read_bytes()


def failures():
    """A step that can't be done is tried again in smaller ones, and then leaves all as it was."""
    broken = {**EXACT, "Loads/Body force": "0; 0; 1/(t < 0.095) - 1"} # nothing, then infinite
    for name, steps in [("backward euler", 20), ("esdirk4", 20), ("imex4", 20), ("explicit4", 100), ("variable trbdf2", 20),
                        ("variable imex5", 20), ("variable explicit4", 20), ("ida 2", 20)]:
        settings = settings_of(name, steps, duration=0.2)
        end = fails({**broken, **settings}).history()[-1]["time"]
        runner.check(0.09 - 1e-9 < end < 0.095 + 1e-9, f"{name}: it fails after {end}")
        if name in FIXED and name != "imex4": # which takes no smaller steps than it is asked for
            failed = fails({**broken, **settings, "Time/Retries": 0})
            whole = simulate({**EXACT, **settings, "Output/Frames": "every"})
            good = len(failed.history()) - 1
            runner.check(good == math.floor(0.095 / settings["Time/Step"] + 1e-9), f"{name}: {good} good steps")
            runner.check(frame(failed, good) == frame(whole, good), f"{name}: the failed step is in the last frame")

    # Newton's method must not need more than four iterations: steps are halved where it does.
    exact = references(PUSHED, 100)["consistent"]
    for name in ["implicit midpoint", "esdirk4"]:
        errors = {}
        for limit in (100, 4):
            results = simulate({**PUSHED, **settings_of(name, 8), "Time/Newton iterations": limit})
            errors[limit] = distance(place(results), exact)
            rejected = results.summary()["rejected_steps"]
            runner.check((rejected > 0) == (limit == 4), f"{name}: {rejected} rejected steps")
        times = [row["time"] for row in results.history()]
        for k in range(9):
            runner.check(min(abs(time - 0.05 * k) for time in times) < 1e-12, f"{name}: time {0.05 * k} is passed over")
        print(f"{name}: error {errors[100]:.1e} m in whole steps, {errors[4]:.1e} m with halves")
        runner.check(errors[4] < errors[100], f"{name}: errors {errors}")


def nothing_swings():
    """Of a body whose vertices are all held no explicit step is too long."""
    held = {**EXACT, "Material/Mass": "lumped", "Time/Method": "explicit4", "Constraints/Clamped boundaries": "", "Motion/Of": "all"}
    status, output, error = runner.run("--check", runner.BAR, *runner.overrides(held))
    runner.check(status == 0 and "any length" in output, f"{output}{error}")


def stability():
    """Explicit methods: the longest stable step is told, and kept to."""
    nothing_swings()
    plucked = {**EXACT, "Start/Velocity": "0; 0; -20*(y < 1)", "Loads/Gravity": "0, 0, 0", "Material/Mass": "lumped"}

    def stable_step(settings, step=1e-5):
        return simulate({**plucked, **settings, "Time/Steps": 10, "Time/Step": step}).summary()["stable_step"]

    # On the imaginary axis |R| <= 1 up to sqrt(3) and 2 sqrt(2); a run of few steps may go a little beyond.
    for name, limit in [("explicit3", math.sqrt(3)), ("explicit4", math.sqrt(8))]:
        settings = {"Time/Method": name}
        step = stable_step(settings)["frequency"]
        step = limit / step
        longer = {**plucked, **settings, "Time/Step": 1.01 * step, "Time/Steps": 1000}
        status, _, error = runner.run("--check", runner.BAR, *runner.overrides(longer))
        found = re.search(r"is stable up to a step of ([0-9.e-]+) s", error)
        runner.check(status == 1 and "Time/Step" in error and found, f"{name}: {status} {error}")
        runner.check(abs(float(found[1]) / step - 1) < 5e-3, f"{name}: {found[1]} instead of {step}")
        history = simulate({**longer, "Time/Step": 0.99 * step}).history()
        total = [row["kinetic"] + row["elastic"] for row in history]
        runner.check(max(total) < 1.05 * total[0], f"{name}: the energy grows to {max(total) / total[0]} of itself")

    # Variable steps are held to it however loose the tolerance is.
    loose = {**plucked, **settings_of("variable explicit5", 2000, 0.1, duration=20)}
    results = simulate(loose)
    history, limit = results.history(), results.summary()["stable_step"]["step"]
    total = [row["kinetic"] + row["elastic"] for row in history]
    print(f"variable explicit5 at a tolerance of 0.1: steps up to {max(row['dt'] for row in history) / limit} of the stable one, "
          f"energy up to {max(total) / total[0]} of that at the start")
    runner.check(max(row["dt"] for row in history) < limit * (1 + 1e-9), "steps longer than the stable one")
    runner.check(max(total) < 1.05 * total[0], f"variable explicit5: the energy grows to {max(total) / total[0]} of itself")

    # By the Gershgorin of physics: a cell's size over the speed of sound, whatever the unit of length.
    for scale in (1e-3, 1e3):
        sizes = {"Mesh/Box size": f"{4 * scale}, {12 * scale}, {4 * scale}", "Time/Method": "explicit4", "Probes/Points": ""}
        found = stable_step({**sizes, "Start/Velocity": "0; 0; 0"}, 1e-5 * scale)["frequency"] * scale
        runner.check(abs(found / stable_step({"Time/Method": "explicit4"})["frequency"] - 1) < 1e-9, "it does not scale")

    # Damping by stiffness shortens the step, much of it to that of the real axis; drag hardly matters.
    undamped = stable_step({"Time/Method": "explicit4"})
    stiff = stable_step({"Time/Method": "explicit4", "Damping/Stiffness factor": 0.01})
    runner.check(abs(stiff["step"] * 0.01 * undamped["frequency"] ** 2 - 2.785) < 0.1, f"real axis: {stiff}")
    held = simulate({**plucked, "Time/Method": "explicit4", "Damping/Stiffness factor": 0.01, "Time/Steps": 500,
                     "Time/Step": 0.98 * stiff["step"]}).history()
    runner.check(held[-1]["total"] < held[0]["total"], "a damped body gains energy")
    runner.check(stable_step({"Time/Method": "explicit4", "Damping/Mass factor": 1})["step"] > 0.99 * undamped["step"], "drag")

    # Backward differentiation of higher order is warned of.
    for order, expected in [(2, 0), (3, 1)]:
        settings = {**settings_of("ida 2", 2), "Time/Maximum order": order}
        warnings = simulate({**STILL, **settings}).summary()["warnings"]
        runner.check(len([text for text in warnings if "Maximum order" in text]) == expected, f"order {order}: {warnings}")
    status, _, error = runner.run("--check", runner.BAR, "--set", "Time/Method=ida", "--set", "Time/Maximum order=6")
    runner.check(status == 1 and "5 at most" in error, f"order 6: {status} {error}")

    # A motion that its time stepping drives is not passed off as a result.
    wild = {**settings_of("implicit midpoint", 20, duration=1.4), "Start/Velocity": "0; 0; -80"}
    warnings = simulate({**EXACT, **wild}).summary()["warnings"]
    runner.check(any("The time stepping added" in text for text in warnings), f"warnings {warnings}")


def sizes():
    """A body of millimetres and one of kilometres take the steps that one of metres takes."""
    counts = {}
    for name in ["variable trbdf2", "variable explicit4", "ida 2"]:
        for scale in (1, 1e-3, 1e3):
            settings = settings_of(name, 100, duration=0.4 * scale)
            results = simulate({**settings, "Output/Frames": "none", "Mesh/Box size": f"{4 * scale}, {12 * scale}, {4 * scale}",
                                "Loads/Gravity": f"0, 0, {-9.81 / scale}", "Probes/Points": f"n28: {2 * scale}, 0, {2 * scale}"})
            summary = results.summary()
            counts[scale] = (summary["steps"], results.probes()[-1]["n28.uz"] / scale)
        print(f"{name}: steps and motion {counts}")
        for steps, motion in counts.values():
            runner.check(abs(steps / counts[1][0] - 1) < 0.02, f"{name}: steps {counts}")
            runner.check(abs(motion / counts[1][1] - 1) < 1e-3, f"{name}: motions {counts}")


def ranks():
    """One process and two."""
    settings = {**EXACT, "Loads/Body force": "1e4*sin(10*t); 0; 0", "Damping/Stiffness factor": 1e-3,
                "Motion/Of": "vertex 40", "Motion/Displacement": "0.1*sin(9*t); free; free"}
    for name, steps in [("esdirk4", 20), ("imex4", 40), ("variable imex5", 20), ("explicit4", 150), ("ida 2", 20)]:
        run = {**settings, **settings_of(name, steps)}
        one, two = simulate(run), simulate(run, ranks=2)
        columns = [column for column in one.probes()[0] if column not in ("step", "clamp.ux", "clamp.uy", "clamp.uz")]
        difference = runner.largest_difference(one.probes(), two.probes(), columns)
        energies = runner.largest_difference(one.history(), two.history(), ["time", "kinetic", "elastic", "total", "work"])
        print(f"{name}: probes within {difference:.1e}, history within {energies:.1e}")
        runner.check(difference < 1e-8 and energies < 1e-8, f"{name}: probes {difference}, history {energies}")


PARTS = [convergence, tolerances, energies, motions, loads, failures, stability, sizes, ranks]

if __name__ == "__main__":
    dict((part.__name__, part) for part in PARTS)[sys.argv[2]]()
