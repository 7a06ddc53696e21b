"""Mesh/Refine and Space/Aim: pilot runs that refine where the error is, the aim that is met, the same mesh on several processes,
and what is refused."""

import pathlib
import re
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

SAG = -0.20637  # of the bar's free end, by quadratic tetrahedra [m]
QUIET = {"Output/Report": "false", "Output/Frames": "none"}
folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))


def sag(results):
    return results.probes()[-1]["n28.uz"]


def pilots(results):
    return results.summary().get("pilot_runs", [])


def refused(settings, *words, scene=runner.STATIC, check=False):
    arguments = ["--check"] if check else ["--quiet", "--output", folder / "none"]
    message = runner.refused(runner.run(*arguments, scene, *runner.overrides({**QUIET, **settings})), words, f"{settings}")
    runner.check(len(message) < 900 and not (folder / "none").exists(), message)


# Each pilot run lowers the error; the estimate is near to the true one.
plain = runner.simulate(runner.STATIC, QUIET)
runner.check(pilots(plain) == [], "pilot runs nobody asked for")
by = {quantity: runner.simulate(runner.STATIC, {**QUIET, "Mesh/Refine": f"4 by {quantity}"}) for quantity in ("n28.uz", "energy")}
for quantity, results in by.items():
    told = pilots(results)
    error = 1 - sag(results) / SAG
    print(f"by {quantity}: {[pilot['cells'] for pilot in told]} and {results.summary()['cells']} cells, "
          f"estimated {[round(pilot['error'], 3) for pilot in told]}, at last {error:.3f} off")
    runner.check(len(told) == 4 and told[0]["cells"] == 192 and all(pilot["of"] == quantity for pilot in told), f"{told}")
    runner.check(all(a["cells"] < b["cells"] and a["error"] > b["error"] for a, b in zip(told, told[1:])), f"{told}")
    runner.check(error < 0.4 * (1 - sag(plain) / SAG), f"{error}")
estimate = by["n28.uz"].summary()["error_estimate"]["space"]["probes"]["n28.uz"]
true = 1 - sag(by["n28.uz"]) / SAG
runner.check(0.7 < estimate / true < 1.3, f"estimated {estimate}, true {true}")

# Fewer unknowns than a uniform mesh as good as that.
uniform = runner.simulate(runner.STATIC, {**QUIET, "Mesh/Box cubes": "12, 36, 12"})
runner.check(abs(1 - sag(uniform) / SAG) > true and uniform.summary()["dofs"] > by["n28.uz"].summary()["dofs"],
             f"uniform: {uniform.summary()['dofs']} unknowns, {1 - sag(uniform) / SAG}; adaptive: {by['n28.uz'].summary()['dofs']}, {true}")

# The same on several processes, and the mesh can be read again.
exact = {**QUIET, "Mesh/Refine": "3 by n28.uz", "Corotation/Rotation": "polar", "Solver/Tolerance": 1e-13,
         "Time/Newton tolerance": 1e-13, "Mesh/Layers": "6, 6", "Material/By id": "1: 5e7, 0.3, 1200", "Output/Mesh": "true"}
one = runner.simulate(runner.STATIC, exact)
for ranks in (2, 4):
    several = runner.simulate(runner.STATIC, exact, ranks=ranks)
    runner.check((one.folder / "mesh.msh").read_text() == (several.folder / "mesh.msh").read_text(), f"another mesh on {ranks} processes")
    worst = abs(sag(several) / sag(one) - 1)
    print(f"{ranks} processes: the tip within {worst:.1e}")
    runner.check(worst < 1e-10, f"{ranks} processes: {worst}")

# A motion, by the energy; patches are made anew.
short = {**QUIET, "Time/Steps": 20}
moving = runner.simulate(runner.BAR, {**short, "Mesh/Refine": "2 by energy"})
runner.check(moving.summary()["cells"] > 192 and [pilot["error"] for pilot in pilots(moving)] == [None, None], f"{pilots(moving)}")
patches = runner.simulate(runner.STATIC, {**QUIET, "Mesh/Refine": "2 by n28.uz", "Material/Volumetric locking cure": "patches"})
runner.check(patches.summary()["cells"] > 192, "no cell was cut")

# An aim, with the words on the screen.
aimed = tempfile.mkdtemp(prefix="supple-")
status, output, error = runner.run(runner.STATIC, "--output", aimed, *runner.overrides({**QUIET, "Space/Aim": 0.1}))
runner.check(status == 0, error)
lines = re.findall(r"pilot run (\d+): (\d+) cells, (\d+) unknowns, in space about (\S+) % of (\S+),", output)
runner.check([int(line[0]) for line in lines] == list(range(1, len(lines) + 1)) and len(lines) > 2, output)
met = runner.Results(aimed)
told = pilots(met)
runner.check(told[-1]["error"] <= 0.1 < told[-2]["error"] and met.summary()["cells"] == told[-1]["cells"], f"{told}")
runner.check(0.03 < abs(1 - met.probes()[-1][told[-1]["of"]] / SAG) < 0.12, "the aim is missed")
few = runner.simulate(runner.STATIC, {**QUIET, "Space/Aim": 0.01, "Mesh/Refine": "2 by n28.uz"})
runner.check(any("Space/Aim" in text and "after 2 refinements" in text for text in few.summary()["warnings"]), f"{few.summary()['warnings']}")

