"""Make a picture of a run: the bodies beside the slave surface of their contact.

Usage, with the interpreter of ParaView. Debian's needs a display even to render
off the screen, hence xvfb-run (apt-get install paraview xvfb xauth):

  xvfb-run -a pvbatch contrib/render.py FOLDER PICTURE.png
          [--field NAME] [--contact NAME] [--unit TEXT] [--contact-unit TEXT]
          [--scale S] [--camera "X Y Z"] [--up "X Y Z"] [--zoom Z]
          [--focus "X Y Z"] [--contact-camera "X Y Z"] [--contact-up "X Y Z"]
          [--contact-zoom Z] [--no-edges] [--points FILE.txt]

FOLDER is the output folder of a run; its last picture is shown, deformed S times
(1). On the left solution.pvd with the field von_mises, on the right contact.pvd
with the field pressure, unless told otherwise. The camera looks from the
direction X Y Z at the middle or at the focus. --points also writes the values at the contact nodes as a table
"x y z pressure gap status".

The pictures of the documentation are made by contrib/make_pictures.sh.
"""

import argparse
import os

from paraview import servermanager
from paraview.simple import *  # noqa: F403 pylint: disable=wildcard-import
from vtkmodules.util import numpy_support
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

WIDTH, HEIGHT = 1000, 480


def triple(text):
    return [float(x) for x in text.split()]


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("picture")
    parser.add_argument("--field", default="von_mises")
    parser.add_argument("--contact", default="pressure")
    parser.add_argument("--unit", default="")
    parser.add_argument("--contact-unit", default=None)
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--camera", type=triple, default=[1, 1, 1])
    parser.add_argument("--up", type=triple, default=[0, 0, 1])
    parser.add_argument("--zoom", type=float, default=1.0)
    parser.add_argument("--contact-zoom", type=float, default=None)
    parser.add_argument("--no-edges", action="store_true")
    parser.add_argument("--focus", type=triple)
    parser.add_argument("--contact-camera", type=triple)
    parser.add_argument("--contact-up", type=triple)
    parser.add_argument("--points")
    return parser.parse_args()


def read_last(folder, name, scale):
    """The last time of a .pvd file, warped by the displacement."""
    reader = PVDReader(FileName=os.path.join(folder, name))
    reader.UpdatePipelineInformation()
    times = reader.TimestepValues
    time = times[-1] if hasattr(times, "__len__") else times
    reader.UpdatePipeline(time)
    warped = WarpByVector(Input=reader)
    warped.Vectors = ["POINTS", "displacement"]
    warped.ScaleFactor = scale
    warped.UpdatePipeline(time)
    return warped, time


def show(view, source, time, field, title, edges, camera):
    view.ViewTime = time
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 1
    view.OrientationAxesLabelColor = [0, 0, 0]
    display = Show(source, view)
    display.Representation = "Surface With Edges" if edges else "Surface"
    display.EdgeColor = [0.25, 0.25, 0.25]
    # Colours are to be read, so shading stays faint.
    display.Ambient, display.Diffuse = 0.6, 0.4
    display.Interpolation = "Flat"
    values = source.PointData.GetArray(field)
    if values is None:
        raise SystemExit(f"there is no field '{field}' in this picture")
    ColorBy(display, ("POINTS", field), separate=True)
    # A lookup table of its own for each view: both may show the same field.
    table = GetColorTransferFunction(field, display, separate=True)
    table.ApplyPreset("Cool to Warm (Extended)", True)
    low, high = values.GetRange()
    if high - low < 1e-3 * max(abs(high), abs(low)):
        # A uniform field shows as one colour, not as its round-off.
        middle, half = (low + high) / 2, 0.05 * max(abs(high), abs(low), 1e-300)
        low, high = middle - half, middle + half
    table.RescaleTransferFunction(low, high)
    table.NumberOfTableValues = 16
    bar = GetScalarBar(table, view)
    bar.Visibility = 1
    bar.DrawBackground = 1
    bar.BackgroundColor = [1, 1, 1, 0.85]
    bar.Title = title
    bar.ComponentTitle = ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = 17
    bar.LabelFontSize = 15
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = "%.4g"
    bar.AddRangeLabels = 0
    bar.UseCustomLabels = 1
    bar.CustomLabels = [low + (high - low) * i / 4 for i in range(5)]
    bar.Orientation = "Horizontal"
    bar.WindowLocation = "Lower Center"
    bar.ScalarBarLength = 0.6

    direction, up, zoom, focus = camera
    bounds = source.GetDataInformation().GetBounds()
    centre = focus or [(bounds[2 * d] + bounds[2 * d + 1]) / 2 for d in range(3)]
    radius = 0.5 * sum((bounds[2 * d + 1] - bounds[2 * d]) ** 2 for d in range(3)) ** 0.5
    scale = 1.15 * radius / zoom
    length = sum(x * x for x in direction) ** 0.5
    # A little down, to leave room for the colour bar.
    centre = [c - 0.2 * scale * u for c, u in zip(centre, up)]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = scale
    view.CameraFocalPoint = centre
    view.CameraPosition = [c + 5 * radius * x / length for c, x in zip(centre, direction)]
    view.CameraViewUp = up


