# SPDX-License-Identifier: LGPL-2.1-or-later
"""What must hold between runs of the same scene."""

from .geometry import norm
from .invariants import Finding, largest_force

# Forces relative to the largest of the run.
EXACT = 1e-6
# Frictionless elastic scenes do not depend on the steps; others converge with them.
STEPS = {"exact": 1e-5, "path": 0.1}
# What the program says where forces are carried by a node or two of a mesh that cannot resolve them. A body on one
# node balances in several ways, and with friction two such nodes have several balances.
COARSE = ("by a factor: refine", "Rows of slave nodes cannot describe this contact: refine")


def path_dependent(scene):
    """Whether the result depends on what was in between."""
    return scene.frictional() or any("Mises" in b.material["Law"] for b in scene.bodies)


def _vectors(scene, result):
    """Forces and moments of the pairs in the original axes and units, by time."""
    force, moment = scene.stress * scene.length ** 2, scene.stress * scene.length ** 3
    table = {}
    for row in result.rows:
        values = {}
        for pair in scene.pairs:
            values[pair.name, "force"] = scene.back(result.force(row, pair.name), unit=force)
            values[pair.name, "moment"] = scene.back(
                result.vector(row, f"{pair.name}: moment"), True, moment)
        table[f"{row['time'] / scene.end_time:.7f}"] = values
    return table


def difference(scene_a, a, scene_b, b):
    """Largest difference of a force or moment at a common time, relative, and where."""
    first, second = _vectors(scene_a, a), _vectors(scene_b, b)
    # Gaps within their tolerance, 1e-8 of a face, make forces of up to 1e-10 of the stiffness; a tenth
    # of that is no difference.
    size = max(largest_force(scene_a, a), 1e-11 / EXACT * scene_a.stiffness())
    size /= scene_a.stress * scene_a.length ** 2
    units = {"force": size, "moment": size * scene_a.size() / scene_a.length}
    worst = (0.0, "")
    for time in sorted(first.keys() & second.keys()):
        for (pair, kind), value in first[time].items():
            other = second[time][pair, kind]
            d = norm([p - q for p, q in zip(value, other)]) / units[kind]
            if not d <= worst[0]:
                worst = (d, f"{kind} of {pair} at {float(time):.3g} of the time")
    return worst


def same_times(a, b):
    """Whether both runs have made the same steps: one that is cut goes another way."""
    return [row["time"] for row in a.rows] == [row["time"] for row in b.rows]


def compare(scene, default, variant_scene, result, variant):
    """Findings from the run with default settings and one of a variant."""
    if not (default.converged() and result.converged()):
        return
    d, where = difference(scene, default, variant_scene, result)
    # A step that is cut is another path.
    same_steps = same_times(default, result) or not path_dependent(scene)
    if variant.bound is not None:
        bound = variant.bound
    elif variant.exact and same_steps:
        bound = EXACT
    else:
        bound = STEPS["path" if path_dependent(scene) else "exact"]
    if not d <= bound:
        said = all(any(words in run.terminal for words in COARSE) for run in (default, result))
        yield Finding("differs, too coarse as it says" if said else f"differs: {variant.name}",
                      f"{where}: {d:.1e}")


def explained_by_steps(scene, default, variant_scene, result, fine_scene, fine):
    """Whether two runs that differ do so because the result depends on the steps: with small
    steps it is as far from the default run, and near to the other one, which has cut its steps."""
    if not fine.converged():
        return False
    d, _ = difference(scene, default, variant_scene, result)
    to_default, _ = difference(scene, default, fine_scene, fine)
    to_variant, _ = difference(fine_scene, fine, variant_scene, result)
    return to_default >= 0.5 * d and to_variant <= 0.5 * d
