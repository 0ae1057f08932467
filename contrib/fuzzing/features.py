# SPDX-License-Identifier: LGPL-2.1-or-later
"""Features that any scene may have, in random combinations, and what must hold between runs."""

import dataclasses
import math
import random
import re

from benchmarking import processes

from . import runs

IMPLICIT = ("newmark", "hht", "generalized_alpha", "contact_stabilized")
# What two exact ways may differ by, relative to the largest force or energy of a run.
EXACT = 1e-5
# Columns that count, time or depend on where a step was cut.
COUNTS = re.compile(r"iterations|nodes|area|moment|momentum|penetration|rows|cuts|dofs|cells|error|"
                    r"^step$|gap|seconds|cycles")


def names(text, key):
    """What a list at the top of a scene file names."""
    found = re.search(rf"^\s*set\s+{key}\s*=\s*(.*)$", text, re.M)
    return [name.strip() for name in found[1].split(",") if name.strip()] if found else []


def _of_run(rng, young, bodies):
    density = [f"Body {b}/Material/Density={young * rng.choice((1e-4, 1e-3, 1e-2)):g}"
               for b in bodies]
    contact = rng.choice(("elimination", "lagrange multipliers", "augmented lagrange", "penalty"))
    return rng.choice((
        [f"Contact/Enforcement={contact}"],
        ["Contact/Enforcement=augmented lagrange", "Contact/Augmentation=outer"],
        [f"Contact/Linearisation={rng.choice(('frozen', 'consistent'))}"],
        ["Discretisation/Degree=2"],
        [f"Discretisation/Partitioner={rng.choice(('p4est', 'METIS', 'coordinates'))}"],
        [f"Refinement/Estimator={rng.choice(('Kelly', 'recovered stress'))}", "Refinement/Cycles=1",
         f"Refinement/Cycles per step={rng.choice((0, 1))}"],
        [f"Time integration/Scheme={rng.choice(IMPLICIT)}",
         f"Time integration/Mass={rng.choice(('consistent', 'lumped'))}"] + density,
        ["Time integration/Scheme=central_differences",
         f"Load stepping/End time={rng.choice((0.01, 0.1))}"] + density,
        [f"Linear solver/Type={rng.choice(('MUMPS', 'Belos CG', 'Belos GMRES', 'PETSc'))}"],
        [f"Load stepping/Steps={rng.choice((2, 3, 7))}"]))


def _of_body(rng, young, body):
    material = f"Body {body}/Material"
    plastic = [f"{material}/Law={rng.choice(('small', 'finite'))}-strain von Mises",
               f"{material}/Plasticity/Yield stress={young * rng.choice((1e-3, 1e-2)):g}",
               f"{material}/Plasticity/Hardening=linear",
               f"{material}/Plasticity/Hardening modulus={young / 20:g}"]
    return rng.choice((
        plastic,
        [f"{material}/Law={rng.choice(('linear elastic', 'neo-Hookean', 'St. Venant-Kirchhoff'))}"],
        [f"Body {body}/Element={rng.choice(('full', 'b-bar', 'incompatible modes', 'F-bar'))}"],
        [f"{material}/Thermal expansion/Coefficient=1e-5",
         f"{material}/Thermal expansion/Temperature=100*t"],
        [f"Body {body}/Body force z={-young * 1e-5:g}*t"],
        [f"{material}/Poisson ratio={rng.choice((0, 0.45, 0.49))}"]))


def _of_pair(rng, young, pair):
    section = f"Contact pair {pair}"
    return rng.choice((
        [f"{section}/Behaviour=coulomb", f"{section}/Friction/Coefficient=0.3"],
        [f"{section}/Behaviour=tresca", f"{section}/Friction/Shear strength={young * 1e-4:g}"],
        [f"{section}/Behaviour={rng.choice(('frictionless', 'tied'))}"],
        [f"{section}/Pairing={rng.choice(('pointwise', 'averaged'))}"],
        [f"{section}/Initial overlap={rng.choice(('adjust', 'ramp'))}"],
        [f"{section}/Sliding=small"],
        [f"{section}/Contact geometry=faceted"],
        [f"{section}/Master normal={rng.choice(('face', 'smoothed'))}"]))


def settings(rng, text):
    """One to four features of a scene, as "Section/Key=value"."""
    young = re.search(r"Young modulus\s*=\s*([-+.\deE]+)", text)
    young = float(young[1]) if young else 1e3
    bodies, pairs = names(text, "Bodies"), names(text, "Contact pairs")
    result = {}
    for _ in range(rng.choice((1, 2, 2, 3, 3, 4))):
        kind = rng.random()
        if kind < 0.4 and pairs:
            more = _of_pair(rng, young, rng.choice(pairs))
        elif kind < 0.6 and bodies:
            more = _of_body(rng, young, rng.choice(bodies))
        else:
            more = _of_run(rng, young, bodies)
        result.update(setting.split("=", 1) for setting in more)
    return [f"{key}={value}" for key, value in result.items()]


