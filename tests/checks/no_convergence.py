# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that does not converge says so with exit code and reason, and leaves the last converged state
on disk; and names the law of a material that gives way, ties that contradict each other, bodies that start
to slide, rows that go from one face of the master to another, and parts of bodies that nothing holds."""
# ctest: label = quick

import re
import shutil

from touchstone_test import Run, check, checks, finish, folder, launch, run

for ranks in 1, 2:
    shutil.rmtree(folder / "results", ignore_errors=True)
    done = launch("--output", "results", checks / "no_convergence.prm", ranks=ranks)
    check(done.returncode == 2, f"exit code {done.returncode} instead of 2")
    check(re.search(r"^Not converged: no convergence in 1 Newton iterations: residual .*cut 1 times\)",
                    done.stdout, re.M), f"the reason is missing: {done.stdout}")
    result = Run("no convergence", "results", done.stdout)
    check(result.summary["converged"] is False, "summary.json says that it converged")
    check(result.summary["steps"] == 1, "summary.json must count one step")
    check(result.summary["failure"].startswith("no convergence in 1 Newton iterations"),
          "summary.json does not name the reason")
    result.says("The run did not converge")
    result.says("trying again with a step of 0.5")
    series = (folder / "results/solution.pvd").read_text(encoding="utf-8")
    check('timestep="1"' in series, "no VTU file of the last converged state")
    check(not re.search(r'timestep="(1\.5|2)"', series), "a VTU file of a failed state")
    check(len(result.rows()) == 1, "statistics must have one row")

# The material has no answer: the message names the place and the law. Another law has one.
pressed = checks / "law_gives_way.prm"
failed = run("law_gives_way", pressed, fails=True)
for reason in "body 'press' at (", "by its 'Law' it resists no longer":
    failed.says(reason)
run("law_holds", pressed, {"Body press/Material/Law": "neo-Hookean"})
# Conditions that contradict each other, and the remedy.
driven = checks / "tied_driven_nodes.prm"
failed = run("tied_driven_nodes", driven, fails=True)
for reason in "supports hold slave nodes of 'joint'", "exchange slave and master":
    failed.says(reason)
joint = "Contact pair joint"
run("tied_exchanged", driven, {f"{joint}/Slave body": "outer", f"{joint}/Slave boundaries": "inner",
                               f"{joint}/Master body": "inner", f"{joint}/Master boundaries": "outer"})
# A body that its load makes slide: how it moves, what that can mean, and the remedy, in summary.json too.
failed = run("starts_to_slide", checks / "starts_to_slide.prm", fails=True)
for reason in ("'up' has moved by", " in x on average in this step", "starts to slide as a whole",
               "'Time integration/Scheme = newmark'"):
    check(reason in failed.summary["failure"], f"summary.json does not say \"{reason}\"")
# All nine nodes go one face on in the first iteration of the second step, and the fifth is not the last: how many have, and
# where, on any number of ranks. Rows that change from open to active or back are others.
for ranks in 1, 2:
    failed = run(f"next_face_{ranks}", checks / "block_one_face_on.prm", ranks=ranks, fails=True)
    for reason in ("0 contact rows changed, 9 went from a face, edge or vertex of the master to another one",
                   "rows of pair 'c' that touch now one thing and then another, one of them at (0.4, 0.4, 0) of body 'up'"):
        check(reason in failed.summary["failure"], f"{failed}: {failed.summary['failure']}")
# A part of a body that supports do not hold while others are: its place, and the remedy.
failed = run("loose_copies", checks / "loose_copies.prm", fails=True)
for reason in "the part of body 'block' between (0, 0, 1.5) and (1, 1, 2.5)", "a body of its own":
    failed.says(reason)
finish()