def write_points(source, file_name):
    data = servermanager.Fetch(MergeBlocks(Input=source))
    columns = [data.GetPointData().GetArray(n) for n in ("pressure", "gap", "status")]
    rows = {(*data.GetPoint(i), *(c.GetTuple1(i) for c in columns))
            for i in range(data.GetNumberOfPoints())}
    with open(file_name, "w", encoding="ascii") as out:
        out.write("# x y z pressure gap status\n")
        for row in sorted(rows):
            out.write(" ".join(f"{x:.9g}" for x in row) + "\n")


def compress(file_name):
    """Write the picture again with 32 levels per colour, which makes it small."""
    reader = vtkPNGReader()
    reader.SetFileName(file_name)
    reader.Update()
    image = reader.GetOutput()
    values = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
    values[:] = ((values.astype(int) * 31 + 127) // 255) * 255 // 31
    writer = vtkPNGWriter()
    writer.SetCompressionLevel(9)
    writer.SetFileName(file_name)
    writer.SetInputData(image)
    writer.Write()


def with_unit(text, unit):
    return f"{text.replace('_', ' ')}{f' ({unit})' if unit else ''}"


def main():
    arguments = parse()
    contact_unit = arguments.unit if arguments.contact_unit is None else arguments.contact_unit
    layout = CreateLayout("picture")
    left = CreateView("RenderView")
    AssignViewToLayout(view=left, layout=layout, hint=0)
    right_hint = layout.SplitHorizontal(0, 0.5)
    right = CreateView("RenderView")
    AssignViewToLayout(view=right, layout=layout, hint=right_hint + 1)
    layout.SetSize(WIDTH, HEIGHT)

    bodies, time = read_last(arguments.folder, "solution.pvd", arguments.scale)
    show(left, bodies, time, arguments.field,
         with_unit(arguments.field, arguments.unit) + ", deformed"
         + ("" if arguments.scale == 1 else f" {arguments.scale:g} times"),
         not arguments.no_edges,
         (arguments.camera, arguments.up, arguments.zoom, arguments.focus))
    contact, time = read_last(arguments.folder, "contact.pvd", arguments.scale)
    show(right, contact, time, arguments.contact,
         "contact " + with_unit(arguments.contact, contact_unit) + ", slave surface",
         not arguments.no_edges,
         (arguments.contact_camera or arguments.camera, arguments.contact_up or arguments.up,
          arguments.contact_zoom or arguments.zoom, arguments.focus))
    SaveScreenshot(arguments.picture, layout, ImageResolution=[WIDTH, HEIGHT],
                   CompressionLevel="9")
    compress(arguments.picture)
    if arguments.points:
        write_points(contact, arguments.points)


main()