@dataclasses.dataclass
class Outcome:
    """Of one run."""
    usage: processes.Usage
    said: str
    rows: list


def execute(program, scene, folder, values, ranks=1, options=(), time_limit=30):
    """One run of a scene file with further settings."""
    folder.mkdir(parents=True, exist_ok=True)
    command = (["mpirun", "-n", str(ranks)] if ranks > 1 else []) + \
        [str(program), str(scene), "--output", str(folder), *options]
    for value in ("Output/VTU interval=0", *values):
        command += ["--set", value]
    usage = processes.run(command, folder, folder / "terminal", time_limit)
    said = (folder / "terminal").read_text(encoding="utf-8", errors="replace")
    return Outcome(usage, said, runs.statistics(folder / "statistics"))


def fault(outcome):
    """What no run may do, whatever its scene, or nothing."""
    code = outcome.usage.exit_code
    if outcome.usage.timed_out:
        return ""
    if code not in (0, 1, 2):
        return f"exit code {code}"
    if runs.RAW.search(outcome.said):
        return f"text of a library: {runs.RAW.search(outcome.said)[0]}"
    if code == 1 and "Remedy: " not in outcome.said:
        return "no remedy"
    if any(not math.isfinite(value) for row in outcome.rows for value in row.values()):
        return "not a number in 'statistics'"
    return ""


def _scale(name, rows):
    """The largest value of the kind of a column."""
    kind = re.compile("energy" if name.startswith("energy") else
                      "force|reaction" if re.search("force|reaction", name) else re.escape(name))
    return max((abs(row[other]) for row in rows for other in row if kind.search(other)), default=0.)


def difference(a, b):
    """Largest difference of forces and energies at the end, relative, and where."""
    if [row["time"] for row in a.rows] != [row["time"] for row in b.rows]:
        return 0., ""  # a step that was cut is another path
    worst = (0., "")
    last = a.rows[-1] if a.rows else {}
    compared = {name: value for name, value in last.items()
                if re.search("force|reaction|energy", name) and not COUNTS.search(name)}
    # Springs and bonds may carry everything: then reactions are round-off.
    nothing = 1e-11 * max(map(abs, compared.values()), default=0.)
    for name, value in compared.items():
        size = _scale(name, a.rows)
        if size > max(nothing, 1e-12) and abs(value - b.rows[-1].get(name, math.inf)) / size > worst[0]:
            worst = (abs(value - b.rows[-1][name]) / size, name)
    return worst


def other_ways(rng, text, values):
    """Names, settings, ranks of runs that must have the same result."""
    everything = text + "\n".join(values)
    yield "2 ranks", [], 2
    if re.search("central_differences|penalty|regularised|multipliers", everything):
        return
    yield rng.choice((
        ("multipliers", ["Contact/Enforcement=lagrange multipliers", "Linear solver/Type=MUMPS"], 1),
        ("elimination, GMRES", ["Contact/Enforcement=elimination", "Linear solver/Type=Belos GMRES"], 1),
        ("augmented Lagrange", ["Contact/Enforcement=augmented lagrange"], 1)))


def judge(program, scene, folder, seed, index, time_limit):
    """Run a scene with random features. @return its settings, what came of it, and faults"""
    rng = random.Random(f"{seed}/{index}/{scene.name}")
    text = scene.read_text(encoding="utf-8")
    values = settings(rng, text)
    first = execute(program, scene, folder / "first", values, time_limit=time_limit)
    faults = [fault(first)] if fault(first) else []
    if first.usage.timed_out:
        return values, "time limit", faults
    if first.usage.exit_code != 0:
        last = [line for line in first.said.splitlines() if re.search("Not converged|Input error", line)]
        return values, (last or [f"exit code {first.usage.exit_code}"])[-1], faults
    for name, more, ranks in other_ways(rng, text, values):
        other = execute(program, scene, folder / name.replace(" ", "_"), values + more, ranks,
                        time_limit=4 * time_limit)
        if fault(other):
            faults.append(f"{name}: {fault(other)}")
        elif other.usage.exit_code == 0 and not other.usage.timed_out:
            size, where = difference(first, other)
            if size > EXACT:
                faults.append(f"{name}: differs by {size:.1e}, {where}")
        elif ranks > 1 and not other.usage.timed_out:
            faults.append(f"{name}: exit code {other.usage.exit_code}")
    return values, "converged", faults
