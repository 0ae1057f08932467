# SPDX-License-Identifier: LGPL-2.1-or-later
"""The problem of --export-model in GetFEM: python3 getfem_program.py JOB.json RESULT.json

Runs as a program of its own, for its CPU time and memory are what is measured. JOB has the
exported model and the choices of the contender, RESULT what the harness compares.

Cells are those of the model, GT_QK and FEM_QK of its degree. Supports are constraints with
multipliers, whose values are the reactions. Contact is one of GetFEM's two integral bricks
with a multiplier of degree 1 on the slave surface:
* large sliding: raytracing from the deformed slave surface, version 0
* small sliding: between non-matching meshes, projected in the reference state
Alart and Curnier's augmentation r is a number of Young's moduli over the size of a slave
face; the solver is GetFEM's Newton with MUMPS, its tolerance 1e-9. Stresses are in units of
the first Young's modulus, since GetFEM's one residual has forces and gaps in it.
"""

import json
import pathlib
import sys

import numpy
from scipy.spatial import cKDTree

import getfem

SLAVE, MASTER = 1, 2
# Corners of a lexicographic cell on its six sides.
SIDES = ((0, 2, 4, 6), (1, 3, 5, 7), (0, 1, 4, 5), (2, 3, 6, 7), (0, 1, 2, 3), (4, 5, 6, 7))
LARGE_STRAIN = ("(mu{b}*pow(Det({F}),-2/3)*({F}-Norm_sqr({F})/3*Inv({F})')"
                "+kappa{b}/2*(sqr(Det({F}))-1)*Inv({F})'):Grad_Test_u{b}")


class Body:
    """Mesh, displacements and stiffness of one body."""

    def __init__(self, model, problem, number):
        self.number, self.degree = number, problem["degree"]
        self.data = problem["bodies"][number]
        positions = numpy.array(problem["nodes"])
        cells = numpy.array(self.data["cells"])
        self.mesh = getfem.Mesh("empty", 3)
        shape = getfem.GeoTrans(f"GT_QK(3,{self.degree})")
        ids = self.mesh.add_convex(shape, positions[cells].transpose(2, 1, 0))
        n = self.degree + 1
        ends = (0, self.degree)
        corners = [i + n * (j + n * k) for k in ends for j in ends for i in ends]
        self.side_of = {frozenset(cell[[corners[c] for c in side]]): (cv, s)
                        for cell, cv in zip(cells, ids) for s, side in enumerate(SIDES)}
        self.local_side = self._local_sides(positions[cells[0]][corners], int(ids[0]))
        self.space = getfem.MeshFem(self.mesh, 3)
        self.space.set_fem(getfem.Fem(f"FEM_QK(3,{self.degree})"))
        self.rule = getfem.MeshIm(
            self.mesh, getfem.Integ(f"IM_GAUSS_PARALLELEPIPED(3,{2 * self.degree + 1})"))
        # Node k of GetFEM has the components 3 k, 3 k + 1, 3 k + 2.
        self.nodes = numpy.unique(cells)
        places = self.space.basic_dof_nodes()[:, ::3].T
        far, nearest = cKDTree(positions[self.nodes]).query(places)
        assert far.max() <= 1e-9 * numpy.ptp(positions), "nodes of the mesh and of the space"
        self.node_of = self.nodes[nearest]
        self.index_of = {int(node): k for k, node in enumerate(self.node_of)}
        self.name = f"u{number}"
        model.add_fem_variable(self.name, self.space)
        self._material(model)

    def _local_sides(self, corners, cell):
        """GetFEM's number of each side, from the points of a cell's faces."""
        result = {}
        for face in range(6):
            points = self.mesh.pts(self.mesh.pid_in_faces([[cell], [face]])).T
            middle = points[:4].mean(axis=0) if self.degree == 1 else points.mean(axis=0)
            result[min(range(6), key=lambda s, m=middle: numpy.linalg.norm(
                corners[list(SIDES[s])].mean(axis=0) - m))] = face
        assert len(result) == 6, "sides of a cell"
        return result

    def _material(self, model):
        young, nu = self.data["young_modulus"], self.data["poisson_ratio"]
        mu, first = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
        b = self.number
        for name, value in (("mu", mu), ("first", first), ("kappa", first + 2 * mu / 3)):
            model.add_initialized_data(f"{name}{b}", value)
        if self.data["law"] == "linear elastic":
            model.add_isotropic_linearized_elasticity_brick(self.rule, self.name, f"first{b}",
                                                            f"mu{b}")
        else:
            model.add_nonlinear_term(self.rule, LARGE_STRAIN.format(
                b=b, F=f"(Id(3)+Grad_u{b})"))

    def set_region(self, number, faces):
        p = self.degree
        sides = [self.side_of[frozenset((f[0], f[p], f[p * (p + 1)], f[-1]))] for f in faces]
        self.mesh.set_region(number, [[int(cv) for cv, _ in sides],
                                      [self.local_side[s] for _, s in sides]])

    def stresses(self, model):
        """Of small strain, at the quadrature points: xx, yy, zz, xy, xz, yz."""
        b = self.number
        points = getfem.MeshImData(self.rule, -1, [3, 3])
        values = model.interpolation(
            f"first{b}*Trace(Grad_u{b})*Id(3)+mu{b}*(Grad_u{b}+Grad_u{b}')", points)
        s = values.reshape(-1, 9)
        return s[:, [0, 4, 8, 1, 2, 5]].tolist()


