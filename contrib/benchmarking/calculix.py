# SPDX-License-Identifier: LGPL-2.1-or-later
"""The same mesh, materials, supports and loads in CalculiX (ccx).

The program exports the discrete problem of a scene (--export-model); here it becomes a
deck. Differences that remain:
* C3D20 has no nodes in the middle of faces and cells, FE_Q(2) has: corners and edges are
  the same, so a quadratic mesh has fewer nodes here. Loads on the middle of a face go to
  the others with the values of their shape functions there, which is exact.
* CalculiX knows contact surfaces by their facets only, where the program takes the exact
  surfaces of its geometries (key 'Contact geometry').
* Contact is a penalty: its stiffness is the key 'penalty' times Young's modulus over the
  size of a slave face.
* Small strain, as in the program's linear elastic bodies; contact follows the displaced
  nodes in both. Neo-Hookean bodies: NLGEOM, and a slightly different law, see material().
"""

import math
import shutil

from . import calculix_results, exported, processes, surfaces

LAWS = ("linear elastic", "neo-Hookean")
# Corners in the order of CalculiX from the lexicographic one, as steps along x, y, z.
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6),
         (3, 7))
# Corners of the sides S1 to S6 of an element.
SIDES = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def installed():
    return shutil.which("ccx")


def element_nodes(cell, degree):
    """Nodes of a cell in the order of C3D8 or C3D20."""
    n = degree + 1

    def at(i, j, k):
        return cell[i + n * (j + n * k)]

    nodes = [at(*(degree * c for c in corner)) for corner in CORNERS]
    if degree == 2:
        nodes += [at(*(CORNERS[a][d] + CORNERS[b][d] for d in range(3))) for a, b in EDGES]
    return nodes


class Model:
    """The exported problem, in the terms of CalculiX."""

    def __init__(self, model):
        self.degree = model["degree"]
        self.positions = model["nodes"]
        self.bodies = model["bodies"]
        self.steps = model["steps"]
        self.pair = exported.only_pair(model, LAWS)
        self.large_strain = any(b["law"] != "linear elastic" for b in self.bodies)
        self.reference = model["reference"]
        self.elements, self.side_of = [], {}
        for number, body in enumerate(self.bodies):
            for cell in body["cells"]:
                nodes = element_nodes(cell, self.degree)
                self.elements.append((number, nodes))
                for side, corners in enumerate(SIDES):
                    key = frozenset(nodes[c] for c in corners)
                    self.side_of[key] = (len(self.elements), side + 1)
        # The middles of faces and cells belong to no element of degree 2.
        self.nodes = sorted({n for _, nodes in self.elements for n in nodes})
        slave = self.face_side(self.pair["slave"][0])[0]
        body = self.elements[slave - 1][0]
        self.slave_body_nodes = {n for b, nodes in self.elements for n in nodes if b == body}
        self.slave_young = self.bodies[body]["young_modulus"]
        self.areas = surfaces.node_areas(self.pair["slave"], self.positions, self.degree,
                                         quadratic_of_eight=self.degree == 2)
        self.face_size = math.sqrt(sum(self.areas.values()) / len(self.pair["slave"]))

    def face_side(self, face):
        """Element and side of a face with lexicographic nodes."""
        p = self.degree
        corners = (face[0], face[p], face[p * (p + 1)], face[-1])
        return self.side_of[frozenset(corners)]

    def forces(self, step):
        """Nodal forces of a step on the nodes of this mesh."""
        forces = {entry[0]: entry[1:] for entry in step["forces"]}
        middles = {}
        if self.degree == 2:
            # In the bodies' cells: nodes in the middle of faces, with the 8 around them.
            for body in self.bodies:
                for cell in body["cells"]:
                    for axis in range(3):
                        for end in (0, 2):
                            s = [3**axis, 3 ** ((axis + 1) % 3), 3 ** ((axis + 2) % 3)]
                            face = [cell[end * s[0] + i * s[1] + j * s[2]]
                                    for j in range(3) for i in range(3)]
                            middles[face[4]] = [face[i] for i in surfaces.EIGHT]
        result = {}
        for node, force in forces.items():
            shares = zip(middles[node], surfaces.MIDDLE) if node in middles else [(node, 1.0)]
            for target, share in shares:
                known = result.setdefault(target, [0.0, 0.0, 0.0])
                for d in range(3):
                    known[d] += share * force[d]
        return result

    def supports(self):
        """Nodes by name of the support, of which each may prescribe several components."""
        known = set(self.nodes)
        return {name: list(dict.fromkeys(entry[0] for entry in entries if entry[0] in known))
                for name, entries in self.steps[0]["displacements"].items()}

    def displacements(self, step):
        """Prescribed components (node, axis) of a step and their values."""
        result = {}
        known = set(self.nodes)
        for support, entries in step["displacements"].items():
            for node, *direction, value in entries:
                axis = max(range(3), key=lambda d: abs(direction[d]))
                if abs(abs(direction[axis]) - 1) > 1e-12:
                    raise exported.ModelError(f"the support {support} is not along an axis")
                if node in known:
                    result[(node, axis)] = value / direction[axis]
        return result


