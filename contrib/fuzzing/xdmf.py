# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads results in the format XDMF, with h5py: the same arrays as those of VTU files, see vtu."""

import xml.etree.ElementTree as xml


def grids(series):
    """(time, grid) of a .xdmf file."""
    if not series.is_file():
        return []
    return [(float(time.get("Value")), grid) for grid in xml.parse(series).iter("Grid")
            for time in grid.findall("Time")]


def read(folder, grid):
    """The arrays of a grid by their names, flat, "position" are the points; and the points of each of its cells."""
    try:
        import h5py  # pylint: disable=import-outside-toplevel
    except ImportError as error:
        raise ImportError(f"{folder}: results in the format XDMF need h5py: apt-get install python3-h5py, or "
                          "pip install h5py") from error

    def values(item):
        file, _, name = item.text.strip().partition(":")
        with h5py.File(folder / file, "r") as data:
            return data[name][()]

    arrays = {"position": tuple(values(grid.find("Geometry/DataItem")).ravel().tolist())}
    for attribute in grid.iter("Attribute"):
        arrays[attribute.get("Name")] = tuple(values(attribute.find("DataItem")).ravel().tolist())
    return arrays, values(grid.find("Topology/DataItem")).tolist()
