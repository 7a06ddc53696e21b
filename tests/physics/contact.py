"""Bodies that touch tools, each other and themselves: Hertz's force, friction on an incline, impact, weight, patches, momentum, folds, and
nothing that passes through anything, whatever happens. The second argument is the part of the test to run."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import contact_solutions
import runner
import vtu

CONTACT = runner.ROOT / "parameters" / "contact"
HERTZ, INCLINE, BOUNCE, SKIN = [CONTACT / f"{name}.prm" for name in ("hertz", "incline", "bounce", "needle-skin")]
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
quiet = {"Output/Frames": "none", "Output/Report": "false"}
SOFT = """subsection Material
  set Young modulus = 1e5
  set Poisson ratio = 0.3
  set Density       = 1000
end
"""
CUBE = folder / "cube.prm"
CUBE.write_text(f"""# a soft cube above a floor
subsection Mesh
  set Box origin = 0, 0, 0.02
  set Box size   = 0.1, 0.1, 0.1
  set Box cubes  = 3, 3, 3
end
{SOFT}subsection Loads
  set Gravity = 0, 0, -9.81
end
subsection Tool floor
  set Shape = plane
end
subsection Time
  set Step  = 0.01
  set Steps = 60
end
""")
NEEDLE = folder / "needle.prm"
NEEDLE.write_text(f"""# a needle thinner than a cell is pushed into a block
subsection Mesh
  set Box origin = -0.05, -0.05, -0.1
  set Box size   = 0.1, 0.1, 0.1
  set Box cubes  = 4, 4, 4
end
{SOFT}subsection Constraints
  set Clamped boundaries = 4
end
subsection Tool needle
  set Shape    = capsule
  set Radius   = 0.001
  set Axis     = 0.02, 0, 0.1
  set Position = 0.005; 0.0035; 0.001 - min(t, 0.02)
end
subsection Time
  set Step  = 0.001
  set Steps = 22
