"""The bodies in the VTU files of a run: for render.py and volumes.py, not called."""

import xml.etree.ElementTree

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy


def read_frames(folder):
    """(time, file) of each frame."""
    if not (folder / "solution.pvd").is_file():
        raise SystemExit(f"{folder} has no solution.pvd: it is not the output folder of a run with frames.")
    record = xml.etree.ElementTree.parse(folder / "solution.pvd")
    return [(float(entry.get("timestep")), folder / entry.get("file")) for entry in record.iter("DataSet")]


def read_grid(file):
    parallel = file.suffix == ".pvtu"
    reader = vtk.vtkXMLPUnstructuredGridReader() if parallel else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def places(grid):
    return vtk_to_numpy(grid.GetPoints().GetData())


def displacements(grid):
    return vtk_to_numpy(grid.GetPointData().GetArray("displacement"))


def owner(grid, field):
    """What has a field of the file, or one of which it is a component: the points of the body or its cells."""
    both = (grid.GetPointData(), grid.GetCellData())
    for data in both:
        if data.HasArray(field) or field.rpartition("_")[2].isdigit() and data.HasArray(field.rpartition("_")[0]):
            return data
    raise SystemExit(f"There is no field {field}. There are: "
                     + ", ".join(data.GetArrayName(i) for data in both for i in range(data.GetNumberOfArrays())))


def values(grid, field):
    """A field of numbers, of points or of cells: one that is in the file, a component of it, or the length of a vector."""
    data = owner(grid, field)
    if data.HasArray(field):
        found = vtk_to_numpy(data.GetArray(field))
        return found if found.ndim == 1 else numpy.linalg.norm(found, axis=1)
    name, _, component = field.rpartition("_")
    return vtk_to_numpy(data.GetArray(name))[:, int(component)]


def at_rest(grid):
    """The same cells where they were before they moved, with common vertices (of several processes each has its own)."""
    points, numbers = numpy.unique(places(grid) - displacements(grid), axis=0, return_inverse=True)
    rest_points = vtk.vtkPoints()
    rest_points.SetData(numpy_to_vtk(points, deep=True))
    vertices = numbers.ravel()[vtk_to_numpy(grid.GetCells().GetConnectivityArray())]
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    cells = vtk.vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(ids.astype(numpy.int64), deep=True) for ids in (offsets, vertices)))
    rest = vtk.vtkUnstructuredGrid()
    rest.SetPoints(rest_points)
    rest.SetCells(grid.GetCellType(0), cells)
    return rest


def enlarge(grid, factor):
    """Draws the body on, to so many times its displacement; at_rest finds it where it was."""
    far = factor * displacements(grid)
    moved = vtk.vtkPoints()
    moved.SetData(numpy_to_vtk(places(grid) - displacements(grid) + far, deep=True))
    grid.SetPoints(moved)
    displacement = numpy_to_vtk(far, deep=True)
    displacement.SetName("displacement")
    grid.GetPointData().AddArray(displacement)