def material(body):
    """Lines of a material. The energy of volume of CalculiX' neo-Hookean law is that of
    (J - 1)^2, the program's that of (J^2 - 1)/2 - ln J: the same to second order."""
    young, nu = body["young_modulus"], body["poisson_ratio"]
    if body["law"] == "linear elastic":
        return ["*ELASTIC", f"{young:.12g}, {nu:.12g}"]
    shear, bulk = young / (2 * (1 + nu)), young / (3 * (1 - 2 * nu))
    return ["*HYPERELASTIC, NEO HOOKE", f"{shear / 2:.12g}, {2 / bulk:.12g}"]


def deck(model, choices, tension, with_stress):
    """The text of the deck."""
    # CalculiX reads 20 characters of a number: with 15 digits exponents would be lost.
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{n + 1}, " + ", ".join(f"{x:.12g}" for x in model.positions[n])
              for n in model.nodes]
    for number, body in enumerate(model.bodies):
        lines.append(f"*ELEMENT, TYPE={choices['element']}, ELSET=BODY{number}")
        for e, (owner, nodes) in enumerate(model.elements):
            if owner == number:
                words = [str(e + 1)] + [str(n + 1) for n in nodes]
                # At most 16 entries stand in a line.
                lines += [", ".join(words[i:i + 11]) + ("," if i + 11 < len(words) else "")
                          for i in range(0, len(words), 11)]
        lines += [f"*MATERIAL, NAME=MATERIAL{number}", *material(body),
                  f"*SOLID SECTION, ELSET=BODY{number}, MATERIAL=MATERIAL{number}"]
    for name in ("slave", "master"):
        lines.append(f"*SURFACE, NAME={name.upper()}, TYPE=ELEMENT")
        lines += ["{}, S{}".format(*model.face_side(face)) for face in model.pair[name]]
    stiffness = choices["penalty"] * model.slave_young / model.face_size
    lines += ["*SURFACE INTERACTION, NAME=CONTACT",
              "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
              f"{stiffness:.9g}" + (f", {tension:.9g}" if tension > 0 else "")]
    if model.pair["friction_coefficient"] > 0:
        # The stick slope is a tenth of the stiffness, as CalculiX' manual advises.
        lines += ["*FRICTION", f"{model.pair['friction_coefficient']:.9g}, {0.1 * stiffness:.9g}"]
    kind = choices["contact"].upper()
    lines += [f"*CONTACT PAIR, INTERACTION=CONTACT, TYPE={kind}", "SLAVE, MASTER"]
    for number, nodes in enumerate(model.supports().values()):
        lines += [f"*NSET, NSET=SUPPORT{number}"] + [f"{n + 1}," for n in nodes]
    start = 0.0
    for step in model.steps:
        period = step["time"] - start
        start = step["time"]
        lines += ["*STEP, INC=1000" + (", NLGEOM" if model.large_strain else ""), f"*STATIC, SOLVER={choices['solver'].upper()}",
                  f"{period / choices['increments']:.9g}, {period:.9g}", "*BOUNDARY"]
        lines += [f"{node + 1}, {axis + 1}, {axis + 1}, {value:.12g}"
                  for (node, axis), value in sorted(model.displacements(step).items())]
        forces = model.forces(step)
        if forces:
            lines.append("*CLOAD")
            lines += [f"{node + 1}, {d + 1}, {force[d]:.12g}"
                      for node, force in sorted(forces.items()) for d in range(3) if force[d]]
        last = step is model.steps[-1]
        lines += ["*NODE FILE" + ("" if last else ", FREQUENCY=100000"), "U, RF",
                  "*CONTACT FILE" + ("" if last else ", FREQUENCY=100000"), "CDIS, CSTR"]
        for number in range(len(model.supports())):
            lines += [f"*NODE PRINT, NSET=SUPPORT{number}, TOTALS=ONLY, FREQUENCY=100000", "RF"]
        if with_stress and last:
            for number in range(len(model.bodies)):
                lines += [f"*EL PRINT, ELSET=BODY{number}", "S"]
        lines.append("*END STEP")
    return "\n".join(lines) + "\n"