end
""")


def simulate(scene, settings=None, ranks=1):
    results = runner.simulate(scene, {**quiet, **(settings or {})}, ranks=ranks)
    runner.check(all(row["min_gap"] > 0 for row in results.history()), f"{settings}: the body is within a tool")
    return results


def balance(history):
    """What is missing in the balance of energies, over the largest of them."""
    size = max(abs(row[name]) for row in history for name in ("kinetic", "elastic", "potential", "work", "dissipated"))
    start = history[0]["total"]
    return max(abs(row["total"] + row["dissipated"] + row["rubbed"] - row["work"] - start) for row in history) / size


def hertz():
    """Hertz: the force of a sphere on a half-space goes with the depth to the power 1.5, on quadratic cells and on linear ones."""
    for settings, limit in (({}, 0.01), ({"Mesh/Order": 1, "Mesh/Box cubes": "16, 16, 16", "Time/Steps": 2}, 0.035)):
        for row in simulate(HERTZ, settings).table("tool_sphere.csv")[1:]:
            exact = 36.630037 * row["time"] ** 1.5
            runner.check(abs(-4 * row["fz"] / exact - 1) < limit, f"{settings}: {-4 * row['fz']} N instead of {exact} N at {row['time']}")
    # The pressure, also on the edges and the corner of the quarter, where it is shared with faces that touch nothing; on two processes too.
    for settings, limits in (({}, (0.06, 0.15)), ({"Mesh/Order": 1, "Mesh/Box cubes": "16, 16, 16"}, (0.06, 0.09))):
        frames = []
        for ranks in (1, 2):
            pressed = runner.simulate(HERTZ, {"Output/Report": "false", "Time/Steps": 1, "Solver/Tolerance": 1e-10, **settings}, ranks=ranks)
            frames.append([vtu.Frame(file) for file in sorted((pressed.folder / "solution").glob("frame_0001*.vtu"))])
        middle, worst = contact_solutions.errors_of_pressure(frames[0][0])
        runner.check(abs(middle) < limits[0] and worst < limits[1], f"{settings}: the pressure is {middle} off in the middle, {worst} at most")
        one, two = ({tuple(round(x, 6) for x in place): p for frame in list_of for place, p in zip(frame.points, frame.of_points["contact_pressure"])}
                    for list_of in frames)
        differs = max(abs(one[place] - two[place]) for place in one) / contact_solutions.HERTZ_PRESSURE
        runner.check(len(one) == len(two) and differs < 1e-4, f"{settings}: on two processes pressures differ by {differs}")


def mindlin():
    """Cattaneo and Mindlin: a sphere that is moved sideways sticks in the middle and slips around it; the force and the radius are known."""
    pushed = simulate(CONTACT / "mindlin.prm", {"Output/Frames": "every"})
    states = [vtu.Frame(file) for file in sorted((pushed.folder / "solution").glob("*.vtu"))]
    for row, state in list(zip(pushed.table("tool_sphere.csv"), states))[2:]:
        load, force = contact_solutions.mindlin_load(row["time"]), 2 * row["fx"] / contact_solutions.MINDLIN_LIMIT
        runner.check(abs(force - load) < 0.02, f"{force} of the force at which all slides instead of {load}")
        radius = contact_solutions.stick_radius(state, states[1], row["time"])
        runner.check(abs(radius - (1 - load) ** (1 / 3)) < 0.12, f"with {load} it sticks within {radius} a")


def ironing():
    """A die that goes over cells feels them little: less than 3 % of its force, with friction too, which is that of Coulomb then."""
    for settings, n_begin in (({"Time/Steps": 84}, 4), ({"Tool die/Friction": 0.3, "Contact/Slip resolution": 2e-4}, 24)):
        ironed = simulate(CONTACT / "ironing.prm", settings)
        rows = ironed.table("tool_die.csv")[n_begin:]
        whole, period = contact_solutions.variation([row["fy"] for row in rows], 20)
        runner.check(whole < 0.03 and 1e-4 < period < 0.02, f"{settings}: the force varies by {whole}, within a cell by {period}")
        ratio = sum(row["fx"] for row in rows) / -sum(row["fy"] for row in rows)
        runner.check(abs(ratio - settings.get("Tool die/Friction", 0)) < 0.015, f"{settings}: sideways {ratio} of the force down")


def friction():
    """A block on an incline slides with g (sin - mu cos), all of the work of friction is heat; a flatter one holds it, but for its creep."""
    slides = simulate(INCLINE)
    history, plane = slides.history(), slides.table("tool_plane.csv")
    a, b = history[40], history[100]
    acceleration = (b["px"] - a["px"]) / (b["time"] - a["time"])
    runner.check(abs(acceleration / (3.643338 - 0.3 * 9.108346) - 1) < 1e-6, f"it slides with {acceleration} m/s^2")
    runner.check(abs(plane[-1]["fx"] / plane[-1]["fz"] + 0.3) < 1e-6 and abs(plane[-1]["fz"] / 9.108346 - 1) < 1e-6, "forces of the plane")
    way = [row["block.ux"] for row in slides.probes()]
    rubbed = b["rubbed"] - a["rubbed"]
    runner.check(abs(rubbed / (0.3 * 9.108346 * (way[100] - way[40])) - 1) < 1e-5, f"{rubbed} J became heat")
    runner.check(balance(history) < 1e-12, f"sliding: energies out of balance by {balance(history)}")
    for scale in (1, 10):  # the same in other units
        settings = {"Loads/Gravity": "1.923879, 0, -9.619397"}
        if scale != 1:
            settings = {"Loads/Gravity": "19.23879, 0, -96.19397", "Mesh/Box size": "1, 1, 1", "Material/Density": 10,
                        "Contact/Slip resolution": 1e-2, "Probes/Points": "block: 1, 1, 1"}
        holds = simulate(INCLINE, settings)
        creep = holds.probes()[-1]["block.vx"] / scale
        exact = 1e-3 * (1 - math.sqrt(1 - 0.2 / 0.3))
        runner.check(abs(creep / exact - 1) < 1e-5, f"creeps with {creep} m/s instead of {exact} m/s")
        runner.check(abs(holds.summary()["contact"]["creep"] / scale / exact - 1) < 1e-5, "the creep in summary.json")
        runner.check(balance(holds.history()) < 1e-9, f"holding: energies out of balance by {balance(holds.history())}")

    # A plane that moves carries the block along; its work becomes motion and heat.
    carried = simulate(INCLINE, {"Loads/Gravity": "0, 0, -9.81", "Tool plane/Position": "0.2*t^2; 0; 0"})
    history = carried.history()
    runner.check(abs(carried.probes()[-1]["block.vx"] / 0.2 - 1) < 0.01, f"{carried.probes()[-1]['block.vx']} m/s on a plane with 0.2 m/s")
    runner.check(balance(history) < 1e-10 and history[-1]["work"] > 0.9 * 0.5 * 0.2**2, f"carried: {balance(history)}")
    runner.check(abs(carried.table("tool_plane.csv")[-1]["work"] - history[-1]["work"]) < 1e-12, "work of the tool")


def trouble():
    """What friction makes hard to find is told, and what can't be found at all is told by its names and places, with all files."""
    hard = {"Tool floor/Friction": 0.3, "Time/Steps": 12}
    # Whether such steps are found in the end is a matter of round-off; the warning is not.
    results = folder / "hard"
    status, _, error = runner.run(CUBE, "--quiet", "--output", results,
                                  *runner.overrides({**hard, "Contact/Slip resolution": 1e-5, "Time/Newton iterations": 30}))
    runner.check(status == 0 or status == 2 and "the least gap" in error, f"{status}: {error}")
    words = " ".join(runner.Results(results).summary()["warnings"])
    runner.check("Friction makes steps hard to find" in words and "Contact/Slip resolution is 1e-05 m/s" in words, f"no warning of friction: {words}")
    words = " ".join(simulate(CUBE, {**hard, "Contact/Slip resolution": 0.1}).summary()["warnings"])
    runner.check("Friction makes" not in words, f"a warning of friction that is easy: {words}")

    held = folder / "held.prm"
    held.write_text(f"""# two blocks whose faces are held and driven into each other
subsection Mesh
  set Box size         = 0.1, 0.1, 0.1
  set Box cubes        = 3, 3, 3
  set Piece maps       = x; y; z | 0.02 + x; y; z + 0.105
  set Boundary regions = 7: abs(z - 0.1) < 1e-9; 8: abs(z - 0.105) < 1e-9
end
{SOFT}subsection Constraints
  set Clamped boundaries = 7
end
subsection Motion
  set Of           = boundary 8
  set Displacement = 0; 0; -0.02*t
end
subsection Contact
  set Bodies = pieces
end
""")
    for settings, last in (({"Time/Problem": "static", "Time/Steps": 20}, 0.25), ({"Time/Step": 0.05, "Time/Steps": 10}, 0.25)):
        results = folder / f"held-{settings.get('Time/Problem')}"
        status, _, error = runner.run(held, "--quiet", "--output", results, *runner.overrides(settings))
        runner.check(status == 2 and all(word in error for word in ("piece 1, boundary 7, vertex", "piece 2, boundary 8, vertex", "can't be")), error)
        history = runner.Results(results).history()
        runner.check(0.2 - 1e-9 < history[-1]["time"] < last and (results / "summary.json").exists() and (results / "report.html").exists(),
                     f"it ended at {history[-1]['time']}")
        runner.check(len(runner.Results(results).frame_times()) > 1, "frames are missing")


