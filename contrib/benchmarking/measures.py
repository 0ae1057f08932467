# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors against exact solutions from the contact results of any program.

The same measures as those of source/verification/{interference_fit,hertz,cattaneo_mindlin,
uniform_stress}.cc, where their formulas and sources stand; tests/checks/benchmark.py
holds the two against each other.
"""

import dataclasses
import math


@dataclasses.dataclass
class Point:
    """Result at one slave node."""
    position: tuple
    area: float
    pressure: float
    # Shear traction of the master on the slave surface along x.
    shear: float = 0.0
    active: bool = False
    stick: bool = False


def reference_values(text):
    """The key 'Values' of a reference solution: 'name: number, name: number'."""
    result = {}
    for entry in text.split(","):
        if entry.strip():
            name, number = entry.split(":")
            result[name.strip()] = float(number)
    return result


def half_ellipse(x, a):
    return math.sqrt(1 - (x / a) ** 2) if abs(x) < a else 0.0


def fitted_edge(samples, fallback):
    """Where a traction that falls like a half ellipse vanishes: the zero of the line that
    fits its square against the square of the distance. Samples are (weight, r, t)."""
    s = [0.0] * 5
    for w, r, t in samples:
        s = [a + b for a, b in zip(s, (w, w * r**2, w * r**4, w * t**2, w * r**2 * t**2))]
    determinant = s[0] * s[2] - s[1] * s[1]
    slope = s[0] * s[4] - s[1] * s[3]
    constant = s[2] * s[3] - s[1] * s[4]
    if determinant > 1e-12 * s[0] * s[2] and slope < 0 < constant:
        return math.sqrt(-constant / slope)
    return fallback


def profile_error(points, computed, exact):
    """Difference of two tractions in the area-weighted square mean, relative."""
    size = sum(p.area * e * e for p, e in zip(points, exact))
    error = sum(p.area * (c - e) ** 2 for p, c, e in zip(points, computed, exact))
    return math.sqrt(error / size) if size > 0 else math.nan


def fit_pressure(values):
    """Exact pressure of the press fit on the slave surface."""
    inner, outer = values["inner skin radius"], values["outer bore radius"]
    a, c = values["inner radius"], values["outer radius"]
    young, nu = values["young modulus"], values["poisson ratio"]
    outer_young = values.get("outer young modulus", young)
    outer_nu = values.get("outer poisson ratio", nu)
    compliance = ((1 - nu**2) / young * (inner**2 + a**2) / (inner**2 - a**2) -
                  nu * (1 + nu) / young +
                  (1 - outer_nu**2) / outer_young * (c**2 + outer**2) / (c**2 - outer**2) +
                  outer_nu * (1 + outer_nu) / outer_young)
    return (inner - outer) / compliance / values["slave radius"]


def interference_fit(points, _force, values, _fields=None):
    exact = fit_pressure(values)
    active = [p for p in points if p.active]
    area = sum(p.area for p in active)
    mean = sum(p.area * p.pressure for p in active) / area if area > 0 else 0.0
    return {"contact_pressure_mean": abs(mean / exact - 1),
            "contact_pressure_max_deviation":
                max(abs(p.pressure - exact) for p in points) / exact}


def hertz(points, force, values, fields=None):
    compliance = (1 - values["poisson ratio"] ** 2) / values["young modulus"]
    if "second young modulus" in values:
        compliance += ((1 - values.get("second poisson ratio", 0) ** 2) /
                       values["second young modulus"])
    symmetry = values.get("symmetry factor", 1)
    axis = max(range(3), key=lambda d: abs(force[d]))
    total = symmetry * abs(force[axis])
    a = (3 * total * values["radius"] * compliance / 4) ** (1 / 3)
    peak = 3 * total / (2 * math.pi * a * a)
    centre = [values.get("centre " + d, 0.0) for d in "xyz"]
    r = [math.sqrt(sum((p.position[d] - centre[d]) ** 2 for d in range(3) if d != axis))
         for p in points]
    exact = [peak * half_ellipse(x, a) for x in r]
    active_area = sum(p.area for p in points if p.active)
    edge = fitted_edge([(p.area, x, p.pressure) for p, x in zip(points, r)
                        if p.active and x < 0.98 * a],
                       math.sqrt(symmetry * active_area / math.pi))
    result = {"peak_pressure": abs(max(p.pressure for p in points) / peak - 1),
              "contact_radius": abs(edge / a - 1),
              "pressure_l2": profile_error(points, [p.pressure for p in points], exact)}
    if fields:
        result["pressure_field_l2"] = fields["pressure"].relative_error(
            lambda x: peak * half_ellipse(math.sqrt(sum(
                (x[d] - centre[d]) ** 2 for d in range(3) if d != axis)), a))
    return result


def cattaneo_mindlin(points, force, values, fields=None):
    """Of the first loading only: the tangential force is at its peak."""
    young, nu = values["young modulus"], values["poisson ratio"]
    mu, depth = values["friction coefficient"], values["depth"]
    modulus = young / (2 * (1 - nu**2))
    normal, tangential = abs(force[2]) / depth, -force[0] / depth
    sign = math.copysign(1.0, tangential)
    a = math.sqrt(4 * normal * values["radius"] / (math.pi * modulus))
    p0 = 2 * normal / (math.pi * a)
    c = a * math.sqrt(max(1 - abs(tangential) / (mu * normal), 0.0))
    centre = values.get("centre x", 0.0)

    def pressure(t):
        return p0 * half_ellipse(t, a)

    def traction(t):
        return mu * p0 * (half_ellipse(t, a) - (c / a * half_ellipse(t, c) if c > 0 else 0))

    x = [p.position[0] - centre for p in points]
    p_exact, q_exact = [pressure(t) for t in x], [traction(t) for t in x]
    shear = [-sign * p.shear for p in points]
    active = sum(p.area for p in points if p.active)
    stick = sum(p.area for p in points if p.stick)
    width = fitted_edge([(p.area, t, p.pressure) for p, t in zip(points, x)
                         if p.active and abs(t) < 0.98 * a], active / (2 * depth))
    strip = fitted_edge([(p.area, t, mu * p.pressure - q) for p, t, q in zip(points, x, shear)
                         if p.stick], stick / (2 * depth))
    result = {"contact_half_width": abs(width / a - 1),
              "stick_half_width": abs(strip / c - 1) if c > 0 else math.nan,
              "pressure_l2": profile_error(points, [p.pressure for p in points], p_exact),
              "shear_traction_l2": profile_error(points, shear, q_exact)}
    if fields:
        result["pressure_field_l2"] = fields["pressure"].relative_error(
            lambda y: pressure(y[0] - centre))
        result["shear_traction_field_l2"] = fields["shear"].relative_error(
            lambda y: -sign * traction(y[0] - centre))
    return result


def uniform_stress(stresses, values):
    """Largest deviation of a stress (xx, yy, zz, xy, xz, yz) from the exact one."""
    exact = [values.get(name, 0.0) for name in ("sxx", "syy", "szz", "sxy", "sxz", "syz")]

    def norm(s):
        return math.sqrt(sum(v * v for v in s[:3]) + 2 * sum(v * v for v in s[3:]))

    return {"stress_max_deviation":
                max(norm([a - b for a, b in zip(s, exact)]) for s in stresses) / norm(exact)}


OF_CONTACT = {"interference fit": interference_fit, "hertz": hertz,
              "cattaneo mindlin": cattaneo_mindlin}