class Supports:
    """Prescribed components of a body: rows of a constraint with multipliers."""

    def __init__(self, model, body, problem):
        first = problem["steps"][0]["displacements"]
        self.body, self.rows, known = body, [], set()
        for name, entries in first.items():
            for place, (node, *direction, _) in enumerate(entries):
                if node not in body.index_of:
                    continue
                axis = int(numpy.argmax(numpy.abs(direction)))
                assert abs(abs(direction[axis]) - 1) < 1e-12, f"{name} is not along an axis"
                if (node, axis) not in known:
                    known.add((node, axis))
                    self.rows.append((name, place, axis, direction[axis], node))
        matrix = getfem.Spmat("empty", len(self.rows), body.space.nbdof())
        for i, (_, _, axis, _, node) in enumerate(self.rows):
            matrix.add(i, 3 * body.index_of[node] + axis, 1.0)
        self.multiplier = f"support{body.number}"
        model.add_variable(self.multiplier, len(self.rows))
        self.brick = model.add_constraint_with_multipliers(
            body.name, self.multiplier, matrix, numpy.zeros(len(self.rows)))

    def values(self, step):
        return numpy.array([step["displacements"][name][place][4] / sign
                            for name, place, _, sign, _ in self.rows])

    def fixed(self):
        return {(node, axis) for *_, axis, _, node in self.rows}

    def reactions(self, model):
        """Force of each support on the body."""
        result = {}
        for row, force in zip(self.rows, model.variable(self.multiplier)):
            result.setdefault(row[0], [0.0, 0.0, 0.0])[row[2]] -= float(force)
        return result


class Contact:
    """The contact brick and its multiplier."""

    def __init__(self, model, problem, bodies, supports, choices):
        pair = problem["pairs"][0]
        slave = next(b for b in bodies if pair["slave"][0][0] in b.index_of)
        master = next(b for b in bodies if pair["master"][0][0] in b.index_of)
        slave.set_region(SLAVE, pair["slave"])
        master.set_region(MASTER, pair["master"])
        self.slave, self.friction = slave, pair["friction_coefficient"]
        self.large = choices["sliding"] == "large"
        components = 3 if self.large or self.friction else 1
        space = getfem.MeshFem(slave.mesh, components)
        space.set_fem(getfem.Fem(f"FEM_QK(3,{choices['multiplier']})"))
        places = space.basic_dof_nodes().T
        far, nearest = cKDTree(numpy.array(problem["nodes"])[slave.nodes]).query(places)
        assert far.max() < 1e-9, "nodes of the multiplier"
        # Where a support holds a component its multiplier would have no equation.
        held = supports[slave.number].fixed() if components == 3 else ()
        nodes = slave.nodes[nearest]
        self.dofs = [int(d) for d in numpy.unique(space.basic_dof_on_region(SLAVE))
                     if (nodes[d], d % components) not in held]
        self.at = [(int(nodes[d]), d % components) for d in self.dofs]
        self.components = components
        self.space = getfem.MeshFem("partial", space, self.dofs)
        rule = f"IM_GAUSS_PARALLELEPIPED(3,{2 * slave.degree + 1})"
        if choices["parts"] > 1:
            rule = f"IM_STRUCTURED_COMPOSITE({rule},{choices['parts']})"
        self.rule = getfem.MeshIm(slave.mesh, getfem.Integ(rule))
        model.add_fem_variable("contact", self.space)
        model.add_initialized_data("r", choices["augmentation"] * slave.data["young_modulus"]
                                   / choices["face size"])
        self.past = {}
        if self.friction:
            model.add_initialized_data("friction", self.friction)
            model.add_initialized_data("rate", 1.0)
            for body in (slave, master):
                self.past[f"past{body.number}"] = body.name
                model.add_fem_data(f"past{body.number}", body.space)
        if self.large:
            self._large(model, slave, master, 3 * choices["face size"])
        else:
            words = ["friction"] if self.friction else []
            after = (["rate", f"past{slave.number}", f"past{master.number}"] if self.friction
                     else [])
            model.add_integral_contact_between_nonmatching_meshes_brick(
                self.rule, slave.name, master.name, "contact", "r", *words, SLAVE, MASTER, 1,
                *after)

    def _large(self, model, slave, master, release):
        words = ["friction", "rate"] if self.friction else []
        brick = model.add_integral_large_sliding_contact_brick_raytracing("r", release, *words)
        w = [f"past{b.number}" if self.friction else "" for b in (slave, master)]
        model.add_slave_contact_boundary_to_large_sliding_contact_brick(
            brick, self.rule, SLAVE, slave.name, "contact", *w[:1])
        model.add_master_contact_boundary_to_large_sliding_contact_brick(
            brick, master.rule, MASTER, master.name, *w[1:])

    def keep(self, model):
        """The displacements at the start of a step, from which slip counts."""
        for data, name in self.past.items():
            model.set_variable(data, model.variable(name))

    def values(self, model):
        """Multiplier at the slave nodes: [node, x, y, z], or [node, normal]."""
        result = {}
        for (node, component), value in zip(self.at, model.variable("contact")):
            result.setdefault(node, [0.0] * self.components)[component] = float(value)
        return [[node, *value] for node, value in result.items()]


