# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that does not converge says so with exit code and reason, and leaves the last converged state
on disk."""
# ctest: label = quick

import re
import shutil

from touchstone_test import Run, check, checks, finish, folder, launch

for ranks in 1, 2:
    shutil.rmtree(folder / "results", ignore_errors=True)
    done = launch("--output", "results", checks / "no_convergence.prm", ranks=ranks)
    check(done.returncode == 2, f"exit code {done.returncode} instead of 2")
    check(re.search(r"^Not converged: no convergence in 1 Newton iterations: residual .*cut 1 times\)",
                    done.stdout, re.M), f"the reason is missing: {done.stdout}")
    run = Run("no convergence", "results", done.stdout)
    check(run.summary["converged"] is False, "summary.json says that it converged")
    check(run.summary["steps"] == 1, "summary.json must count one step")
    check(run.summary["failure"].startswith("no convergence in 1 Newton iterations"),
          "summary.json does not name the reason")
    run.says("The run did not converge")
    run.says("trying again with a step of 0.5")
    series = (folder / "results/solution.pvd").read_text(encoding="utf-8")
    check('timestep="1"' in series, "no VTU file of the last converged state")
    check(not re.search(r'timestep="(1\.5|2)"', series), "a VTU file of a failed state")
    check(len(run.rows()) == 1, "statistics must have one row")
finish()
