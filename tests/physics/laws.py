"""The laws by an energy: closed forms, motion, ranks, quadratic cells, checkpoints, estimates of the error in space."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner
import vtu

CUBE = """
subsection Mesh
  set Box size  = 1, 1, 1
  set Box cubes = 1, 1, 1
end
subsection Constraints
  set Boundaries held along x = 0
  set Boundaries held along y = 2
  set Boundaries held along z = 4
end
subsection Time
  set Problem          = static
  set Steps            = 4
  set Newton tolerance = 1e-11
end
subsection Probes
  set Boundaries = side: 1; top: 3
end
"""
LAWS = ["fixed corotated", "neo-hookean", "stable neo-hookean", "st venant-kirchhoff", "mooney-rivlin"]
RATIO = 0.6    # c2 / c1
QUIET = {"Output/Frames": "none", "Space/Estimate error": "never"}

cube = pathlib.Path(tempfile.mkdtemp(prefix="supple-")) / "cube.prm"
cube.write_text(CUBE)


def principal_stresses(law, lam, mu, s):
    """dW/ds_i of the stretches s, from the energies of doc/materials.md."""
    J = s[0] * s[1] * s[2]
    I1 = sum(x * x for x in s)

    def stress(i):
        x, rest = s[i], J / s[i]
        if law == "fixed corotated":
            return 2 * mu * (x - 1) + lam * (J - 1) * rest
        if law == "neo-hookean":
            return mu * x - mu * rest + (lam + mu) * (J - 1) * rest
        if law == "stable neo-hookean":
            m = 4 / 3 * mu
            return m * x * (1 - 1 / (I1 + 1)) - 0.75 * m * rest + (lam + 5 / 6 * mu) * (J - 1) * rest
        if law == "st venant-kirchhoff":
            return x * (mu * (x * x - 1) + 0.5 * lam * (I1 - 3))
        c1 = 0.5 * mu / (1 + RATIO)
        c2 = RATIO * c1
        return 2 * c1 * x + 2 * c2 * x * (I1 - x * x) + ((lam + 2 * c1) * (J - 1) - 2 * (c1 + 2 * c2)) * rest

    return [stress(i) for i in range(3)]


def free_stretch(stress, low=0.3, high=2.0):
    """Where an increasing function is zero."""
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stress(middle) < 0 else (low, middle)
    return 0.5 * (low + high)


def pulled(law, lam, mu, stretch, both):
    """The force on the top of the cube pulled along y, or along x and y."""
    settings = {"Material/Law": law, "Material/Mooney ratio": RATIO, "Material/Elastic constants": "Lame", "Material/Lame lambda": lam,
                "Material/Lame mu": mu, "Motion/Of": "boundary 3", "Motion/Displacement": f"free; {stretch - 1}*t; free"}
    if both:
        settings.update({"Motion 2/Of": "boundary 1", "Motion 2/Displacement": f"{stretch - 1}*t; free; free"})
    return runner.simulate(cube, {**settings, **QUIET}).probes()[-1]["top.fy"]


def closed_forms():
    """Uniaxial and equibiaxial: the same as the closed form of the compressible law, and close to that of incompressible bodies."""
    for law in LAWS:
        lam, mu = 2e5 if law == "st venant-kirchhoff" else 20e5, 1e5    # that one gives way when squeezed by its own stretch
        for stretch in (0.9, 1.2 if law == "st venant-kirchhoff" else 1.3):
            side = free_stretch(lambda s: principal_stresses(law, lam, mu, [s, stretch, s])[0])
            exact = principal_stresses(law, lam, mu, [side, stretch, side])[1]
            found = pulled(law, lam, mu, stretch, False)
            runner.check(abs(found / exact - 1) < 1e-7, f"{law}, uniaxial {stretch}: {found} and not {exact}")
            side = free_stretch(lambda s: principal_stresses(law, lam, mu, [stretch, stretch, s])[2])
            exact = principal_stresses(law, lam, mu, [stretch, stretch, side])[1]
            found = pulled(law, lam, mu, stretch, True)
            runner.check(abs(found / exact - 1) < 1e-7, f"{law}, equibiaxial {stretch}: {found} and not {exact}")
    mu, worst = 1e5, 0
    for law, c2 in (("neo-hookean", 0), ("mooney-rivlin", 0.5 * mu * RATIO / (1 + RATIO))):
        c1 = 0.5 * mu - c2
        for l in (0.9, 1.1, 1.3):
            uniaxial = 2 * (l - l**-2) * (c1 + c2 / l)
            equibiaxial = 2 * (l - l**-5) * (c1 + c2 * l * l)
            for both, exact in ((False, uniaxial), (True, equibiaxial)):
                worst = max(worst, abs(pulled(law, 1e5 * mu, mu, l, both) / exact - 1))
    print(f"incompressible: {worst:.1e}")
    runner.check(worst < 5e-5, f"incompressible: off by {worst}")


def torsion():
    """Rivlin's: energy, moment (the slope of the energy) and normal force on two meshes."""
    errors = []
    for cubes in (4, 8):
        run = runner.simulate(runner.ROOT / "parameters" / "validation" / "twist.prm",
                              {"Mesh/Box cubes": f"{cubes}, {cubes}, {cubes}", "Time/Steps": 5, **QUIET})
        history, mu, tau = run.history(), 1e5, 1.5
        energy, push = mu * math.pi * tau**2 / 4, -mu * math.pi * tau**2 / 4
        moment = (history[-1]["elastic"] - history[-2]["elastic"]) / (0.2 * tau) / (0.9 * mu * math.pi * tau / 2)
        errors.append((history[-1]["elastic"] / energy - 1, moment - 1, run.probes()[-1]["plate.fz"] / push - 1))
    print("torsion, energy, moment, normal force:", errors)
    for coarse, fine in zip(*errors):
        order = math.log2(coarse / fine)
        runner.check(abs(fine) < 0.06 and 1.6 < order < 2.3, f"torsion: {errors}, order {order}")


