"""Draws instants of a run, from the VTU files that solution.pvd names, beside or below each other, and other runs with it.

    scripts/render.sh OUTPUT_FOLDER PICTURE.png [--times 0 0.14 7] [--below OTHER_OUTPUT_FOLDER...] [further options]
    scripts/render.sh OUTPUT_FOLDER SHEET.png --sheet 12      twelve frames spread over the run
    scripts/render.sh OUTPUT_FOLDER FILM.mp4 [--seconds 8]    all frames, each shown until the next one's time
    scripts/render.sh OUTPUT_FOLDER FILM.webp [--seconds 8]   the same as a picture that moves, for pages

The bodies are drawn in parallel projection and fill their views; the picture is as high as it must be. All runs have the
same scale and colours. The field that colours them may be a component (displacement_2); of a vector, else, its length.
"""

import argparse
import math
import pathlib
import subprocess
import tempfile

try:
    import numpy
    import vtk
    from PIL import Image
except ModuleNotFoundError as missing:
    raise SystemExit(f"{missing}: start it by scripts/render.sh, which takes the Python that has it.")
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from frames import at_rest, enlarge, owner, places, read_frames, read_grid, values

UNITS = {"displacement": "m", "velocity": "m/s", "von_mises_stress": "Pa"}
PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ")]
MARGIN, HEAD, FOOT = 0.04, 44, 68    # empty part of a view's width; pixels above a body, and of the colour bar
TEXT_SIZE = 24
# How ffmpeg writes them.
FILMS = {".mp4": ["-vf", "fps=25,format=yuv420p", "-c:v", "libx264", "-crf", "20", "-movflags", "+faststart"],
         ".webp": ["-vf", "fps=10", "-c:v", "libwebp_anim", "-quality", "60", "-compression_level", "6", "-loop", "0"]}


def unit(field, largest):
    """How often the field's unit with a prefix holds that without, and what it is called; both for the colour bar."""
    symbol = UNITS.get(field) or UNITS.get(field.rpartition("_")[0])
    if symbol is None or largest == 0:
        return 1, symbol
    return next(((size, prefix + symbol) for size, prefix in PREFIXES if largest >= size), (1, symbol))


def body_actor(grid, colours, plain=False):
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputData(grid)
    if grid.GetCellData().HasArray("colour"):
        mapper.SetScalarModeToUseCellFieldData()
    else:
        mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("colour")
    mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetEdgeVisibility(not plain)
    look.SetEdgeColor(0.25, 0.25, 0.3)
    look.SetLineWidth(1.0)
    look.SetInterpolationToFlat()
    look.SetAmbient(0.74)
    look.SetDiffuse(0.34)
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
        edges.SetDirectionToCameraVector()
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


def dark(text):
    text.SetColor(0.1, 0.1, 0.1)
    text.ItalicOff()
    text.ShadowOff()
    text.BoldOff()


def colour_bar(colours):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetNumberOfLabels(5)
    bar.SetMaximumNumberOfColors(256)
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.36, 0.08)
    bar.SetWidth(0.6)
    bar.SetHeight(0.84)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    bar.GetLabelTextProperty().SetFontSize(TEXT_SIZE - 4)
    dark(bar.GetLabelTextProperty())
    return bar


def caption(text, x, y):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    actor.GetTextProperty().SetFontSize(TEXT_SIZE)
    dark(actor.GetTextProperty())
    actor.SetPosition(x, y)
    return actor


def directions(grid, arguments):
    """To the right, upwards, and towards the camera; plane bodies are seen from the front."""
    low, high = grid.GetBounds()[4:]
    flat = low == high
    towards = numpy.array(arguments.camera or ((0, 0, 1) if flat else (-1.2, -0.7, 0.6)))
    towards = towards / numpy.linalg.norm(towards)
    right = numpy.cross(arguments.up or ((0, 1, 0) if flat else (0, 0, 1)), towards)
    right /= numpy.linalg.norm(right)
    return right, numpy.cross(towards, right), towards


def frame(grids, axes, width):
    """Camera that sees all bodies, as they are and at rest, in a view of this width, and the view's height in pixels."""
    points = numpy.vstack([places(grid) for grid in grids] + [places(at_rest(grid)) for grid in grids])
    seen = points @ numpy.transpose(axes)
    low, high = seen.min(axis=0), seen.max(axis=0)
    pixel = (high - low)[0] / (width * (1 - 2 * MARGIN))
    body = (high - low)[1] / pixel
    height = round(body + HEAD + MARGIN * width)
    middle = (low + high) / 2
    middle[1] = low[1] + (height / 2 - MARGIN * width / 2) * pixel    # the caption stands above the body
    away = 2 * numpy.ptp(seen, axis=0).max()
    camera = vtk.vtkCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(height / 2 * pixel)
    camera.SetFocalPoint(*(middle @ axes))
    camera.SetPosition(*(middle @ axes + away * axes[2]))
    camera.SetViewUp(*axes[1])
    camera.SetClippingRange(0.1 * away, 2 * away)
    return camera, height


