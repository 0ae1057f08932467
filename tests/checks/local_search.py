# SPDX-License-Identifier: LGPL-2.1-or-later
"""The local searches beside the projection, against it on the same meshes: soft balls and bars that
collide, plates that slide, a press fit (doc/theory.md 3.4, 3.5; table of doc/which_method.md)."""


from touchstone_test import (STEPS, below, check, checks, contact_gives, finish, folder, launch, prm, relative, run,
                             same, settings_options, stopped_and_resumed)

BALLS = "pinball", "splitting pinball"
OTHERS = ("inside-outside", *BALLS)


def peak(result):
    """Largest force of the impact, of the whole balls."""
    return 4 * result.value("motion", "impacts", "impact", "peak_force")


def text_of(path):
    """Of the table of a run."""
    return (path / "statistics").read_text(encoding="utf-8")


def same_bits(name, one, scene, settings):
    """On two ranks, and after a restart from the checkpoint before the last."""
    two = run(f"{one}_2", scene, settings, ranks=2)
    check(text_of(two.folder) == text_of(one.folder), f"{name}: other results on 2 ranks")
    again = stopped_and_resumed(str(one), scene, settings, every=2)
    check(text_of(again.folder) == text_of(one.folder), f"{name}: other results after a restart")


# Two soft balls up to the largest force: 3 % and 10 % from the projection. A coarse mesh will do for
# the line along the slave normal; balls in cells need some across the contact.
scene = checks / "soft_balls.prm"
coarse = {name: run(f"balls_{name}", scene, {"Contact pair impact/Pairing": name})
          for name in ("pointwise", "inside-outside")}
below("soft balls, inside-outside", relative(peak(coarse["inside-outside"]),
                                             peak(coarse["pointwise"])), 0.03)
below("soft balls, time of contact", relative(
    *(sum(force > 0 for force in coarse[name].column("impact: force z"))
      for name in ("inside-outside", "pointwise"))), 0.03)
contact_gives(coarse["inside-outside"], 1e-11)
FINE = {"Discretisation/Refinement factor": 2, "Load stepping/End time": 2.4e-4, STEPS: 24}
fine = {name: run(f"fine_balls_{name}", scene, {"Contact pair impact/Pairing": name, **FINE})
        for name in ("pointwise", "pinball")}
below("soft balls, pinball", relative(peak(fine["pinball"]), peak(fine["pointwise"])), 0.1)
contact_gives(fine["pinball"], 1e-11)

# Two bars with faces that do not match: the stress is half the speed, whatever the pairing.
for name in OTHERS:
    bars = run(f"bars_{name}", checks / "explicit_bars.prm",
               {"Contact pair impact/Pairing": name, "Body left/Geometry/Cells": "20, 3, 3",
                "Body right/Geometry/Cells": "20, 2, 2", "Time integration/Courant factor": 0.9,
                "Load stepping/End time": 54, STEPS: 60})
    force = [abs(value) for value in bars.column("impact: force x")]
    pressed = [k for k, value in enumerate(force) if value > 0]
    check(pressed == list(range(pressed[0], pressed[-1] + 1)), f"{bars}: contact opens twice")
    plateau = force[pressed[0] + 5:pressed[-1] - 5]
    below(f"{bars}, stress", relative(sum(plateau) / len(plateau), 0.005), 0.003)
    below(f"{bars}, speed left", abs(bars.value("motion", "velocities", "left", 0)) / 0.01, 0.05)

# A plate slides on another one: friction is mu times the normal force, momentum and its moment are
# exact, and so are the bits on two ranks, also with springs and after a restart.
scene = checks / "sliding_plates.prm"
for name in OTHERS:
    setting = {"Contact pair pair/Pairing": name}
    plates = run(f"plates_{name}", scene, setting)
    impulse = [plates.value("motion", "impacts", "pair", "impulse", d) for d in range(3)]
    below(f"{plates}, friction", relative(-impulse[0], 0.3 * impulse[2]), 0.01)
    contact_gives(plates, 1e-12)
    rows = plates.rows()
    for title in rows[0]:
        if "momentum" in title:
            below(f"{plates}, {title}", max(row[title] for row in rows) -
                  min(row[title] for row in rows), 1e-15)
    if name != "splitting pinball":
        same_bits(name, plates, scene, setting)
    springs = run(f"springs_{name}", scene, {**setting, "Contact/Enforcement": "soft penalty"})
    check(springs.value("motion", "impacts", "pair", "impulse", 2) > 0.03, f"{springs}: no force")

# A press fit on meshes that do not match: the same with all enforcements and on two ranks, and the
# projection within the error of the mesh.
FIT = {"Body inner tube/Geometry/Cells": "4, 14, 1", "Body outer tube/Geometry/Cells": "4, 12, 1",
       "Contact pair fit/Pairing": "inside-outside"}
fit = run("fit", prm / "press_fit.prm", FIT)
by_projection = run("fit_pointwise", prm / "press_fit.prm",
                    {**FIT, "Contact pair fit/Pairing": "pointwise"})
below("fit, pressure", abs(fit.error("contact_pressure_mean")), 2e-3)
below("fit, pressure by projection", abs(fit.error("contact_pressure_mean") -
                                         by_projection.error("contact_pressure_mean")), 1e-5)
check(fit.iterations() == by_projection.iterations(), "fit: other iterations than by projection")
same(fit, run("fit_2", prm / "press_fit.prm", FIT, ranks=2), 1e-9)
for name in "lagrange multipliers", "augmented lagrange":
    same(fit, run(f"fit_{name}", prm / "press_fit.prm", {**FIT, "Contact/Enforcement": name}), 1e-6)

# What balls are not for, with section, key and remedy, before anything is computed.
PAIR = "Contact pair pair/"
for what, settings, text in (
        ("statics", {"Time integration/Scheme": "static"}, "is for explicit dynamics"),
        ("tied", {PAIR + "Behaviour": "tied"}, "joins slave nodes"),
        ("small sliding", {PAIR + "Sliding": "small"}, "keeps the partners"),
        ("smoothed", {PAIR + "Master normal": "smoothed"}, "smooths the faces"),
        ("splittings", {PAIR + "Splittings": 3}, "Splittings")):
    refused = launch("--results-only", "--output", "refused",
                     *settings_options({PAIR + "Pairing": "splitting pinball", **settings}), scene)
    check(refused.returncode == 1 and text in refused.stdout and "Remedy: " in refused.stdout,
          f"{what}: not refused, or not for this reason:\n{refused.stdout[-600:]}")
# A quarter of a model is a quarter of the whole: normals at nodes on planes of symmetry are means over
# all of the body, not over the part that is there. Averaged rows miss a sliver of the other half.
scene = checks / "quarter_of_caps.prm"
WHOLE = {f"Body {body}/{key}": value for body in ("upper", "lower")
         for key, value in (("Symmetry", ""), ("Geometry/Part", "whole"))}
for name, setting, allowed in (("inside-outside", {"Pairing": "inside-outside"}, 1e-10),
                               ("smoothed", {"Pairing": "pointwise", "Master normal": "smoothed"}, 1e-10),
                               ("averaged", {"Pairing": "averaged"}, 1e-5)):
    setting = {f"Contact pair pair/{key}": value for key, value in setting.items()}
    whole = run(f"whole_{name}", scene, {**setting, **WHOLE}).force("pair")[2]
    for ranks in (1, 2) if name == "smoothed" else (1,):
        quarter = run(f"quarter_{name}_{ranks}", scene, setting, ranks).force("pair")[2]
        below(f"quarter, {name}, {ranks} ranks", relative(4 * quarter, whole), allowed)
finish()