def impact():
    """Impact of a bar: it takes 2 L/c, and gives the momentum back, which then stays what it is."""
    bounce = simulate(BOUNCE)
    history = bounce.history()
    touching = [row["time"] for row in bounce.table("tool_wall.csv") if row["fx"] > 1]
    runner.check(abs(touching[-1] - touching[0] + 0.001 - 0.02) < 0.0011, f"it touches from {touching[0]} to {touching[-1]} s")
    runner.check(0.93 < -history[-1]["px"] / history[0]["px"] < 1, f"rebound: {history[-1]['px'] / history[0]['px']}")
    after = [row["px"] for row in history if row["time"] > touching[-1] + 0.003]
    runner.check(len(after) > 10 and max(after) - min(after) < 1e-10 * abs(after[0]), "the momentum changes in free flight")
    impulse = sum(row["fx"] for row in bounce.table("tool_wall.csv")) * 0.001
    runner.check(abs(impulse / (history[-1]["px"] - history[0]["px"]) - 1) < 0.05, f"impulse {impulse}")
    warned = " ".join(simulate(BOUNCE, {"Time/Method": "backward euler"}).summary()["warnings"])
    runner.check("how fast it rebounds depends on the step" in warned, "no warning of backward Euler")


def rest():
    """A cube comes to rest on the floor, which bears its weight; on one, two and four processes, with threads, and after a checkpoint."""
    exact = {"Solver/Tolerance": 1e-12}
    rest = simulate(CUBE, exact)
    history, last = rest.history(), rest.table("tool_floor.csv")[-1]
    runner.check(abs(last["fz"] / 9.81 - 1) < 1e-8 and abs(last["tx"] / (0.05 * 9.81) - 1) < 1e-7, f"weight: {last}")
    runner.check(abs(last["area"] / 0.01 - 1) < 0.2 and 0 < last["depth"] < 1e-4, f"area and depth: {last}")
    runner.check(balance(history) < 1e-12, f"falling: energies out of balance by {balance(history)}")
    columns = ["total", "dissipated", "contact", "px", "pz", "ly"]
    for settings, ranks in (({"Solver/Method": "cg-ml"}, 2), ({"Solver/Method": "cg-ml"}, 4), ({"Solver/Threads": 2}, 1)):
        other = simulate(CUBE, {**exact, **settings, "Time/Steps": 25}, ranks)  # it touches at 7
        for table, names in (("history.csv", columns), ("tool_floor.csv", ["fx", "fz", "tx", "min_gap", "work"])):
            difference = runner.largest_difference(rest.table(table)[:26], other.table(table), names)
            runner.check(difference < 1e-8, f"{settings} on {ranks} processes: {table} differs by {difference}")
    for scene, tool in ((CUBE, "floor"), (INCLINE, "plane"), (NEEDLE, "needle")):
        whole = simulate(scene, exact)
        half = len(whole.history()) // 2
        resumed = folder / f"resumed-{tool}"
        for steps in (half, len(whole.history()) - 1):
            status, _, error = runner.run(scene, "--quiet", "--output", resumed, *runner.overrides(
                {**quiet, **exact, "Checkpoint/Every": 5, "Checkpoint/Resume": "auto", "Time/Steps": steps}))
            runner.check(status == 0, error)
        for table, names in (("history.csv", ["total", "contact", "work", "rubbed", "min_gap"]), (f"tool_{tool}.csv", ["fx", "fz", "ty", "work"])):
            difference = runner.largest_difference(whole.table(table), runner.Results(resumed).table(table), names)
            runner.check(difference < 1e-12, f"{tool}: {table} differs by {difference} after a checkpoint")


