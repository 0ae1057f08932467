# SPDX-License-Identifier: LGPL-2.1-or-later
# ctest: label = quick
"""Penalties that are too soft: where the springs of contact give way and not the bodies, the run ends with the
key and the remedy; where they take some percents of the force it warns; driven by an interference and by a load,
on one and two ranks."""

from touchstone_test import FACTOR, PENALTY, check, finish, prm, run

KEY = "Contact/Penalty factor"
FIT = {**PENALTY, FACTOR: 0.5}
hard = run("hard", prm / "press_fit.prm", FIT)
check(not hard.summary["warnings"], f"{hard}: {hard.summary['warnings']}")


def force(result):
    return sum(abs(x) for x in result.force("fit"))


for factor, fails, ranks in ((1e-3, False, 1), (1e-5, True, 1), (1e-12, True, 2)):
    soft = run(f"fit_{factor}", prm / "press_fit.prm", {**FIT, KEY: factor}, ranks, fails=fails)
    text = soft.summary["failure"] if fails else " ".join(soft.summary["warnings"])
    check("springs leave a penetration" in text and KEY in text and "'fit'" in text, f"{soft}: {text}")
    lost = 1 - force(soft) / force(hard)
    check((lost > 0.5) == fails and lost > 0.02, f"{soft}: {lost} of the force is lost")

# Under a load the force is there, but the gap is what the springs make of it.
loaded = run("loaded", prm / "patch_test.prm", {**PENALTY, KEY: 1e-5}, fails=True)
check("springs leave a penetration" in loaded.summary["failure"], f"{loaded}: {loaded.summary['failure']}")
exact = run("exact", prm / "patch_test.prm", {KEY: 1e-5})
check([KEY.split("/")[1] in text and "has no effect" in text for text in exact.summary["warnings"]] == [True],
      f"a factor that the method does not use: {exact.summary['warnings']}")
finish()
