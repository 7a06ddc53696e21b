"""Mesh/Refine and Space/Aim: pilot runs that refine where the error is, the aim that is met, the same mesh on several processes,
and what is refused."""

import pathlib
import re
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
refused({"Space/Aim": 0.001, "Mesh/Refine most cells": 3000}, "with an error of about", "the mesh would have", "Mesh/Refine most cells = 3000")
refused({"Space/Aim": 0.1, "Mesh/Refine": "9 by energy", "Loads/Nodal force": "0; 0; -5e6", "Loads/Nodal force on": "nearest to 2, 0, 2"},
        "Space/Aim", "at a point")
status, _, error = runner.run(runner.STATIC, "--output", folder / "none", *runner.overrides({**QUIET, "Mesh/Refine": "1 by energy", "Loads/Gravity": "0, 0, 0"}))
runner.check(status == 2 and "Pilot run 1" in error and "no strain energy" in error, error)
