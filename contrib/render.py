# SPDX-License-Identifier: LGPL-2.1-or-later
"""Render a run: the bodies beside the slave surfaces of their contact.

Usage: /usr/bin/python3 contrib/render.py FOLDER IMAGE.png
          [--field NAME] [--contact NAME] [--no-contact] [--no-bodies] [--unit TEXT] [--contact-unit TEXT]
          [--scale S] [--time "T ..."] [--range "LOW HIGH"] [--contact-range "LOW HIGH"]
          [--camera "X Y Z"] [--up "X Y Z"] [--focus "X Y Z"] [--width W]
          [--contact-camera "X Y Z"] [--contact-up "X Y Z"] [--contact-width W]
          [--hide "BODY NUMBER ..."] [--pairs "PAIR NUMBER ..."] [--mirror "x y"] [--no-edges] [--no-outline]
          [--size "WIDTH HEIGHT"] [--points FILE.txt]

Needs VTK 9 for Python (apt-get install python3-vtk9 python3-numpy xvfb xauth); on a machine without a
screen it starts itself under xvfb-run.

FOLDER is the output folder of a run; the last time is shown (or the one next to T; bodies at several
times side by side), deformed S times (1). On the left solution.pvd with the field von_mises, on the
right contact.pvd with the field pressure, unless told otherwise. The camera looks from the direction X Y Z; the image is
cropped to what it shows, or, with a width, to a square of that size around the focus; panels
have at most WIDTH by HEIGHT pixels (760 600). --no-outline leaves out the lines along sharp edges, --no-edges those of cells: of cells of degree 2 these
are the triangles that VTK draws them with. --pairs
shows the surfaces of these contact pairs, numbered from 0 in the order of the scene; without it pairs that
are tied, whose pressure can be tension, are left out where there are others. --mirror
adds the other half of bodies that are cut by the planes x = 0 or y = 0. --points also writes the
values at the contact nodes as a table "x y z pressure gap status". Without --unit the legend says what
the field is made of, as force/length^2.

The images of the documentation are made by contrib/make_pictures.sh.
"""

import argparse
import os
import pathlib
import re
import shutil
import sys
import xml.etree.ElementTree

try:
    import numpy
    from vtkmodules.util import numpy_support
    import vtkmodules.all as vtk
except ImportError as error:
    sys.exit(f"contrib/render.py needs VTK 9 and numpy for Python ({error}): apt-get install python3-vtk9 "
             "python3-numpy xvfb xauth, and start it with Debian's own /usr/bin/python3")

# VTK would end the program if there is no screen.
if not os.environ.get("DISPLAY"):
    if not shutil.which("xvfb-run"):
        sys.exit("contrib/render.py needs a screen, or xvfb-run in place of one: apt-get install xvfb xauth")
    # A display of its own, whose server needs a moment to start.
    os.execvp("xvfb-run", ["xvfb-run", "-n", str(100 + os.getpid() % 900), "-w", "5", sys.executable, *sys.argv])

MARGIN, TEXT, SMALL = 16, 27, 23
# From low to high; every colour is light enough to show the edges of cells.
COLOURS = ["3b4cc0", "4f69d9", "6788ee", "82a6fb", "9dbdff", "b7cff9", "cedaeb", "e2dad5",
           "f0cdbb", "f7b89c", "f6a081", "ee8468", "df634e", "cb3e38", "b40426"]
# What fields are made of, by the beginnings of their names; others have no unit.
DIMENSIONS = {"displacement|gap|slip": "length", "velocity": "length/time", "reaction|force": "force", "area": "length^2",
              "(cell_)?(stress|von_mises)|hydrostatic_pressure|pressure|traction": "force/length^2"}


def numbers(text):
    return [float(x) for x in text.split()]