# Bad input: with a run and with --check.
for check in (False, True):
    refused({"Mesh/Refine": "3 by tip.uz"}, "Mesh/Refine", "no probe follows tip.uz", "n28.uz", "energy", check=check)
    refused({"Mesh/Refine": "3 by n28.uz", "Probes/Points": "", "Probes/Boundaries": ""}, "has no probes", check=check)
    refused({"Mesh/Refine": "3 by n28.uz"}, "dynamic", "energy", scene=runner.BAR, check=check)
    refused({"Space/Aim": 0.1}, "Space/Aim", "only a static scene", scene=runner.BAR, check=check)
    refused({"Mesh/Refine": "3 by energy", "Corotation/Rotation": "gram-schmidt"}, "no elastic energy", check=check)
for text in ("3", "by energy", "0 by energy", "101 by energy", "2 by n28.uz energy"):
    refused({"Mesh/Refine": text}, "Mesh/Refine", "N by QUANTITY")
refused({"Mesh/Refine": "3 by n28.uy2"}, "did you mean 'n28.uy'?")
for aim in (1, -0.1, "1 %"):
    refused({"Space/Aim": aim}, "Space/Aim", "greater than 0 and less than 1")
refused({"Mesh/Refine": "1 by clamp.uz"}, "clamp.uz", "held, does not move")
refused({"Mesh/Refine": "5 by energy", "Mesh/Refine most cells": 1000}, "The pilot run on", "the mesh would have", "Mesh/Refine most cells = 1000")
for text in ("-4294967295 by energy", "3by energy", "3 by", "0 by energy"):
    refused({"Mesh/Refine": text}, "Mesh/Refine", "N by QUANTITY")
refused({"Space/Aim": 0.1, "Space/Estimate error": "never"}, "Space/Estimate error", "Space/Aim")
refused({"Mesh/Refine region": "1/0"}, "Mesh/Refine region", "not a finite number")

# An aim that the mesh can't meet within its cells: the run is on the last mesh that can be, and says so.
outcome = runner.run(runner.STATIC, "--output", folder / "limit",
                     *runner.overrides({**QUIET, "Space/Aim": 0.001, "Mesh/Refine most cells": 3000}))
runner.accepted(outcome, ["refinements the error of", "there can be no more of them", "Mesh/Refine most cells = 3000"], "an aim beyond the cells")
refused({"Space/Aim": 0.001, "Mesh/Refine most cells": 300, "Mesh/Refine region": "1"}, "the mesh would have")

# Ctrl-C ends the pilot runs.
process = subprocess.Popen([runner.SUPPLE, runner.STATIC, "--output", folder / "stopped", *runner.overrides({"Space/Aim": 0.0005})],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=runner.ENVIRONMENT)
process.stdout.readline()  # a pilot run is done
process.send_signal(signal.SIGINT)
_, error = process.communicate(timeout=100 * runner.PATIENCE)
runner.check(process.returncode == 2 and "Interrupted" in error and "pilot run" in error and not (folder / "stopped").exists(), f"{process.returncode} {error}")

# Regions of the boundary are those of the mesh before the pilot runs: the load stays what it is.
PRESSED = {**QUIET, "Loads/Gravity": "0, 0, 0", "Mesh/Boundary regions": "9: (y < 0.001) * (z > 0.9)", "Loads/Traction": "0; 0; -1e4", "Loads/Traction on": 9}
forces = [runner.simulate(runner.STATIC, {**PRESSED, **more}).probes()[-1]["clamp.fz"] for more in ({}, {"Mesh/Refine": "3 by n28.uz"})]
runner.check(abs(forces[1] / forces[0] - 1) < 1e-6, f"the load changes with the mesh: {forces}")

# Near to buckling an aim without a probe is told by the answer to the loads, not by the energy alone, which is short by far.
COLUMN = {**QUIET, "Mesh/Box size": "1, 1, 12", "Mesh/Box cubes": "3, 3, 36", "Material/Young modulus": 1e6, "Material/Poisson ratio": 0.3,
          "Corotation/Rotation": "polar", "Constraints/Clamped boundaries": 4, "Loads/Gravity": "0, 0, 0", "Loads/Traction": "10; 0; -1700",
          "Loads/Traction on": 5, "Time/Steps": 5, "Probes/Points": "", "Probes/Boundaries": "", "Output/History": "true"}
space = runner.simulate(runner.STATIC, COLUMN).summary()["error_estimate"]["space"]
runner.check(space.get("more_than") == 0.5, f"a column near to buckling: {space}")
refused({"Space/Aim": 0.1, "Mesh/Refine": "9 by energy", "Loads/Nodal force": "0; 0; -5e6", "Loads/Nodal force on": "nearest to 2, 0, 2"},
        "Space/Aim", "at a point")
status, _, error = runner.run(runner.STATIC, "--output", folder / "none", *runner.overrides({**QUIET, "Mesh/Refine": "1 by energy", "Loads/Gravity": "0, 0, 0"}))
runner.check(status == 2 and "Pilot run 1" in error and "no strain energy" in error, error)

# A probe between vertices follows the one that is nearest on the first mesh, whatever comes nearer by the cuts.
BETWEEN = {**QUIET, "Probes/Points": "p: 1.4, 6.8, 1.4", "Mesh/Refine": "1 by p.uz"}
outcome = runner.run(runner.STATIC, "--output", folder / "between", *runner.overrides(BETWEEN))
runner.accepted(outcome, ["at (2, 7.5, 2)"], "a probe between vertices")

# What can't be written is refused before the pilot runs.
(folder / "file").write_text("")
outcome = runner.run(runner.STATIC, "--output", folder / "file" / "x", *runner.overrides({**QUIET, "Mesh/Refine": "1 by energy"}))
runner.refused(outcome, ["can't be written", "is no folder"], "a file in the way")
