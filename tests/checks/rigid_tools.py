# SPDX-License-Identifier: LGPL-2.1-or-later
# ctest: goldens = cone_obstacle, turning_obstacle, turning_roller, stl_plate
"""Rigid tools: a cone against the force of the half space, a turned tool is the tool in another place,
a block on a plane that turns follows it, tied without stress with each enforcement, or held by friction,
on two ranks as well; a sharp tip on a node; friction of a roller that turns on the spot has the moment mu R N."""

import math

from touchstone_test import ENFORCEMENT, ENFORCEMENTS, STEPS, below, check, checks, finish, golden, relative, run, same, tests

# A quarter of F = gamma 2 / pi E / (1 - nu^2) delta^2 tan(alpha): Sneddon's force with the correction
# gamma for the displacement along the surface (Hay, Bolshakov and Pharr 1999). A block is stiffer
# than the half space by a part that falls as one over its size: two blocks tell that part.
nu, angle = 0.3, math.radians(80)
radial = (1 - 2 * nu) / (4 * (1 - nu)) / math.tan(angle)
gamma = math.pi * (math.pi / 4 + 0.15483073 * radial) / (math.pi / 2 - 0.83119312 * radial) ** 2
exact = 0.25 * gamma * 2 / math.pi * 100 / (1 - nu**2) * 0.2**2 * math.tan(angle)
GEOMETRY = "Body block/Geometry/"
FINE = {"Discretisation/Refinement factor": 2, STEPS: 1}
LARGE = {GEOMETRY + "Lower corner": "0,0,-16", GEOMETRY + "Upper corner": "16,16,0",
         GEOMETRY + "Grading": "40,40,0.025"}
near = -run("cone_8", tests / "cone_obstacle.prm", FINE).force("contact")[2]
far = -run("cone_16", tests / "cone_obstacle.prm", {**FINE, **LARGE}).force("contact")[2]
print(f"cone in blocks of 8 and 16: {near:.4f}, {far:.4f}, half space {2 * far - near:.4f}, exact {exact:.4f}")
below("cone, force deviates from that of the half space", relative(2 * far - near, exact), 0.01)

# A sharp tip on a node of a whole block: no force across, whatever solves the contact; and a blunter one.
TIP = checks / "cone_on_node.prm"
for name, settings, ranks in [("cone_on_node", {}, 1), ("cone_on_node_2", {}, 2),
                              *((f"cone_on_node_{e}", {ENFORCEMENT: e}, 1) for e in ENFORCEMENTS),
                              ("cone_on_node_80", {"Obstacle indenter/Half angle": 80}, 1)]:
    pressed = run(name, TIP, settings, ranks)
    across = math.hypot(*pressed.force("contact")[:2]) / abs(pressed.force("contact")[2])
    below(f"{pressed}, force across a symmetric block", across, 1e-6)

# The same tool from another place. The plate is the same after a quarter turn.
turned = run("cone_turned", tests / "cone_obstacle.prm",
             {"Obstacle indenter/Direction": "1,0,0", "Obstacle indenter/Rotate axis": "0,1,0",
              "Obstacle indenter/Rotate angle": -90})
same(turned, golden("cone_obstacle"), 1e-9)
PLATE = "Obstacle ground/"
same(run("plate_turned", tests / "stl_plate.prm",
         {PLATE + "Rotate point": "0.5,0.5,0", PLATE + "Rotate angle": 90}), golden("stl_plate"), 1e-9)

# Tied to a plane that turns by 120 degrees, about an axis that takes x to y and so on for the right
# axis; the probe stands at (1, 0, 0) at first.


def end(result):
    """The last values of the probe."""
    return result.probe("corner")[-1]


PROBE = {"Probes": "corner", "Probe corner/Body": "block", "Probe corner/Point": "1,0,0"}
for enforcement in ENFORCEMENTS:
    tied = run(f"tied_{enforcement}", tests / "turning_obstacle.prm", {ENFORCEMENT: enforcement})
    below(f"{tied}, pressure without load", tied.contact("contact", "max_pressure"), 1e-6)
for steps, ranks in (3, 1), (9, 2):
    tied = run(f"tied_{steps}", tests / "turning_obstacle.prm",
               {STEPS: steps, "Obstacle table/Rotate axis": "1,1,1",
                "Obstacle table/Rotate point": "0,0,0", **PROBE}, ranks)
    values = end(tied)
    # (1, 0, 0) goes to (0, 1, 0), and by 1 along x.
    for name, value in ("displacement_x", 0), ("displacement_y", 1), ("displacement_z", 0):
        below(f"{tied}, {name} deviates", abs(values[name] - value), 1e-8)

# Held by friction alone on a table that turns by 0.4 degrees about (0.5, 0.5).
turn = math.radians(0.4)
corner = 0.5 * (math.cos(turn) - 1), 0.5 * math.sin(turn)
for ranks in 1, 2:
    table = run(f"table_{ranks}", tests / "turning_table.prm", PROBE, ranks)
    moved = end(table)
    for name, value in (("displacement_x", corner[0] + corner[1]), ("displacement_y", corner[1] - corner[0])):
        below(f"{table}, {name} deviates", abs(moved[name] - value), 1e-8)
    check(table.column("contact: stick nodes")[-1] == 9, f"{table}: not all nodes stick")

# The moment of friction about the axis of the roller, which stands at a height of 2.98. Normals
# have almost one direction: N from the resultant.
roller = golden("turning_roller")
force, moment = roller.force("contact"), roller.vector("results", "contact", "contact", "moment")
check(force[0] < 0, "the roller pulls the wrong way")
normal = math.hypot(force[0], force[2]) / math.hypot(1, 0.25)
below("roller, moment deviates from mu R N",
      relative(moment[1] - 2.98 * force[0], 0.25 * 3 * normal), 2e-3)
check(roller.column("contact: slip nodes")[-1] == roller.column("contact: active nodes")[-1],
      "roller: not all nodes slip")
finish()
