# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a contender of a campaign can choose."""

# Axes of a contender and the key of the scene that each of them sets.
AXES = {
    "touchstone": {
        "degree": "Discretisation/Degree",
        "element": "Body {body}/Element",
        "pairing": "Contact pair {pair}/Pairing",
        "normal": "Contact pair {pair}/Master normal",
        "geometry": "Contact pair {pair}/Contact geometry",
        "enforcement": "Contact/Enforcement",
        "linearisation": "Contact/Linearisation",
        "friction": "Contact/Friction",
        "solver": "Linear solver/Type",
        "ranks": None,
    },
    "calculix": {
        "degree": "Discretisation/Degree",
        "element": None,
        "contact": None,
        "penalty": None,
        "increments": None,
        "solver": None,
    },
    "getfem": {
        "degree": "Discretisation/Degree",
        "sliding": None,
        "augmentation": None,
        "multiplier": None,
        "parts": None,
    },
}
# What other programs take where a contender does not choose.
DEFAULTS = {
    "calculix": {
        "degree": 1,
        "element": "C3D8I",
        "contact": "surface to surface",
        "penalty": 50.0,
        "increments": 1,
        "solver": "spooles",
    },
    "getfem": {"degree": 1, "sliding": "large", "augmentation": 1.0, "multiplier": 1,
               "parts": 1},
}
CHOICES = {
    "calculix": {
        "element": ("C3D8", "C3D8I", "C3D8R", "C3D20", "C3D20R"),
        "contact": ("surface to surface", "node to surface"),
        "solver": ("spooles", "iterative scaling", "iterative cholesky"),
    },
    "getfem": {"degree": (1, 2), "sliding": ("large", "small"), "multiplier": (1, 2)},
}
NAMES = {"touchstone": "Touchstone", "calculix": "CalculiX", "getfem": "GetFEM"}
PLURALS = {"ranks": "ranks", "increments": "increments", "geometry": "geometries",
           "penalty": "penalties", "sliding": "slidings", "parts": "parts"}


def plural(axis):
    """Axes stand in the plural where they list several values."""
    return PLURALS.get(axis, axis + "s")
