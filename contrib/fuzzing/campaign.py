# SPDX-License-Identifier: LGPL-2.1-or-later
"""Variants of scenes, their verdicts, and the table of these."""

import collections
import dataclasses
import random
import re

from . import agreement, generator, invariants, runs, text
from .geometry import NotExpressible


@dataclasses.dataclass(frozen=True)
class Variant:
    """Another way to the same result."""
    name: str
    settings: tuple = ()
    ranks: int = 1
    change: str = ""  # a method of Scene
    steps: int = 1
    exact: bool = True
    bound: float = None  # of differences, of the largest force, if not that of its kind

    def of(self, scene):
        """The scene to run. @throws NotExpressible"""
        if self.steps > 1:
            return dataclasses.replace(scene, steps=self.steps * scene.steps)
        if self.change == "rescaled":
            return scene.rescaled(1e-3, 1e6)
        return getattr(scene, self.change)() if self.change else scene


DEFAULT = Variant("default")
VARIANTS = (
    Variant("lagrange multipliers", ("Contact/Enforcement=lagrange multipliers",
                                     "Linear solver/Type=MUMPS")),
    Variant("augmented lagrange", ("Contact/Enforcement=augmented lagrange",)),
    Variant("GMRES", ("Linear solver/Type=Belos GMRES",)),
    Variant("CG", ("Linear solver/Type=Belos CG",)),
    Variant("2 ranks", ranks=2),
    Variant("mirrored", change="mirrored"),
    Variant("rotated", change="rotated"),
    Variant("rescaled", change="rescaled"),
    Variant("finer steps", steps=2, exact=False),
    # A step in which nothing moves changes nothing.
    Variant("paused", change="paused", bound=agreement.EXACT),
    # Coarse surfaces that end and those that go on over an edge have rows of their own there.
    Variant("more boundaries", change="with_sides", bound=0.1))
# Of these each scene of a quick campaign is run in one.
QUICK = tuple(variant for variant in VARIANTS if variant.exact and variant.bound is None)


@dataclasses.dataclass
class Verdict:
    """Of a scene."""
    index: int
    title: str
    frictional: bool
    findings: list  # pairs of variant and Finding
    outcomes: dict  # variant: 'converged', or the reason
    seconds: float
    scene: object

    WRONG_IS_NOT = ("not converged", "time limit", "refused", "variant not converged",
                    "differs, too coarse as it says")

    def kinds(self):
        """Kinds of findings, or 'as it must be'."""
        return list(dict.fromkeys(f.kind for _, f in self.findings)) or ["as it must be"]

    def wrong(self):
        return [f for _, f in self.findings if f.kind not in self.WRONG_IS_NOT]


def outcome(result, default):
    """A finding if the run has no result."""
    if result.timed_out:
        return invariants.Finding("time limit", f"after {result.seconds:.0f} s")
    if result.exit_code == 1:
        return invariants.Finding("refused", result.reason())
    if result.exit_code == 2:
        return invariants.Finding("not converged" if default else "variant not converged",
                                  result.reason())
    return None


SMALL_STEPS = 16  # times as many as the scene has


def with_times_of(scene, result):
    """The scene with the steps that a run of it has made."""
    return dataclasses.replace(scene, ends=tuple(row["time"] for row in result.rows
                                                 if row["time"] > 0))


def made_steps(result):
    """The number of steps of a run."""
    return sum(row["time"] > 0 for row in result.rows)


def compare(scene, default, own, result, variant, program, folder, time_limit):
    """Findings from a run with default settings and one of a variant. Where friction or
    plasticity makes the result depend on the steps and a run has cut some of them, each is run
    with the steps of the other; if both cut these, too, runs with small steps decide."""
    found = list(agreement.compare(scene, default, own, result, variant))
    if variant.change == "paused":
        # Steps that are cut or divided take another path, and end at other times.
        return found if made_steps(default) == scene.steps and made_steps(result) == scene.steps + 1 else []
    if not found or not agreement.path_dependent(scene) or agreement.same_times(default, result):
        return found
    if variant.exact:
        of_variant = with_times_of(own, default)
        again = runs.run(program, of_variant, runs.folder_of(folder, variant.name + ", same steps"),
                         variant.settings, variant.ranks, time_limit)
        if again.converged() and agreement.same_times(default, again):
            return list(agreement.compare(scene, default, of_variant, again, variant))
        of_default = with_times_of(scene, result)
        again = runs.run(program, of_default, runs.folder_of(folder, "default, same steps"), (), 1,
                         time_limit)
        if again.converged() and agreement.same_times(again, result):
            return list(agreement.compare(of_default, again, own, result, variant))
    fine = dataclasses.replace(scene, steps=SMALL_STEPS * scene.steps)
    reference = runs.run(program, fine, runs.folder_of(folder, "small steps"), (), 1,
                         SMALL_STEPS * time_limit)
    if agreement.explained_by_steps(scene, default, own, result, fine, reference):
        return []
    if variant.exact:
        fine_variant = dataclasses.replace(own, steps=SMALL_STEPS * own.steps)
        again = runs.run(program, fine_variant, runs.folder_of(folder, variant.name + ", small steps"),
                         variant.settings, variant.ranks, SMALL_STEPS * time_limit)
        if reference.converged() and again.converged() and agreement.same_times(reference, again):
            return list(agreement.compare(fine, reference, fine_variant, again, variant))
    return found