def motion():
    """A free body keeps its momenta, a held one its energy; ranks, threads and checkpoints change nothing."""
    soft = {"Material/Young modulus": 2e5, "Time/Step": 0.02, "Time/Newton tolerance": 1e-12, "Solver/Tolerance": 1e-12, **QUIET}
    free = {**soft, "Constraints/Clamped boundaries": "", "Loads/Gravity": "0, 0, 0", "Start/Velocity": "0; 0; 3*(y - 6)", "Probes/Boundaries": ""}
    for law in LAWS:
        # The midpoint rule keeps momenta; by trbdf2 and shorter steps the energy falls by its error alone.
        rows = runner.simulate(runner.BAR, {**free, "Material/Law": law, "Time/Method": "implicit midpoint", "Time/Steps": 6}).history()
        spin = max(abs(row["lx"]) for row in rows)
        for row in rows:
            runner.check(abs(row["pz"] - rows[0]["pz"]) < 1e-8 * spin and abs(row["lx"] / rows[0]["lx"] - 1) < 1e-2, f"{law}: momenta {row}")
    drift = []
    for steps in (10, 20):
        rows = runner.simulate(runner.BAR, {**free, "Material/Law": "neo-hookean", "Time/Method": "esdirk3", "Time/Steps": steps,
                                            "Time/Step": 0.2 / steps}).history()
        drift.append(max(abs(row["total"] / rows[0]["total"] - 1) for row in rows))
    print("energy drifts by", drift)
    runner.check(drift[1] < 0.3 * drift[0] and drift[0] < 1e-2, f"energy drifts by {drift}")

    held = {**soft, "Start/Velocity": "0; 0; -5", "Time/Method": "trbdf2", "Time/Steps": 6}
    probes = ["n28.uz", "n28.vz"]
    for law, order in (("neo-hookean", 1), ("fixed corotated", 1), ("stable neo-hookean", 2)):
        settings = {**held, "Material/Law": law, "Mesh/Order": order}
        one = runner.simulate(runner.BAR, settings)
        two = runner.simulate(runner.BAR, settings, ranks=2)
        worst = runner.largest_difference(one.probes(), two.probes(), probes)
        runner.check(worst < 1e-8, f"{law}, order {order}: 2 ranks differ by {worst}")
    kept = {**settings, "Checkpoint/Every": 3, "Checkpoint/Resume": "auto"}
    folder = tempfile.mkdtemp(prefix="supple-")
    for steps in (3, 6):
        status, _, error = runner.run(runner.BAR, "--quiet", "--output", folder, *runner.overrides({**kept, "Time/Steps": steps}))
        runner.check(status == 0, error)
    worst = runner.largest_difference(one.probes(), runner.Results(folder).probes(), probes)
    runner.check(worst < 1e-12, f"from a checkpoint: {worst}")


