# SPDX-License-Identifier: LGPL-2.1-or-later
"""What contrib/scoreboard rests on: distances of fields, curves and choices of the best run on
falsified results, and the same problem in GetFEM where it is installed."""
# ctest: label = nightly

import json
import sys

from touchstone_test import check, finish, folder, program, source

if sys.version_info < (3, 11):
    print("skipped: contrib/scoreboard needs Python 3.11")
    sys.exit(0)

# pylint: disable=wrong-import-position,import-error
from benchmarking import campaign, exported, fields, runner, scoreboard, table, with_getfem


def surface(degree, xs):
    """Faces and nodes of a strip from y = 0 to 1 with the given corners along x."""
    at = [a + (b - a) * k / degree for a, b in zip(xs, xs[1:]) for k in range(degree)] + [xs[-1]]
    rows = degree + 1
    nodes = [(x, j / degree, 0.0) for j in range(rows) for x in at]
    return [[first * degree + i + len(at) * j for j in range(rows) for i in range(rows)]
            for first in range(len(xs) - 1)], nodes


# A linear field is exact with all kinds of faces; an error of 1 % is one of 1 %.
for degree, kind in ((1, "all"), (2, "all"), (2, "corners"), (2, "eight")):
    faces, nodes = surface(degree, [0, 0.1, 0.3, 0.35, 1])
    known = {n: 2 + x - y for n, (x, y, _) in enumerate(nodes)}

    def error(values, faces=faces, nodes=nodes, degree=degree, kind=kind):
        return fields.Field(faces, nodes, degree, values, kind).relative_error(
            lambda x: 2 + x[0] - x[1])

    check(error(known) < 1e-14, f"a linear field, degree {degree}, {kind}: {error(known)}")
    off = error({n: 1.01 * v for n, v in known.items()})
    check(abs(off - 0.01) < 1e-12, f"a field off by 1 %, degree {degree}, {kind}: {off}")
    check(abs(error({}) - 1) < 1e-12, f"no traction, degree {degree}, {kind}")

# Means around the nodes of a graded mesh are not the values there; recovered ones nearly are.
faces, nodes = surface(1, [0, 1, 3, 7, 15])
means = fields.Field(faces, nodes, 1, {n: x for n, (x, _, _) in enumerate(nodes)})
sums, areas = {}, {}
for x, area, shapes, members in means.points():
    for s, n in zip(shapes, members):
        sums[n], areas[n] = sums.get(n, 0.0) + area * s * x[0], areas.get(n, 0.0) + area * s
means.values = {n: sums[n] / areas[n] for n in sums}
before, after = (f.relative_error(lambda x: x[0]) for f in (means, means.recovered()))
check(0 < after < 0.6 * before, f"recovery: {before} becomes {after}")

# Curves.
curve = campaign.Curve("body/far", 2, [(0, 1.0), (1, 2.0), (2, 3.0)])
check(curve.error([(0, 1.0), (2, 3.0)]) < 1e-14, "a curve is linear between its times")
check(abs(curve.error([(0, 1.02), (1, 2.04), (2, 3.06)]) - 0.02) < 1e-12, "a curve off by 2 %")
try:
    curve.error([(0, 1.0), (1.5, 2.5)])
    check(False, "a curve that ends too early is accepted")
except ValueError as reason:
    check("time 2" in str(reason), f"message: {reason}")

# The best run; one that failed on a finer mesh says nothing, one that is worse does.
rows = [{"contender": "Touchstone, a", "program": "touchstone", "mesh": str(n), "nodes": n,
         "status": "converged", "e": e, "user_seconds": n} for n, e in ((1, 0.02), (2, 0.03))]
failed = rows[1] | {"status": "failed", "reason": "gave up", "nodes": 9, "e": ""}
check(table.best(rows + [failed], "e", 0.05)["nodes"] == 1, "a failed run on a finer mesh")
check(table.best(rows, "e", 0.025) is None, "a worse run on a finer mesh")
check("1.00 s" in scoreboard.cell(rows, "e", 0.05) and "a, mesh 1" in
      scoreboard.cell(rows, "e", 0.05), "the cell of the best run")
check(scoreboard.cell(rows, "e", 0.01) == "– (2 % in 1.0 s)", "the cell without a run")
check(scoreboard.cell([failed], "e", 0.05) == "no result: gave up", "the cell of a failure")

# The shipped campaigns can be read.
for path in sorted((source / "contrib/benchmark.d/scoreboard").glob("*.toml")):
    for quick in (False, True):
        check(campaign.load(path, source, quick).cases, f"{path.name} has no runs")

if not with_getfem.installed():
    print("skipped: python3-getfem is not installed")
    finish()
    sys.exit(0)

TINY = """title = "Tiny"
scene = "prm/press_fit.prm"
errors = ["contact_pressure_mean", "contact_pressure_max_deviation", "pull"]
repeat = 1
time_limit = 60
# Pressure times radius times depth: the pull at the cut.
[quantities.pull]
path = ["results", "reactions", "outer tube", "second cut", 0]
exact = -13.527
[meshes.6]
"Body inner tube/Geometry/Cells" = "2, 6, 1"
"Body outer tube/Geometry/Cells" = "2, 6, 1"
[[contender]]
name = "ours"
[[contender]]
name = "GetFEM"
program = "getfem"
degrees = [1, 2]
slidings = ["large", "small"]
"""
(folder / "tiny.toml").write_text(TINY, encoding="utf-8")
rows = runner.run(campaign.load(folder / "tiny.toml", source), program, folder / "board")
ours = rows[0]
for row in rows:
    # Degree 1 does not know the arc between the nodes: 2 % of this interference.
    for name, bound in (("contact_pressure_mean", 0.02), ("contact_pressure_max_deviation", 0.03),
                        ("pull", 0.03)):
        check(row["status"] == "converged" and row[name] < bound,
              f"{row['contender']}: {name} {row[name]} {row['reason']}")
check(rows[1]["nodes"] == ours["nodes"] and rows[1]["newton"] > 0, "nodes and iterations")

# Falsified answers: another sign, another force, a part of the pressure.
own = folder / "board/tiny/runs/GetFEM_degree_2_small_6"
answer = json.loads((own / "result.json").read_text(encoding="utf-8"))
model = json.loads((own / "model.json").read_text(encoding="utf-8"))
good = with_getfem.errors(model, answer, 1)["contact_pressure_mean"]
for factor, expected in ((-1.0, 1.0), (1.1, 0.1), (0.0, 1.0)):
    wrong = answer | {"contact": [[n, *(factor * v for v in value)]
                                  for n, *value in answer["contact"]]}
    found = with_getfem.errors(model, wrong, 1)["contact_pressure_max_deviation"]
    check(found > 0.8 * expected > good, f"pressures times {factor} have the error {found}")
try:
    exported.only_pair(model | {"bodies": [model["bodies"][0] | {"law": "Gent"}]}, with_getfem.LAWS)
    check(False, "another law is accepted")
except exported.ModelError as reason:
    check("'Gent'" in str(reason), f"message: {reason}")
finish()
