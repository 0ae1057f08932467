# SPDX-License-Identifier: LGPL-2.1-or-later
"""General contact, 'Initial overlap = adjust': surfaces that cross each other as bodies are placed are moved
apart without stress, on any number of ranks; what overlaps too far is refused (doc/general_contact.md)."""

from math import pi

from touchstone_test import below, check, finish, folder, launch, run
import crossings  # of tests/, which touchstone_test finds
from hexahedra import box, move, ring, turn

ADJUST = {"Contact pair everything/Initial overlap": "adjust"}


def scene(name, meshes, symmetry=""):
    """Write a scene of bodies at rest."""
    text = [f"set Bodies = {', '.join(meshes)}", "set Contact pairs = everything",
            "subsection Contact pair everything", "end"]
    for body, mesh in meshes.items():
        geometry = mesh
        if not isinstance(mesh, str):
            mesh.written(folder / f"{name}_{body}.vtk")
            geometry = f"    set Type = file\n    set File = {name}_{body}.vtk"
        text += [f"subsection Body {body}", "  set Element = one point", f"  set Symmetry = {symmetry}",
                 "  subsection Geometry", geometry, "  end", "  subsection Material",
                 "    set Law = neo-Hookean", "    set Young modulus = 1000", "    set Poisson ratio = 0.3",
                 "    set Density = 1", "  end", "end"]
    text += ["subsection Time integration", "  set Scheme = central_differences", "end",
             "subsection Load stepping", "  set End time = 0.1", "  set Steps = 1", "end", ""]
    (folder / f"{name}.prm").write_text("\n".join(text), encoding="utf-8")
    return folder / f"{name}.prm"


def tube(inner, outer, start, around, angle):
    """A tube as the geometry of the program."""
    return (f"    set Type = tube\n    set Axis = z\n    set Inner radius = {inner}\n    set Outer radius = {outer}\n"
            f"    set Start = {start}\n    set End = {start + 1}\n    set Angle = {angle}\n"
            f"    set Cells = 2, {around}, 3")


def adjusted(name, path, ranks=1, mirrored=()):
    """Nothing crosses when the run begins, and nothing is pressed."""
    result = run(f"{name}_{ranks}", path, ADJUST, ranks, vtu=1)
    result.says("without stress")
    for file in sorted(result.folder.glob("solution_*.vtu")):
        places = crossings.find(file, mirrored=mirrored)
        check(not places, f"{name}: {len(places)} crossings in {file.name}, the first at {places[:1]}")
    velocities = result.summary.get("motion", {}).get("velocities", {"none": (1,)})
    below(f"{name}, velocity", max(abs(c) for v in velocities.values() for c in v), 1e-8)
    return result


# A plug in a ring: facets of the one overlap those of the other by their arcs.
plug = scene("plug", {"ring": tube(1, 1.4, 0, 14, 360), "plug": tube(.6, 1, .1, 18, 360)})
one, two = adjusted("plug", plug), adjusted("plug", plug, 2)
check(bool(one.summary) and one.summary["motion"] == two.summary.get("motion"), "plug: ranks differ")
# A quarter: nodes at the cuts stay there, or the program would refuse planes that are not plane.
quarter = adjusted("quarter", scene("quarter", {"ring": tube(1, 1.4, 0, 4, 90), "plug": tube(.6, 1, .1, 5, 90)},
                                    "first cut, second cut"), mirrored=((0, 0), (1, 0)))
nodes, _ = crossings.read(quarter.folder / "solution_0000.vtu")
check(min(min(x[:2]) for x in nodes.values()) > -1e-15 and
      sum(min(x[:2]) < 1e-15 for x in nodes.values()) == 48, "quarter: nodes have left the cuts")
# Only edges cross, by less than a quarter of a face.
BAR = box((-.5, -2, -.5), (.5, 2, .5), (1, 3, 1)).mapped(turn((0, 1, 0), pi / 4))
bars = scene("bars", {"lower": BAR, "upper": BAR.mapped(turn((0, 0, 1), pi / 2), move((.13, .07, 1.3)))})
adjusted("bars", bars)
# A body that overlaps itself: a C whose ends have passed each other.
adjusted("itself", scene("itself", {"c": ring(1, .3, .3, 16, 2, 1, 2 * pi + .02)}))

BOXES = [box((0, 0, z), (1, 1, z + 1), (2, 2, 2)).mapped(move((s, s, 0))) for s, z in ((0, 0), (.2, .7))]
deep = scene("deep", {"lower": BOXES[0], "upper": BOXES[1]})
for path, options, texts in (
        (plug, (), ("'ring' and 'plug' near (", "'adjust'")),
        (deep, ("--set", "Contact pair everything/Initial overlap=adjust"),
         ("surfaces cross each other at the start", "'lower' and 'upper' near (", "a quarter of a face"))):
    refused = launch("--results-only", "--output", "refused", *options, path, timeout=60)
    check(refused.returncode != 0 and all(text in refused.stdout for text in ("Remedy: ", *texts)),
          f"{path.name}: not refused, or not for this reason:\n{refused.stdout[-600:]}")
finish()
