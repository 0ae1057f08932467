# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact of getfem_program.py."""

import numpy
from scipy.spatial import cKDTree

import getfem

SLAVE, MASTER = 1, 2


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
