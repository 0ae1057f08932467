# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results are continuous in the initial gap: gaps that differ by 1e-4 of their size, and gaps and
overlaps of next to nothing, give forces that differ in proportion, whatever becomes of overlaps."""

from touchstone_test import AUGMENTED, MULTIPLIERS, PENALTY, check, finish, folder, run

GAP, NEARLY = 0.002, 1e-4
GAPS = (GAP * (1 + NEARLY), GAP, GAP * (1 - NEARLY), 1e-7, 0.0, -1e-7, -GAP, -GAP * (1 + NEARLY))

BODY = """subsection Body {name}
  {supports}
  subsection Geometry
    set Type = {geometry}
  end
  subsection Material
    set Young modulus = 1000
  end
"""
PAIR = """subsection Contact pair contact
  set Slave body        = upper
  set Slave boundaries  = {slave}
  set Master body       = lower
  set Master boundaries = {master}
"""
FRICTION = """  set Behaviour = coulomb
  subsection Friction
    set Coefficient = 0.3
  end
"""
REST = """end
set Bodies        = lower, upper
set Contact pairs = contact
subsection Load stepping
  set Steps = 2
end
"""


def blocks(gap, friction):
    """A block that is pressed on a wider one by 0.01, and pushed; the faces do not match."""
    lower = """box
    set Lower corner = -0.2, -0.2, 0
    set Upper corner = 1.2, 1.2, 1
    set Cells        = 3, 3, 2"""
    upper = f"""box
    set Lower corner = 0, 0, {1 + gap!r}
    set Upper corner = 1, 1, {2 + gap!r}
    set Cells        = 2, 2, 2"""
    return (BODY.format(name="lower", supports="set Fixed = bottom", geometry=lower) + "end\n" +
            BODY.format(name="upper", supports="set Boundary conditions = top", geometry=upper) +
            """  subsection Boundary top
    set Displacement x = 0.01*t
    set Displacement y = 0
    set Displacement z = -0.01*t
  end
end
""" + PAIR.format(slave="bottom", master="top") + (FRICTION if friction else "") + REST)


def tubes(gap, _):
    """A tube in another one that is pressed from outside; the faces do not match."""
    cuts = "set Symmetry = first cut, second cut, start, end"
    inner = """tube
    set Inner radius = 0.5
    set Outer radius = 1
    set Cells        = 2, 6, 2"""
    outer = f"""tube
    set Inner radius = {1 + gap!r}
    set Outer radius = 1.5
    set Cells        = 2, 4, 3"""
    return (BODY.format(name="lower", supports=cuts, geometry=inner) + "end\n" +
            BODY.format(name="upper", supports=cuts + "\n  set Boundary conditions = outer",
                        geometry=outer) +
            """  subsection Boundary outer
    set Pressure = 20*t
  end
end
""" + PAIR.format(slave="inner", master="outer") + REST)


def continuous(name, scene, friction=False, settings=None):
    """Runs with all gaps. Forces of neighbouring gaps differ by no more than 1.5 times what the
    whole range of gaps says of their difference."""
    forces = []
    for k, gap in enumerate(GAPS):
        path = folder / f"{name}_{k}.prm"
        path.write_text(scene(gap, friction), encoding="utf-8")
        result = run(f"{name}_{k}", path, settings)
        forces.append(result.contact("contact", "max_pressure") if scene is tubes else
                      result.force("contact")[2])
    slope = max(abs(forces[4] - forces[1]), abs(forces[6] - forces[4])) / GAP
    worst = max(abs(a - b) / (slope * (g - h)) for (g, a), (h, b) in
                zip(zip(GAPS, forces), zip(GAPS[1:], forces[1:])))
    check(forces[4] > forces[1] > 0 and worst < 1.5,
          f"{name}: forces {forces}, {worst:.3g} times as far apart as their gaps")
    print(f"{name}: {forces[1]:.6g} to {forces[6]:.6g}, largest slope {worst:.4f} of the mean",
          flush=True)


OVERLAP, PAIRING = "Contact pair contact/Initial overlap", "Contact pair contact/Pairing"
POINTWISE = {PAIRING: "pointwise"}
continuous("interference", blocks, friction=True)
continuous("pointwise", blocks, friction=True, settings=POINTWISE)
continuous("adjusted", blocks, settings={OVERLAP: "adjust"})
continuous("adjusted_pointwise", blocks, friction=True, settings={OVERLAP: "adjust", **POINTWISE})
continuous("ramped", blocks, friction=True, settings={OVERLAP: "ramp"})
continuous("multipliers", blocks, settings=MULTIPLIERS)
continuous("augmented", blocks, settings=AUGMENTED)
continuous("penalty", blocks, settings=PENALTY)
continuous("tubes", tubes)
continuous("tubes_adjusted", tubes, settings={OVERLAP: "adjust"})
finish()
