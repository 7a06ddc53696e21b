"""Draws instants of a run side by side, from the VTU files that solution.pvd names, and another run below.

    scripts/render.sh OUTPUT_FOLDER PICTURE.png [--times 0 0.14 7] [--below OTHER_OUTPUT_FOLDER] [further options]
"""

import argparse
import pathlib
import xml.etree.ElementTree

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy


def read_frames(folder):
    """(time, file) of each frame."""
    record = xml.etree.ElementTree.parse(folder / "solution.pvd")
    return [(float(entry.get("timestep")), folder / entry.get("file")) for entry in record.iter("DataSet")]


def read_grid(file):
    parallel = file.suffix == ".pvtu"
    reader = vtk.vtkXMLPUnstructuredGridReader() if parallel else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def at_rest(grid):
    """The same cells where they were before they moved, with common vertices (in the files each cell has its own)."""
    displacement = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
    places, numbers = numpy.unique(vtk_to_numpy(grid.GetPoints().GetData()) - displacement, axis=0, return_inverse=True)
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(places, deep=True))
    vertices = numbers.ravel()[vtk_to_numpy(grid.GetCells().GetConnectivityArray())]
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    cells = vtk.vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(ids.astype(numpy.int64), deep=True) for ids in (offsets, vertices)))
    rest = vtk.vtkUnstructuredGrid()
    rest.SetPoints(points)
    rest.SetCells(grid.GetCellType(0), cells)
    return rest


def body_actor(grid, field, colours):
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputData(grid)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    mapper.SetLookupTable(colours)
    mapper.SetScalarRange(colours.GetRange())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.25, 0.25, 0.3)
    actor.GetProperty().SetLineWidth(1.2)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.6)
    actor.GetProperty().SetDiffuse(0.5)
    return actor


def ghost_actor(grid, camera):
    """Outline of the body at rest: its sharp edges, or, where a camera is given, its silhouette from there."""
    surface = vtk.vtkGeometryFilter()
    surface.SetInputData(at_rest(grid))
    if camera is None:
        edges = vtk.vtkFeatureEdges()
        edges.SetFeatureAngle(60)
        edges.NonManifoldEdgesOff()
        edges.ColoringOff()
    else:
        edges = vtk.vtkPolyDataSilhouette()
        edges.SetCamera(camera)
        edges.SetEnableFeatureAngle(0)
    edges.SetInputConnection(surface.GetOutputPort())
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.55, 0.55, 0.55)
    return actor


def colour_map(low, high):
    function = vtk.vtkColorTransferFunction()
    function.SetColorSpaceToLab()
    for part, colour in [(0, (0.16, 0.25, 0.55)), (0.25, (0.2, 0.55, 0.7)), (0.5, (0.75, 0.85, 0.65)),
                         (0.75, (0.95, 0.65, 0.3)), (1, (0.7, 0.1, 0.15))]:
        function.AddRGBPoint(low + part * (high - low), *colour)
    return function


def colour_bar(colours, title):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(5)
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.3, 0.02)
    bar.SetWidth(0.4)
    bar.SetHeight(0.11)
    bar.SetLabelFormat("%.3g")
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.1)
        text.ItalicOff()
        text.ShadowOff()
        text.BoldOff()
    return bar


def caption(text):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    actor.GetTextProperty().SetFontSize(26)
    actor.GetTextProperty().SetColor(0.1, 0.1, 0.1)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(0.05, 0.92)
    return actor


def box_of(grids):
    """Box around all bodies, as they are and at rest."""
    bounds = vtk.vtkBoundingBox()
    for grid in grids:
        bounds.AddBounds(grid.GetBounds())
        bounds.AddBounds(at_rest(grid).GetBounds())
    box = [0.0] * 6
    bounds.GetBounds(box)
    return box


