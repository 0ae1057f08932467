# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of a ring and a C that are pressed between two planes until they touch themselves, whole and as the
half with a plane in the middle."""

from touchstone_test import folder

PLANE = """subsection Obstacle {name}
  set Shape     = plane
  set Point     = 0, 0, {height}
  set Direction = 0, 0, {direction}
  set Motion z  = {travel} * min(1, t/{end})^2 * (3 - 2*min(1, t/{end}))
end
"""
PAIR = """subsection Contact pair {name}
  set Slave body       = ring
  set Slave boundaries = {boundaries}
  set Obstacle         = {name}
end
"""


def write(name, first, angle, cells, travel, end, damping, symmetry, planes, itself, element="one point",
          scheme="  set Scheme = central_differences\n", steps=50, more=""):
    """Write a scene: a part of a ring of the radii 8 and 10 about the axis y.

    @param planes: (name, height, direction, travel relative to @p travel, boundaries)
    @param itself: lines of the pair by which the ring touches itself; without any it does not.
    @param scheme: lines of the section "Time integration".
    @param more: further sections.
    """
    pairs = [plane[0] for plane in planes] + (["itself"] if itself else [])
    text = f"""set Bodies        = ring
set Obstacles     = {', '.join(plane[0] for plane in planes)}
set Contact pairs = {', '.join(pairs)}
subsection Body ring
  set Element  = {element}
  set Symmetry = {symmetry}
  subsection Geometry
    set Type         = tube
    set Axis         = y
    set Inner radius = 8
    set Outer radius = 10
    set First angle  = {first}
    set Angle        = {angle}
    set Cells        = {cells}
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 100
    set Poisson ratio = 0.3
    set Density       = 1e-3
    set Rayleigh mass = {damping}
  end
end
"""
    for plane, height, direction, part, boundaries in planes:
        text += PLANE.format(name=plane, height=height, direction=direction, travel=part * travel, end=end)
        text += PAIR.format(name=plane, boundaries=boundaries)
    if itself:
        text += f"subsection Contact pair itself\n  set Slave body = ring\n{itself}end\n"
    text += (f"subsection Time integration\n{scheme}end\n"
             f"subsection Load stepping\n  set End time = {end}\n  set Steps = {steps}\nend\n{more}")
    (folder / f"{name}.prm").write_text(text, encoding="utf-8")
    return folder / f"{name}.prm"


TOP, BOTTOM = ("top", 10, -1, -1, "outer"), ("bottom", -10, 1, 1, "outer")
