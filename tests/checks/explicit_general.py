# SPDX-License-Identifier: LGPL-2.1-or-later
"""General contact of explicit dynamics: nothing passes through anything, whatever meets, on any
number of ranks (doc/general_contact.md)."""

from math import pi

from touchstone_test import below, check, contact_gives, finish, folder, launch, run
from fuzzing.vtu import read  # of contrib/, which touchstone_test finds
from hexahedra import box, move, turn  # of tests/

NOT_TURNED = turn((0, 0, 1), 0)


def block(name, lower, upper, cells, velocity, turned=NOT_TURNED, offset=(0, 0, 0)):
    """The section of a block that is turned about the origin and moved, and its mesh file."""
    box(lower, upper, cells).mapped(turned, move(offset)).written(folder / f"{name}.vtk")
    lines = [f"subsection Body {name}", "  set Element = one point"]
    lines += [f"  set Initial velocity {axis} = {v}" for axis, v in zip("xyz", velocity)]
    lines += ["  subsection Geometry", "    set Type = file", f"    set File = {name}.vtk", "  end",
              "  subsection Material", "    set Law = neo-Hookean", "    set Young modulus = 1000",
              "    set Poisson ratio = 0.3", "    set Density = 1", "  end", "end"]
    return "\n".join(lines)


def write(name, parts, end=1, contact="all"):
    """Write the scene."""
    bodies = ", ".join(part.split("\n", 1)[0][len("subsection Body "):] for part in parts
                       if part.startswith("subsection Body"))
    text = [f"set Bodies = {bodies}", f"set Contact pairs = {contact}", *parts,
            "subsection Time integration", "  set Scheme = central_differences", "end",
            "subsection Load stepping", f"  set End time = {end}", "  set Steps = 5", "end", ""]
    (folder / f"{name}.prm").write_text("\n".join(text), encoding="utf-8")
    return folder / f"{name}.prm"


def meet(name, parts, ranks=1, contact="all", gives=1e-10):
    """Two bodies meet and part again: none has passed through the other."""
    result = run(f"{name}_{ranks}", write(name, parts, contact=contact), ranks=ranks)
    if not result.summary:
        return result
    motion = result.summary["motion"]
    lower, upper = (motion["velocities"][body][2] for body in ("lower", "upper"))
    check(upper > lower + 0.1, f"{name}: bodies do not part, {lower} {upper}")
    below(f"{name}, balance error", abs(motion["energies"]["balance_error"]), 2e-3)
    for axis in "xyz":
        values = result.column(f"momentum {axis}")
        below(f"{name}, momentum {axis}", max(abs(v - values[0]) for v in values), 1e-12)
    contact_gives(result, gives)
    return result


UP, DOWN = (0, 0, 0.5), (0, 0, -0.5)
# Only edges meet: cubes of one cell, one turned by 45 degrees, and bars that cross, each with an edge
# towards the other.
meet("cubes", [block("lower", (-.5, -.5, 0), (.5, .5, 1), (1, 1, 1), UP),
               block("upper", (-.5, -.5, 1.01), (.5, .5, 2.01), (1, 1, 1), DOWN,
                     turn((0, 0, 1), pi / 4))])
BARS = [block("lower", (-.5, -2, -.5), (.5, 2, .5), (1, 3, 1), UP, turn((0, 1, 0), pi / 4)),
        block("upper", (-2, -.5, -.5), (2, .5, .5), (3, 1, 1), DOWN, turn((1, 0, 0), pi / 4),
              (0, 0, 1.45))]
first, second = meet("bars", BARS), meet("bars", BARS, ranks=2)
check(first.summary["motion"] == second.summary["motion"], "bars: one and two ranks differ")
# Forces on the contact surface are what changes the momenta, on any number of ranks.
for ranks in 1, 2:
    drawn = run(f"drawn_{ranks}", folder / "bars.prm", ranks=ranks, vtu=1)
    # Of several ranks there is a file of each, which have nodes between them both.
    nodes = [node for step in range(1, 6) for node in
             {node.position: node for file in drawn.folder.glob(f"contact_{step:04d}*.vtu") for node in read(file)}.values()]
    for body, sign in ("lower", 1), ("upper", -1):
        # The middles of the bars are 1.45 apart; steps of 0.2, masses of 4.
        impulse = sum(0.2 * node.force[2] for node in nodes if (node.position[2] < 0.725) == (sign > 0))
        change = 4 * (drawn.value("motion", "velocities", body, 2) - 0.5 * sign)
        below(f"bars, impulse on the {body} one", abs(impulse / change - 1), 1e-5)
    check(any(node.pressure > 0 for node in nodes) and all((node.status > 0) == any(node.force) for node in nodes),
          "bars: no pressure, or status and force do not belong together")