def tool_actor(file):
    """The tools that belong to a frame, so that the body is seen through them."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(0.5, 0.52, 0.56)
    look.SetOpacity(0.35)
    look.SetInterpolationToFlat()
    return actor


def tools_of(frame):
    """The file of the tools beside that of a frame; none without tools."""
    file = frame.with_name(frame.name.replace("frame_", "tools_")).with_suffix(".vtp")
    return file if file.exists() else None


def add_view(window, corners, grid, tools, text, camera, colours, arguments):
    """One body in a part of the window, with the file of its tools or None."""
    view = vtk.vtkRenderer()
    view.SetBackground(1, 1, 1)
    view.SetViewport(*corners)
    light = vtk.vtkLight()
    light.SetLightTypeToCameraLight()
    light.SetPosition(0.3, 0.8, 1)
    view.AddLight(light)
    view.AddActor(body_actor(grid, colours, arguments.plain))
    if tools and arguments.enlarge == 1:
        view.AddActor(tool_actor(tools))
    view.AddActor(ghost_actor(grid, camera if arguments.outline == "silhouette" else None))
    view.AddActor(caption(text, 12, (corners[3] - corners[1]) * window.GetSize()[1] - HEAD + 8))
    view.SetActiveCamera(camera)
    window.AddRenderer(view)


def add_colour_bar(window, colours, title):
    foot = vtk.vtkRenderer()
    foot.SetBackground(1, 1, 1)
    foot.SetViewport(0, 0, 1, FOOT / window.GetSize()[1])
    foot.AddActor2D(colour_bar(colours))
    foot.AddActor2D(caption(title, 12, 14))
    window.AddRenderer(foot)


def write(window, file, colours=256):
    """As PNG of few colours, which are enough and make a small file."""
    window.Render()
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    image = picture.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)[::-1]
    image = Image.fromarray(pixels)
    if colours:
        image = image.quantize(colours, Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE)
    image.save(file, optimize=bool(colours))


def colour(grids, arguments):
    """Gives the bodies their colours; the map, and what stands at the colour bar."""
    fields = [values(grid, arguments.field) for grid in grids]
    low, high = arguments.range or (min(map(numpy.min, fields)), max(map(numpy.max, fields)))
    if not arguments.range and arguments.field in UNITS and 0 < low < 0.1 * high:
        low = 0    # where sizes begin; the smallest of these instants means nothing
    size, symbol = unit(arguments.field, max(abs(low), abs(high)))
    for grid, field in zip(grids, fields):
        array = numpy_to_vtk(field / size, deep=True)
        array.SetName("colour")
        owner(grid, arguments.field).AddArray(array)
    title = arguments.title or arguments.field.replace("_", " ").replace("mises", "Mises")
    return colour_map(low / size, high / size), title + (f" in {symbol}" if symbol else "")


class Drawing:
    """Bodies with their colours, and how they are looked at: the same for all of them."""

    def __init__(self, runs, arguments, columns):
        self.arguments = arguments
        self.grids = [[read_grid(file) for _, file in instants] for instants in runs]
        self.tools = {id(grid): tools_of(pathlib.Path(file)) for grids, instants in zip(self.grids, runs) for grid, (_, file) in zip(grids, instants)}
        every = [grid for row in self.grids for grid in row]
        self.colours, self.title = colour(every, arguments)
        for grid in every:
            enlarge(grid, arguments.enlarge)
        self.camera, self.height = frame(every, directions(every[0], arguments), arguments.width / columns)

    def write(self, file, places, shape, colours=256):
        """(row, column, body, text) of each view, in so many rows and columns."""
        window = vtk.vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(8)
        window.SetSize(self.arguments.width, shape[0] * self.height + FOOT)
        whole = window.GetSize()[1]
        for row, column, grid, text in places:
            corners = (column / shape[1], 1 - (row + 1) * self.height / whole, (column + 1) / shape[1], 1 - row * self.height / whole)
            add_view(window, corners, grid, self.tools[id(grid)], text, self.camera, self.colours, self.arguments)
        add_colour_bar(window, self.colours, self.title)
        write(window, file, colours)


def caption_of(name, time, instant=None):
    return ", ".join(filter(None, [name, f"t = {time:.3g} s" if instant is None else instant]))


def draw(runs, arguments):
    """A row for each run and a column for each of its instants (time, file), or, stacked, the other way round."""
    shape = (len(runs[0]), len(runs)) if arguments.stacked else (len(runs), len(runs[0]))
    drawing = Drawing(runs, arguments, shape[1])
    places = []
    for r, (grids, instants, name) in enumerate(zip(drawing.grids, runs, arguments.names)):
        for i, (grid, (time, _)) in enumerate(zip(grids, instants)):
            text = caption_of(name, time, arguments.instants[i] if arguments.instants else None)
            places.append((*((i, r) if arguments.stacked else (r, i)), grid, text))
    drawing.write(arguments.picture, places, shape)


def draw_sheet(frames, arguments):
    """Some frames of a run, spread over it, in rows."""
    n = min(arguments.sheet, len(frames))
    chosen = [frames[round(i * (len(frames) - 1) / max(1, n - 1))] for i in range(n)]
    columns = math.ceil(math.sqrt(n))
    drawing = Drawing([chosen], arguments, columns)
    places = [(i // columns, i % columns, grid, caption_of("", time))
              for i, (grid, (time, _)) in enumerate(zip(drawing.grids[0], chosen))]
    drawing.write(arguments.picture, places, (math.ceil(n / columns), columns))


def draw_film(runs, arguments):
    """All frames of the first run with those nearest in time of the others below them. Nothing is drawn in between."""
    times = [time for time, _ in runs[0]]
    runs = [[min(run, key=lambda frame, t=time: abs(frame[0] - t)) for time in times] for run in runs]
    drawing = Drawing(runs, arguments, 1)
    drawing.height += (len(runs) * drawing.height + FOOT) % 2    # a film's height is even
    scale = arguments.seconds / (times[-1] - times[0] or 1)
    with tempfile.TemporaryDirectory() as folder:
        script = ["ffconcat version 1.0"]
        for i, time in enumerate(times):
            places = [(r, 0, grids[i], caption_of(name, time)) for r, (grids, name) in enumerate(zip(drawing.grids, arguments.names))]
            drawing.write(f"{folder}/{i}.png", places, (len(runs), 1), colours=None)
            until = times[i + 1] if i + 1 < len(times) else time + 1 / scale
            script += [f"file {i}.png", f"duration {max(0.02, (until - time) * scale):.6f}"]
        script.append(f"file {len(times) - 1}.png")
        pathlib.Path(folder, "script").write_text("\n".join(script))
        subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-f", "concat", "-i", f"{folder}/script",
                        *FILMS[pathlib.Path(arguments.picture).suffix], arguments.picture], check=True)


def choose(folder, times):
    """The frames of a run nearest to the times; first, middle and last if there are none."""
    frames = read_frames(folder)
    if times is None:
        return [frames[0], frames[len(frames) // 2], frames[-1]]
    gap = max((after[0] - before[0] for before, after in zip(frames, frames[1:])), default=0)
    for time in times:
        if not frames[0][0] - gap <= time <= frames[-1][0] + gap:
            print(f"{folder} has frames from {frames[0][0]:g} to {frames[-1][0]:g} s; the nearest one to {time:g} s is drawn.")
    return [min(frames, key=lambda frame: abs(frame[0] - time)) for time in times]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="output folder of a run")
    parser.add_argument("picture", help="PNG, MP4 or WebP file to write")
    parser.add_argument("--below", type=pathlib.Path, nargs="+", default=[], help="output folders of other runs, drawn below the first")
    parser.add_argument("--names", nargs="+", default=[], help="what the runs are called")
    parser.add_argument("--times", type=float, nargs="+", help="instants [s]; the nearest frames are taken")
    parser.add_argument("--instants", nargs="+", help="what the instants are called, instead of their times")
    parser.add_argument("--sheet", type=int, help="draw so many frames, spread over the run, in rows")
    parser.add_argument("--seconds", type=float, default=8, help="how long a film takes")
    parser.add_argument("--stacked", action="store_true", help="instants below each other and runs side by side")
    parser.add_argument("--enlarge", type=float, default=1, help="draw so many times the displacement")
    parser.add_argument("--field", default="von_mises_stress", help="what colours the body")
    parser.add_argument("--range", type=float, nargs=2, help="where the colours begin and end")
    parser.add_argument("--title", help="title of the colours, without the unit")
    parser.add_argument("--plain", action="store_true", help="without the edges of the cells")
    parser.add_argument("--outline", choices=("edges", "silhouette"), default="edges", help="of the body at rest")
    parser.add_argument("--camera", type=float, nargs=3, help="direction to look from")
    parser.add_argument("--up", type=float, nargs=3, help="direction that is upwards in the picture")
    parser.add_argument("--width", type=int, default=1200, help="of the picture in pixels")
    arguments = parser.parse_args()

    folders = [arguments.folder, *arguments.below]
    arguments.names = (arguments.names + [""] * len(folders))[:len(folders)]
    if pathlib.Path(arguments.picture).suffix in FILMS:
        arguments.width -= arguments.width % 2
        draw_film([read_frames(folder) for folder in folders], arguments)
        return
    if arguments.sheet:
        draw_sheet(read_frames(arguments.folder), arguments)
        return
    runs = [choose(folder, arguments.times) for folder in folders]
    if arguments.instants and len(arguments.instants) != len(runs[0]):
        parser.error(f"--instants has {len(arguments.instants)} names for {len(runs[0])} instants")
    draw(runs, arguments)


if __name__ == "__main__":
    main()
