"""Bodies of triangles in plane strain, plane stress and around an axis, against exact solutions."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import vtu

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
E, NU, LOAD = 1e6, 0.3, 1e4
PLATE = folder / "plate.prm"
PLATE.write_text("""# a plate of 4 x 12 m between two planes of symmetry
subsection Mesh
  set Shape             = rectangle
  set Rectangle size    = 4, 12
  set Rectangle squares = 3, 7
  set Rectangle split   = alternating
end
subsection Material
  set Young modulus = 1e6
  set Poisson ratio = 0.3
end
subsection Corotation
  set Rotation = none
end
subsection Constraints
  set Boundaries held along x = 0
  set Boundaries held along y = 2
end
subsection Time
  set Problem = static
  set Steps   = 1
end
subsection Solver
  set Tolerance = 1e-12
end
subsection Probes
  set Points     = far: 4, 12, 0
  set Boundaries = low: 2; left: 0
end
""")
MODELS = ["plane strain", "plane stress", "axisymmetric"]


def section(model):
    """Entries of a model, and the area of the end y = 0."""
    if model == "axisymmetric":
        return {"Plane/Model": model}, math.pi * 4**2
    return {"Plane/Model": model, "Plane/Thickness": 0.25}, 4 * 0.25


def near(found, expected, tolerance, what, size=0):
    """Measured by the size of what is expected, or by another one."""
    runner.check(abs(found - expected) <= tolerance * max(abs(expected), size), f"{what}: {found} instead of {expected}")


# Uniform strain, exact for linear triangles: pulled along y, and pressed from all sides.
pulled = {"Loads/Traction": f"0; {LOAD}; 0", "Loads/Traction on": 3}
pressed = {"Loads/Pressure": LOAD, "Loads/Pressure on": "0, 1, 2, 3", "Loads/Pressure follows": "false"}
STRAINS = {("plane strain", "pulled"): (-NU * (1 + NU), 1 - NU**2), ("plane stress", "pulled"): (-NU, 1),
           ("axisymmetric", "pulled"): (-NU, 1), ("plane strain", "pressed"): 2 * [-(1 + NU) * (1 - 2 * NU)],
           ("plane stress", "pressed"): 2 * [NU - 1], ("axisymmetric", "pressed"): 2 * [2 * NU - 1]}
for (model, load), strain in STRAINS.items():
    entries, area = section(model)
    solvers = [("ldlt", 1, "alternating")]
    if load == "pulled":
        solvers = [("ldlt", 1, "falling"), ("cholmod", 1, "rising"), ("cg-ml", 2, "alternating"), ("cg-jacobi", 1, "rising")]
    for solver, ranks, split in solvers:
        last = runner.simulate(PLATE, {**entries, **(pulled if load == "pulled" else pressed), "Solver/Method": solver,
                                       "Mesh/Rectangle split": split}, ranks=ranks).probes()[-1]
        what = f"{model}, {load}, {solver} on {ranks}, {split}"
        near(last["far.ux"], strain[0] * LOAD / E * 4, 1e-9, what)
        near(last["far.uy"], strain[1] * LOAD / E * 12, 1e-9, what)
        near(last["low.fy"], -LOAD * area if load == "pulled" else 0, 1e-9, what, LOAD * area)
        runner.check(last["far.uz"] == 0, f"{what}: it leaves the plane")

# Weight: the end below bears it, in the middle between the walls too.
for model in MODELS:
    entries, area = section(model)
    weight = runner.simulate(PLATE, {**entries, "Loads/Gravity": "0, -10, 0", "Material/Density": 500}).probes()[-1]
    near(weight["low.fy"], 12 * area * 5000, 1e-9, f"weight, {model}")
    force = runner.simulate(PLATE, {**entries, "Loads/Body force": "0; -5000; 0"}).probes()[-1]
    near(force["low.fy"], 12 * area * 5000, 1e-9, f"body force, {model}")


def write_ring(name, n):
    """A quarter of a ring, 1 <= r <= 2, as a .msh file: curves 1 (inside), 2 (y = 0), 3 (x = 0)."""
    size = 3 * n // 2
    vertices = [((1 + i / n) * math.cos(j * math.pi / 2 / size), (1 + i / n) * math.sin(j * math.pi / 2 / size))
                for j in range(size + 1) for i in range(n + 1)]
    def vertex(i, j):
        return i + (n + 1) * j + 1
    elements = []
    for j in range(size):
        for i in range(n):
            a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
            # Cut like a chessboard; the first triangle of each pair the wrong way round.
            elements += [(2, 7, (b, a, d)), (2, 7, (b, c, d))] if (i + j) % 2 else [(2, 7, (b, a, c)), (2, 7, (a, c, d))]
    elements += [(1, 1, (vertex(0, j), vertex(0, j + 1))) for j in range(size)]
    elements += [(1, 2, (vertex(i, 0), vertex(i + 1, 0))) for i in range(n)]
    elements += [(1, 3, (vertex(i, size), vertex(i + 1, size))) for i in range(n)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", len(vertices)]
    lines += [f"{i} {x:.17g} {y:.17g} 0" for i, (x, y) in enumerate(vertices, 1)] + ["$EndNodes", "$Elements", len(elements)]
    lines += [f"{i} {kind} 2 {group} {group} {' '.join(map(str, nodes))}" for i, (kind, group, nodes) in enumerate(elements, 1)]
    (folder / name).write_text("\n".join(map(str, lines)) + "\n$EndElements\n")
    return name


def second_order(what, exact, solve):
    errors = [abs(solve(n) / exact - 1) for n in (4, 8, 16, 32)]
    orders = [math.log2(coarse / fine) for coarse, fine in zip(errors, errors[1:])]
    print(f"{what}: errors {' '.join(f'{error:.2e}' for error in errors)}, orders {' '.join(f'{order:.2f}' for order in orders)}")
    runner.check(min(orders[1:]) > 1.85 and errors[-1] < 1e-3, f"{what}: errors {errors}, orders {orders}")


# Lame: walls of 1 m about a cavity of 1 m radius under a pressure of 1 Pa.
lame = {"Material/Young modulus": 1000, "Loads/Pressure": 1, "Loads/Pressure follows": "false", "Probes/Boundaries": "",
        "Probes/Points": "inner: 1, 0, 0"}
tube = {**lame, "Plane/Model": "axisymmetric", "Mesh/Rectangle origin": "1, 0", "Loads/Pressure on": 0,
        "Constraints/Boundaries held along x": "", "Constraints/Boundaries held along y": "2, 3"}
ring = {**lame, "Mesh/Shape": "file", "Loads/Pressure on": 1, "Constraints/Boundaries held along x": 3}


def radial(settings):
    return runner.simulate(PLATE, settings).probes()[-1]["inner.ux"]


second_order("cylinder, axisymmetric", 1.906667e-3,
             lambda n: radial({**tube, "Mesh/Rectangle size": "1, 0.25", "Mesh/Rectangle squares": f"{n}, {max(n // 4, 1)}"}))
second_order("cylinder, plane strain", 1.906667e-3,
             lambda n: radial({**ring, "Mesh/File": write_ring(f"ring-{n}.msh", n), "Plane/Thickness": 3}))
plane_stress = 1 / (1000 * 3) * (1 * (1 - NU) + 4 * (1 + NU))
second_order("cylinder, plane stress", plane_stress,
             lambda n: radial({**ring, "Mesh/File": f"ring-{n}.msh", "Plane/Model": "plane stress"}))
second_order("sphere, axisymmetric", 8.0e-4,
             lambda n: radial({**ring, "Mesh/File": f"ring-{n}.msh", "Plane/Model": "axisymmetric",
                               "Constraints/Boundaries held along x": ""}))
follower = {**tube, "Mesh/Rectangle size": "1, 0.25", "Mesh/Rectangle squares": "16, 4", "Loads/Pressure follows": "true"}
ratio = radial(follower) / radial({**follower, "Loads/Pressure follows": "false"})
runner.check(1 + 1e-4 < ratio < 1.005, f"pressure that follows the widening wall: {ratio} of one that does not")

# The same displacement of every vertex in a box and in its cross section: the same energy, large rotations included.
bent = {"Motion/Of": "all", "Motion/Displacement": "0.2*x*y + 0.05*x^3; 0.3*x^2 - 0.1*y^2; 0", "Probes/Boundaries": "",
        "Constraints/Boundaries held along x": "", "Constraints/Boundaries held along y": "", "Probes/Points": ""}
for rotation in ["none", "polar"]:
    flat = {**bent, "Mesh/Rectangle size": "1, 1.5", "Mesh/Rectangle squares": "3, 5", "Mesh/Rectangle split": "rising",
            "Plane/Thickness": 0.7, "Corotation/Rotation": rotation}
    solid = {**bent, "Mesh/Shape": "box", "Mesh/Box size": "1, 1.5, 0.7", "Mesh/Box cubes": "3, 5, 2",
             "Corotation/Rotation": rotation}
    energies = [runner.simulate(PLATE, settings).history()[-1]["elastic"] for settings in (flat, solid)]
    near(energies[0], energies[1], 1e-12, f"energy of a bent plate, {rotation}")

# Turned by any angle a free body bears no force, and it stays where it is.
free = {"Constraints/Boundaries held along x": "", "Constraints/Boundaries held along y": "", "Time/Problem": "dynamic",
        "Time/Step": 0.05, "Time/Steps": 5}
for model in MODELS[:2]:
    for rotation in ["polar", "gram-schmidt"]:
        for angle in [180] if rotation == "gram-schmidt" else [30, 250]:
            turned = {**free, **section(model)[0], "Start/Rotation": f"0, 0, {angle}", "Start/Rotation center": "1, 2, 0",
                      "Corotation/Rotation": rotation}
            results = runner.simulate(PLATE, turned)
            c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
            last = results.probes()[-1]
            for found, expected in [(last["far.ux"], c * 3 - s * 10 - 3), (last["far.uy"], s * 3 + c * 10 - 10)]:
                runner.check(abs(found - expected) < 1e-9, f"turned by {angle}: {found} instead of {expected}")
            runner.check(max(row["elastic"] for row in results.history()) < 1e-18 * E, "a turned body is strained")

# Energies balance whatever moves, pushes and damps; and the same on two processes.
PHYSICAL = ["kinetic", "elastic", "potential", "dissipated", "total", "work", "px", "py", "pz", "lz", "min_volume_ratio",
            "max_volume_ratio"]
CASES = [("none", "consistent", 0), ("polar", "consistent", 0), ("polar", "lumped", 0), ("gram-schmidt", "consistent", 20)]
for model in MODELS:
    for rotation, mass, vertex_mass in CASES:
        gravity = "0, -9.81, 0" if model == "axisymmetric" else "3, -9.81, 0"
        shaken = {**section(model)[0], "Time/Problem": "dynamic", "Time/Step": 0.02, "Time/Steps": 40,
                  "Corotation/Rotation": rotation, "Constraints/Boundaries held along x": "",
                  "Constraints/Boundaries held along y": "", "Constraints/Clamped boundaries": 2,
                  "Motion/Of": "boundary 3", "Motion/Displacement": "free; sin(3*t); free",
                  "Loads/Gravity": gravity, "Loads/Body force": "1e3*x*cos(5*t); 0; 0",
                  "Loads/Pressure": "5e3*sin(4*t)", "Loads/Pressure on": 1, "Start/Velocity": "0.1*x; 2*x; 0",
                  "Damping/Mass factor": 0.3, "Damping/Stiffness factor": 0.002, "Damping/Viscous": 300,
                  "Material/Mass": mass, "Material/Mass per vertex": vertex_mass, "Output/Frames": "none"}
        one = runner.simulate(PLATE, shaken)
        runner.check(all(row["far.uz"] == 0 == row["far.vz"] for row in one.probes()), "out of the plane")
        history = one.history()
        size = max(abs(row[name]) for row in history for name in ("kinetic", "elastic", "potential", "work"))
        sums = [row["total"] + row["dissipated"] - row["work"] for row in history]
        stray = max(abs(value - sums[0]) for value in sums) / size
        what = f"{model}, {rotation}, {mass}, {vertex_mass}"
        runner.check(stray < 1e-10, f"{what}: energies out of balance by {stray}")
        two = runner.simulate(PLATE, shaken, ranks=2)
        difference = max(runner.largest_difference(history, two.history(), PHYSICAL),
                         runner.largest_difference(one.probes(), two.probes(), list(one.probes()[0])[1:]))
        runner.check(difference < 1e-8, f"{what}: one and two processes differ by {difference}")

# Pressure all around does not push a free body away, wherever it has turned to and however deep it is pressed in.
for model in MODELS:
    spinning = {**free, **section(model)[0], "Corotation/Rotation": "polar", "Time/Steps": 40, "Loads/Pressure": "3e5*sin(9*t)",
                "Loads/Pressure on": "1, 2, 3" if model == "axisymmetric" else "0, 1, 2, 3",
                "Start/Velocity": "0; y; 0" if model == "axisymmetric" else "2*(y - 6); -2*(x - 2); 0"}
    history = runner.simulate(PLATE, spinning).history()
    momentum = max(abs(row["py"] - history[0]["py"]) + abs(row["px"] - history[0]["px"]) for row in history)
    energy = max(row["kinetic"] for row in history)
    runner.check(momentum < 1e-9 * energy and energy > 1, f"{model}: pressure moves the body, {momentum}")


# What ParaView gets: triangles, and the stress and volume ratio that each model has.
for model, stress, volume in [("plane strain", math.sqrt(1 - NU + NU**2), (1 - 2 * NU) * (1 + NU)),
                              ("plane stress", 1, 1 - 2 * NU), ("axisymmetric", 1, 1 - 2 * NU)]:
    results = runner.simulate(PLATE, {**pulled, **section(model)[0], "Output/Frames": "every", "Output/Every": 1})
    frame = vtu.Frame(results.folder / "solution" / "frame_0001.vtu")
    runner.check(set(frame.types) == {5}, "not all cells are triangles")
    for value in frame.of_cells["von_mises_stress"]:
        near(value, stress * LOAD, 1e-5, f"{model}: von Mises stress")
    for value in frame.of_cells["volume_ratio"]:
        near(value - 1, volume * LOAD / E, 0.02, f"{model}: volume ratio")
turned = {**free, "Start/Rotation": "0, 0, 100", "Corotation/Rotation": "polar", "Output/Frames": "every", "Time/Steps": 1}
frame = vtu.Frame(runner.simulate(PLATE, turned).folder / "solution" / "frame_0000.vtu")
for value in frame.of_cells["rotation_angle"]:
    near(value, 100, 1e-5, "rotation angle")

# The volume ratio knows how thin a plate in plane stress has become, as the same bar in three dimensions does.
for load, strains in [("pulled", (1, -NU, -NU)), ("pressed", (1 - NU, 1 - NU, -2 * NU))]:
    results = runner.simulate(PLATE, {"Plane/Model": "plane stress", "Output/Frames": "every",
                                      **(pulled if load == "pulled" else pressed)})
    last = results.history()[-1]
    ratio = math.prod(1 + (1 if load == "pulled" else -1) * strain * LOAD / E for strain in strains)
    near(last["min_volume_ratio"] - 1, ratio - 1, 1e-7, f"the least volume ratio, {load}")
    near(last["max_volume_ratio"] - 1, ratio - 1, 1e-7, f"the largest volume ratio, {load}")
