"""Draws instants of a run side by side, from the VTU files that solution.pvd names."""

import argparse
import pathlib
import xml.etree.ElementTree

import vtk


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
    """The same cells where they were before they moved."""
    points = vtk.vtkPoints()
    displacement = grid.GetPointData().GetArray("displacement")
    for i in range(grid.GetNumberOfPoints()):
        points.InsertNextPoint([x - u for x, u in zip(grid.GetPoint(i), displacement.GetTuple(i))])
    rest = vtk.vtkUnstructuredGrid()
    rest.DeepCopy(grid)
    rest.SetPoints(points)
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


def ghost_actor(grid):
    """Outline of the body at rest."""
    surface = vtk.vtkGeometryFilter()
    surface.SetInputData(at_rest(grid))
    merged = vtk.vtkCleanPolyData()
    merged.SetInputConnection(surface.GetOutputPort())
    edges = vtk.vtkFeatureEdges()
    edges.SetInputConnection(merged.GetOutputPort())
    edges.SetFeatureAngle(60)
    edges.NonManifoldEdgesOff()
    edges.ColoringOff()
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


def draw(instants, arguments):
    """One view for each instant, all with the same camera and colours."""
    grids = [read_grid(file) for _, file in instants]
    ranges = [grid.GetPointData().GetArray(arguments.field).GetRange() for grid in grids]
    colours = colour_map(min(low for low, _ in ranges), max(high for _, high in ranges))
    bounds = vtk.vtkBoundingBox()
    for grid in grids:
        bounds.AddBounds(grid.GetBounds())
        bounds.AddBounds(at_rest(grid).GetBounds())
    box = [0.0] * 6
    bounds.GetBounds(box)

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(arguments.width, arguments.height)
    camera = vtk.vtkCamera()
    for i, (grid, (time, _)) in enumerate(zip(grids, instants)):
        view = vtk.vtkRenderer()
        view.SetBackground(1, 1, 1)
        view.SetViewport(i / len(grids), 0.12, (i + 1) / len(grids), 1)
        light = vtk.vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(0.3, 0.8, 1)
        view.AddLight(light)
        view.AddActor(body_actor(grid, arguments.field, colours))
        view.AddActor(ghost_actor(grid))
        view.AddActor(caption(f"t = {time:.3g} s"))
        view.SetActiveCamera(camera)
        window.AddRenderer(view)
        if i == 0:
            flat = box[4] == box[5]
            camera.SetViewUp(0, flat, not flat)
            camera.SetPosition(*(arguments.camera or ((0, 0, 1) if flat else (-1.2, -0.7, 0.6))))
            camera.SetFocalPoint(0, 0, 0)
            view.ResetCamera(box)
            camera.Zoom(arguments.zoom)
        view.ResetCameraClippingRange(box)
    foot = vtk.vtkRenderer()
    foot.SetBackground(1, 1, 1)
    foot.SetViewport(0, 0, 1, 0.12)
    bar = colour_bar(colours, arguments.title or arguments.field.replace("_", " "))
    bar.SetPosition(0.3, 0.05)
    bar.SetHeight(0.9)
    foot.AddActor2D(bar)
    window.AddRenderer(foot)
    window.Render()

    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(arguments.picture)
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="output folder of a run")
    parser.add_argument("picture", help="PNG file to write")
    parser.add_argument("--times", type=float, nargs="+", help="instants [s]; the nearest frames are taken")
    parser.add_argument("--field", default="von_mises_stress", help="what colours the body")
    parser.add_argument("--title", help="title of the colours")
    parser.add_argument("--camera", type=float, nargs=3, help="direction to look from")
    parser.add_argument("--zoom", type=float, default=1.0)
    parser.add_argument("--width", type=int, default=1500)
    parser.add_argument("--height", type=int, default=640)
    arguments = parser.parse_args()

    frames = read_frames(arguments.folder)
    if arguments.times is None:
        instants = [frames[0], frames[len(frames) // 2], frames[-1]]
    else:
        instants = [min(frames, key=lambda frame: abs(frame[0] - time)) for time in arguments.times]
    draw(instants, arguments)


if __name__ == "__main__":
    main()
