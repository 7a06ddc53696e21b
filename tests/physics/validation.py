"""The studies in space on their coarser meshes: errors against exact solutions, and orders observed."""

import csv
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
STUDIES = runner.ROOT / "parameters" / "studies"


def study(name, levels=None, **entries):
    """A study that ships, with its first levels alone; gives its rows."""
    settings = {f"Study/{entry}": value for entry, value in entries.items()}
    if levels:
        text = re.sub(r"\\\n\s*", "", (STUDIES / f"{name}.prm").read_text())
        all_levels = re.search(r"set Levels\s*=\s*(.*)", text).group(1).split(";")
        settings["Study/Levels"] = ";".join(all_levels[:levels])
    results = folder / name
    status, _, error = runner.run(STUDIES / f"{name}.prm", "--quiet", "--output", results, *runner.overrides(settings))
    runner.check(status == 0, f"{name}: exit status {status}: {error}")
    with open(results / "study.csv") as file:
        return list(csv.DictReader(file))


def converges(rows, errors, orders):
    """On the finest level of each variant: errors below these, and orders between these two numbers."""
    for variant in {row.get("variant", "") for row in rows}:
        fine = [row for row in rows if row.get("variant", "") == variant][-1]
        first = True
        for column, limit in errors.items():
            order = float(fine["order" if first else f"order_{column}"])
            first = False
            runner.check(float(fine[f"error_{column}"]) < limit and orders[0] < order < orders[1],
                         f"{variant} {column}: {fine}")


rows = study("patch-test")
runner.check(len(rows) == 8 and all(row["verdict"] == "right" for row in rows), f"{rows}")
expected = 1.1 * 0.96 - 0.05 * 0.02
for row in rows:
    volume = expected * (1.06 if row["case"].startswith("tetrahedra") else 1)
    if row["case"].startswith("plane stress"):
        continue  # it gets thinner
    runner.check(abs(float(row["smallest"]) / volume - 1) < 1e-9, f"{row}")

converges(study("lame-cylinder", levels=3), {"inner": 0.013, "outer": 0.01}, (1.85, 2.1))
converges(study("lame-cylinder-plane", levels=4), {"inner": 3e-4, "outer": 4e-4}, (1.95, 2.05))
converges(study("lame-sphere-axisymmetric", levels=4), {"inner": 4e-4, "outer": 5e-4}, (1.9, 2.05))
# The sizes of triangles, where levels have names that are none.
rows = study("lame-cylinder-plane", Levels="coarse [Mesh/Rectangle squares = 8, 12]; fine [Mesh/Rectangle squares = 16, 24]")
runner.check(abs(float(rows[1]["order"]) - 2) < 0.1 and 0.05 < float(rows[1]["cell_size"]) < 0.1, f"{rows}")

rows = study("lame-sphere", levels=3)
converges(rows, {"inner": 0.09}, (1.3, 2.1))
runner.check(float(rows[-1]["error_energy"]) < 0.03 and float(rows[-1]["order_energy"]) > 1.7, f"{rows[-1]}")

# Stiff in bending: on the same mesh the frequencies are too high, and fall.
bending = study("cantilever-bending", levels=3)
converges(bending, {"f": 0.13}, (1.6, 2.1))
plane = study("cantilever-plane", levels=3)
converges(plane, {"f": 0.03}, (1.9, 2.1))
for row in bending + plane:
    runner.check(float(row["f"]) > 0.5, f"{row}")
converges(study("cantilever-axial", levels=2), {"f": 3e-4}, (1.9, 2.3))

# A beam far bent: closer at each load, and at each too little bent before it passes.
rows = study("elastica", levels=2)
for load in (1, 2, 5, 10):
    for quantity in ("w", "u"):
        for coarse, fine in (rows[:2], rows[2:]):
            order = float(fine[f"order_{quantity}{load}" if quantity + str(load) != "w1" else "order"])
            runner.check(float(fine[f"error_{quantity}{load}"]) < 0.09 and order > 1.7, f"{quantity}{load}: {fine}")
