# SPDX-License-Identifier: LGPL-2.1-or-later
"""Impacts of bodies with inertia. Large steps, cut steps, all enforcements and pairings, friction,
gravity, free flight, Hertz's theory."""
# ctest: goldens = bouncing_block, oblique_impact, rotating_block, hertz_impact

import math

from touchstone_test import (CG, ENFORCEMENT, ENFORCEMENTS, STEPS, below, check, finish, golden,
                             prm, relative, run, same, tests)

SCHEME, RHO, MASS = ("Time integration/Scheme", "Time integration/Spectral radius",
                     "Time integration/Mass")
STABILISED = {SCHEME: "contact_stabilized"}
LUMPED = {MASS: "lumped"}
bars = prm / "benchmarks/two_bars.prm"


def gain(result):
    """Energy that came from nowhere, of the balance error that was printed."""
    return max(0, result.after("  balance error"))


def never_grows(result, title, sign, allowed):
    """How far the sign times a column rises in a step."""
    values = result.column(title)
    below(f"{result}, {title} rises in a step",
          max(0, *(sign * (b - a) for a, b in zip(values, values[1:]))), allowed)


def bar_settings(cells, steps):
    return {"Body left/Geometry/Cells": f"{cells},1,1",
            "Body right/Geometry/Cells": f"{cells},1,1", STEPS: steps}


def two_bars(name, cells, steps, settings=None, ranks=1, fails=False):
    return run(name, bars, {**bar_settings(cells, steps), **(settings or {})}, ranks, fails)


def bounds(result, stress, duration, energy):
    """Errors of a run, and contact opens once."""
    below(f"{result}, contact stress", abs(result.error("contact_stress")), stress)
    below(f"{result}, duration", abs(result.error("contact_duration")), duration)
    below(f"{result}, energy", abs(result.error("energy")), energy)
    below(f"{result}, further openings", abs(result.error("openings")), 0.5)
    below(f"{result}, gain of energy in contact", max(0, -result.after("  contact ")), 1e-5)


# Every enforcement, both pairings and Belos, where mesh and step make no error.
for enforcement in ENFORCEMENTS:
    for pairing in ("pointwise", "averaged") if enforcement == "elimination" else ("averaged",):
        bounds(two_bars(f"{enforcement}_{pairing}", 20, 50,
                        {ENFORCEMENT: enforcement, "Contact pair impact/Pairing": pairing}),
               *((0.02, 0.05, 0.01) if enforcement == "penalty" else (1e-5, 1e-5, 1e-5)))
bounds(two_bars("belos", 20, 50, CG), 1e-5, 1e-5, 1e-5)
bounds(two_bars("two_ranks", 20, 50, ranks=2), 1e-5, 1e-5, 1e-5)

# In contact at time 0 with a velocity: no gap to close.
bounds(two_bars("touching", 20, 50, {"Body right/Geometry/Lower corner": "0,0,0",
                                     "Body right/Geometry/Upper corner": "100,10,10"}),
       1e-5, 1e-5, 1e-5)

# Ten times the step in which a wave passes a cell: the bars and their impact last four steps.
for kind in "consistent", "lumped":
    bounds(two_bars(f"large_{kind}", 20, 5, {**STABILISED, RHO: "automatic", MASS: kind,
                                             "Load stepping/End time": 4.833538583e-5}),
           0.35, 0.35, 0.05)

# Awkward steps.
awkward = two_bars("awkward", 20, 437, {**STABILISED, **LUMPED})
even = two_bars("even", 20, 400, {**STABILISED, **LUMPED})
below("awkward, duration differs from that of even steps",
      relative(awkward.after("  from, to", 2), even.after("  from, to", 2)), 0.01)

# Nodes that do not rebound: Newmark's and the HHT method do not chatter, nor gain energy.
for scheme in "newmark", "hht":
    steady = two_bars(scheme, 40, 200, {SCHEME: scheme, **LUMPED})
    # The mean stress is the momentum that the bars exchange over the duration, which is a step longer.
    bounds(steady, 0.03, 0.02, 0.01)
    below(f"{scheme}, balance error, gain", gain(steady), 1e-3)
# Left to rebound they do, and the run ends with the reason.
rebound = two_bars("gain", 40, 200, {SCHEME: "newmark", **LUMPED,
                                     "Time integration/Impact": "elastic"}, fails=True)
check("came from nowhere" in rebound.text, "the gain of energy was not named")

# A block that falls, bounces and falls again.
bouncing = golden("bouncing_block")
check(bouncing.after("  opened") >= 2, "bouncing: not two impacts or more")
never_grows(bouncing, "energy: contact", -1, 1e-9)
below("bouncing, balance error", abs(bouncing.after("  balance error")), 1e-6)

