# SPDX-License-Identifier: LGPL-2.1-or-later
"""General contact over many cycles: a block that rests on a floor presses it with its weight whatever the length
of the cycles, and a mat whose ends are turned against each other rolls up without passing through itself
(doc/general_contact.md, section 7). With one more argument: results of the mat."""

import sys
from math import pi

from touchstone_test import below, check, finish, folder, rounds_are_few, run
import crossings  # of tests/, which touchstone_test finds
from hexahedra import box, turn


def body(name, geometry, keys, damping):
    """The section of a body of one-point cells."""
    return "\n".join([f"subsection Body {name}", "  set Element = one point", keys, "  subsection Geometry", geometry, "  end",
                      "  subsection Material", "    set Law = neo-Hookean", "    set Young modulus = 1000",
                      "    set Poisson ratio = 0.3", "    set Density = 1", f"    set Rayleigh mass = {damping}", "  end",
                      "end"])


def write(name, bodies, end, steps=5):
    """Write the scene."""
    names = ", ".join(text.split("\n", 1)[0][len("subsection Body "):] for text in bodies)
    (folder / f"{name}.prm").write_text("\n".join(
        [f"set Bodies = {names}", "set Contact pairs = all", *bodies, "subsection Time integration",
         "  set Scheme = central_differences", "end", "subsection Load stepping", f"  set End time = {end}",
         f"  set Steps = {steps}", "end", ""]), encoding="utf-8")
    return folder / f"{name}.prm"


def block(lower, upper, cells):
    """A box of the program."""
    return "\n".join(["    set Type = box", f"    set Lower corner = {lower}", f"    set Upper corner = {upper}",
                      f"    set Cells = {cells}"])


box((-.4, -.4, 0), (.4, .4, .8), (2, 2, 2)).mapped(turn((0, 0, 1), .3)).written(folder / "block.vtk")
REST = write("rest", [body("floor", block("-1, -1, -0.5", "1, 1, 0", "3, 3, 1"), "  set Fixed = bottom", 20),
                      body("block", "    set Type = file\n    set File = block.vtk",
                           "  set Body force z = -10*min(1,t)", 20)], 2)
for courant in 0.95, 0.03, 0.001:
    rest = run("rest", REST, {"Time integration/Courant factor": courant})
    below(f"force at rest with Courant factor {courant}", abs(rest.reaction("floor", "bottom")[2] / 5.12 - 1), 1e-4)

# Both ends by two thirds of a turn.
TURNS = ""
for side, sign in ("left", -1), ("right", 1):
    angle = f"({sign * 4 / 3 * pi / 4}*t)"
    TURNS += (f"  subsection Boundary {side}\n    set Displacement x = 0\n"
              f"    set Displacement y = y*(cos({angle}) - 1) - z*sin({angle})\n"
              f"    set Displacement z = y*sin({angle}) + z*(cos({angle}) - 1)\n  end\n")
mat = run("mat", write("mat", [body("mat", block("-1.5, -0.5, -0.02", "1.5, 0.5, 0.02", "24, 8, 1"),
                                    "  set Boundary conditions = left, right\n" + TURNS, 0.5)], 4,
                       *(int(word) for word in sys.argv[4:] if word.isdigit())), vtu=1)
for path in sorted(mat.folder.glob("solution_*.vtu")):
    places = crossings.find(path)
    check(not places, f"mat: {len(places)} crossings in {path.name}, the first at {places[:1]}")
below("mat, balance error", abs(mat.value("motion", "energies", "balance_error")) /
      mat.value("motion", "energies", "external"), 1e-2)
print("mat, cycles between results:", max(mat.column("cycles")))
rounds_are_few(mat, 1e-3, 2e-2)
impulse = mat.value("motion", "energies", "contact")
check(impulse > 0, "mat: it does not meet itself")
finish()
