# SPDX-License-Identifier: LGPL-2.1-or-later
"""What CalculiX answers, and its errors."""

import math

from . import exported, fields, measures, surfaces


def read_frd(path):
    """The last block of each name in a result file: values by node."""
    blocks, current = {}, None
    with open(path, encoding="ascii", errors="replace") as lines:
        for line in lines:
            if line.startswith(" -4"):
                current = blocks[line[5:13].strip()] = {}
            elif line.startswith(" -1") and current is not None:
                current[int(line[3:13]) - 1] = [float(line[i:i + 12])
                                                for i in range(13, len(line.rstrip()), 12)]
            elif line.startswith(" -3"):
                current = None
    return blocks


def read_stresses(path):
    """All lines 'element point sxx syy szz sxy sxz syz' of a .dat file."""
    result = []
    for line in path.read_text(encoding="ascii", errors="replace").splitlines():
        words = line.split()
        if len(words) == 8 and words[0].isdigit():
            result.append([float(w) for w in words[2:]])
    return result


def read_reactions(model, path):
    """Reactions at the end of each step: see exported.quantities()."""
    names, history = list(model.supports()), {}
    lines = iter(path.read_text(encoding="ascii", errors="replace").splitlines())
    for line in lines:
        words = line.split()
        if words[:2] == ["total", "force"]:
            next(lines)
            number = int(words[words.index("set") + 1].removeprefix("SUPPORT"))
            history.setdefault(float(words[-1]), {})[names[number]] = [
                float(w) for w in next(lines).split()]
    # Supports share nodes, but each prescribes components of its own.
    own = {name: {max(range(3), key=lambda d, e=entry: abs(e[d + 1])) for entry in entries}
           for name, entries in model.steps[0]["displacements"].items()}
    return [{"time": time, "reactions": {
        name: [f if d in own[name] else 0.0 for d, f in enumerate(force)]
        for name, force in reactions.items()}} for time, reactions in history.items()]


def contact_points(model, blocks):
    """Results at the slave nodes, with the areas that the program gives them."""
    values = blocks.get("CONTACT", {})
    mu = model.pair["friction_coefficient"]
    points = []
    for node, area in model.areas.items():
        # COPEN, CSLIP1, CSLIP2, CPRESS, CSHEAR1, CSHEAR2; nothing where contact is open.
        _, _, _, pressure, shear1, shear2 = values.get(node, [0.0] * 6)
        active = pressure > 0
        stick = active and mu > 0 and math.hypot(shear1, shear2) < 0.999 * mu * pressure
        # The first tangent of a surface along z is x; CSHEAR acts on the master.
        points.append(measures.Point(tuple(model.positions[node]), area, pressure, -shear1, active,
                                     stick))
    return points


def mean_pressure(model, force):
    """The uniform pressure with this force on the slave surface; no number for a closed ring,
    where it has none."""
    area = surfaces.vector_area(model.pair["slave"], model.positions, model.degree)
    size = sum(a * a for a in area)
    if size < 1e-6 * sum(model.areas.values()) ** 2:
        return math.nan
    return -sum(f * a for f, a in zip(force, area)) / size


def contact_fields(model, points, kind):
    """Tractions as fields. Those of node-to-surface contact are means around the nodes like
    the program's, and are recovered like these."""
    shapes = "eight" if model.degree == 2 else "all"
    result = {}
    for name in ("pressure", "shear"):
        values = {node: getattr(p, name) for node, p in zip(model.areas, points)}
        result[name] = fields.Field(model.pair["slave"], model.positions, model.degree, values,
                                    shapes)
        if kind == "node to surface" and model.degree == 1:
            result[name] = result[name].recovered()
    return result


def errors(model, folder, contact):
    """The same errors as those of the program's summary."""
    values = measures.reference_values(model.reference["values"])
    kind = model.reference["type"]
    if kind == "none":
        return {}
    if kind == "uniform stress":
        return measures.uniform_stress(read_stresses(folder / "deck.dat"), values)
    if kind not in measures.OF_CONTACT:
        raise exported.ModelError(f"there is no measure for the reference solution '{kind}'")
    blocks = read_frd(folder / "deck.frd")
    # What holds the slave body is balanced by the contact force on it.
    force = [-sum(f[d] for n, f in blocks["FORC"].items() if n in model.slave_body_nodes)
             for d in range(3)]
    points = contact_points(model, blocks)
    result = measures.OF_CONTACT[kind](points, force, values,
                                       contact_fields(model, points, contact))
    if kind == "interference fit":
        # Pressures that CalculiX extrapolates to nodes do not add up to the force, those of
        # the program do: its mean is force over area.
        mean = mean_pressure(model, force)
        if not math.isnan(mean):
            result["contact_pressure_mean"] = abs(mean / measures.fit_pressure(values) - 1)
    return result
