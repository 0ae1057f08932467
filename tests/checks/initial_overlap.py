# SPDX-License-Identifier: LGPL-2.1-or-later
"""What becomes of an overlap of the bodies as they are placed. Nothing, if it is adjusted; the same
as an interference at the end, if it is ramped, and half of it half way there."""

from touchstone_test import STEPS, below, finish, prm, relative, run

OVERLAP, SMALL = "Contact pair fit/Initial overlap", {"Contact pair fit/Sliding": "small"}


def fit(name, settings):
    return run(name, prm / "press_fit.prm", {"Body inner tube/Geometry/Cells": "4, 12, 1",
                                             "Body outer tube/Geometry/Cells": "4, 12, 1",
                                             **settings})


interference = fit("interference", SMALL).force("fit")[0]
adjusted = fit("adjusted", {OVERLAP: "adjust"})
ramped = fit("ramped", {**SMALL, OVERLAP: "ramp", STEPS: 4})
below("adjusted, force", abs(adjusted.force("fit")[0]), 1e-9)
below("ramped, deviates from the interference", relative(ramped.force("fit")[0], interference), 1e-8)
below("ramped, half way", relative(ramped.column("fit: force x")[1], interference / 2), 1e-6)
adjusted.says("adjusted to no gap")
finish()