def thin():
    """A needle thinner than a cell does not pass between vertices, nor does a fall of 50 m/s in steps longer than the body."""
    needle = simulate(NEEDLE)
    runner.check(min(row["fz"] for row in needle.table("tool_needle.csv")) < -5, "the needle went through the block")
    runner.check(balance(needle.history()) < 1e-8, f"needle: energies out of balance by {balance(needle.history())}")
    thrown = {"Mesh/Box origin": "0, 0, 0.3", "Start/Velocity": "3; 1; -50", "Start/Rotation": "20, 30, 10",
              "Start/Rotation center": "0.05, 0.05, 0.35", "Time/Steps": 20}
    for step in (0.07, 0.005):
        runner.check(balance(simulate(CUBE, {**thrown, "Time/Step": step}).history()) < 1e-10, f"thrown in steps of {step} s")


def plane():
    """A plane body is met by its edges: the same cube, once as a square in plane strain."""
    SQUARE = folder / "square.prm"
    SQUARE.write_text(CUBE.read_text().replace("set Box origin = 0, 0, 0.02", "set Shape = rectangle\n  set Rectangle origin = 0, 0.02")
                      .replace("set Box size   = 0.1, 0.1, 0.1", "set Rectangle size = 0.1, 0.1")
                      .replace("set Box cubes  = 3, 3, 3", "set Rectangle squares = 3, 3").replace("0, 0, -9.81", "0, -9.81, 0")
                      .replace("set Shape = plane", "set Shape = plane\n  set Normal = 0, 1, 0"))
    square = simulate(SQUARE)
    runner.check(abs(square.table("tool_floor.csv")[-1]["fy"] / 98.1 - 1) < 1e-8, "weight of a plane body")
    for tool, settings in (("sphere", {}), ("capsule", {"Tool floor/Axis": "0.02, -0.2, 0"})):
        over = simulate(SQUARE, {"Tool floor/Shape": tool, "Tool floor/Radius": 0.002, "Tool floor/Position": "0.045; 0.01; 0", **settings,
                                 "Time/Step": 0.002, "Time/Steps": 40})
        runner.check(max(row["fy"] for row in over.table("tool_floor.csv")) > 1, f"the square passes a {tool} between two vertices")

    # Where nothing touches, a linear body needs a single factorization.
    far = simulate(CUBE, {"Corotation/Rotation": "none", "Tool floor/Position": "0; 0; -10"})
    runner.check(far.summary()["built"]["factorizations"] == 1, f"{far.summary()['built']['factorizations']} factorizations far from tools")