# Until it lands a falling body is free of stress, whichever nodes have the mass: the weight hung on
# the cells at massless nodes, which yielded in the first step ("energy came from nowhere").
block = "Body block/Material"
for mass in "lumped", "consistent", "dispersion corrected":
    for law in {}, {f"{block}/Law": "finite-strain von Mises", f"{block}/Plasticity/Yield stress": 0.1,
                    f"{block}/Plasticity/Hardening": "linear",
                    f"{block}/Plasticity/Hardening modulus": 200}:
        falling = run(f"falling_{mass.split()[0]}_{len(law)}", tests / "bouncing_block.prm",
                      {**law, MASS: mass, "Load stepping/End time": 0.08, STEPS: 8,
                       "Body block/Body force x": 2})
        energies = falling.summary["motion"]["energies"]
        below(f"{falling}, strain energy", abs(energies["strain"]) / energies["kinetic"], 1e-12)
        below(f"{falling}, plastic work", energies["plastic"], 1e-30)
        below(f"{falling}, momentum",
              relative(falling.column("momentum z")[-1], -10 * 0.08)
              + relative(falling.column("momentum x")[-1], 2 * 0.08), 1e-9)

# Oblique impact.
oblique = golden("oblique_impact")
below("oblique, impulse along the plane is not mu times that across",
      relative(oblique.after("  impulse", 1), -0.2 * oblique.after("  impulse", 3)), 1e-4)
never_grows(oblique, "energy: friction", -1, 1e-9)
# Steps that are cut in the middle of it: the iterations allowed do not suffice. Those in which nodes
# come into contact do not count.
askew = {"Body block/Initial velocity z": "-1 + 0.2 * x + 0.1 * y"}
uncut = run("uncut", tests / "oblique_impact.prm", askew)
cut = run("cut", tests / "oblique_impact.prm",
          {**askew, "Newton/Maximum iterations": 2, "Newton/Residual tolerance": 1e-8,
           "Newton/Gap tolerance": 1e-7})
check(cut.cuts() >= 3, f"cut: {cut.cuts()} cuts are not three or more")
below("cut, impulse differs from that of whole steps",
      relative(cut.after("  impulse", 3), uncut.after("  impulse", 3)), 0.01)
never_grows(cut, "energy: contact", -1, 1e-9)
sticking = run("sticking", tests / "oblique_impact.prm",
               {"Contact pair contact/Friction/Coefficient": 50})
never_grows(sticking, "energy: friction", -1, 1e-9)
below("sticking, gain of energy", gain(sticking), 1e-6)


# Free flight: angular momentum about the origin, and its error with half the step.
def spin(result):
    return math.hypot(*(result.column(f"angular momentum {d}")[-1] -
                        result.column(f"angular momentum {d}")[0] for d in "xyz"))


def keeps_momentum(result):
    for d in "xyz":
        values = result.column(f"momentum {d}")
        below(f"{result}, momentum {d} drifts", max(abs(x - values[0]) for x in values), 1e-9)
    below(f"{result}, angular momentum drifts", spin(result), 1e-3)


flight = golden("rotating_block")
keeps_momentum(flight)
half = run("flight_half", tests / "rotating_block.prm", {STEPS: 100})
below("flight_half, drift with half the step, over a quarter", spin(half) / (spin(flight) / 4), 1.2)

# The mesh changes in flight, and in an impact: momentum stays, and ranks agree.
adaptive = run("flight_adaptive", tests / "rotating_block.prm",
               {"Refinement/Estimator": "region", "Refinement/Region": "sin(100*t)*x",
                "Refinement/Maximum level": 1})
keeps_momentum(adaptive)
below("flight_adaptive, balance error", abs(adaptive.after("  balance error")), 1e-3)
check(adaptive.log.count("  mesh") >= 10, "flight_adaptive: not ten meshes or more")
ranks_1, ranks_2 = (run(f"adaptive_{ranks}", tests / "bouncing_block.prm",
                        {SCHEME: "generalized_alpha", "Refinement/Estimator": "Kelly",
                         "Refinement/Cycles": 1, "Refinement/Maximum level": 1}, ranks)
                    for ranks in (1, 2))
for result in ranks_1, ranks_2:
    below(f"{result}, gain of energy", gain(result), 1e-6)
same(ranks_1, ranks_2, 1e-6)

# Hertz: K = 4/3 sqrt(R) E*, the mass of a quarter from the momentum at the start.
hertz = golden("hertz_impact")
v, mass = 200, -4 * hertz.column("momentum z")[0] / 200
K = 4 / 3 * math.sqrt(10) * 210000 / 0.91
depth = (1.25 * mass * v * v / K) ** 0.4
below("hertz, duration of contact",
      relative(hertz.after("  from, to", 2) - hertz.after("  from, to", 1), 2.9432 * depth / v), 0.05)
below("hertz, largest force", relative(hertz.after("  peak force"), K * depth ** 1.5 / 4), 0.05)
finish()
