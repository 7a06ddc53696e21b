"""Opens a run in ParaView with colours, edges, and the outline of the body at rest, as scripts/render.sh draws it.

    cd OUTPUT_FOLDER && paraview --script=.../scripts/paraview_view.py
    pvpython scripts/paraview_view.py OUTPUT_FOLDER            writes OUTPUT_FOLDER/solution.pvsm, a state that ParaView loads
    pvpython scripts/paraview_view.py OUTPUT_FOLDER PICTURE.png     and draws the frame in the middle
"""

import pathlib
import sys

from paraview import simple

COLOURS = [0, 0.16, 0.25, 0.55, 0.25, 0.2, 0.55, 0.7, 0.5, 0.75, 0.85, 0.65, 0.75, 0.95, 0.65, 0.3, 1, 0.7, 0.1, 0.15]
FIELD = "von_mises_stress"


def largest(reader):
    """Of the field in all frames."""
    worst = 0
    for time in reader.TimestepValues:
        reader.UpdatePipeline(time)
        worst = max(worst, reader.CellData[FIELD].GetRange()[1])
    return worst or 1


def colour(shown, view, top):
    simple.ColorBy(shown, ("CELLS", FIELD))
    table = simple.GetColorTransferFunction(FIELD)
    table.ColorSpace = "Lab"
    table.RGBPoints = [value * top if i % 4 == 0 else value for i, value in enumerate(COLOURS)]
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = "von Mises stress [Pa]", ""
    bar.Orientation, bar.WindowLocation, bar.ScalarBarLength = "Horizontal", "Lower Center", 0.5
    bar.TitleFontSize, bar.LabelFontSize, bar.ScalarBarThickness = 14, 12, 12
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    shown.SetScalarBarVisibility(view, True)


def show_at_rest(reader, view):
    """The parts of several processes have points of their own: they are put together for the outline."""
    back = simple.WarpByVector(registrationName="at rest", Input=reader)
    back.Vectors = ["POINTS", "displacement"]
    back.ScaleFactor = -1
    surface = simple.ExtractSurface(Input=simple.CleantoGrid(Input=back))
    edges = simple.FeatureEdges(registrationName="outline at rest", Input=surface)
    edges.FeatureAngle = 60
    edges.NonManifoldEdges = 0
    shown = simple.Show(edges, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.55, 0.55, 0.55]


def look(reader, view):
    low_x, high_x, low_y, high_y, low_z, high_z = reader.GetDataInformation().GetBounds()
    flat = low_z == high_z
    middle = [(low_x + high_x) / 2, (low_y + high_y) / 2, (low_z + high_z) / 2]
    towards = (0, 0, 1) if flat else (-1.2, -0.7, 0.6)
    view.CameraFocalPoint = middle
    view.CameraPosition = [x + d * (high_x - low_x + high_y - low_y) for x, d in zip(middle, towards)]
    view.CameraViewUp = [0, 1, 0] if flat else [0, 0, 1]
    view.CameraParallelProjection = 1


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    reader = simple.PVDReader(registrationName=folder.name, FileName=str(folder / "solution.pvd"))
    times = list(reader.TimestepValues)
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1200, 700]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    top = largest(reader)
    shown = simple.Show(reader, view)
    shown.SetRepresentationType("Surface With Edges")
    shown.EdgeColor = [0.25, 0.25, 0.3]
    shown.Ambient, shown.Diffuse = 0.6, 0.5
    colour(shown, view, top)
    show_at_rest(reader, view)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    view.ViewTime = times[len(times) // 2]
    look(reader, view)
    simple.ResetCamera(view)
    if len(sys.argv) > 1:
        simple.SaveState(str(folder / "solution.pvsm"))
    if len(sys.argv) > 2:
        simple.SaveScreenshot(sys.argv[2], view, ImageResolution=[1200, 700])


main()
