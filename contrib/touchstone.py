# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what runs have written, with nothing but Python: summary, statistics, probes, and the VTU files
of bodies and contact surfaces; with h5py those of the format XDMF, too.

    import sys; sys.path.insert(0, "contrib")
    import touchstone
    run = touchstone.Run("output/press_fit")
    run.summary["converged"]
    columns, units = run.statistics()
    columns["time"], columns["fit.force_z"], units["fit.force_z"]
    columns, units = run.probe("tip")
    for node in run.contact():            # of the last time; contact(2.0): of the nearest to 2
        node.position, node.pressure, node.gap
    for piece in run.bodies():            # some for each rank, of 1,024 cells at most (degree 1)
        piece["position"], piece["displacement"], piece["von_mises"]

Numbers are lists or tuples of floats; vectors and tensors of VTU files are flat, one after the other.
numpy.array(...) takes them as they are.
"""

import csv
import json
import math
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

# pylint: disable=wrong-import-position
from fuzzing import vtu, xdmf


class Run:
    """The output folder of a run."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "summary.json").is_file():
            raise FileNotFoundError(f"{folder} is not the folder of a run: it has no summary.json")

    @property
    def summary(self):
        """What the run came to, as summary.json has it."""
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))

    def statistics(self):
        """Columns of statistics.csv and their units, by name."""
        return table(self.folder / "statistics.csv")

    def probe(self, name):
        """Columns of the history of a probe and their units, by name."""
        return table(self.folder / f"probe_{name}.csv")

    def newton(self):
        """Residuals of each attempt at a step, by iteration."""
        return newton(self.folder)

    def times(self, series="contact"):
        """Times of the files of a series, 'contact' or 'solution'."""
        return [time for time, _ in results(self.folder, series)]

    def contact(self, time=None):
        """Nodes of the slave surfaces, vtu.Node, at a time, or at the last."""
        return surface(self.folder, time)

    def faces(self, time=None):
        """Faces of the slave surfaces, each with its four nodes in order around it."""
        return faces(self.folder, time)

    def pairs(self):
        """Names of the contact pairs; the pair of a node is a place in this list."""
        return pairs(self.folder)

    def bodies(self, time=None):
        """Arrays of the bodies by name, of each rank; 'position' are the points. Points between cells
        come once for each cell."""
        grid = grid_at(self.folder, "solution", time)
        if grid is not None:
            return [xdmf.read(self.folder, grid)[0]]
        return [arrays for file in files_at(self.folder, "solution", time)
                for arrays in vtu.pieces(file)]


def files(series):
    """(time, file) of a .pvd file."""
    if not series.is_file():
        return []
    return [(float(d.get("timestep")), d.get("file")) for d in xml.parse(series).iter("DataSet")]


def results(folder, name):
    """(time, file or grid) of a series, in order: of VTU files, of XDMF, or of a run that was resumed in the
    other format."""
    found = files(folder / f"{name}.pvd") + xdmf.grids(folder / f"{name}.xdmf")
    return sorted(found, key=lambda entry: entry[0])


def result_at(folder, name, time=None):
    """The file or grid of one time: the nearest to @p time, or the last."""
    found = results(folder, name)
    if not found:
        return None
    return (found[-1] if time is None else min(found, key=lambda entry: abs(entry[0] - time)))[1]


def grid_at(folder, name, time=None):
    """The same if it is one of XDMF, or None."""
    found = result_at(folder, name, time)
    return None if isinstance(found, str) else found


def files_at(folder, name, time=None):
    """The VTU files of all ranks of one time: the nearest to @p time, or the last."""
    found = result_at(folder, name, time)
    if not isinstance(found, str):
        return []
    # Only files that the series names: the folder may have others, of an earlier run.
    file = folder / found
    if file.suffix != ".pvtu":
        return [file]
    return [folder / piece.get("Source") for piece in xml.parse(file).iter("Piece")]


def table(path):
    """Columns of a CSV file of the program, by their names, and their units; empty cells are no
    numbers."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    if not rows or not rows[0]:
        raise ValueError(f"{path} is empty")
    columns, units = {}, {}
    for i, title in enumerate(rows[0]):
        name, _, unit = title.partition("[")
        columns[name] = [float(row[i]) if row[i] else math.nan for row in rows[1:]]
        units[name] = unit.rstrip("]")
    return columns, units


def newton(folder):
    """Residuals of each step by iteration, of a log; of a step that was cut each attempt, and of one with a
    force on a tool or a bolt each solution."""
    return [residuals for _, residuals in attempts(folder)]


def attempts(folder):
    """The same as pairs (what it is, residuals): 'step 2, t = 0.5', the next solution '(2)'."""
    found, current, step, number = [], None, "", 0
    if not (folder / "log").is_file():
        return found
    for line in (folder / "log").read_text(encoding="utf-8", errors="replace").splitlines():
        if head := re.match(r"Step (\d+)\S*\s+t = (\S+)", line):
            current, step, number = None, f"step {head[1]}, t = {head[2]}", 0
        # iteration, residual, gap, active nodes, changes, linear iterations
        words = line.split()
        if len(words) >= 5 and re.fullmatch(r"\d+", words[0]) and re.fullmatch(
                r"[\d.]+e[+-]\d+", words[1]):
            if current is None or int(words[0]) <= len(current):
                current, number = [], number + 1
                found.append((step + (f" ({number})" if number > 1 else ""), current))
            current.append(float(words[1]))
    return found


def surface(folder, time=None):
    """Nodes of the contact surface at a time, or the last, of all ranks."""
    grid = grid_at(folder, "contact", time)
    found = (node for file in files_at(folder, "contact", time) for node in vtu.read(file)) if grid is None else (
        vtu.nodes_of(xdmf.read(folder, grid)[0]))
    # Nodes between the parts of two ranks are in the files of both; XDMF has them for each face.
    return list({(node.position, node.pair): node for node in found}.values())


def faces(folder, time=None):
    """Faces of the contact surface at a time, or the last, of all ranks."""
    grid = grid_at(folder, "contact", time)
    if grid is not None:
        arrays, cells = xdmf.read(folder, grid)
        nodes = vtu.nodes_of(arrays)
        return [[nodes[i] for i in cell] for cell in cells]
    return [face for file in files_at(folder, "contact", time) for face in vtu.faces(file)]


def pairs(folder):
    """Names of the contact pairs in the order of the scene."""
    text = (folder / "parameters.prm").read_text(encoding="utf-8")
    names = re.search(r"^set Contact pairs *= *(.*)$", text, re.M)
    return [name.strip() for name in names[1].partition("#")[0].split(",")] if names else []
