# SPDX-License-Identifier: LGPL-2.1-or-later
"""The limit of friction. A block that is pushed by a displacement needs mu N in full slip (1e-6) with
every enforcement and solver; pushed by 0.98 mu N it sticks at all nodes, and pushed by 1.02 mu N
there is no equilibrium, which the program must say."""

import re

from touchstone_test import (AUGMENTED, ENFORCEMENT, ENFORCEMENTS, GMRES, MULTIPLIERS, PENALTY, below,
                             check, finish, prm, relative, run, same)


def slides(name, settings=None, ranks=1):
    result = run(name, prm / "benchmarks/sliding_block.prm", settings, ranks)
    below(f"{name}, reaction differs from mu N", relative(result.reaction("block", "top")[0], 4.8),
          1e-6)
    check(result.column("contact: slip nodes")[-1] == result.column("contact: active nodes")[-1],
          f"{name}: not all nodes slip")
    below(f"{name}, nodes that stick", result.column("contact: stick nodes")[-1], 0.5)
    return result


elimination = slides("elimination")
same(elimination, slides("elimination_2", ranks=2), 1e-8)
same(elimination, slides("gmres", GMRES), 1e-6)
same(elimination, slides("multipliers", MULTIPLIERS), 1e-8)
slides("augmented", AUGMENTED)
slides("penalty", PENALTY)


def pushed(name, traction, settings=None, fails=False):
    """TRACTION is the shear traction on top and sides."""
    load = f"{traction} * max(t - 1, 0)"
    sides = {f"Body {body}/Boundary {side}/Traction z": sign + load for body in ("base", "block")
             for side, sign in (("left", "-"), ("right", ""))}
    return run(name, prm / "benchmarks/sliding_block_force.prm",
               {**sides, "Body block/Boundary top/Traction x": load, **(settings or {})}, fails=fails)


for enforcement in ENFORCEMENTS:
    stick = pushed(f"stick_{enforcement}", 1.176, {ENFORCEMENT: enforcement})
    check(stick.column("contact: stick nodes")[-1] == 27, f"{stick}: not all 27 nodes stick")
    below(f"{stick}, stress deviates", stick.error("stress_max_deviation"), 1e-8)

beyond = pushed("beyond", 1.224, fails=True)
check(re.search("^Not converged: .*held by contact alone", beyond.text, re.M),
      f"the reason is missing: {beyond.text}")
finish()
