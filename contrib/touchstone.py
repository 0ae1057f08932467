# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what runs have written, with nothing but Python: summary, statistics, probes, and the VTU files
of bodies and contact surfaces.

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
from fuzzing import vtu


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
        return [time for time, file in files(self.folder / f"{series}.pvd")]

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
        return [arrays for file in files_at(self.folder, "solution", time)
                for arrays in vtu.pieces(file)]


def files(series):
    """(time, file) of a .pvd file."""
    if not series.is_file():
        return []
    return [(float(d.get("timestep")), d.get("file")) for d in xml.parse(series).iter("DataSet")]


def files_at(folder, name, time=None):
    """The files of all ranks of one time: the nearest to @p time, or the last."""
    found = files(folder / f"{name}.pvd")
    if not found:
        return []
    # Not the last file in the folder, which may have some of an earlier run.
    file = found[-1][1] if time is None else min(found, key=lambda entry: abs(entry[0] - time))[1]
    return sorted(folder.glob(f"{file.partition('.')[0]}.*vtu"))


def table(path):
    """Columns of a CSV file of the program, by their names, and their units; empty cells are no
    numbers."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
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
    # Nodes between the parts of two ranks are in the files of both.
    nodes = {(node.position, node.pair): node
             for file in files_at(folder, "contact", time) for node in vtu.read(file)}
    return list(nodes.values())


def faces(folder, time=None):
    """Faces of the contact surface at a time, or the last, of all ranks."""
    return [face for file in files_at(folder, "contact", time) for face in vtu.faces(file)]


def pairs(folder):
    """Names of the contact pairs in the order of the scene."""
    text = (folder / "parameters.prm").read_text(encoding="utf-8")
    names = re.search(r"^set Contact pairs *= *(.*)$", text, re.M)
    return [name.strip() for name in names[1].partition("#")[0].split(",")] if names else []
