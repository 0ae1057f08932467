# SPDX-License-Identifier: LGPL-2.1-or-later
"""Self-contact of explicit dynamics against half of the body and a plane in the middle: a ring that is
pressed between two planes until its inner walls meet, and a C whose ends meet (doc/general_contact.md,
section 7)."""

from touchstone_test import below, check, contact_gives, finish, folder, run

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


def write(name, first, angle, cells, travel, end, damping, symmetry, planes, self_contact):
    """Write a scene: a part of a ring of the radii 8 and 10 about the axis y.

    @param planes: (name, height, direction, travel relative to @p travel, boundaries)
    """
    pairs = [plane[0] for plane in planes] + (["itself"] if self_contact else [])
    text = f"""set Bodies        = ring
set Obstacles     = {', '.join(plane[0] for plane in planes)}
set Contact pairs = {', '.join(pairs)}
subsection Body ring
  set Element  = one point
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
    if self_contact:
        text += "subsection Contact pair itself\n  set Slave body = ring\nend\n"
    text += ("subsection Time integration\n  set Scheme = central_differences\nend\n"
             f"subsection Load stepping\n  set End time = {end}\n  set Steps = 50\nend\n")
    (folder / f"{name}.prm").write_text(text, encoding="utf-8")
    return folder / f"{name}.prm"


def compare(name, whole, half, alone):
    """Forces of the upper plane of the whole body and its half; @p alone: without self-contact."""
    one, other = run(f"{name}_whole", whole), run(f"{name}_half", half)
    forces, expected = (result.column("top: force z") for result in (one, other))
    largest = max(map(abs, expected))
    below(f"{name}, force against that of the half", max(abs(a - b) for a, b in zip(forces, expected)) / largest,
          1e-3)
    # The planes do not touch each other's half: without contact in the middle nothing would stop it.
    check(max(other.column("middle: force z")) > 0.1 * largest, f"{name}: the middle does not touch")
    contact_gives(one, 1e-6)
    both = run(f"{name}_whole_2", whole, ranks=2)
    check(one.summary.get("motion") == both.summary.get("motion"), f"{name}: one and two ranks differ")
    free = run(f"{name}_alone", alone)
    check(max(abs(a - b) for a, b in zip(free.column("top: force z"), expected)) > 0.01 * largest,
          f"{name}: without self-contact the force is the same")


TOP, BOTTOM = ("top", 10, -1, -1, "outer"), ("bottom", -10, 1, 1, "outer")
RING = "3, 24, 1", 8.2, 1, 0, "first cut, second cut, start, end", (TOP, BOTTOM)
compare("ring", write("ring", 0, 180, *RING, True),
        write("half_ring", 0, 90, "3, 12, 1", 8.2, 1, 0, "first cut, second cut, start, end",
              (TOP, ("middle", 0, 1, 0, "inner")), False), write("ring_alone", 0, 180, *RING, False))
# Damped, as the ends would bounce off each other.
BENT = "2, 40, 1", 6.2, 4, 20, "start, end", (TOP, BOTTOM)
compare("c", write("c", 120, 300, *BENT, True),
        write("half_c", 270, 150, "2, 20, 1", 6.2, 4, 20, "first cut, start, end",
              (TOP, ("middle", 0, 1, 0, "inner, outer, second cut")), False), write("c_alone", 120, 300, *BENT, False))
finish()
