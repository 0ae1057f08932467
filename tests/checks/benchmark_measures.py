"""benchmark_measures.py PROJECT MODEL.json POINTS SUMMARY.json: do the measures of the
harness (contrib/benchmarking), taken from the contact picture of a run, agree with the
errors that the program itself has in its summary? POINTS is what contact_points.pl prints."""

import json
import math
import sys

project, model_file, points_file, summary_file = sys.argv[1:]
sys.path.insert(0, project + "/contrib")
# pylint: disable=wrong-import-position,import-error
from benchmarking import measures, surfaces


with open(model_file, encoding="utf-8") as file:
    model = json.load(file)
with open(summary_file, encoding="utf-8") as file:
    expected = json.load(file)["errors"]
areas = surfaces.node_areas(model["pairs"][0]["slave"], model["nodes"], model["degree"])

points, force = [], [0.0] * 3
with open(points_file, encoding="utf-8") as file:
    for line in file:
        n = [float(word) for word in line.split()]
        # The picture has positions in single precision, and no numbers of nodes.
        node = min(areas, key=lambda m: math.dist(model["nodes"][m], n[:3]))
        area, status = areas.pop(node), n[4]
        points.append(measures.Point(tuple(n[:3]), area, n[6], n[10], status >= 1, status == 2))
        force = [f + area * t for f, t in zip(force, n[10:13])]
if areas:
    sys.exit(f"{len(areas)} slave nodes are not in the picture")

values = measures.reference_values(model["reference"]["values"])
computed = measures.OF_CONTACT[model["reference"]["type"]](points, force, values)
failed = set(computed) ^ set(expected)
for name in set(computed) & set(expected):
    if not abs(computed[name] - expected[name]) < 2e-6:
        failed.add(name)
    print(f"{name}: program {expected[name]:.8f}, harness {computed[name]:.8f}")
if failed:
    sys.exit("they differ: " + ", ".join(sorted(failed)))
