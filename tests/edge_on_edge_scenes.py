# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of two blocks that meet in one edge and are pressed on each other across it."""

from touchstone_test import folder

BLOCK = """subsection Body {name}
  set Symmetry            = front, back
  set Boundary conditions = {sides}
  subsection Geometry
    set Lower corner = {corner}, 0, {corner}
    set Upper corner = {corner} + 1, 1, {corner} + 1
    set Cells        = 3, {cells}, 3
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 100
    set Poisson ratio = 0.3
  end
"""
DRIVEN = """  subsection Boundary {side}
    set Displacement x = {way} * t
    set Displacement z = {way} * t
  end
"""
ON_EDGE = ("  set Master body       = lower\n  set Master boundaries = top, right\n"
           "  set Pairing           = pointwise\n")


def block(name, corner, cells, way):
    """A block whose two sides away from the edge are driven."""
    sides = ("left", "bottom") if corner == 0 else ("right", "top")
    text = BLOCK.format(name=name, sides=", ".join(sides), corner=corner, cells=cells)
    return text.replace(f"{corner} + 1", str(corner + 1)) + "".join(
        DRIVEN.format(side=side, way=way) for side in sides) + "end\n"


def pressed(name, head, blocks, master, slave="bottom, left"):
    """Write a scene of blocks; the upper one is the slave."""
    path = folder / f"{name}.prm"
    path.write_text(f"{head}set Contact pairs = edge\n{blocks}subsection Contact pair edge\n"
                    f"  set Slave body       = upper\n  set Slave boundaries = {slave}\n{master}end\n"
                    "subsection Load stepping\n  set Steps = 5\nend\n", encoding="utf-8")
    return path
