"""What hands do is mechanics: a spring pulls as hard as a force of its size, a held vertex feels its reaction, nothing is lost."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

SMALL = runner.ROOT / "parameters" / "bar" / "small.prm"
# A stiff bar at rest, damped: after a while it is in equilibrium with its load.
AT_REST = {"Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0", "Time/Step": 0.1, "Damping/Mass factor": 20, "Solver/Tolerance": 1e-13,
           "Probes/Points": "tip: 2, 0, 2"}
LINEAR = {**AT_REST, "Corotation/Rotation": "none"}


def live(settings, deeds):
    """Repeats a session. deeds are texts, or numbers of steps until the next one. Gives its results."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
    step, lines = 0, []
    for deed in [*deeds, "end"]:
        if isinstance(deed, str):
            lines.append(f"step {step} time {step * settings['Time/Step']} {deed}\n")
        else:
            step += deed
    (folder / "by_hand.motion").write_text("".join(lines))
    return runner.simulate(SMALL, {**settings, "Live/Motion": folder / "by_hand.motion"})


def close(value, wanted, part, what):
    runner.check(abs(value - wanted) <= part * abs(wanted), f"{what}: {value}, not {wanted}")


# In equilibrium the spring's force is k (p - x), and a nodal force of that size gives the same displacement.
for settings in (LINEAR, AT_REST):
    pulled = live(settings, ["grab 28 2 0 2.4 by 28 1e6 0 0 0", 400])
    hand, probe = pulled.table("hands.csv")[-1], pulled.probes()[-1]
    force = 1e6 * (2.4 - hand["z"])
    close(hand["fz"], force, 1e-12, "force of the spring")
    runner.check(abs(hand["x"] - 2 - probe["tip.ux"]) < 1e-12 and 0.05 < probe["tip.uz"] < 0.4, f"the tip is at {probe['tip.uz']}")
    loaded = runner.simulate(SMALL, {**settings, "Loads/Nodal force": f"{hand['fx']:.17g}; {hand['fy']:.17g}; {force:.17g}",
                                     "Loads/Nodal force on": "vertex 28", "Time/Steps": 401})
    close(loaded.probes()[-1]["tip.uz"], probe["tip.uz"], 1e-8, "displacement by a force of the spring's size")

# A held vertex feels what a spring would have to pull with, to be where it is.
held = live(LINEAR, ["hold 28 2 0 2", f"move 28 2 0 {2 + probe['tip.uz']:.17g} over 1", 400])
grip = held.table("hands.csv")[-1]
runner.check(grip["holds"] == 1 and abs(grip["z"] - 2 - probe["tip.uz"]) < 1e-12, f"the held vertex is at {grip['z']}")
pulled = live(LINEAR, ["grab 28 2 0 2.4 by 28 1e6 0 0 0", 400]).table("hands.csv")[-1]
straight = live(LINEAR, ["hold 28 2 0 2", f"move 28 {pulled['x']:.17g} {pulled['y']:.17g} {pulled['z']:.17g} over 1", 400]).table("hands.csv")[-1]
close(straight["fz"], pulled["fz"], 1e-6, "reaction of a held vertex beside the spring's force there")

# Work: what the hand has put in is in the energies, whatever is changed on the way.
for method in ("backward euler", "trbdf2", "imex3"):
    busy = live({"Time/Step": 0.01, "Time/Method": method, "Solver/Tolerance": 1e-13, "Start/Velocity": "0; 0; -1", "Probes/Points": "tip: 2, 0, 2"},
                [5, "grab 28 2 0 2 by 28 1e9 0 0 0", "move 28 2 0 2.3 over 0.05", 10, "set Material/Young modulus=5e7", 5, "move 28 2 0.1 1.8 over 0.03", 5, "set Loads/Gravity=0, 5, 0", 5,
                 "release 28", 10])
    rows = busy.history()
    scale = max(row["total"] + abs(row["work"]) for row in rows)
    balance = [row["total"] + row["dissipated"] - row["work"] for row in rows]
    runner.check(max(balance) - min(balance) < 1e-9 * scale, f"{method}: the balance moves by {max(balance) - min(balance)} of {scale}")
    losses = [b["dissipated"] - a["dissipated"] for a, b in zip(rows, rows[1:])]
    runner.check(method != "backward euler" or min(losses) > -1e-9 * scale, f"{method}: it gains {-min(losses)} of {scale}")

# A free body without weight: once it is let go, its momentum stays.
free = live({"Constraints/Clamped boundaries": "", "Loads/Gravity": "0, 0, 0", "Start/Velocity": "0; 0; 0", "Time/Step": 0.02,
             "Solver/Tolerance": 1e-14}, ["grab 28 2 0 2 by 28 1e9 0 0 0", "move 28 2 0 3 over 0.1", 10, "release 28", 20])
rows = free.history()
last = rows[-1]
runner.check(abs(last["pz"]) > 1e3, f"the hand has given a momentum of {last['pz']}")
for name in ("px", "py", "pz"):
    drift = max(abs(row[name] - last[name]) for row in rows[12:])
    runner.check(drift < 1e-9 * abs(last["pz"]), f"{name} drifts by {drift}")

# A step that is halved in a session is that of a scene that starts there.
halved = live({"Time/Step": 0.02, "Solver/Tolerance": 1e-13}, [1, "set Time/Step=0.01", 20])
times = [row["time"] for row in halved.history()]
runner.check(math.isclose(times[-1], 0.02 + 20 * 0.01, rel_tol=1e-12) and len(times) == 22, f"steps end at {times[-3:]}")

# A spring pulls as hard with semi-implicit methods, whose splitting it is part of, as with an implicit one of their order.
QUICK = {"Time/Step": 0.002, "Solver/Tolerance": 1e-13, "Start/Velocity": "0; 0; -1"}
PULL = ["grab 28 2 0 2 by 28 1e9 0 0 0", "move 28 2 0.05 2.1 over 0.04", 40]


def forces(method, settings=None):
    return [(row["fx"], row["fy"], row["fz"]) for row in live({**QUICK, "Time/Method": method, **(settings or {})}, PULL).table("hands.csv")]


wanted = forces("esdirk4")
largest = max(math.hypot(*force) for force in wanted)
for method, part in (("imex3", 0.4), ("imex4", 0.02), ("imex5", 0.4)):  # how a stiff spring rings differs
    worst = max(math.dist(one, other) for one, other in zip(forces(method), wanted))
    runner.check(worst < part * largest, f"{method}: a force of the spring is {worst} N from that of esdirk4, of {largest} N")

# The work of a hand is what its force does on its way, by the tables alone; so is that of a hand that holds.
for method in ("backward euler", "trbdf2"):
    for taken in (PULL, ["hold 28 2 0 2", *PULL[1:]]):
        way = live({**QUICK, "Start/Velocity": "0; 0; 0", "Loads/Gravity": "0, 0, 0", "Time/Method": method}, taken)
        hands, rows = way.table("hands.csv"), way.history()
        work, before = 0.0, None
        for now in hands:
            if before:
                mean = [now[c] if method == "backward euler" else 0.5 * (before[c] + now[c]) for c in ("fx", "fy", "fz")]
                work += sum(f * (now[c] - before[c]) for f, c in zip(mean, "xyz"))
            before = now
        close(rows[-1]["work"], work, 0.05, f"{method}, {taken[0][:4]}: work of the hand beside that of its force")