def dimension(field, unit):
    """The unit of a field in brackets: as it is given, or what it is made of."""
    if unit is None:
        found = [made_of for names, made_of in DIMENSIONS.items() if re.match(names, field)]
        unit = found[0] if found else ""
    return f" ({unit})" if unit else ""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("folder", type=pathlib.Path)
    add("image")
    add("--field", default="von_mises")
    add("--contact", default="pressure")
    add("--no-contact", action="store_true")
    add("--no-bodies", action="store_true")
    add("--unit")
    add("--contact-unit")
    add("--scale", type=float, default=1.0)
    add("--time", type=numbers)
    add("--range", type=numbers)
    add("--contact-range", type=numbers)
    add("--camera", type=numbers, default=[1, 1, 1])
    add("--up", type=numbers, default=[0, 0, 1])
    add("--focus", type=numbers)
    add("--width", type=float)
    add("--contact-camera", type=numbers)
    add("--contact-up", type=numbers)
    add("--contact-width", type=float)
    add("--hide", type=numbers, default=[])
    add("--pairs", type=numbers)
    add("--mirror", default="")
    add("--no-edges", action="store_true")
    add("--no-outline", action="store_true")
    add("--size", type=numbers, default=[760, 600])
    add("--points")
    return parser.parse_args()


def read(pvd, time):
    """The grid of one time of a .pvd file, all ranks together."""
    sets = [(float(d.get("timestep")), pvd.parent / d.get("file"))
            for d in xml.etree.ElementTree.parse(pvd).iter("DataSet")]
    if not sets:
        sys.exit(f"{pvd} lists no times")
    chosen = max(t for t, _ in sets) if time is None else min(sets, key=lambda s: abs(s[0] - time))[0]
    append = vtk.vtkAppendFilter()
    for _, file in (s for s in sets if s[0] == chosen):
        reader = (vtk.vtkXMLPUnstructuredGridReader if file.suffix == ".pvtu"
                  else vtk.vtkXMLUnstructuredGridReader)()
        reader.SetFileName(str(file))
        reader.Update()
        append.AddInputData(reader.GetOutput())
    append.Update()
    return append.GetOutput()


def of_pairs(grid, pairs):
    """The faces of these contact pairs, or of those that are not tied if there are any."""
    data = grid.GetPointData()
    pair, status = (numpy_support.vtk_to_numpy(data.GetArray(n)) for n in ("pair", "status"))
    if pairs is None:
        pairs = numpy.unique(pair[status != 3])
        if not pairs.size:
            return grid
    elif not numpy.isin(pairs, pair).all():
        sys.exit(f"--pairs: the run has the pairs {', '.join(f'{p:g}' for p in numpy.unique(pair))}")
    chosen = vtk.vtkIdList()
    for cell in range(grid.GetNumberOfCells()):
        if pair[grid.GetCell(cell).GetPointId(0)] in pairs:
            chosen.InsertNextId(cell)
    extract = vtk.vtkExtractCells()
    extract.SetInputData(grid)
    extract.SetCellList(chosen)
    extract.Update()
    return extract.GetOutput()


def merged(grid):
    """The grid with one point at each place, so that faces between cells are recognised."""
    points = numpy_support.vtk_to_numpy(grid.GetPoints().GetData())
    size = max(numpy.ptp(points, axis=0).max(), 1e-300)
    _, first, index = numpy.unique(numpy.round(points / size * 1e6), axis=0, return_index=True,
                                   return_inverse=True)
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(vtk.vtkPoints())
    result.GetPoints().SetData(numpy_support.numpy_to_vtk(points[first], deep=True))
    cells = vtk.vtkCellArray()
    old = grid.GetCells()
    connectivity = index.ravel()[numpy_support.vtk_to_numpy(old.GetConnectivityArray())]
    cells.SetData(*(numpy_support.numpy_to_vtkIdTypeArray(a.astype(numpy.int64), deep=True)
                    for a in (numpy_support.vtk_to_numpy(old.GetOffsetsArray()), connectivity)))
    result.SetCells(grid.GetCellTypesArray(), cells)
    data = grid.GetPointData()
    for k in range(data.GetNumberOfArrays()):
        array = data.GetArray(k)
        copy = numpy_support.numpy_to_vtk(numpy_support.vtk_to_numpy(array)[first], deep=True)
        copy.SetName(array.GetName())
        result.GetPointData().AddArray(copy)
    return result


