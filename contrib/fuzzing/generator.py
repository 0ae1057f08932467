# SPDX-License-Identifier: LGPL-2.1-or-later
"""A random scene from a seed: always the same for the same numbers."""

import dataclasses
import random

from . import fits, rolling, stacks

KINDS = (stacks.two,) * 6 + (stacks.row, stacks.corner, stacks.quarter, stacks.quarter,
                             fits.fit, fits.fit, fits.fit, fits.rigid, fits.between, fits.bore)
# Kinds with four pairs came later, with a random stream of their own: other scenes of a seed are
# those that they were before. So did what rolls.
LATER = {"four pairs": (stacks.row_of_four, stacks.table), "rolling": (rolling.rolled,)}
SHARE = 0.05  # of each of these
# Lengths and stresses: N, mm, MPa as they are; SI; inch and psi; grams.
UNITS = ((1.0, 1.0), (1.0, 1.0), (1e-3, 1e6), (1 / 25.4, 145.0), (1e3, 1e-6), (1e-6, 1e9))


def without_smoothing(pair):
    """Curved faces of degree 2 are not smoothed."""
    return dataclasses.replace(pair, settings=tuple(setting for setting in pair.settings
                                                    if setting != ("Master normal", "smoothed")))


def scene(seed, index):
    """The scene @p index of a campaign."""
    rng, kinds = random.Random(f"{seed}/{index}"), KINDS
    for name, later in LATER.items():
        stream = random.Random(f"{seed}/{index}/{name}")
        if stream.random() < SHARE:
            rng, kinds = stream, later
            break
    result = rng.choice(kinds)(rng)
    if rng.random() < 0.1:
        result = dataclasses.replace(result, settings=(("Discretisation/Degree", "2"),),
                                     pairs=tuple(map(without_smoothing, result.pairs)))
    units = rng.choice(UNITS)
    result = result.rescaled(*units) if units != (1.0, 1.0) else result
    # What follows is compared with this one, in its own axes and units.
    return dataclasses.replace(result, length=1.0, stress=1.0)
