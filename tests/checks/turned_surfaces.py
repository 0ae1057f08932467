# SPDX-License-Identifier: LGPL-2.1-or-later
"""A press fit on exact surfaces that turns as a whole keeps its energy, and runs say where tied pairs
do not follow their surfaces (doc/theory.md 4, equation (8), and 4.6): the distance that they are placed with, whose
forces also lose their moment. They say nothing where nothing has turned."""

from touchstone_test import check, finish, folder, run

TUBE = """subsection Body {name}
  subsection Geometry
    set Type         = tube
    set Inner radius = {inner}
    set Outer radius = {outer}
    set Angle        = 360
    set End          = 0.5
    set Cells        = 1, {cells}, 1
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 1000
  end
end
"""
HELD = """subsection Contact pair {name}
  set Slave body       = {body}
  set Slave boundaries = {boundary}
  set Obstacle         = tool
  set Behaviour        = tied
end
"""
# A press fit of two tubes, both held by one tool that turns by 60 degrees after t = 1.
(folder / "fit.prm").write_text("""set Bodies        = inner, outer
set Obstacles     = tool
set Contact pairs = fit, bore, shell
subsection Obstacle tool
  set Shape        = reference point
  set Rotate angle = 60 * max(t - 1, 0)
end
subsection Contact pair fit
  set Slave body        = outer
  set Slave boundaries  = inner
  set Master body       = inner
  set Master boundaries = outer
end
subsection Load stepping
  set End time = 2
  set Steps    = 4
end
""" + TUBE.format(name="inner", inner=1, outer=1.51, cells=12) + TUBE.format(name="outer", inner=1.5, outer=2, cells=9) +
                                HELD.format(name="bore", body="inner", boundary="inner") +
                                HELD.format(name="shell", body="outer", boundary="outer"), encoding="utf-8")
BLOCK = """subsection Body {name}
  {supports}
  subsection Geometry
    set Type         = box
    set Lower corner = 0, 0, {bottom}
    set Upper corner = 1, 1, {top}
    set Cells        = 2, 2, 2
  end
  subsection Material
    set Young modulus = 1e6
  end
end
"""
# A block that is tied to another one across a gap, and pushed.
(folder / "gap.prm").write_text("set Bodies = lower, upper\nset Contact pairs = joint\n" +
                                BLOCK.format(name="lower", supports="set Fixed = bottom", bottom=0, top=1) +
                                BLOCK.format(name="upper", bottom=1.1, top=2.1,
                                             supports="""set Boundary conditions = top
  subsection Boundary top
    set Traction x = 1
  end""") + """subsection Contact pair joint
  set Slave body        = upper
  set Slave boundaries  = bottom
  set Master body       = lower
  set Master boundaries = top
  set Behaviour         = tied
end
""", encoding="utf-8")

TIED, TURNED, MOMENT = {"Contact pair fit/Behaviour": "tied"}, "has turned by 60", "without their moment: 0.1 is"
for name, scene, settings, ranks, words in (
        ("fit at rest", "fit", {**TIED, "Load stepping/End time": 1, "Load stepping/Steps": 1}, 1, ""),
        ("tied", "fit", TIED, 1, TURNED),
        ("gap", "gap", {}, 1, MOMENT), ("gap on two ranks", "gap", {}, 2, MOMENT)):
    told = [text for text in run(name.replace(" ", "_"), folder / f"{scene}.prm", settings, ranks).summary["warnings"]
            if "turned" in text or "moment" in text]
    check(len(told) == (words != "") and all(words in text for text in told), f"{name}: {told}")

# Before the turn and behind it. Where neighbours decide how far averaged rows follow the smallest gap, equation (29), displacements
# are taken as they are and not as turned: that is seen with friction, which leaves more to them.
for name, settings, ranks, bound in (
        ("averaged", {}, 1, 1e-6), ("averaged on two ranks", {}, 2, 1e-6),
        ("pointwise", {"Contact pair fit/Pairing": "pointwise"}, 1, 1e-6),
        ("inside-outside", {"Contact pair fit/Pairing": "inside-outside"}, 1, 1e-6),
        ("friction", {"Contact pair fit/Behaviour": "coulomb", "Contact pair fit/Friction/Coefficient": 0.3}, 1, 1e-4),
        ("degree 2", {"Discretisation/Degree": 2}, 1, 1e-6)):
    energy = run("turned_" + name.replace(" ", "_"), folder / "fit.prm", settings, ranks).column("energy: strain")
    check(abs(energy[-1] / energy[1] - 1) < bound, f"{name}: strain energy {energy[1]:.8g}, turned {energy[-1]:.8g}")
finish()
