# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact and friction where they are hard. Each case must converge without a cut step and obey:
the forces of both sides balance, no penetration, no tension, no traction beyond the friction
cone. Writes a table of what it found to robustness.md, which contrib/robustness_table.sh
prints."""
# ctest: goldens = hard_mu_one, hard_mu_two, hard_wedge, hard_stiffness_ratio
# ctest: goldens = hard_incompressible, hard_coarse_slave, hard_corner, hard_rocking
# ctest: goldens = hard_edge_and_back, hard_edge_on_edge, hard_warped_master, hard_large_step
# ctest: goldens = hard_lift_off, hard_edge_and_back.mpirun=2

import math
import re

from touchstone_test import (AUGMENTED, CG, below, check, finish, folder, golden, run, same,
                             tests)

rows = ["| case | ranks | steps | cut | Newton | forces out of balance | penetration | tension "
        "| beyond the cone |", "|---|---|---|---|---|---|---|---|---|"]


def judge(title, result, master, mu, ranks=1):
    """The pair is called "contact", the body MASTER has no loads but its supports."""
    if not result.summary:
        rows.append(f"| {title} | {ranks} | – | – | not converged | | | | |")
        return
    # Supports of the master carry what the slave is pushed back with.
    force = result.force("contact")
    supports = result.summary["results"]["reactions"][master].values()
    rest = math.hypot(*(f - sum(r[i] for r in supports) for i, f in enumerate(force)))
    load = max(math.hypot(*r) for body in result.summary["results"]["reactions"].values()
               for r in body.values())
    # Where all contact is lost what is left of its force is the tolerance of gaps.
    size = math.hypot(*force)
    balance = rest / ((size if size > 1e-6 * load else load) or 1)
    # Of tractions: the least pressure and the worst excess over the cone, over the largest
    # pressure. VTU files have six digits.
    nodes = result.contact_nodes()
    check(len(nodes) > 3, f"{result}: hardly any contact points")
    scale = max(0, *(n.pressure for n in nodes)) or 1
    tension = max(0, *(-n.pressure for n in nodes)) / scale
    beyond = max(0, *(math.hypot(*n.shear()) - mu * n.pressure for n in nodes)) / scale
    penetration = result.contact("contact", "max_penetration")
    below(f"{title}, {ranks} rank(s), forces out of balance", balance, 1e-9)
    below(f"{title}, {ranks} rank(s), penetration", penetration, 1e-7)
    below(f"{title}, {ranks} rank(s), tension", tension, 1e-6)
    below(f"{title}, {ranks} rank(s), beyond the cone", beyond, 1e-5)
    below(f"{title}, {ranks} rank(s), steps cut", result.cuts(), 0.5)
    rows.append(f"| {title} | {ranks} | {len(result.rows())} | {result.cuts():.0f} | "
                f"{result.iterations():.0f} | {balance:.0e} | {penetration:.0e} | {tension:.0e} | "
                f"{beyond:.0e} |")


pair = "Contact pair contact"
judge("coefficient 1", golden("hard_mu_one"), "base", 1)
judge("coefficient 2", golden("hard_mu_two"), "base", 2)
judge("wedge just below self-locking", golden("hard_wedge"), "incline", 0.27)
judge("stiffness ratio 1e6", golden("hard_stiffness_ratio"), "base", 0.3)
judge("both nearly incompressible", golden("hard_incompressible"), "base", 0.3)
judge("slave 4 times coarser", golden("hard_coarse_slave"), "base", 0.3)
judge("slave 4 times finer",
      run("finer_slave", tests / "hard_coarse_slave.prm",
          {f"{pair}/Slave body": "base", f"{pair}/Slave boundaries": "top",
           f"{pair}/Master body": "block", f"{pair}/Master boundaries": "bottom"}, vtu=100000),
      "block", 0.3)
judge("first contact at a corner", golden("hard_corner"), "base", 0.3)
judge("opening and closing in one step", golden("hard_rocking"), "base", 0.3)
edge = golden("hard_edge_and_back")
judge("off the edge and back", edge, "base", 0.3)
judge("slave edge along a master edge", golden("hard_edge_on_edge"), "base", 0.3)
judge("warped master faces", golden("hard_warped_master"), "base", 0.3)
judge("ten times too large a step", golden("hard_large_step"), "base", 0.3)
judge("all contact lost", golden("hard_lift_off"), "base", 0.3)
for ranks in 1, 2:
    judge("friction lagged beside stiff springs",
          run(f"lagged_{ranks}", tests / "hard_warped_master.prm",
              {**CG, **AUGMENTED, f"{pair}/Pairing": "pointwise"}, ranks, vtu=100000),
          "base", 0.3, ranks)
for ranks in 2, 3:
    other = golden("hard_edge_and_back", 2) if ranks == 2 else \
        run(f"edge_{ranks}", tests / "hard_edge_and_back.prm", None, ranks, vtu=100000)
    judge("off the edge and back", other, "base", 0.3, ranks)
    same(edge, other, 1e-8)

# Beyond self-locking nothing holds the wedge, and the program must say so.
beyond_locking = run("wedge_beyond", tests / "hard_wedge.prm",
                     {f"{pair}/Friction/Coefficient": 0.266}, fails=True)
check(re.search("^Not converged: ", beyond_locking.text, re.M),
      f"the reason is missing: {beyond_locking.text}")
rows.append("| wedge just beyond self-locking | 1 | – | – | refused, as it must | | | | |")

(folder / "robustness.md").write_text("\n".join(rows) + "\n", encoding="utf-8")
print("\n".join(rows))
finish()
