# SPDX-License-Identifier: LGPL-2.1-or-later
"""The conical insertion with a coefficient of friction of 0.2 has one answer: the push force is the
same to 1e-6 with every exact enforcement, solver and number of ranks, to 1e-4 with springs, and to
1 % in 1, 4 and 16 steps; the two planes of symmetry bear the same force to 1e-8. A row that comes
into contact within a step shows in each of these."""

import re

from touchstone_test import (AUGMENTED, CG, GMRES, MULTIPLIERS, MUMPS, PENALTY, PETSC, STEPS, below,
                             finish, prm, relative, run)


def insert(name, settings, ranks=1, coefficient=0.2):
    return run(name, prm / "two_tubes.prm",
               {"Contact pair cone/Behaviour": "coulomb",
                "Contact pair cone/Friction/Coefficient": coefficient, **settings}, ranks)


def push(name, reference, bound, settings, ranks=1):
    """The push force lies within BOUND of REFERENCE."""
    result = insert(name, settings, ranks)
    force = result.reaction("inner tube", "end")[0]
    below(f"{name}, push force {force} differs from {reference}", relative(force, reference), bound)
    below(f"{name}, forces on the planes of symmetry differ",
          relative(result.reaction("inner tube", "first cut")[2],
                   result.reaction("inner tube", "second cut")[1]), 1e-8)
    return result


# Large-sliding integral contact of a general finite element library gives 672.7.
first = push("elimination", -672.7, 3e-3, GMRES)
answer = first.reaction("inner tube", "end")[0]
# At most 15; one more is left to other round-off.
below("iterations of GMRES in a solve",
      max(int(n) for n in re.findall(r"^ +\d+ +\S+e.* (\d+)$", first.log, re.MULTILINE)), 17)
push("elimination_2", answer, 1e-8, GMRES, 2)
push("conjugate_gradients", answer, 1e-6, CG)
push("direct", answer, 1e-6, MUMPS)
push("multipliers", answer, 1e-6, {**MULTIPLIERS, STEPS: 2})  # MUMPS, as 'direct'
push("augmented", answer, 1e-6, {**AUGMENTED, **GMRES})
push("regularised", answer, 1e-4, {"Contact/Friction": "regularised", **GMRES})
push("penalty", answer, 1e-2, PENALTY)
stiff = push("stiff_penalty", answer, 1e-5, {**PENALTY, **GMRES, "Contact/Penalty factor": 100,
                                             "Contact/Linearisation": "consistent"})
below("stiff_penalty, Newton iterations in 4 steps", stiff.iterations(), 24)
below("stiff_penalty, iterations of GMRES in the mean", stiff.iterations("linear_mean"), 20)
push("one_step", answer, 1e-2, {**GMRES, STEPS: 1})
push("sixteen_steps", answer, 1e-2, {**GMRES, STEPS: 16})
push("petsc_2", answer, 1e-6, {**PETSC, STEPS: 1}, 2)
push("petsc_multipliers_2", answer, 1e-6, {**PETSC, **MULTIPLIERS, STEPS: 1}, 2)

# No harder with more friction.
for coefficient in 0.5, 1:
    result = insert(f"coefficient_{coefficient}", GMRES, coefficient=coefficient)
    below(f"{result}, Newton iterations in 4 steps", result.iterations(), 48)

# Pointwise rows are another discretisation with an answer of their own.
pointwise = insert("pointwise", {**GMRES, "Contact pair cone/Pairing": "pointwise"})
below("pointwise, push force differs from -672.7",
      relative(pointwise.reaction("inner tube", "end")[0], -672.7), 1e-2)
finish()
