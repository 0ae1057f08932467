# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies and supports of getfem_program.py."""

import numpy
from scipy.spatial import cKDTree

import getfem

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
