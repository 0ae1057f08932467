# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes that change in implicit dynamics: a bar in which all is uniform keeps its forces and energies, whatever its
material remembers, when it is refined; a block that falls with nodes without mass beside hanging ones has no stress."""
# ctest: label = quick

from touchstone_test import below, check, checks, finish, folder, run, tests

BAR = """
set Bodies = bar
subsection Body bar
  set Boundary conditions = left, right
  subsection Geometry
    set Type         = box
    set Lower corner = 0, 0, 0
    set Upper corner = 4, 1, 1
    set Cells        = 4, 1, 1
  end
  subsection Boundary left
    set Displacement x = 0
  end
  subsection Boundary right
    set Displacement x = 0.04*t
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0
    set Density       = 1e-6
  end
end
subsection Load stepping
  set End time = 1
  set Steps    = 10
end
subsection Refinement
  set Estimator       = region
  set Region          = if(t > 0.75, 1 - x, -1)
  set Cycles          = 0
  set Cycles per step = 1
  set Maximum level   = 1
end
"""
(folder / "bar.prm").write_text(BAR, encoding="utf-8")
MATERIAL = "Body bar/Material/"
PLASTIC = {MATERIAL + "Law": "small-strain von Mises", MATERIAL + "Plasticity/Yield stress": 1,
           MATERIAL + "Plasticity/Hardening": "linear", MATERIAL + "Plasticity/Hardening modulus": 100}
HEAT = {MATERIAL + "Thermal expansion/Coefficient": 1e-4, MATERIAL + "Thermal expansion/Temperature": "50*t"}
# The new mesh began with the law at the displacement of time 0 and the history of now, at the temperature of the
# end: plastic strains three times as large, or energy from nowhere. The stiffness that damps was a tangent.
for name, settings, schemes in (
        ("plastic", PLASTIC, ("newmark", "generalized_alpha")),
        ("finite", {**PLASTIC, MATERIAL + "Law": "finite-strain von Mises"}, ("newmark",)),
        ("viscoelastic", {MATERIAL + "Law": "viscoelastic", MATERIAL + "Shear ratios": 0.5,
                          MATERIAL + "Relaxation times": 0.3}, ("newmark",)),
        ("damped", {**PLASTIC, MATERIAL + "Rayleigh stiffness": 0.1}, ("newmark",)),
        ("heated", HEAT, ("newmark", "generalized_alpha")), ("heated_plastic", {**PLASTIC, **HEAT}, ("newmark",))):
    for scheme in schemes:
        settings = {**settings, "Time integration/Scheme": scheme}
        one = run(f"{name}_{scheme}", "bar.prm", {**settings, "Refinement/Estimator": "none"})
        for ranks in 1, 2:
            two = run(f"{name}_{scheme}_refined_{ranks}", "bar.prm", settings, ranks=ranks)
            check(two.summary["meshes"][-1]["cells"] > 4, f"{two}: not refined")
            dissipated = "energy: material dissipation" if name in ("viscoelastic", "heated") else "energy: plastic"
            for column in ("energy: strain", dissipated, "energy: external", "bar/left: reaction x"):
                expected = one.column(column)
                scale = max(abs(value) for value in expected + one.column("energy: strain"))
                worst = max(abs(a - b) for a, b in zip(expected, two.column(column)))
                below(f"{two}: {column}", worst / scale, 2e-4)

# Hanging nodes on and beside the slave surface kept their mass and velocity while the nodes that they follow had
# none: the surface was torn from the second step on, and free fall ended with "energy came from nowhere".
REGION = {"Refinement/Estimator": "region", "Refinement/Region": "if(x < 0.4 && z < 0.4, 1, -1)", "Refinement/Cycles": 1,
          "Refinement/Cycles per step": 0, "Refinement/Maximum level": 1}
for ranks in 1, 2:
    falls = run(f"falls_{ranks}", tests / "bouncing_block.prm", {**REGION, "Load stepping/Steps": 60}, ranks=ranks)
    times, strain = falls.column("time"), falls.column("energy: strain")
    below(f"{falls}: stress in free fall", max(abs(e) for t, e in zip(times, strain) if t < 0.09) / max(strain), 1e-12)
    below(f"{falls}: balance", max(abs(e) for e in falls.column("energy: balance error")) / max(strain), 1e-10)
    check(max(falls.column("contact: force z")) > 20, f"{falls}: no impact")

# Momentum that coarsening loses is given back also to bodies with supports, along what these leave free: half of a
# stack with friction parted from the whole one, forces by 8 % after four steps.
HALF = {"Body a/Geometry/Lower corner": "0, 0, 0", "Body a/Geometry/Cells": "3, 2, 3", "Body a/Symmetry": "front",
        "Body b/Geometry/Lower corner": "0.1, 0, 0.5", "Body b/Geometry/Cells": "2, 2, 3", "Body b/Symmetry": "front"}
whole, half = (run(name, checks / "shaken_stack.prm", settings) for name, settings in (("whole", {}), ("half", HALF)))
for column in "c: force x", "c: force z", "e: force x", "e: force z", "momentum x", "momentum z":
    scale = max(abs(value) for value in whole.column(column))
    below(f"half: {column}", max(abs(2 * b - a) for a, b in zip(whole.column(column), half.column(column))) / scale, 1e-7)

# In free flight nothing changes the momentum. The forces of inertia that coarsened cells made of the old ones had a
# resultant, which moved the body by half a per cent of its momentum within the next step.
FLIGHT = """set Bodies = b
subsection Body b
  set Initial velocity x = 1 + 0.3*cos(2*pi*x)
  set Initial velocity y = 0
  set Initial velocity z = 0.2*sin(2*pi*x)
  subsection Geometry
    set Type  = box
    set Cells = 4, 4, 4
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 10
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Refinement
  set Estimator        = region
  set Region           = if(t < 0.3 && t > 0.05, 0.5 - x, -1)
  set Cycles           = 0
  set Cycles per step  = 1
  set Maximum level    = 1
  set Coarsen fraction = 0.6
  set Refine fraction  = 0.3
end
subsection Load stepping
  set End time = 0.6
  set Steps    = 30
end
"""
(folder / "flight.prm").write_text(FLIGHT, encoding="utf-8")
for scheme in "newmark", "hht", "generalized_alpha", "contact_stabilized":
    flies = run(f"flies_{scheme}", "flight.prm", {"Time integration/Scheme": scheme})
    check(len({mesh["cells"] for mesh in flies.summary["meshes"]}) > 1, f"{flies}: one mesh")
    for axis, start in ("x", 1), ("y", 0), ("z", 0):
        below(f"{flies}: momentum {axis}", max(abs(p - start) for p in flies.column(f"momentum {axis}")), 1e-9)
finish()
