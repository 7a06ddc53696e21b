"""The bar hanging under ten times its weight, far bent, by CalculiX and by Supple: seconds and the end's displacement.

    apt-get install calculix-ccx && scripts/run.sh --version && python3 benchmarks/other-programs/run.py

The same vertices, linear tetrahedra, clamp and load; geometrically nonlinear, the whole load in one step, Newton's method
until forces out of balance are below 1e-6 of the loads; one thread, whole run with reading and setup. CalculiX measures
strains by Green's tensor, Supple by corotation: the same for small strains, here they differ by some per cent.
CalculiX's direct solver is SPOOLES; `iterative` is its conjugate gradients with incomplete Cholesky.
"""

import csv
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import timing

SIZE = (4., 12., 4.)
GRAVITY = 98.1
ONE_THREAD = {**os.environ, **timing.ENVIRONMENT, "CCX_NPROC_EQUATION_SOLVER": "1"}


def bar(refinement):
    """Vertices and the six tetrahedra of each cube along its diagonal, as Supple cuts it."""
    n = (2 * refinement, 8 * refinement, 2 * refinement)
    number = {place: k for k, place in enumerate(itertools.product(*(range(m + 1) for m in n)))}
    vertices = [[SIZE[d] * place[d] / n[d] for d in range(3)] for place in number]
    cells = []
    for corner in itertools.product(*(range(m) for m in n)):
        for order in itertools.permutations(range(3)):
            path = [list(corner)]
            for d in order:
                path.append(list(path[-1]))
                path[-1][d] += 1
            cell = [number[tuple(place)] for place in path]
            odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
            cells.append([cell[0], cell[2], cell[1], cell[3]] if odd else cell)
    return vertices, cells


def input_file(refinement, solver):
    vertices, cells = bar(refinement)
    end = vertices.index([2., 0., 2.])
    held = [k + 1 for k, x in enumerate(vertices) if x[1] == SIZE[1]]
    lines = ["*NODE, NSET=ALL", *(f"{k + 1}, {x[0]!r}, {x[1]!r}, {x[2]!r}" for k, x in enumerate(vertices)),
             "*ELEMENT, TYPE=C3D4, ELSET=BODY",
             *(f"{k + 1}, " + ", ".join(str(v + 1) for v in cell) for k, cell in enumerate(cells)),
             "*NSET, NSET=END", str(end + 1), "*NSET, NSET=HELD", *map(str, held),
             "*MATERIAL, NAME=SOFT", "*ELASTIC", "100e6, 0.33", "*DENSITY", "1000.",
             "*SOLID SECTION, ELSET=BODY, MATERIAL=SOFT", "*BOUNDARY", "HELD, 1, 3",
             "*STEP, NLGEOM, INC=100", f"*STATIC, SOLVER={solver}, DIRECT", "1., 1.",
             "*CONTROLS, PARAMETERS=FIELD", "1e-6, 1.", "*DLOAD", f"BODY, GRAV, {GRAVITY}, 0., 0., -1.",
             "*NODE PRINT, NSET=END", "U", "*END STEP"]
    return "\n".join(lines) + "\n"


def calculix(refinement, solver):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "bar.inp").write_text(input_file(refinement, solver))
        start = time.perf_counter()
        with open(folder / "log", "w") as log:
            status = subprocess.run(["ccx", "bar"], cwd=folder, stdout=log, stderr=log, env=ONE_THREAD).returncode
        seconds = time.perf_counter() - start
        text = (folder / "log").read_text()
        rows = [line.split() for line in (folder / "bar.dat").read_text().splitlines() if line[:1] == " " and line.split()]
        numbers = [row for row in rows if row[0].isdigit()]
        if status != 0 or not numbers:
            return seconds, float("nan"), 0
        return seconds, float(numbers[-1][3]), text.count("iteration ")


def supple(refinement, method, program):
    settings = {"Mesh/Box cubes": f"{2 * refinement}, {8 * refinement}, {2 * refinement}", "Corotation/Rotation": "polar",
                "Loads/Gravity": f"0, 0, -{GRAVITY}", "Time/Steps": 1, "Time/Newton tolerance": 1e-6,
                "Solver/Method": method, "Output/Frames": "none"}
    with tempfile.TemporaryDirectory() as folder:
        command = [program, timing.ROOT / "parameters/bar/static.prm", "--quiet", "--output", folder]
        for entry, value in settings.items():
            command += ["--set", f"{entry}={value}"]
        start = time.perf_counter()
        subprocess.run(command, check=True, env=ONE_THREAD)
        seconds = time.perf_counter() - start
        folder = pathlib.Path(folder)
        last = list(csv.DictReader(open(folder / "probes.csv")))[-1]
        summary = json.loads((folder / "summary.json").read_text())
        return seconds, float(last["n28.uz"]), summary["solver"]["newton_iterations"]


def main():
    parser = timing.parser(__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1, 2, 4])
    arguments = parser.parse_args()
    print("| tetrahedra | program | solver | seconds | end sinks by [m] | Newton's iterations |\n|---|---|---|---|---|---|")
    for refinement in arguments.sizes:
        cells = 6 * 32 * refinement**3
        runs = [("CalculiX", solver, lambda s=solver: calculix(refinement, s)) for solver in ("SPOOLES", "ITERATIVE CHOLESKY")]
        runs += [("Supple", method, lambda m=method: supple(refinement, m, arguments.program)) for method in ("auto",)]
        for program, solver, run in runs:
            results = sorted(run() for _ in range(arguments.repeat))
            seconds, end, iterations = results[len(results) // 2]
            print(f"| {cells} | {program} | {solver.lower()} | {seconds:.3g} | {-end:.6f} | {iterations} |", flush=True)


if __name__ == "__main__":
    main()