def add_view(window, corners, grid, text, camera, colours, arguments):
    """One body in a part of the window."""
    view = vtk.vtkRenderer()
    view.SetBackground(1, 1, 1)
    view.SetViewport(*corners)
    light = vtk.vtkLight()
    light.SetLightTypeToCameraLight()
    light.SetPosition(0.3, 0.8, 1)
    view.AddLight(light)
    view.AddActor(body_actor(grid, arguments.field, colours))
    view.AddActor(ghost_actor(grid, camera if arguments.outline == "silhouette" else None))
    view.AddActor(caption(text))
    view.SetActiveCamera(camera)
    window.AddRenderer(view)
    return view


def add_colour_bar(window, colours, title, height):
    foot = vtk.vtkRenderer()
    foot.SetBackground(1, 1, 1)
    foot.SetViewport(0, 0, 1, height)
    bar = colour_bar(colours, title)
    bar.SetPosition(0.3, 0.05)
    bar.SetHeight(0.9)
    foot.AddActor2D(bar)
    window.AddRenderer(foot)


def write(window, file):
    window.Render()
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(file)
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()


def draw(rows, arguments):
    """A row for each run and a view for each of its instants (time, file), all with the same camera and colours."""
    grids = [[read_grid(file) for _, file in instants] for instants in rows]
    every = [grid for row in grids for grid in row]
    ranges = [grid.GetPointData().GetArray(arguments.field).GetRange() for grid in every]
    colours = colour_map(min(low for low, _ in ranges), max(high for _, high in ranges))
    box = box_of(every)

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(arguments.width, arguments.height)
    camera = vtk.vtkCamera()
    camera.SetViewUp(0, 0, 1)
    camera.SetPosition(*arguments.camera)
    camera.SetFocalPoint(0, 0, 0)
    foot = 77 / arguments.height
    views = []
    for r, (row, instants, name) in enumerate(zip(grids, rows, arguments.names)):
        low, high = (1 - (1 - foot) * (r + part) / len(rows) for part in (1, 0))
        for i, (grid, (time, _)) in enumerate(zip(row, instants)):
            corners = (i / len(row), low, (i + 1) / len(row), high)
            text = f"{name}, t = {time:.3g} s" if name else f"t = {time:.3g} s"
            views.append(add_view(window, corners, grid, text, camera, colours, arguments))
    views[0].ResetCamera(box)
    camera.Zoom(arguments.zoom)
    for view in views:
        view.ResetCameraClippingRange(box)
    add_colour_bar(window, colours, arguments.title or arguments.field.replace("_", " "), foot)
    write(window, arguments.picture)


def choose(folder, times):
    """The frames of a run nearest to the times; first, middle and last if there are none."""
    frames = read_frames(folder)
    if times is None:
        return [frames[0], frames[len(frames) // 2], frames[-1]]
    return [min(frames, key=lambda frame: abs(frame[0] - time)) for time in times]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="output folder of a run")
    parser.add_argument("picture", help="PNG file to write")
    parser.add_argument("--below", type=pathlib.Path, help="output folder of another run, drawn below the first")
    parser.add_argument("--names", nargs="+", default=[], help="what the runs are called")
    parser.add_argument("--times", type=float, nargs="+", help="instants [s]; the nearest frames are taken")
    parser.add_argument("--field", default="von_mises_stress", help="what colours the body")
    parser.add_argument("--title", help="title of the colours")
    parser.add_argument("--outline", choices=("edges", "silhouette"), default="edges", help="of the body at rest")
    parser.add_argument("--camera", type=float, nargs=3, default=(-1.2, -0.7, 0.6), help="direction to look from")
    parser.add_argument("--zoom", type=float, default=1.0)
    parser.add_argument("--width", type=int, default=1500)
    parser.add_argument("--height", type=int, default=640)
    arguments = parser.parse_args()

    folders = [arguments.folder] + ([arguments.below] if arguments.below else [])
    arguments.names = (arguments.names + [""] * len(folders))[:len(folders)]
    draw([choose(folder, arguments.times) for folder in folders], arguments)


if __name__ == "__main__":
    main()