def surface(grid, scale, mirror):
    """The boundary of a grid whose cells have points of their own, deformed."""
    warp = vtk.vtkWarpVector()
    warp.SetInputData(merged(grid))
    warp.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    warp.SetScaleFactor(scale)
    outside = vtk.vtkGeometryFilter()
    outside.SetInputConnection(warp.GetOutputPort())
    outside.Update()
    result = outside.GetOutput()
    for axis in mirror:
        other = vtk.vtkTransform()
        other.Scale(*(-1 if axis == a else 1 for a in "xyz"))
        flip = vtk.vtkTransformPolyDataFilter()
        flip.SetTransform(other)
        flip.SetInputData(result)
        both = vtk.vtkAppendPolyData()
        both.AddInputData(result)
        both.AddInputConnection(flip.GetOutputPort())
        both.Update()
        result = both.GetOutput()
    return result


def bodies(grid, scale, hide, mirror):
    """The surface of each body, since bodies share no nodes where they touch."""
    present = numpy.unique(numpy_support.vtk_to_numpy(grid.GetPointData().GetArray("body")))
    for body in present:
        if body in hide:
            continue
        part = vtk.vtkThreshold()
        part.SetInputData(grid)
        part.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "body")
        part.SetLowerThreshold(body - 0.5)
        part.SetUpperThreshold(body + 0.5)
        part.Update()
        yield surface(part.GetOutput(), scale, mirror)


def add_component(surfaces, field):
    """Components of vectors as fields of their own: traction_x, displacement_z."""
    name, _, axis = field.rpartition("_")
    for s in surfaces:
        vector = s.GetPointData().GetArray(name)
        if vector is not None and s.GetPointData().GetArray(field) is None and axis in ("x", "y", "z"):
            array = numpy_support.numpy_to_vtk(
                numpy_support.vtk_to_numpy(vector)[:, "xyz".index(axis)].copy(), deep=True)
            array.SetName(field)
            s.GetPointData().AddArray(array)


def colour_table(low, high):
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(COLOURS))
    for i, colour in enumerate(COLOURS):
        table.SetTableValue(i, *(int(colour[k:k + 2], 16) / 255 for k in (0, 2, 4)), 1)
    table.SetRange(low, high)
    return table


def value_range(surfaces, field, given):
    if given:
        return given
    values = [s.GetPointData().GetArray(field) for s in surfaces]
    if None in values:
        sys.exit(f"there is no field '{field}'")
    low = min(v.GetRange()[0] for v in values)
    high = max(v.GetRange()[1] for v in values)
    if high - low < 1e-3 * max(abs(high), abs(low)):
        # A uniform field shows as one colour, not as its round-off.
        middle, half = (low + high) / 2, 0.05 * max(abs(high), abs(low), 1e-300)
        low, high = middle - half, middle + half
    return low, high


