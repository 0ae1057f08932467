# SPDX-License-Identifier: LGPL-2.1-or-later
"""The work against friction never falls and is that of the force along the way, also where rows of nodes are handed
over from one pair to another, and where the mesh changes; on two ranks and after a restart."""

from touchstone_test import CG, below, check, checks, finish, relative, run, same, stopped_and_resumed

scene = checks / "sliding_over_joint.prm"
WAY, FORCE = 1.63, 0.2 * 9  # mu times the pressure on the block


def worked(name, settings=None, ranks=1, bound=3e-2):
    """All of it while the block slides: what rows did that are no more was lost, 17 % after 96 steps (exit code 0)."""
    result = run(name, scene, settings, ranks)
    time, work = result.column("time"), result.column("energy: friction")
    force = [-sum(step) for step in zip(result.column("one: force x"), result.column("two: force x"))]
    by_force = sum(f * WAY * (t - s) for s, t, f in zip(time, time[1:], force[1:]) if s >= 1)
    below(f"{result}: force", relative(force[-1], FORCE), 1e-2)
    below(f"{result}: work of the force", relative(work[-1], by_force), bound)
    check(all(b >= a for a, b in zip(work, work[1:])), f"{result}: the work falls: {work}")
    return result


first = worked("averaged")
same(first, worked("averaged_2", ranks=2), 1e-7)
same(first, stopped_and_resumed("averaged", scene, {}, 12), 1e-8)
worked("cg", CG)
worked("pointwise", {f"Contact pair {pair}/Pairing": "pointwise" for pair in ("one", "two")})
# A region of small cells that moves with the block.
worked("adaptive", {"Refinement/Estimator": "region", "Refinement/Region": "0.5 - abs(x - 1.63*max(t - 1, 0) - 0.8)",
                    "Refinement/Cycles": 1, "Refinement/Cycles per step": 1, "Refinement/Maximum level": 1})
finish()
