#!/usr/bin/env python3
"""Uniform meshes against those that Mesh/Refine makes: unknowns, seconds with all pilot runs, estimated and true error of a static
bar and of an L with an edge of 270 degrees. The tables of doc/error.md: scripts/refinement.py [build/supple] [--rounds N]."""

import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Displacements by quadratic tetrahedra on three meshes, extrapolated [m].
SAG, TIP = 0.20637, 0.0479334

LBAR = """
subsection Mesh
  set Shape            = file
  set File             = %s
  set Boundary regions = 1: y > 1.999; 2: x > 1.999
end
subsection Material
  set Young modulus = 1000
  set Poisson ratio = 0.3
end
subsection Corotation
  set Rotation = none
end
subsection Constraints
  set Clamped boundaries = 1
end
subsection Loads
  set Traction    = 0; -1; 0
  set Traction on = 2
end
subsection Time
  set Problem = static
  set Steps   = 1
end
subsection Probes
  set Points = tip: 2, 1, 1
end
"""


def lbar(folder, n):
    """The scene of three unit cubes about an edge of 270 degrees, n cubes along each side of one."""
    number, cells = {}, []

    def vertex(*place):
        return number.setdefault(place, len(number) + 1)

    for i in range(2 * n):
        for j in range(2 * n):
            for k in range(n):
                if i < n or j < n:
                    c = [vertex(i + (q & 1), j + (q >> 1 & 1), k + (q >> 2 & 1)) for q in range(8)]
                    cells += [[c[a] for a in tet] for tet in [(0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7)]]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", len(number)]
    lines += [f"{v} {' '.join(str(c / n) for c in place)}" for place, v in number.items()] + ["$EndNodes", "$Elements", len(cells)]
    lines += [f"{e} 4 2 0 1 {' '.join(map(str, cell))}" for e, cell in enumerate(cells, 1)] + ["$EndElements"]
    (folder / f"l{n}.msh").write_text("\n".join(map(str, lines)) + "\n")
    (folder / f"l{n}.prm").write_text(LBAR % f"l{n}.msh")
    return folder / f"l{n}.prm"


def measure(program, scene, settings, column, right, repeats=3):
    """Unknowns that are not held, seconds, estimated and true error."""
    folder = tempfile.mkdtemp(prefix="supple-")
    words = [word for entry, value in {"Output/Frames": "none", "Output/Report": "false", **settings}.items()
             for word in ("--set", f"{entry}={value}")]
    seconds = []
    for _ in range(repeats):
        subprocess.run([program, str(scene), "--quiet", "--output", folder, *words], check=True)
        summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
        seconds.append(summary["seconds"]["setup"] + summary["seconds"]["run"] + sum(pilot["seconds"] for pilot in summary.get("pilot_runs", [])))
    header, *rows = (pathlib.Path(folder) / "probes.csv").read_text().splitlines()
    value = float(rows[-1].split(",")[header.split(",").index(column)])
    told = summary.get("error_estimate", {}).get("space", {}).get("probes", {}).get(column)
    return summary["dofs"] - summary["held"], min(seconds), told, 1 - abs(value) / right


def row(name, unknowns, seconds, told, true):
    print(f"| {name} | {unknowns} | {seconds:.2f} | {'more than 50' if told is None else f'{100 * told:.2g}'} | {100 * true:.2g} |", flush=True)


def table(program, scenes, coarse, column, right, rounds):
    print("| mesh | unknowns | seconds | estimated % | true % |\n|---|---|---|---|---|")
    for name, scene, settings in scenes:
        row(name, *measure(program, scene, settings, column, right))
    for by in (column, "energy"):
        for n in range(1, rounds + 1):
            row(f"{n} by {by}", *measure(program, coarse, {"Mesh/Refine": f"{n} by {by}"}, column, right))


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program", nargs="?", default=ROOT / "build" / "supple")
    arguments.add_argument("--rounds", type=int, default=6)
    options = arguments.parse_args()
    bar = ROOT / "parameters" / "bar" / "static.prm"
    print("The bar of parameters/bar/static.prm, n28.uz:\n")
    table(options.program, [(f"{n} cubes through the height", bar, {"Mesh/Box cubes": f"{n}, {3 * n}, {n}"}) for n in (2, 4, 8, 12, 16, 24)],
          bar, "n28.uz", SAG, options.rounds)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print("\nAn L of three cubes, pulled down at its end, tip.uy:\n")
        table(options.program, [(f"{n} cubes along a leg's width", lbar(folder, n), {}) for n in (3, 6, 12, 20, 28)],
              lbar(folder, 3), "tip.uy", TIP, options.rounds)


if __name__ == "__main__":
    main()