def render(surfaces, field, table, style, camera):
    """The panel as an array of pixels, cropped to what it shows."""
    direction, up, focus, width = camera
    largest, edges, outlines = style
    view = numpy.array(direction) / numpy.linalg.norm(direction)
    right = numpy.cross(up, view)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(view, right)
    points = numpy.concatenate([numpy_support.vtk_to_numpy(s.GetPoints().GetData()) for s in surfaces])
    extent = [(points @ axis).min() for axis in (right, up)], [(points @ axis).max() for axis in (right, up)]
    if width:
        middle = focus if focus else points.mean(axis=0)
        centre = numpy.array([numpy.dot(middle, right), numpy.dot(middle, up)])
        extent = centre - width / 2, centre + width / 2
    size = numpy.array(extent[1]) - numpy.array(extent[0])
    pixels = min(largest[0] / size[0], largest[1] / size[1])
    shape = [max(int(size[0] * pixels), 40) + 8, max(int(size[1] * pixels), 40) + 8]

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for s in surfaces:
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(s)
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(field)
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
        mapper.InterpolateScalarsBeforeMappingOn()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        # Colours are to be read, so shading stays faint.
        look.SetAmbient(0.65)
        look.SetDiffuse(0.35)
        look.SetInterpolationToFlat()
        if edges:
            look.EdgeVisibilityOn()
            look.SetEdgeColor(0.3, 0.3, 0.3)
            look.SetLineWidth(1.0)
        renderer.AddActor(actor)
        if not outlines:
            continue
        outline = vtk.vtkFeatureEdges()
        outline.SetInputData(s)
        outline.SetFeatureAngle(40)
        outline.ColoringOff()
        lines = vtk.vtkPolyDataMapper()
        lines.SetInputConnection(outline.GetOutputPort())
        lines.ScalarVisibilityOff()
        lines.SetRelativeCoincidentTopologyLineOffsetParameters(0, -4)
        sharp = vtk.vtkActor()
        sharp.SetMapper(lines)
        sharp.GetProperty().SetColor(0, 0, 0)
        sharp.GetProperty().SetLineWidth(2.2)
        renderer.AddActor(sharp)
    eye = renderer.GetActiveCamera()
    eye.ParallelProjectionOn()
    depth = points @ view
    middle = (extent[0][0] + extent[1][0]) / 2 * right + (extent[0][1] + extent[1][1]) / 2 * up \
        + (depth.min() + depth.max()) / 2 * view
    eye.SetFocalPoint(*middle)
    eye.SetPosition(*(middle + (numpy.ptp(depth) + size.max()) * 2 * view))
    eye.SetViewUp(*up)
    eye.SetParallelScale(shape[1] / pixels / 2)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*shape)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    array = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
    array = array.reshape(image.GetDimensions()[1], image.GetDimensions()[0], 3)[::-1]
    ink = numpy.argwhere((array < 255).any(axis=2))
    return array[ink[:, 0].min():ink[:, 0].max() + 1, ink[:, 1].min():ink[:, 1].max() + 1].copy()


def written(text, size):
    """A line of text as an array of pixels."""
    look = vtk.vtkTextProperty()
    look.SetFontFamilyToArial()
    look.SetFontSize(size)
    look.SetColor(0, 0, 0)
    image = vtk.vtkImageData()
    vtk.vtkTextRenderer.GetInstance().RenderString(look, text, image, [0, 0], 72)
    array = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
    array = array.reshape(image.GetDimensions()[1], image.GetDimensions()[0], 4)[::-1]
    alpha = array[..., 3:].astype(float) / 255
    array = (255 * (1 - alpha) + array[..., :3] * alpha).astype(numpy.uint8)
    ink = numpy.argwhere((array < 250).any(axis=2))
    return array[:, max(ink[:, 1].min() - 1, 0):ink[:, 1].max() + 2]


def paste(canvas, array, top, left):
    height, width = array.shape[:2]
    canvas[top:top + height, left:left + width] = array


