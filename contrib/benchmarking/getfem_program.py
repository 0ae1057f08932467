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

import getfem
from getfem_bodies import Body, Supports
from getfem_contact import Contact


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