def prepare(program, case, campaign, folder):
    """Export the model and write the deck. @throws exported.ModelError"""
    model = Model(exported.export(program, case, campaign, folder))
    with_stress = model.reference["type"] == "uniform stress"
    (folder / "deck.inp").write_text(deck(model, case.choices, case.tension, with_stress),
                                     encoding="ascii")
    return model


def results(model, case, campaign, folder):
    """Errors of a run that ended well, or why there are none."""
    try:
        history = calculix_results.read_reactions(model, folder / "deck.dat")
        return {"errors": calculix_results.errors(model, folder, case.choices["contact"]) |
                exported.quantities(campaign, history)}
    except exported.ModelError as error:
        return {"reason": str(error)}


def execute(program, case, campaign, folder, models):
    """Run the case once; see touchstone.execute(). @param models Those of earlier rounds."""
    row = {"user_seconds": math.nan, "system_seconds": math.nan, "wall_seconds": math.nan,
           "memory_mb": math.nan, "reason": "", "command": ["ccx", "-i", "deck"], "errors": {}}
    try:
        if case.folder not in models:
            models[case.folder] = prepare(program, case, campaign, folder)
        model = models[case.folder]
    except exported.ModelError as error:
        return row | {"reason": str(error)}
    for suffix in ("frd", "dat"):
        (folder / f"deck.{suffix}").unlink(missing_ok=True)
    log = folder / "terminal"
    usage = processes.run(["ccx", "-i", "deck"], folder, log, campaign.time_limit)
    row |= {"user_seconds": usage.user_seconds, "system_seconds": usage.system_seconds,
            "wall_seconds": usage.wall_seconds, "memory_mb": usage.memory_mb,
            "nodes": len(model.nodes), "unknowns": 3 * len(model.nodes),
            "reason": usage.failure()}
    text = log.read_text(encoding="utf-8", errors="replace")
    row["newton"] = text.count("iteration ") or None
    if not usage.failure():
        # It says so and yet ends with exit code 0 or 201, by version.
        if "*ERROR" in text or "Job finished" not in text:
            complaints = [line.strip() for line in text.splitlines() if "*ERROR" in line]
            row["reason"] = complaints[-1] if complaints else "did not finish"
        else:
            row |= results(model, case, campaign, folder)
    elif usage.exit_code and "*ERROR" in text:
        row["reason"] += ": " + [line.strip() for line in text.splitlines() if "*ERROR" in line][-1]
    return row
