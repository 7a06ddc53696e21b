"""The tests of the 2002 thesis by its own recipe, and where linear and corotational bodies come to rest, free and held. Called by
scripts/theses.sh.

Writes the tables of doc/vein.md and draws doc/pictures/vein-thesis-1.png to -5.png. Runs are left in output/theses/vein. Errors in
time are those of the first 200 steps of the thesis on the way to rest.
"""

import csv
import dataclasses
import pathlib
import re
import subprocess
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import errors
import frames
import pages
import scene_run

ROOT = pathlib.Path(__file__).resolve().parent.parent
DATA = ROOT / "tests" / "data" / "vein"
OUTPUT = ROOT / "output" / "theses" / "vein"
HELD = {1: "top", 2: "both ends", 3: "bottom", 4: "both ends", 5: "both ends"}
BOUNDARIES = {"nothing": "", "top": "3", "bottom": "2", "both ends": "2, 3"}
STATIC = {"Time/Problem": "static", "Time/Steps": 10, "Damping/Viscous": 0}
LONG = {"Time/Steps": 12000}
PRINTED, SMALLER = "10000", "1000"    # the force of test 5 in the thesis's text and in its program
RANGE = {1: (0.96, 1.04), 2: (0.8, 1.2), 3: (0.8, 1.2), 4: (0.76, 1.24), 5: (0.7, 1.3)}
LOOK = {4: ("--up", "0", "-1", "0", "--camera", "1", "0", "0.35")}    # the vertex moves along y
SWEEPS, FRAMES = 4, 100    # of the recipe: of tests 1 to 4, and of test 5, which goes on without end


def read(name):
    with open(DATA / name) as file:
        return list(csv.DictReader(file))


VERTICES = numpy.array([[float(row[axis]) for axis in "xyz"] for row in read("nodes.csv")])
CELLS = numpy.array([[int(row[corner]) for corner in "abcd"] for row in read("tets.csv")])


def volumes(places, cells=CELLS):
    edges = places[cells[:, 1:]] - places[cells[:, :1]]
    return numpy.linalg.det(edges) / 6


def thesis_stiffness(places, first, second):
    """The coefficients of the thesis's program: those of the stiffness matrix without the volume of the cell, and divided by 36,
    for its gradients are a sixth of what they should be."""
    corners = numpy.concatenate([places[CELLS], numpy.ones((len(CELLS), 4, 1))], axis=2)
    gradients = numpy.linalg.inv(corners)[:, :3, :].transpose(0, 2, 1) / 6
    blocks = first * numpy.einsum("cia,cjb->ciajb", gradients, gradients)
    blocks += second * numpy.einsum("cja,cib->ciajb", gradients, gradients)
    blocks += second * numpy.einsum("cim,cjm,ab->ciajb", gradients, gradients, numpy.eye(3))
    matrix = numpy.zeros((3 * len(places), 3 * len(places)))
    unknowns = (3 * CELLS[:, :, None] + numpy.arange(3)).reshape(len(CELLS), 12)
    numpy.add.at(matrix, (unknowns[:, :, None], unknowns[:, None, :]), blocks.reshape(len(CELLS), 12, 12))
    return matrix


def thesis_sweep(matrix, new, now, before, case, force=0., wanted=lambda place: True):
    """One sweep of Gauss and Seidel over equation (3.6) of the thesis, with its signs: the elastic force of the last increment
    pushes away from rest, and the damping drives."""
    inertia, damping = case["mass"] / case["dt"] ** 2, case["damping"] / (2 * case["dt"])
    right = -matrix @ now.ravel() + 2 * inertia * now.ravel() - (inertia + damping) * before.ravel() + force
    unknowns, diagonal = new.ravel(), matrix.diagonal()
    for vertex in range(len(new)):
        if not wanted(new[vertex]) or vertex == case["vertex"]:
            continue
        for row in range(3 * vertex, 3 * vertex + 3):
            rest = matrix[row] @ unknowns - diagonal[row] * unknowns[row]
            unknowns[row] = (right[row] + rest) / (inertia - damping - diagonal[row])


