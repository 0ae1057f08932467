# SPDX-License-Identifier: LGPL-2.1-or-later
"""What drives a body or an obstacle, as formulas of time.

Each motion has phases of one unit of time: first the bodies are pressed onto each other,
then they move.
"""

import math

from .scene import Formula

KINDS = ("press", "slide", "turn", "reverse", "lift off")
PRESSED = "min(1, t)"
MOVED = "min(1, max(0, t - 1))"
BACK = "max(0, t - 2)"


class Motion:
    """One kind of motion with its random sizes."""

    def __init__(self, rng, kinds, depth, way, centre=(0.0, 0.0)):
        """Pressed by @p depth along -z, moved by up to @p way across, turned about @p centre."""
        self.kind = rng.choice(kinds)
        self.depth = depth
        self.way = way * rng.uniform(0.2, 1.0)
        self.direction = math.radians(rng.choice((0, 90, rng.uniform(0, 360))))
        self.angle = math.radians(rng.uniform(1, 15))
        self.centre = centre
        self.end_time = {"press": 1, "reverse": 3}.get(self.kind, 2)

    def across(self):
        """Displacements x and y."""
        if self.kind in ("press", "lift off"):
            return Formula(0.0), Formula(0.0)
        if self.kind == "turn":
            (a, b), angle = self.centre, f"{self.angle:.6g} * {MOVED}"
            x, y = f"(x - {a:.6g})", f"(y - {b:.6g})"
            return (Formula(1.0, f"(cos({angle}) - 1) * {x} - sin({angle}) * {y}"),
                    Formula(1.0, f"sin({angle}) * {x} + (cos({angle}) - 1) * {y}"))
        text = MOVED if self.kind == "slide" else f"{MOVED} - 1.5 * {BACK}"
        return (Formula(self.way * round(math.cos(self.direction), 6), text),
                Formula(self.way * round(math.sin(self.direction), 6), text))

    def down(self):
        """Displacement z."""
        text = f"{PRESSED} - 1.5 * max(0, t - 1)" if self.kind == "lift off" else PRESSED
        return Formula(-self.depth, text)

    def force(self, pressure):
        """Traction z instead of a displacement; what is lifted off keeps a tenth."""
        text = f"{PRESSED} - 0.9 * {MOVED}" if self.kind == "lift off" else PRESSED
        return Formula(-pressure, text)