def methods():
    """Each method that is allowed, near the motion of the most exact one; patches; the guard of the energy."""
    settings = {"Material/Law": "neo-hookean", "Material/Young modulus": 2e5, "Material/Mass": "lumped", "Time/Step": 0.02, "Time/Steps": 10,
                "Start/Velocity": "0; 0; -5", **QUIET}
    exact = runner.simulate(runner.BAR, {**settings, "Time/Method": "esdirk5", "Time/Step": 0.005, "Time/Steps": 40}).probes()[-1]["n28.uz"]
    for method, limit in (("implicit backward euler", 0.05), ("implicit midpoint", 3e-3), ("sdirk2", 3e-3), ("trbdf2", 3e-3), ("esdirk3", 1e-3),
                          ("esdirk4", 1e-3), ("ida", 0.02), ("explicit4", 1e-4)):
        found = runner.simulate(runner.BAR, {**settings, "Time/Method": method}).probes()[-1]["n28.uz"]
        runner.check(abs(found / exact - 1) < limit, f"{method}: {found} and not {exact}")
    guarded = runner.simulate(runner.BAR, {**settings, "Time/Method": "implicit midpoint", "Time/Energy guard": "reject"})
    runner.check(abs(guarded.history()[-1]["time"] - 0.2) < 1e-9 and len(guarded.history()) > 11, "no step was done again")
    for order in (1, 2):
        for law in LAWS:
            runner.simulate(runner.BAR, {**settings, "Material/Law": law, "Material/Poisson ratio": 0.499, "Material/Volumetric locking cure": "patches",
                                         "Mesh/Order": order, "Material/Mass": "consistent", "Time/Method": "trbdf2", "Time/Steps": 2})


def drawn():
    """Stress and pressure in the frames are Cauchy's, with patches and without."""
    for law in LAWS:
        lam, mu, stretch = 2e5, 1e5, 1.2
        side = free_stretch(lambda s: principal_stresses(law, lam, mu, [s, stretch, s])[0])
        exact = principal_stresses(law, lam, mu, [side, stretch, side])[1] / side**2
        for cure in ("none",) if law == "st venant-kirchhoff" else ("none", "patches"):    # which makes another law of that one
            run = runner.simulate(cube, {"Material/Law": law, "Material/Mooney ratio": RATIO, "Material/Elastic constants": "Lame",
                                         "Material/Lame lambda": lam, "Material/Lame mu": mu, "Motion/Of": "boundary 3",
                                         "Motion/Displacement": f"free; {stretch - 1}*t; free", "Material/Volumetric locking cure": cure})
            fields = vtu.Frame(run.folder / "solution" / "frame_0004.vtu").of_cells
            for found, right in ((fields["von_mises_stress"], exact), (fields["pressure"], -exact / 3)):
                worst = max(abs(x / right - 1) for x in found)
                runner.check(worst < 1e-5, f"{law}, {cure}: {found} is drawn and not {right}")


def estimated():
    """The estimated error in space is near the true one."""
    scene = runner.ROOT / "parameters" / "validation" / "cook-finite.prm"
    for settings in ({}, {"Material/Volumetric locking cure": "patches"}, {"Material/Law": "mooney-rivlin"}):
        runs = [runner.simulate(scene, {"Mesh/Box cubes": f"{n}, {n}, 1", "Output/Frames": "none", **settings}) for n in (8, 16, 32)]
        tips = [run.probes()[-1]["tip.uy"] for run in runs]
        limit = tips[2] + (tips[2] - tips[1]) / 3
        estimates = runs[1].summary()["error_estimate"]["space"]
        true = abs(tips[1] / limit - 1)
        print(f"Cook, {settings}: tip {tips}, estimated {estimates['probes']['tip.uy']}, true {true}")
        runner.check(0.5 < abs(estimates["probes"]["tip.uy"]) / true < 2, f"estimated {estimates}, true {true}")


for part in sys.argv[2:] or ["closed_forms", "torsion", "motion", "methods", "drawn", "estimated"]:
    globals()[part]()