def case_of(test):
    row = next(row for row in read("thesis_tests.csv") if int(row["test"]) == test)
    case = {"mass": float(row["mass_per_vertex"]), "damping": float(row["damping_per_vertex"]), "dt": float(row["dt"]),
            "lame": (float(row["lambda"]), float(row["mu"])), "vertex": None}
    if row["vertex"] != "all":
        case.update(vertex=int(row["vertex"]), to=[float(row[axis + "1"]) for axis in "xyz"])
    return case


def thesis_point(test, sweeps=SWEEPS):
    """Tests 1 to 4 by the thesis's program: one time step, by so many sweeps, is what it draws."""
    case = case_of(test)
    new = VERTICES.copy()
    new[case["vertex"]] = case["to"]
    matrix = thesis_stiffness(VERTICES, *case["lame"])
    for _ in range(sweeps):
        thesis_sweep(matrix, new, VERTICES, VERTICES, case)
    return new


def thesis_force(size, steps):
    """Test 5 by the thesis's program: a sweep a step over the upper half, the same force along each axis, and coefficients of the
    body as it is deformed. Yields the places after each step."""
    case = case_of(5)
    before, now, new = VERTICES.copy(), VERTICES.copy(), VERTICES.copy()
    for _ in range(steps):
        force = numpy.repeat(size * numpy.sin(10 * numpy.pi / 4.9 * now[:, 2]), 3)
        thesis_sweep(thesis_stiffness(now, *case["lame"]), new, now, before, case, force, lambda place: place[2] >= 0)
        before, now = now, new.copy()
        yield now


def leave(places, folder, like):
    """Writes a body as a run would, so that it can be drawn."""
    grid = frames.read_grid(frames.read_frames(like)[0][1])
    rest = frames.places(grid) - frames.displacements(grid)
    order = numpy.array([numpy.linalg.norm(VERTICES - place, axis=1).argmin() for place in rest])    # frames have one of their own
    cells = order[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)]
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(places[order], deep=True))
    grid.SetPoints(points)
    for data, name, values in [(grid.GetPointData(), "displacement", (places - VERTICES)[order]),
                               (grid.GetCellData(), "volume_ratio", volumes(places, cells) / volumes(VERTICES, cells))]:
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.AddArray(array)
    folder.mkdir(parents=True, exist_ok=True)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(folder / "body.vtu"))
    writer.SetInputData(grid)
    writer.Write()
    (folder / "solution.pvd").write_text('<VTKFile type="Collection"><Collection><DataSet timestep="0" file="body.vtu"/>'
                                         "</Collection></VTKFile>\n")


@dataclasses.dataclass(eq=False)
class Case:
    """A body that comes to rest: test, size of the force of test 5, what is held, the model, and what else is set."""
    test: int
    size: str
    held: str
    model: str
    settings: dict

    def name(self):
        return f"{self.test}, {self.size}" if self.size else str(self.test)

    def folder(self):
        return OUTPUT / re.sub(r"\W+", "-", f"{self.name()} {self.held} {self.model}")

    def stated(self):
        """What is set on the way to rest and at rest alike."""
        force = {"Loads/Nodal force": along_axis(self.size)} if self.size else {}
        return {"Corotation/Rotation": scene_run.MODELS[self.model], **held_by(self.held.partition(",")[0]), **force}


def held_by(part):
    return {"Constraints/Clamped boundaries": BOUNDARIES[part]}


def along_axis(size):
    return f"0; 0; {sine(size)}"


def sine(size):
    return f"{size}*sin(10*pi*z/4.9)"


def cases():
    """Held bodies come to rest as a static problem, which has no damping; free ones and those that buckle in time."""
    found = [Case(test, "", held, model, STATIC if held != "nothing" else {})
             for test in range(1, 5) for held in ("nothing", HELD[test]) for model in scene_run.MODELS]
    found += [Case(5, size, held, "linear", {}) for size in (SMALLER, PRINTED) for held in ("nothing", "both ends")]
    found += [Case(5, SMALLER, held, "corotational", settings)
              for held, settings in (("nothing, kinked", LONG), ("both ends, straight", STATIC), ("both ends, buckled", LONG))]
    return sorted(found, key=lambda case: (case.test, len(case.size), case.held.partition(",")[0] != "nothing"))