def write_box(path, size):
    """A closed surface of triangles, in millimeters."""
    corners = [[500 * size[i] * (1 if k >> i & 1 else -1) for i in range(3)] for k in range(8)]
    faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
    path.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces))


def shapes():
    """A box and triangles of a file bear a cube as a plane does, and turn it over; a ball that spins in place drags what it touches."""
    write_box(folder / "table.obj", (0.3, 0.3, 0.02))
    box = {"Tool floor/Shape": "box", "Tool floor/Size": "0.3, 0.3, 0.02", "Tool floor/Position": "0.05; 0.05; -0.01"}
    triangles = {"Tool floor/Shape": "file", "Tool floor/File": "table.obj", "Tool floor/Scale": 0.001, "Tool floor/Position": "0.05; 0.05; -0.01"}
    weight = {}
    for name, settings in (("box", box), ("triangles", triangles)):
        rest = simulate(CUBE, {**settings, "Solver/Tolerance": 1e-12})
        last = rest.table("tool_floor.csv")[-1]
        runner.check(abs(last["fz"] / 9.81 - 1) < 1e-7 and abs(last["tx"]) + abs(last["ty"]) < 2e-3, f"{name}: weight {last}")
        runner.check(balance(rest.history()) < 1e-9, f"{name}: energies out of balance by {balance(rest.history())}")
        weight[name] = last["fz"]
        small = {"Tool floor/Size": "0.02, 0.02, 0.02"} if name == "box" else {"Tool floor/Scale": 1e-4}
        over = simulate(CUBE, {**settings, **small, "Tool floor/Position": "0.02; 0.05; -0.01", "Tool floor/Rotation": "0; 0; 20", "Time/Step": 0.005, "Time/Steps": 60})
        runner.check(balance(over.history()) < 1e-8, f"{name}: turned over, {balance(over.history())}")
        turned = over.history()[-1]
        runner.check(abs(turned["lx"]) + abs(turned["ly"]) > 1e-4, f"{name}: it does not turn over the edge: {turned}")

    ball = {"Tool floor/Shape": "sphere", "Tool floor/Radius": 0.02, "Tool floor/Friction": 0.3, "Loads/Gravity": "0, 0, 0",
            "Constraints/Clamped boundaries": "5", "Contact/Slip resolution": 1e-3, "Time/Step": 1e-3, "Time/Steps": 40}
    spun = simulate(CUBE, {**ball, "Tool floor/Position": "0.05; 0.05; min(0.1*t, 0.002)", "Tool floor/Rotation": "2000*max(t - 0.02, 0); 0; 0"})
    last = spun.table("tool_floor.csv")[-1]
    runner.check(abs(abs(last["fy"] / last["fz"]) - 0.3) < 0.04, f"a ball that spins drags by {last['fy']} N where it presses by {last['fz']} N")
    runner.check(abs(abs(last["tx"] / (0.02 * last["fy"])) - 1) < 0.15, f"its torque is {last['tx']} N m")
    runner.check(balance(spun.history()) < 1e-10, f"spun: energies out of balance by {balance(spun.history())}")