def bar(width, title, low, high):
    """The colours with their values, below a title."""
    canvas = numpy.full((112, width, 3), 255, numpy.uint8)
    head = written(title, TEXT)[:38]
    if head.shape[1] > width:
        head = written(title, TEXT * (width - 4) // head.shape[1])[:38, :width]
    paste(canvas, head, 4, (width - head.shape[1]) // 2)
    length = min(width - 80, 560)
    start = (width - length) // 2
    for i, colour in enumerate(COLOURS):
        canvas[44:70, start + length * i // len(COLOURS):start + length * (i + 1) // len(COLOURS)] = \
            [int(colour[k:k + 2], 16) for k in (0, 2, 4)]
    for i in range(5):
        number = low + (high - low) * i / 4
        value = f"{number:.0f}" if 1000 <= abs(number) < 1e5 else f"{number:.3g}"
        label = written(value if len(value) < 7 else f"{number:.1e}", SMALL)
        at = start + length * i // 4
        canvas[70:77, max(at - 1, 0):at + 1] = 0
        label = label[:112 - 79]
        paste(canvas, label, 79, min(max(at - label.shape[1] // 2, 0), width - label.shape[1]))
    return canvas


def panel(surfaces, field, title, given, style, camera):
    add_component(surfaces, field)
    low, high = value_range(surfaces, field, given)
    image = render(surfaces, field, colour_table(low, high), style, camera)
    legend = bar(max(image.shape[1], 420), title, low, high)
    width = max(image.shape[1], legend.shape[1])
    return [numpy.pad(part, ((0, 0), ((width - part.shape[1]) // 2, (width - part.shape[1] + 1) // 2), (0, 0)),
                      constant_values=255) for part in (image, legend)]


def write(file_name, array):
    """With 32 levels of each colour, which makes the file small."""
    array = ((array.astype(int) * 31 + 127) // 255) * 255 // 31
    image = vtk.vtkImageData()
    image.SetDimensions(array.shape[1], array.shape[0], 1)
    data = numpy_support.numpy_to_vtk(array[::-1].reshape(-1, 3).astype(numpy.uint8), deep=True)
    image.GetPointData().SetScalars(data)
    writer = vtk.vtkPNGWriter()
    writer.SetCompressionLevel(9)
    writer.SetFileName(file_name)
    writer.SetInputData(image)
    writer.Write()


def write_points(grid, file_name):
    data = grid.GetPointData()
    columns = [data.GetArray(n) for n in ("pressure", "gap", "status")]
    rows = {(*grid.GetPoint(i), *(c.GetTuple1(i) for c in columns)) for i in range(grid.GetNumberOfPoints())}
    with open(file_name, "w", encoding="ascii") as out:
        out.write("# x y z pressure gap status\n")
        for row in sorted(rows):
            out.write(" ".join(f"{x:.9g}" for x in row) + "\n")


def main():
    a = arguments()
    unit = dimension(a.field, a.unit)
    contact_unit = dimension(a.contact, a.unit if a.contact_unit is None else a.contact_unit)
    deformed = {0: "", 1: ", deformed"}.get(a.scale, f", deformed {a.scale:g} times")
    style = a.size, not a.no_edges, not a.no_outline
    panels = []
    for time in () if a.no_bodies else a.time or [None]:
        found = list(bodies(read(a.folder / "solution.pvd", time), a.scale, a.hide, a.mirror.split()))
        panels.append(panel(found, a.field, a.field.replace("_", " ").replace("mises", "Mises") + unit + deformed, a.range,
                            style, (a.camera, a.up, a.focus, a.width)))
    if not a.no_contact:
        contact = read(a.folder / "contact.pvd", a.time[-1] if a.time else None)
        if a.points:
            write_points(contact, a.points)
        contact = of_pairs(contact, a.pairs)
        panels.append(panel([surface(contact, a.scale, a.mirror.split())], a.contact,
                            f"contact {a.contact.replace('_', ' ')}{contact_unit}, slave surface", a.contact_range,
                            style, (a.contact_camera or a.camera, a.contact_up or a.up,
                                             a.focus, a.contact_width or a.width)))
    height = max(image.shape[0] for image, _ in panels)
    width = sum(image.shape[1] for image, _ in panels) + MARGIN * (len(panels) + 1) + 24 * (len(panels) - 1)
    canvas = numpy.full((height + 112 + 2 * MARGIN + 8, width, 3), 255, numpy.uint8)
    left = MARGIN
    for image, legend in panels:
        paste(canvas, image, MARGIN + (height - image.shape[0]) // 2, left)
        paste(canvas, legend, MARGIN + height + 8, left)
        left += image.shape[1] + MARGIN + 24
    write(a.image, canvas)


main()