def run(supple, test, folder, settings):
    return scene_run.run(supple, ROOT / "parameters" / "vein" / f"thesis-{test}.prm", folder, settings)


def ends(folder, probes):
    """Extremes of the volume ratio, cells inside out and mean displacement at the end of a run, as numbers."""
    last = scene_run.last_row(folder / "history.csv")
    return [last["min_volume_ratio"], last["max_volume_ratio"]], int(last["inverted"]), [probes["all.u" + axis] for axis in "xyz"]


def mean_of(numbers):
    return ", ".join(f"{number:.8f}" for number in numbers).replace("-0.00000000", "0.00000000")


def come_to_rest(supple):
    """Runs every case. @return {case: what ends() finds}, and the rows of the table of errors and seconds"""
    found, rows = {}, []
    for case in cases():
        drawable = {"Output/Frames": "every", "Output/Every": 1000000}    # the first and the last
        at_rest, probes = run(supple, case.test, case.folder(), {**case.stated(), **drawable, **case.settings})
        moving, _ = run(supple, case.test, OUTPUT / "moving", {**case.stated(), "Time/Steps": 200, "Space/Estimate error": "never",
                                                              "Time/Estimate error": "true"})
        found[case] = ends(case.folder(), probes)
        rows.append([case.name(), case.held, case.model, f"{at_rest['seconds']['run']:.2g}", errors.in_time(moving),
                     errors.in_space(at_rest).partition(", where")[0]])
        print(f"Done: {' '.join(map(str, rows[-1]))}", flush=True)
    return found, rows


def recipes(like):
    """Runs the thesis's program. @return {test: places that are drawn}, and rows of the table"""
    drawn = {test: thesis_point(test) for test in range(1, 5)}
    rows = [[*told(f"test {test}, {SWEEPS} sweeps", places), f"{abs(places - thesis_point(test, SWEEPS - 1)).max():.3f}"]
            for test, places in drawn.items()]
    for size in SMALLER, PRINTED:
        for step, places in enumerate(thesis_force(float(size), FRAMES), 1):
            if step in (1, 10, FRAMES):
                rows.append([*told(f"test 5, {size}, step {step}", places), ""])
        drawn.setdefault(5, places)
    for test, places in drawn.items():
        leave(places, recipe_folder(test), like)
    return drawn, rows


def recipe_folder(test):
    return OUTPUT / f"{test}-recipe"


def rest_table(found, drawn):
    """What the thesis's program draws, and below it where the body comes to rest."""
    rows = []
    for test, places in drawn.items():
        ratios = volumes(places) / volumes(VERTICES)
        rows.append([f"{test}, {SMALLER}" if test == 5 else test, "nothing", "the thesis's recipe", f"{ratios.min():.6f}",
                     f"{ratios.max():.6f}", (ratios <= 0).sum(), mean_of((places - VERTICES).mean(axis=0))])
        for case, (extremes, inverted, mean) in found.items():
            if case.test == test:
                rows.append([case.name(), case.held, case.model, *(f"{ratio:.6f}" for ratio in extremes), inverted, mean_of(mean)])
    return rows


def compare(found):
    """Largest differences from the independent model of tests 1 and 2."""
    rows = []
    for row in read("thesis_rest.csv"):
        (ratios, _, mean), = [ends for case, ends in found.items()
                              if (str(case.test), case.held, case.model) == (row["test"], row["held"], row["model"])]
        off = max(abs(a - float(row[name])) for a, name in zip(ratios, ("min_volume_ratio", "max_volume_ratio")))
        far = max(abs(a - float(row["centroid_" + axis])) for a, axis in zip(mean, "xyz"))
        rows.append([row["test"], row["held"], row["model"], f"{off:.1e}", f"{far:.1e}"])
    return rows