def patch():
    """Two blocks of different meshes are pressed together: the stress is the same everywhere, but for some error by the guards."""
    for name, cubes, height in (("below", "4, 4, 4", 0), ("above", "6, 6, 6", 0.1001)):
        scene = folder / f"{name}.prm"
        scene.write_text(f"subsection Mesh\n set Box size = 0.1, 0.1, 0.1\n set Box cubes = {cubes}\n set Box origin = 0, 0, {height}\nend\n{SOFT}")
        status, _, error = runner.run(scene, "--quiet", "--output", folder / name, *runner.overrides(
            {**quiet, "Output/Mesh": "true", "Time/Steps": 1}))
        runner.check(status == 0, error)
    both = folder / "patch.prm"
    both.write_text(f"""subsection Mesh
  set Shape            = file
  set File             = below/mesh.msh, above/mesh.msh
  set Boundary regions = 9: z < 1e-9
end
{SOFT}subsection Corotation
  set Rotation = none
end
subsection Contact
  set Bodies = pieces
  set Reach  = 0.0001
end
subsection Constraints
  set Boundaries held along x = 0
  set Boundaries held along y = 2
  set Boundaries held along z = 9
end
subsection Motion
  set Of           = region z > 0.2000999
  set Displacement = free; free; -0.002*t
end
subsection Time
  set Problem = static
  set Steps   = 2
end
""")
    for guard, limit in ((0.1, 0.02), (0.01, 0.01)):
        pressed = simulate(both, {"Contact/Guard": guard, "Output/Frames": "adaptive"})
        stress = vtu.Frame(sorted((pressed.folder / "solution").glob("*.vtu"))[-1]).of_cells["von_mises_stress"]
        mean = sum(stress) / len(stress)
        worst = max(abs(value / mean - 1) for value in stress)
        runner.check(900 < mean < 1000 and worst < limit, f"guard {guard}: stresses of {mean} Pa differ by {worst}")


