# SPDX-License-Identifier: LGPL-2.1-or-later
"""The judge of contrib/fuzz_scenes finds nothing in results that are right and flags each that was
falsified on purpose."""

import copy
import dataclasses

import touchstone_test
from touchstone_test import folder, forking_program

# pylint: disable=wrong-import-order,import-error
from fuzzing import agreement, campaign, generator, invariants, runs, vtu
from fuzzing.geometry import Box
from fuzzing.scene import Body, Condition, Formula, Obstacle, Pair, Scene


program = forking_program()


def check(what, good):
    print(what, flush=True)
    touchstone_test.check(good, what)


def block_on_plane():
    """A block with friction that is pressed onto a plane and pushed along it."""
    top = Condition((Formula(0.01, "max(0, t - 1)"), Formula(0.0), None),
                    (None, None, Formula(-10.0, "min(1, t)")))
    block = Body("block", Box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (2, 2, 2)),
                 {"Law": "linear elastic", "Poisson ratio": "0.3"}, {"Young modulus": 1000.0},
                 conditions=(("top", top),))
    ground = Obstacle("ground", "plane", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (Formula(0.0),) * 3)
    pair = Pair("contact", "block", ("bottom",), "ground", behaviour="coulomb", coefficient=0.2)
    return Scene("Block on a plane", (block,), (ground,), (pair,), 2, 4, clearance=0.0)


def flagged(scene, result, kind, change):
    """After @p change of a copy of the result the judge finds @p kind."""
    wrong = copy.deepcopy(result)
    change(wrong)
    kinds = [f.kind for f in invariants.judge(scene, wrong)]
    check(f"{change.__doc__}: {', '.join(kinds) or 'nothing found'}", kind in kinds)


def node_that_slips(result):
    return next(n for n in result.nodes if n.status == 1 and sum(t * t for t in n.shear()) > 0)


def unbalanced(result):
    "a reaction that is 1e-4 too large"
    result.rows[-1]["block/top: reaction x"] *= 1 + 1e-4


def pulled(result):
    "a node that is pulled"
    node = result.nodes[0]
    node.traction = tuple(-t for t in node.traction)
    node.pressure = -node.pressure


def too_much_shear(result):
    "a node with twice the friction that is possible"
    node = node_that_slips(result)
    node.traction = tuple(t + s for t, s in zip(node.traction, node.shear()))


def pushed_along(result):
    "friction that pushes along the slip"
    node = node_that_slips(result)
    node.slip = tuple(-s for s in node.slip)


def energy_from_friction(result):
    "friction that gives energy"
    result.rows[-1]["energy: friction"] = 0.9 * result.rows[-2]["energy: friction"]


def deep(result):
    "a penetration in the table"
    result.rows[1]["contact: max penetration"] = 1e-4


def below_the_plane(result):
    "a node below the plane that says nothing of it"
    node = result.nodes[0]
    node.displacement = (0.0, 0.0, -1e-3)


def not_a_number(result):
    "a result that is not a number"
    result.rows[0]["energy: strain"] = float("nan")


def overlap(result):
    "an overlap of bodies that only touch"
    result.terminal = result.terminal.replace("smallest gap 0", "smallest gap -0.01")


def aborted(result):
    "a signal"
    result.exit_code = -11


def exception(result):
    "the text of an exception"
    result.terminal += "\nterminate called after throwing an instance of 'std::bad_alloc'\n"


def main():
    scene = block_on_plane()
    right = runs.run(program, scene, folder / "right")
    found = invariants.judge(scene, right)
    check(f"a right result: {found or 'nothing found'}",
          right.converged() and not found and len(right.nodes) == 9 and len(right.rows) == 4)
    for kind, change in (("balance", unbalanced), ("tension", pulled), ("cone", too_much_shear),
                         ("with the slip", pushed_along),
                         ("friction gives energy", energy_from_friction), ("penetration", deep),
                         ("penetration", below_the_plane), ("not a number", not_a_number),
                         ("false overlap", overlap), ("crash", aborted),
                         ("raw message", exception)):
        flagged(scene, right, kind, change)

    for variant in campaign.VARIANTS:
        if variant.change == "with_sides":  # for pairs of bodies
            continue
        own = variant.of(scene)
        result = runs.run(program, own, folder / "variant", variant.settings, variant.ranks)
        found = invariants.judge(own, result) + \
            list(agreement.compare(scene, right, own, result, variant))
        check(f"{variant.name}: {found or 'nothing found'}", result.converged() and not found)
        for row in result.rows:
            for axis in "xyz":
                row[f"contact: force {axis}"] *= 1 + (1e-5 if variant.exact else 0.2)
        found = list(agreement.compare(scene, right, own, result, variant))
        check(f"{variant.name}, falsified: {', '.join(f.kind for f in found)}", bool(found))

    # A run that has left out a step is another path: it is made again with the same steps.
    variant = next(v for v in campaign.VARIANTS if v.name == "GMRES")
    result = runs.run(program, scene, folder / "variant", variant.settings)
    del result.rows[1]
    for row in result.rows:
        row["contact: force z"] *= 1.2
    found = campaign.compare(scene, right, scene, result, variant, program, folder, 60)
    again = runs.read(folder / "GMRES_same_steps", 0, False, 0)
    check(f"other steps: {found or 'nothing found'} with the same steps",
          not found and agreement.same_times(right, again))

    # One that cannot make the steps of the default run: this one is made again with its steps.
    shorter = campaign.with_times_of(scene, result)
    cut = runs.run(program, shorter, folder / "cut", variant.settings)
    unable = dataclasses.replace(variant, settings=("Newton/Maximum iterations=1",))
    other = copy.deepcopy(right)
    for row in other.rows:
        row["contact: force z"] *= 1.2
    found = campaign.compare(scene, other, scene, cut, unable, program, folder, 60)
    again = runs.read(folder / "default_same_steps", 0, False, 0)
    check(f"steps that were cut: {found or 'nothing found'} with the same steps",
          not found and cut.converged() and agreement.same_times(cut, again))
    for row in cut.rows:
        row["contact: force z"] *= 0.8
    found = campaign.compare(scene, right, scene, cut, unable, program, folder, 60)
    check(f"steps that were cut, falsified: {', '.join(f.kind for f in found)}", bool(found))

    check("the same scene for the same seed", generator.scene(3, 5) == generator.scene(3, 5))
    check("another one for another seed", generator.scene(3, 5) != generator.scene(4, 5))
    check("a picture is read", all(isinstance(n, vtu.Node) for n in right.nodes))
    touchstone_test.finish()


main()