def try_readings(supple):
    """Test 5 as its text, its table and its program may be read: the end of a run of 1000 steps, or where it fails."""
    upper = f"if(z > -1e-9, {sine(SMALLER)}, 0)"
    readings = [
        ("along z, damping 0.2", SMALLER, "nothing", "linear", {"Loads/Nodal force": along_axis(SMALLER), "Damping/Viscous": 0.2}),
        ("along x, y and z", SMALLER, "both ends", "linear", {"Loads/Nodal force": "; ".join([sine(SMALLER)] * 3)}),
        ("along x, y and z, upper half", SMALLER, "both ends", "linear", {"Loads/Nodal force": "; ".join([upper] * 3)}),
        ("along x, y and z", SMALLER, "nothing", "corotational", {"Loads/Nodal force": "; ".join([sine(SMALLER)] * 3)}),
        ("along z", PRINTED, "nothing", "corotational", {}),
        ("along z", PRINTED, "both ends", "corotational", {}),
        ("along z, implicit backward euler", PRINTED, "nothing", "corotational", {"Time/Method": "implicit backward euler"}),
    ]
    rows = []
    for reading, size, held, model, settings in readings:
        folder = OUTPUT / "reading"
        summary, _ = run(supple, 5, folder, {"Corotation/Rotation": scene_run.MODELS[model], **held_by(held), **settings,
                                             "Space/Estimate error": "never"})
        last = summary["last"]
        rows.append([reading, size, held, model, f"{last['time']:.3g}", f"{last['min_volume_ratio']:.3g}", f"{last['max_volume_ratio']:.3g}",
                     last["inverted"], f"{last['kinetic']:.1e}", f"{summary['extremes']['energy_gained']:.1e}"])
    return rows


def draw(test, found):
    """The recipe's body and each one at rest, one below the other, lying with the top to the right."""
    shown = [case for case in found if case.test == test and case.size != PRINTED and case.held != "both ends, straight"]
    names = [f"{case.model}, {'free' if case.held.startswith('nothing') else 'held'}" for case in shown]
    low, high = RANGE[test]
    picture = ROOT / "doc" / "pictures" / f"vein-thesis-{test}.png"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "render.py"), str(recipe_folder(test)), str(picture),
                    "--below", *(str(case.folder()) for case in shown), "--names", "the thesis's recipe", *names,
                    "--times", "1e9", "--instants", "", *LOOK.get(test, ("--up", "1", "0", "0", "--camera", "0", "1", "0.35")),
                    "--field", "volume_ratio", "--range", str(low), str(high), "--width", "640"], check=True, stdout=subprocess.DEVNULL)


def told(name, places):
    """What the thesis's recipe does to the body."""
    far = numpy.linalg.norm(places - VERTICES, axis=1)
    ratios = volumes(places) / volumes(VERTICES)
    return [name, f"{ratios.min():.3f}", f"{ratios.max():.3f}", (ratios <= 0).sum(), (far > 0.01 * far.max()).sum(),
            f"{far.mean():.5f}", f"{far.max():.4f}"]


def main():
    supple = sys.argv[1]
    found, seconds = come_to_rest(supple)
    drawn, recipe = recipes(next(iter(found)).folder())
    pages.put_table("vein.md", ["test", "held", "model", "smallest volume ratio", "largest", "cells inside out",
                                "mean displacement x, y, z [m]"], rest_table(found, drawn))
    pages.put_table("vein.md", ["test", "held", "model", "volume ratios differ by", "mean displacements by [m]"], compare(found))
    pages.put_table("vein.md", ["test 5, force", "size", "held", "model", "until [s]", "smallest volume ratio", "largest",
                                "cells inside out", "energy of motion [J]", "energy added by the steps [J]"], try_readings(supple))
    pages.put_table("vein.md", ["the thesis's recipe", "smallest volume ratio", "largest", "cells inside out",
                                "vertices that move by 1 % of the farthest", "mean distance [m]", "largest", "the last sweep moves by [m]"], recipe)
    pages.put_table("vein.md", ["test", "held", "model", "seconds", "error in time", "error in space"], seconds)
    for test in HELD:
        draw(test, found)


if __name__ == "__main__":
    main()
