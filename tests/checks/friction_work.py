# SPDX-License-Identifier: LGPL-2.1-or-later
"""What friction dissipates. A block that sticks is pushed to and fro and dissipates nothing, though
the springs of regularised friction give way; one that slides dissipates mu N times its
relative displacement."""

from touchstone_test import PENALTY, STEPS, below, finish, prm, relative, run

REGULARISED = {"Contact/Friction": "regularised"}


def work(result, step):
    """Work done against friction up to a step."""
    return next(value for title, value in result.rows()[step - 1].items() if "friction" in title)


def pushed(name, settings=None):
    """A shear traction of 0.98 mu N on the top and the sides, to one side, to the other and back
    to nothing."""
    load = "1.176 * (max(t - 1, 0) - 2 * max(t - 2, 0) + 2 * max(t - 4, 0))"
    sides = {f"Body {body}/Boundary {side}/Traction z": sign + load for body in ("base", "block")
             for side, sign in (("left", "-"), ("right", ""))}
    result = run(name, prm / "benchmarks/sliding_block_force.prm",
                 {**sides, "Body block/Boundary top/Traction x": load,
                  "Load stepping/End time": 5, STEPS: 10,
                  "Reference solution/Values": "szz: -4, sxz: 0, pressure: 4", **(settings or {})})
    # Springs give way by t h/(10 E) = 6e-5 under a force of 4.7.
    below(f"{name}, work in a closed loop of stick", abs(work(result, 10)), 1e-12)


def slides(name, settings=None):
    """0.016 a step; in full slip the bodies' strains stay, so that is the slip of each node, under
    mu N = 4.8."""
    result = run(name, prm / "benchmarks/sliding_block.prm",
                 {"Load stepping/End time": 2.4, STEPS: 12, **(settings or {})})
    below(f"{name}, work of one step differs from mu N times the slip",
          relative(work(result, 12) - work(result, 11), 4.8 * 0.016), 1e-6)


pushed("exact")
pushed("regularised", REGULARISED)
pushed("penalty", PENALTY)
slides("slide_exact")
slides("slide_regularised", REGULARISED)
slides("slide_penalty", PENALTY)
finish()
