#!/usr/bin/env python3
"""Uniform meshes against those that Mesh/Refine makes: unknowns, seconds with all pilot runs, estimated and true error of a static
bar, of an L with an edge of 270 degrees and of a flat punch. The tables of doc/error.md:
scripts/refinement.py [build/supple] [--rounds N] [--case bar]."""

import argparse
import importlib.util
import pathlib
import tempfile

import scene_run

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Displacements by quadratic tetrahedra on three meshes, extrapolated [m].
SAG, TIP = 0.20637, 0.0479334
# A quarter of the exact force (Sneddon 1965) [N].
PUNCH = 0.043956 / 4


def measure(program, scene, settings, column, right, repeats=3):
    """Unknowns that are not held, seconds, estimated and true error."""
    seconds = []
    for _ in range(repeats):
        with tempfile.TemporaryDirectory() as folder:
            summary, probes = scene_run.run(program, scene, pathlib.Path(folder), settings)
        seconds.append(sum(summary["seconds"].get(part, 0) for part in ("setup", "run", "error_in_space"))
                       + sum(pilot["seconds"] for pilot in summary.get("pilot_runs", [])))
    space = summary.get("error_estimate", {}).get("space", {})
    told = space.get("forces") if column[-2] == "f" else space.get("probes", {}).get(column)
    return summary["dofs"] - summary["held"], min(seconds), told, 1 - abs(probes[column]) / right


def row(name, unknowns, seconds, told, true):
    print(f"| {name} | {unknowns} | {seconds:.2f} | {'more than 50' if told is None else f'{100 * told:.2g}'} | {100 * true:.2g} |", flush=True)


def table(program, scenes, coarse, column, right, rounds, more=None):
    print("| mesh | unknowns | seconds | estimated % | true % |\n|---|---|---|---|---|")
    for name, scene, settings in scenes:
        row(name, *measure(program, scene, settings, column, right))
    for by in ("energy",) if column[-2] == "f" else (column, "energy"):
        for n in range(1, rounds + 1):
            row(f"{n} by {by}", *measure(program, coarse, {"Mesh/Refine": f"{n} by {by}", **(more or {})}, column, right))


def bar(program, rounds):
    scene = ROOT / "parameters" / "bar" / "static.prm"
    print("The bar of parameters/bar/static.prm, n28.uz:\n")
    table(program, [(f"{n} cubes through the height", scene, {"Mesh/Box cubes": f"{n}, {3 * n}, {n}"}) for n in (2, 4, 8, 12, 16, 24)],
          scene, "n28.uz", SAG, rounds)


def edge(program, rounds):
    scene = ROOT / "parameters" / "validation" / "l-bar.prm"
    spec = importlib.util.spec_from_file_location("mesh", scene.parent / "mesh.py")
    mesh = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(mesh)
    with tempfile.TemporaryDirectory() as name:
        print("\nThe L of parameters/validation/l-bar.prm, pulled down at its end, tip.uy:\n")
        scenes = []
        for n in (3, 6, 12, 20, 28):
            file = pathlib.Path(name) / f"l{n}.msh"
            mesh.l_bar(n, file)
            scenes.append((f"{n} cubes along a leg's width", scene, {"Mesh/File": file}))
        table(program, scenes, scene, "tip.uy", TIP, rounds)


def punch(program, rounds):
    scene = ROOT / "parameters" / "validation" / "flat-punch.prm"
    print("\nThe punch of parameters/validation/flat-punch.prm, whose mesh is fine at its rim already, punch.fy:\n")
    table(program, [(f"{n} cubes along each side", scene, {"Mesh/Box cubes": f"{n}, {n}, {n}"}) for n in (8, 16, 24, 32)],
          scene, "punch.fy", PUNCH, min(rounds, 2), {"Mesh/Box cubes": "8, 8, 8"})


CASES = {"bar": bar, "edge": edge, "punch": punch}


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program", nargs="?", default=ROOT / "build" / "supple")
    arguments.add_argument("--rounds", type=int, default=6)
    arguments.add_argument("--case", choices=CASES, help="one of the tables alone")
    options = arguments.parse_args()
    for name, case in CASES.items():
        if options.case in (None, name):
            case(options.program, options.rounds)


if __name__ == "__main__":
    main()
