# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steps that are cut. All steps of the input end where they do without cuts, so that turning points
of the load are met, and a run that has cut steps gives what one gives that has these steps from the
start: nothing of the attempts that failed is left, whatever the body, the contact and the scheme."""

import shutil

from touchstone_test import (AUGMENTED, CG, DEGREE, MULTIPLIERS, Run, below, check, checks,
                             fail, finish, launch, run, settings_options)

SCENE = checks / "cut_steps.prm"
HEAD = SCENE.read_text(encoding="utf-8").split("subsection Load stepping\n")[0]
PLASTIC = {"Body block/Material/Law": "small-strain von Mises",
           "Body block/Material/Plasticity/Hardening": "linear",
           "Body block/Material/Plasticity/Yield stress": 20,
           "Body block/Material/Plasticity/Hardening modulus": 200}
FINITE = {f"Body {body}/Material/Law": "St. Venant-Kirchhoff" for body in ("base", "block")}
POINTWISE, AVERAGED = ({"Contact pair contact/Pairing": name} for name in ("pointwise", "averaged"))
CASES = {
    "frictionless": {"Contact pair contact/Behaviour": "frictionless", **FINITE, **POINTWISE},
    "multipliers": {**AVERAGED, **MULTIPLIERS},
    "augmented": {**POINTWISE, **AUGMENTED},
    "outer": {**AVERAGED, **AUGMENTED, "Contact/Augmentation": "outer"},
    "regularised": {**POINTWISE, "Contact/Friction": "regularised", **CG},
    "plastic": {**AVERAGED, **PLASTIC, DEGREE: 2},
    "plastic_augmented": {**POINTWISE, **PLASTIC, **AUGMENTED, **FINITE,
                          "Body block/Material/Law": "finite-strain von Mises"},
    "impacts": {"Time integration/Scheme": "generalized_alpha", **FINITE},
}


def with_cuts(case, settings):
    """A run whose Newton iterations are limited such that its hardest steps fail, but not so much
    that it ends."""
    most = max(run(f"{case}_uncut", SCENE, settings).column("Newton iterations"))
    for limit in range(int(most) - 1, 1, -1):
        name = f"{case}_cut"
        shutil.rmtree(name, ignore_errors=True)
        done = launch("--results-only", "--output", name, *settings_options(
            {**settings, "Output/VTU interval": 0, "Newton/Maximum iterations": limit}), SCENE)
        result = Run(name, name, done.stdout, done.returncode)
        if done.returncode == 0 and result.cuts() > 0:
            return result
    return None


def prescribed(path, times):
    """The scene with a phase of one step up to each of these times."""
    names = [f"to {i}" for i in range(len(times))]
    lines = [f"  set Phases = {', '.join(names)}"]
    for name, time in zip(names, times):
        lines += [f"  subsection Phase {name}", f"    set End time = {time!r}", "  end"]
    path.write_text(HEAD + "\n".join(["subsection Load stepping", *lines, "end", ""]),
                    encoding="utf-8")
    return path


for case, settings in CASES.items():
    cut = with_cuts(case, settings)
    if cut is None:
        fail(f"{case}: no limit of Newton iterations cuts a step")
        continue
    times = [row["time"] for row in cut.rows() if row["time"] > 0]
    for time in 0.5, 1, 1.5, 2:
        check(any(abs(t - time) < 1e-9 for t in times), f"{case}: no step ends at {time}: {times}")
    same = run(f"{case}_prescribed", prescribed(cut.folder / "prescribed.prm", times), settings)
    check(same.cuts() == 0, f"{case}: steps are cut again")
    names = [name for name in cut.rows()[0] if "force" in name or "moment" in name or
             "reaction" in name or "energy" in name]
    check(len(names) >= 6, f"{case}: hardly anything to compare")
    size = max(abs(row[name]) for row in cut.rows() for name in names)
    difference = max(abs(a[name] - b[name]) for a, b in zip(cut.rows(), same.rows())
                     for name in names)
    # Attempts after a failure begin at the committed state and not at a guess: what is below the
    # tolerance of Newton's method differs.
    below(f"{case}, {len(times)} steps, cut or prescribed", difference / size, 1e-7)
finish()