def scale(problem, unit):
    """Measure stresses and forces of the problem in @p unit."""
    for body in problem["bodies"]:
        body["young_modulus"] /= unit
    for step in problem["steps"]:
        step["forces"] = [[node, *(f / unit for f in force)] for node, *force in step["forces"]]


class Run:
    """Load steps; a step that does not converge is halved."""

    def __init__(self, job):
        self.problem, self.choices = job["model"], job["choices"]
        self.unit = self.problem["bodies"][0]["young_modulus"]
        scale(self.problem, self.unit)
        self.model = getfem.Model("real")
        self.bodies = [Body(self.model, self.problem, b)
                       for b in range(len(self.problem["bodies"]))]
        self.supports = [Supports(self.model, body, self.problem) for body in self.bodies]
        self.loads = [self.model.add_explicit_rhs(b.name, numpy.zeros(b.space.nbdof()))
                      for b in self.bodies]
        self.contact = Contact(self.model, self.problem, self.bodies, self.supports, self.choices)
        self.iterations, self.history = 0, []

    def state(self, step):
        """What a step prescribes: values of supports and nodal forces, body by body."""
        result = []
        for body, supports in zip(self.bodies, self.supports):
            force = numpy.zeros(body.space.nbdof())
            for node, *f in step["forces"]:
                if node in body.index_of:
                    force[3 * body.index_of[node]:3 * body.index_of[node] + 3] = f
            result.append((supports.values(step), force))
        return result

    def solve(self, state):
        for supports, load, (values, force) in zip(self.supports, self.loads, state):
            self.model.set_private_rhs(supports.brick, values)
            self.model.set_private_rhs(load, force)
        count, converged = self.model.solve(
            "noisy", "max_iter", self.choices["iterations"], "max_res", 1e-9, "lsolver", "mumps",
            "lsearch", "simplest", "alpha max ratio", 1.5, "alpha min", 0.2, "alpha mult", 0.6)
        self.iterations += count
        return bool(converged)

    def reactions(self):
        return {name: [self.unit * f for f in force] for s in self.supports
                for name, force in s.reactions(self.model).items()}

    def steps(self):
        """All load steps. @return Why they ended early, or nothing."""
        start = [(0 * v, 0 * f) for v, f in self.state(self.problem["steps"][0])]
        for step in self.problem["steps"]:
            end, done, part = self.state(step), 0.0, 1.0
            while done < 1:
                before = self.model.from_variables()
                self.contact.keep(self.model)
                to = min(1.0, done + part)
                if self.solve([tuple((1 - to) * a + to * b for a, b in zip(s, e))
                               for s, e in zip(start, end)]):
                    done = to
                    continue
                self.model.to_variables(before)
                part /= 2
                if part < 2.0 ** -self.choices["cuts"]:
                    return (f"Newton did not converge at time {step['time']:g} after "
                            f"{self.choices['cuts']} cuts of the step")
            start = end
            self.history.append({"time": step["time"], "reactions": self.reactions()})
        return ""

    def result(self, reason):
        unknowns = sum(b.space.nbdof() for b in self.bodies)
        law = {b["law"] for b in self.problem["bodies"]}
        with_stress = self.choices["stresses"] and law == {"linear elastic"} and not reason
        return {"reason": reason, "iterations": self.iterations, "nodes": unknowns // 3,
                "unknowns": unknowns, "multipliers": self.contact.space.nbdof(),
                "contact": [[node, *(self.unit * v for v in value)]
                            for node, *value in self.contact.values(self.model)],
                "stresses": [[self.unit * v for v in s] for b in self.bodies
                             for s in b.stresses(self.model)] if with_stress else [],
                "history": self.history}


def main():
    job, result = map(pathlib.Path, sys.argv[1:3])
    getfem.util_trace_level(1)
    run = Run(json.loads(job.read_text(encoding="utf-8")))
    result.write_text(json.dumps(run.result(run.steps())), encoding="utf-8")


if __name__ == "__main__":
    main()
