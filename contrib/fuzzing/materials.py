# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random materials, friction, and settings of pairs."""

LAWS = ("linear elastic", "linear elastic", "linear elastic", "neo-Hookean",
        "St. Venant-Kirchhoff", "small-strain von Mises", "finite-strain von Mises")
# Strains up to which a law is pressed; plastic ones yield before.
STRAINS = {"linear elastic": 0.01, "neo-Hookean": 0.1, "St. Venant-Kirchhoff": 0.03,
           "small-strain von Mises": 0.01, "finite-strain von Mises": 0.03}


def material(rng, beside=1000.0):
    """A material whose modulus is not too far from that of the body beside it.
    @return a strain to load it by, and what Body takes: keys without and with units"""
    law = rng.choice(LAWS)
    young = round(beside * 10 ** rng.choice((0, 0, rng.uniform(-1, 1))), 3)
    moduli = {"Young modulus": young}
    if "Mises" in law:
        moduli |= {"Yield stress": 0.005 * young, "Hardening modulus": 0.1 * young}
    poisson = rng.choice((0.0, 0.3, 0.3, round(rng.uniform(0.1, 0.45), 3)))
    strain = STRAINS[law] * rng.uniform(0.2, 1.0)
    return strain, ({"Law": law, "Poisson ratio": f"{poisson:g}"}, moduli)


def bearable(stuff):
    """The stress at the strain up to which a body of this material is pressed."""
    law, moduli = stuff
    return STRAINS[law["Law"]] * moduli["Young modulus"]


def behaviour(rng):
    """Frictionless, or a law and its coefficient."""
    kind = rng.random()
    if kind < 0.45:
        return "frictionless", 0.0
    if kind < 0.92:
        return "coulomb", rng.choice((0.1, 0.3, round(rng.uniform(0, 1), 3), 1.0))
    return "tresca", round(rng.uniform(0.5, 5), 3)


def settings(rng):
    result = [("Pairing", rng.choice(("averaged", "pointwise")))]
    if rng.random() < 0.15:
        result.append(("Master normal", rng.choice(("face", "smoothed"))))
    if rng.random() < 0.1:
        result.append(("Contact geometry", "faceted"))
    if rng.random() < 0.1:
        result.append(("Initial overlap", rng.choice(("adjust", "ramp"))))
    return tuple(result)