def bodies():
    """A stack rests on the floor by friction; two balls that meet keep their momenta, in any units."""
    stack = simulate(CONTACT / "stack.prm", {"Time/Step": 0.05, "Time/Steps": 40})
    weight = stack.table("tool_floor.csv")[-1]["fz"]
    runner.check(abs(weight / 29.43 - 1) < 1e-4, f"the stack weighs {weight} N")
    top = stack.probes()[-1]
    runner.check(max(abs(top[f"top.v{i}"]) for i in "xyz") < 1e-4 and abs(top["top.ux"]) + abs(top["top.uy"]) < 2e-3, f"the stack moves: {top}")
    runner.check(balance(stack.history()) < 1e-10, f"stack: energies out of balance by {balance(stack.history())}")

    balls = folder / "balls.prm"
    balls.write_text((CONTACT / "two-spheres.prm").read_text().replace("8, 8, 8", "4, 4, 4"))
    exact = {"Solver/Tolerance": 1e-12, "Time/Step": 0.002, "Time/Steps": 40, "Time/Method": "backward euler"}
    met = simulate(balls, exact)
    history = met.history()
    kept = max(abs(row[name] - history[0][name]) for row in history for name in ("px", "py", "pz"))
    runner.check(kept < 1e-12 and max(row["contact"] for row in history) > 0, f"the momentum changes by {kept}")
    turning = simulate(balls, {**exact, "Time/Method": "trbdf2"}).history() # backward Euler damps what turns
    turn = max(abs(row[f"l{i}"] - history[0][f"l{i}"]) for row in turning for i in "xyz")
    runner.check(turn < 2e-3 * abs(history[0]["ly"]), f"the angular momentum changes by {turn} of {history[0]['ly']}")
    runner.check(balance(history) < 1e-7, f"balls: energies out of balance by {balance(history)}")
    large = simulate(balls, {**exact, "Mesh/Map": "10*x; 10*y; 10*z", "Start/Velocity": "if(x < 0, 5, -5); 0; 0", "Material/Young modulus": 1e7})
    for a, b in zip(history, large.history()):
        runner.check(abs(a["contact"] * 1e5 - b["contact"]) < 1e-7 * history[0]["kinetic"] * 1e5, f"in other units: {b['contact']} J")
    half = folder / "resumed-balls"
    for steps in (20, 40):
        status, _, error = runner.run(balls, "--quiet", "--output", half, *runner.overrides(
            {**quiet, **exact, "Checkpoint/Every": 5, "Checkpoint/Resume": "auto", "Time/Steps": steps}))
        runner.check(status == 0, error)
    difference = runner.largest_difference(history, runner.Results(half).history(), ["kinetic", "elastic", "contact", "px"])
    runner.check(difference < 1e-9, f"balls: history.csv differs by {difference} after a checkpoint")


def folds():
    """A hairpin is pressed flat on itself, in space and in the plane, and nothing passes through anything."""
    fold = simulate(CONTACT / "fold.prm", {"Mesh/Box cubes": "32, 1, 1", "Time/Steps": 90,
                                                 "Probes/Points": "upper: -0.038, 0.01, 0.004; lower: -0.038, 0.01, -0.004"})
    runner.check(max(row["contact"] for row in fold.history()) > 0 and max(row["inverted"] for row in fold.history()) == 0, "no fold")
    runner.check(balance(fold.history()) < 1e-7, f"fold: energies out of balance by {balance(fold.history())}")
    legs = [0.008 + row["upper.uz"] - row["lower.uz"] for row in fold.probes()]
    runner.check(0 < min(legs) < 0.0005, f"the legs come as near as {min(legs)} m")

    # In the plane: the upper end of an open ring is pushed into the ring, and takes the lower half along, which nothing else touches.
    ring = folder / "ring.prm"
    ring.write_text(f"""subsection Mesh
  set Shape             = rectangle
  set Rectangle size    = 1, 0.004
  set Rectangle squares = 40, 2
  set Map               = (0.02 + y)*cos(0.3 + 5.68*x); (0.02 + y)*sin(0.3 + 5.68*x); 0
end
{SOFT}subsection Constraints
  set Clamped region = x < -0.0195 && abs(y) < 0.003
end
subsection Contact
  set Bodies = all
end
subsection Tool jaw
  set Shape    = box
  set Size     = 0.03, 0.01, 0.01
  set Position = 0.01; 0.0301 - 0.02*t; 0
end
subsection Time
  set Method = implicit backward euler
  set Step   = 0.01
  set Steps  = 80
end
subsection Probes
  set Points = upper: 0.0191, 0.0059, 0; lower: 0.0191, -0.0059, 0
end
""")
    closed = simulate(ring, {"Mesh/Order": 1})
    ends = closed.probes()[-1]
    runner.check(ends["lower.uy"] < -0.01, f"the lower end of the ring is not pushed down: {ends}")
    runner.check(balance(closed.history()) < 1e-7, f"ring: energies out of balance by {balance(closed.history())}")


globals()[sys.argv[2]]()
