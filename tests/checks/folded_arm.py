# SPDX-License-Identifier: LGPL-2.1-or-later
"""A thin arm that a pressure bends onto a plane: Newton's method may come upon a balance in which the arm is folded
up, with some hundred times the energy that the pressure can have supplied. It is found out by that: the step is
solved in another way, or the run ends and says why; a run that converges has the energy of a finer one."""

from touchstone_test import STEPS, below, check, finish, folder, relative, run
from hexahedra import box  # of tests/, which touchstone_test finds

SIZE = 1 / 6
mesh = box((0, 0, 0), (SIZE, 0.5, 0.05), (1, 1, 1)).joined(box((0, 0, 0.05), (4, 0.5, 0.15), (24, 1, 1)))
mesh.written(folder / "arm.vtk", {
    "held": lambda p: p[0] == 0, "front": lambda p: p[1] == 0, "rear": lambda p: p[1] == 0.5,
    "middle": lambda p: p[2] == 0, "top": lambda p: p[2] > 0.1, "below": lambda p: 0.04 < p[2] < 0.06 and p[0] > 0.9 * SIZE})
(folder / "arm.prm").write_text("""set Title         = Arm that is bent onto a plane
set Bodies        = arm
set Obstacles     = floor
set Contact pairs = contact
subsection Body arm
  set Symmetry            = front, rear, middle
  set Fixed               = held
  set Boundary conditions = top
  set Element             = F-bar
  subsection Geometry
    set Type            = file
    set File            = arm.vtk
    set Boundary arrays = held, front, rear, middle, top, below
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
  subsection Boundary top
    set Pressure = 2 * t
  end
end
subsection Obstacle floor
  set Shape = plane
end
subsection Contact pair contact
  set Slave body       = arm
  set Slave boundaries = below
  set Obstacle         = floor
end
subsection Output
  set VTU interval = 0
end
""", encoding="utf-8")

# With implicit dynamics, which cannot gain energy, and with 32 cells: 0.0053 and 0.0048.
EXPECTED = 0.0053
told = 0
for steps in 6, 12, 24:
    for load in 0.5, 1, 2:
        result = run(f"arm_{steps}_{load}", "arm.prm", {STEPS: steps, "Body arm/Boundary top/Pressure": f"{load} * t"})
        print(result, result.summary.get('converged'), result.rows()[-1].get('energy: strain') if result.summary else result.log[-300:])
finish()
