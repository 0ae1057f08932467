# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two blocks on an interface that is inclined to all axes, pressed together with one uniform stress:
every exact enforcement meets it to 1e-10."""

import math

from touchstone_test import (ENFORCEMENT, EXACT_ENFORCEMENTS, GAP, RESIDUAL, below, finish, folder,
                             run)

# Blocks 1 x 1 x 0.5 on each other with 6 x 6 x 2 and 4 x 4 x 2 cells, turned by the matrix of
# the unit quaternion (1, 0.3, -0.4, 0.2), and the displacement 0.01 z towards the interface.
a, b, c, d = (x / math.sqrt(1.29) for x in (1, 0.3, -0.4, 0.2))
R = ((a*a+b*b-c*c-d*d, 2*(b*c-a*d), 2*(b*d+a*c)),
     (2*(b*c+a*d), a*a-b*b+c*c-d*d, 2*(c*d-a*b)),
     (2*(b*d-a*c), 2*(c*d+a*b), a*a-b*b-c*c+d*d))
CELLS = 6, 4
normal = [row[2] for row in R]


def node(body, i, j, k):
    n = CELLS[body] + 1
    return (1, 1 + 49 * 3)[body] + i + n * (j + n * k)


nodes, elements = [], []
for body, n in enumerate(CELLS):
    for k in range(3):
        for j in range(n + 1):
            for i in range(n + 1):
                point = i / n, j / n, 0.5 * body + 0.25 * k
                turned = [sum(r * x for r, x in zip(row, point)) for row in R]
                nodes.append(f"{node(body, i, j, k)} " + " ".join(f"{x:.17g}" for x in turned))
    for j in range(n):
        for i in range(n):
            def quad(k, i=i, j=j, body=body):
                return (node(body, i, j, k), node(body, i+1, j, k), node(body, i+1, j+1, k),
                        node(body, i, j+1, k))

            for k in range(2):
                elements.append((5, body + 1, *quad(k), *quad(k + 1)))
            for k in 0, 2:
                elements.append((3, 10 * (body + 1) + 1 + k // 2, *quad(k)))
lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "6", '3 1 "lower"',
         '3 2 "upper"', '2 11 "lower_end"', '2 12 "lower_face"', '2 21 "upper_face"',
         '2 22 "upper_end"', "$EndPhysicalNames", "$Nodes", str(len(nodes)), *nodes, "$EndNodes",
         "$Elements", str(len(elements))]
for number, (kind, group, *corners) in enumerate(elements, 1):
    lines.append(f"{number} {kind} 2 {group} {group} " + " ".join(map(str, corners)))
(folder / "inclined.msh").write_text("\n".join([*lines, "$EndElements", ""]), encoding="utf-8")


def body_section(name, condition, boundary=""):
    return f"""subsection Body {name}
  set {condition} = {name}_end
  subsection Geometry
    set Type   = file
    set File   = inclined.msh
    set Volume = {name}
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0
  end
{boundary}end
"""


moved = "".join(f"    set Displacement {axis} = {-0.01 * n!r} * t\n" for axis, n in
                zip("xyz", normal))
stress = ", ".join(f"s{'xyz'[i]}{'xyz'[j]}: {-10 * normal[i] * normal[j]!r}" for i in range(3)
                   for j in range(i, 3))
(folder / "inclined.prm").write_text(
    "set Bodies = lower, upper\nset Contact pairs = interface\n" +
    body_section("lower", "Fixed") +
    body_section("upper", "Boundary conditions", f"  subsection Boundary upper_end\n{moved}  end\n") +
    f"""subsection Contact pair interface
  set Slave body        = lower
  set Slave boundaries  = lower_face
  set Master body       = upper
  set Master boundaries = upper_face
end
subsection Reference solution
  set Type   = uniform stress
  set Pair   = interface
  set Values = pressure: 10, {stress}
end
""", encoding="utf-8")

PAIR = "Contact pair interface"
SWAPPED = {f"{PAIR}/Slave body": "upper", f"{PAIR}/Slave boundaries": "upper_face",
           f"{PAIR}/Master body": "lower", f"{PAIR}/Master boundaries": "lower_face"}
for role, roles in ("fine", {}), ("coarse", SWAPPED):
    for enforcement in EXACT_ENFORCEMENTS:
        # The augmented Lagrangian stops at the gap tolerance.
        result = run(f"{role}_{enforcement}", folder / "inclined.prm",
                     {RESIDUAL: 1e-12, GAP: 1e-12, ENFORCEMENT: enforcement, **roles})
        below(f"{result}, stress_max_deviation", result.error("stress_max_deviation"), 1e-10)
finish()