# A corner on a face, faces on faces of other cells, with friction.
meet("corner", [block("lower", (-2, -2, -1), (2, 2, 0), (4, 4, 1), (0, 0, 0)),
                block("upper", (0, 0, 0), (1, 1, 1), (2, 2, 2), (0, 0, -1),
                      turn((1, -1, 0), 0.9553166), (.3, .2, .02))])
FRICTION = ("subsection Contact pair everything\n  set Slave body = lower, upper\n"
            "  set Behaviour = coulomb\n  subsection Friction\n    set Coefficient = 0.3\n  end\nend")
FACES = [block("lower", (0, 0, 0), (1, 1, 1), (3, 3, 3), UP),
         block("upper", (.2, .1, 1.05), (1.2, 1.1, 2.05), (2, 2, 2), (0.2, 0, -0.5)), FRICTION]
rubbing = meet("faces", FACES, contact="everything", gives=1e-9)
work = rubbing.column("energy: friction")
check(work[-1] > 0 and all(b >= a - 1e-14 for a, b in zip(work, work[1:])),
      "faces: friction does no work, or gives energy")

# Neither ranks nor how and when candidates are found matter to the last bit.
KEY = "Contact pair everything/Search"
for ranks, settings in ((3, {}), (1, {f"{KEY} margin": 0.3}), (1, {f"{KEY} margin": 0.001}),
                        (2, {KEY: "linear grid"})):
    other = run("faces_other", folder / "faces.prm", settings, ranks)
    check(other.summary.get("motion") == rubbing.summary["motion"],
          f"faces: another result on {ranks} rank(s) with {settings}")

# Boxes that are flush with each other, and one that slides over their edges: it meets no bump, and
# what touches without a gap has no force.
FLUSH = [block(f"lower {i}", (i, 0, 0), (i + 1, 1, 1), (2, 2, 2), (0, 0, 0)) for i in range(3)]
flush = run("flush", write("flush", [*FLUSH, block("slider", (.4, .1, 1), (1.3, .9, 1.6), (2, 2, 2),
                                                  (.3, 0, 0))]))
for body, velocity in flush.summary.get("motion", {}).get("velocities", {"none": (1, 1, 1)}).items():
    below(f"flush, {body}, velocity z", abs(velocity[2]), 1e-10)

# Refused before the run, with section, key and remedy or places.
for what, parts, contact, settings, texts in (
        ("crossing", [block("lower", (0, 0, 0), (1, 1, 1), (2, 2, 2), UP),
                      block("upper", (.2, .1, .9), (1.2, 1.1, 1.9), (2, 2, 2), DOWN)], "all", {},
         ("surfaces cross each other at the start", "'lower' and 'upper' near (")),
        ("statics", FACES[:2], "all", {"Time integration/Scheme": "static"}, ("is for explicit dynamics",)),
        ("springs", FACES[:2], "all", {"Contact/Enforcement": "penalty"}, ("'Enforcement'",)),
        ("body", FACES, "everything", {"Contact pair everything/Slave body": "uper"}, ("'uper'",)),
        ("margin", FACES, "everything", {"Contact pair everything/Search margin": "-1"},
         ("'Search margin'",)),
        ("search", FACES, "everything", {"Contact pair everything/Search": "threes"}, ("'Search'",)),
        ("boundary", FACES, "everything", {"Contact pair everything/Slave boundaries": "none"},
         ("'none'",))):
    options = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    refused = launch("--results-only", "--output", "refused", *options,
                     write(what, parts, contact=contact), timeout=60)
    check(refused.returncode != 0 and all(text in refused.stdout for text in ("Remedy: ", *texts)),
          f"{what}: not refused, or not for this reason:\n{refused.stdout[-600:]}")
finish()