def judge_scene(scene, index, variants, program, folder, time_limit):
    """Run a scene in all variants."""
    verdict = Verdict(index, scene.title, scene.frictional(), [], {}, 0.0, scene)
    default = None
    for variant in (DEFAULT,) + tuple(variants):
        try:
            own = variant.of(scene)
        except NotExpressible:
            continue
        result = runs.run(program, own, runs.folder_of(folder, variant.name), variant.settings,
                          variant.ranks, time_limit)
        verdict.seconds += result.seconds
        verdict.outcomes[variant.name] = "converged" if result.converged() else result.reason()
        found = invariants.judge(own, result)
        end = outcome(result, variant is DEFAULT)
        if default is None:
            default = result
            found += [end] if end else []
        elif default.converged():
            found += [end] if end else []
            found += compare(scene, default, own, result, variant, program, folder, time_limit)
        verdict.findings += [(variant.name, f) for f in found]
    return verdict


def variants_by_name(names, error):
    """The variants with these names, separated by commas; None for no names."""
    if names is None:
        return None
    known = {variant.name: variant for variant in VARIANTS}
    unknown = [name for name in names.split(",") if name not in known]
    if unknown:
        error(f"there is no variant '{unknown[0]}'; there are {', '.join(known)}")
    return tuple(known[name] for name in names.split(","))


def chosen_variants(quick, seed, index):
    """All of them, or one for each scene in turn."""
    if not quick:
        return VARIANTS
    return (random.Random(f"variant {seed}/{index}").choice(QUICK),)


def keep(verdict, seed, folder):
    """A scene with findings, and what was found in its head."""
    head = [f"Scene {verdict.index} of seed {seed}: {verdict.title}"
            f"{', with friction' if verdict.frictional else ''}"]
    head += ["Converged: " + (", ".join(n for n, o in verdict.outcomes.items()
                                        if o == "converged") or "none") +
             " of " + ", ".join(verdict.outcomes)]
    head += [f"{variant}: {f.kind}: {f.text}" for variant, f in verdict.findings]
    kind = re.sub(r"[^a-z0-9]+", "_", verdict.kinds()[0].lower())
    path = folder / f"{kind}_{seed}_{verdict.index}.prm"
    path.write_text(text.write(verdict.scene, head), encoding="utf-8")
    return path


def run(numbers, seed, quick, program, folder, time_limit, report, variants=None):
    """Judge the scenes with these numbers, in @p variants if they are given. @return verdicts"""
    verdicts = []
    for index in numbers:
        scene = generator.scene(seed, index)
        chosen = chosen_variants(quick, seed, index) if variants is None else variants
        verdict = judge_scene(scene, index, chosen, program, folder / f"scene_{index}", time_limit)
        verdicts.append(verdict)
        report(verdict)
    return verdicts


def table(verdicts):
    """Counts by kind of finding, without and with friction, in Markdown."""
    counts = collections.Counter((kind, v.frictional) for v in verdicts for kind in v.kinds())
    default = [v for v in verdicts if v.outcomes.get("default") == "converged"]
    lines = ["| verdict | frictionless | friction | scenes |", "|---|---|---|---|"]
    for kind in sorted({kind for kind, _ in counts}):
        numbers = [[v.index for v in verdicts if kind in v.kinds() and v.frictional == f]
                   for f in (False, True)]
        shown = ", ".join(map(str, sorted(sum(numbers, []))[:12]))
        lines.append(f"| {kind} | {len(numbers[0])} | {len(numbers[1])} | {shown} |")
    lines.append("")
    for frictional in (False, True):
        own = [v for v in verdicts if v.frictional == frictional]
        lines.append(f"{'With friction' if frictional else 'Frictionless'}: {len(own)} scenes, "
                     f"{sum(v in default for v in own)} converge with default settings, "
                     f"{sum(bool(v.wrong()) for v in own)} are wrong.")
    return "\n".join(lines) + "\n"
