# SPDX-License-Identifier: LGPL-2.1-or-later
"""The harness contrib/benchmark on a tiny campaign: columns, medians, failures, messages; its
measures against those of the program; with and without CalculiX and gnuplot."""
# ctest: label = nightly

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

from touchstone_test import DEGREE, FACTOR, check, fail, finish, folder, launch, prm, program, run, \
    settings_options, source

if sys.version_info < (3, 11):
    print("skipped: contrib/benchmark needs Python 3.11")
    sys.exit(0)

# pylint: disable=wrong-import-position,import-error
from benchmarking import calculix, campaign, fields, measures, processes, surfaces, table

TINY = """title = "Tiny"
scene = "prm/patch_test.prm"
errors = ["stress_max_deviation"]
repeat = 3
time_limit = 30
[meshes.2]
"Body lower/Geometry/Cells" = "3, 3, 1"
"Body upper/Geometry/Cells" = "2, 2, 1"
[quick]
repeat = 1
[columns]
area = ["results", "contact", "interface", "area"]
[[contender]]
name = "ours"
pairings = ["averaged", "pointwise"]
[[contender]]
name = "gives up"
pairing = "pointwise"
settings = { "Newton/Maximum iterations" = 1, "Load stepping/Maximum cuts" = 0 }
[[contender]]
name = "misspelt"
settings = { "Newton/Maximum iteration" = 1 }
[[contender]]
name = "CalculiX"
program = "calculix"
contacts = ["surface to surface", "node to surface"]
tension = 0.025
"""
said = ""


def benchmark(*arguments, environment=None):
    """Whether the harness ends well; what it says is kept."""
    global said  # pylint: disable=global-statement
    done = subprocess.run([sys.executable, source / "contrib/benchmark", "--program", program,
                           "--output", folder / "results", *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False,
                          env={**os.environ, **(environment or {})})
    said = done.stdout
    return done.returncode == 0


def contains(text, *parts, of="what was said"):
    for part in parts:
        check(part in text, f"{of} does not contain: {part}\n{text}")


def content(name):
    return (folder / "results" / name).read_text(encoding="utf-8")


(folder / "tiny.toml").write_text(TINY, encoding="utf-8")
shutil.rmtree(folder / "results", ignore_errors=True)
check(benchmark("tiny.toml"), f"the tiny campaign: {said}")
contains(content("tiny/results.csv"), "campaign,contender,mesh,program,degree,element,pairing",
         "status,reason,nodes,unknowns,steps,newton,linear_mean,runs,user_seconds,user_seconds_min,"
         "user_seconds_max,system_seconds,wall_seconds,memory_mb,area,stress_max_deviation",
         of="results.csv")
contains(content("tiny/table.md"), "| gives up | 2 | 50 |", "failed: ",
         "Input error in section 'Newton', key 'Maximum iteration'",
         "| stress_max_deviation | 0.1 % | ours, averaged, mesh 2 |", of="table.md")
contains(content("tiny/runs/ours_averaged_2/command"), "Contact pair interface/Pairing=averaged",
         of="command")

# Three runs of each contender that converged, one of those that failed; the same nodes.
rows = {row["contender"]: row for row in table.read_csv(folder / "results/tiny/results.csv")}
check(rows["ours, averaged"]["stress_max_deviation"] < 1e-10, "averaged rows")
check(0.05 < rows["ours, pointwise"]["stress_max_deviation"] < 1, "pointwise rows")
check(abs(rows["ours, averaged"]["area"] - 1) < 1e-10, "the area")
for row in rows.values():
    check(row["runs"] == (1 if row["status"] == "failed" else 3), f"number of runs: {row}")
    check(row["user_seconds_min"] <= row["user_seconds"] <= row["user_seconds_max"], f"times: {row}")
check(rows["gives up"]["status"] == rows["misspelt"]["status"] == "failed", "failures")
if calculix.installed():
    s = rows["CalculiX, surface to surface"]
    check(s["nodes"] == rows["ours, averaged"]["nodes"] == 50, f"nodes: {s}")
    check(s["stress_max_deviation"] < 1e-4, f"patch test: {s}")
    n = rows["CalculiX, node to surface"]["stress_max_deviation"]
    # Pointwise rows are node-to-surface contact.
    check(abs(n - rows["ours, pointwise"]["stress_max_deviation"]) < 0.01, f"node to surface: {n}")
else:
    check(len(rows) == 4, f"{len(rows)} contenders")

# Runs that take too long, and programs that are not there.
usage = processes.run(["sleep", "20"], ".", "sleep.log", 0.2)
check(usage.failure().startswith("time limit") and usage.wall_seconds < 10, f"time limit: {usage}")
check(processes.run(["no such program"], ".", "no.log", 1).failure() == "exit code 127",
      "a program that is not there")

# The median, and the worst of several outcomes.
case = campaign.Case("x", "2", "touchstone", {}, {})
small = campaign.Campaign("c", "t", None, ["e"], 3, 1, {}, [0.1], {}, ["2"], [case])
outcome = {"reason": "", "system_seconds": 0, "wall_seconds": 0, "memory_mb": 0, "errors": {"e": 2}}
outcomes = [outcome | {"user_seconds": t} for t in (5, 1, 2)]
row = table.median_row(case, outcomes, small)
check((row["user_seconds"], row["user_seconds_min"], row["user_seconds_max"]) == (2, 1, 5), "median")
check(table.median_row(case, outcomes + [outcome | {"user_seconds": 1, "reason": "broke"}],
                       small)["reason"] == "broke", "the worst outcome")

# An error that is small by chance on a coarse mesh does not count.
line = [{"contender": "a", "status": "converged", "nodes": n, "e": e, "user_seconds": n}
        for n, e in ((1, 0.001), (2, 0.05), (3, 0.005), (4, 0.004))]
check(table.best(line, "e", 0.01)["nodes"] == 3 and table.best(line, "e", 0.001) is None,
      "errors that are small by chance")

# Decks, which need no CalculiX to be written: all nodes, numbers that it can read, the
# whole load, and on quadratic faces the negative loads of corners.
tiny = campaign.load(folder / "tiny.toml", source)
for degree, element, nodes in ((1, "C3D8I", 50), (2, "C3D20", 147)):
    case = [c for c in tiny.cases if c.program == "calculix"][0]
    case.settings[DEGREE] = degree
    case.choices |= {"degree": degree, "element": element}
    model = calculix.prepare(str(program), case, tiny, folder / "deck")
    blocks, name = {}, None
    for text in (folder / "deck/deck.inp").read_text(encoding="utf-8").splitlines():
        if text.startswith("*"):
            name = blocks.setdefault(text, [])
        else:
            name.append([word.strip() for word in text.split(",")])
    check(len(blocks["*NODE, NSET=ALL"]) == len(model.nodes) == nodes, f"{len(model.nodes)} nodes")
    check(all(len(w) <= 20 for block in blocks.values() for entry in block for w in entry),
          "numbers are too long")
    for surface, side in ("SLAVE", "S2"), ("MASTER", "S1"):
        faces = blocks[f"*SURFACE, NAME={surface}, TYPE=ELEMENT"]
        check({s for _, s in faces} == {side}, f"sides of {surface}")
        check(surface == "MASTER" or len(faces) == 9, f"faces of {surface}")
    loads = [float(entry[2]) for entry in blocks["*CLOAD"] if entry[1] == "3"]
    check(abs(sum(loads) + 10) < 1e-9, f"loads {loads}")
    # Four corners of one face each: a quarter of it, or minus a twelfth.
    corner = {1: -10 / 16, 2: 10 / 48}[degree]
    check(sum(abs(load - corner) < 1e-9 for load in loads) == 4, f"loads of corners {loads}")
    check(abs(sum(model.areas.values()) - 1) < 1e-12, "areas")

# Without the two optional programs.
(folder / "bin").mkdir(exist_ok=True)
for tool in "sh", "mpirun", "env":
    link = folder / "bin" / tool
    link.unlink(missing_ok=True)
    link.symlink_to(shutil.which(tool))
check(benchmark("--quick", "tiny.toml", environment={"PATH": str(folder / "bin")}),
      f"without gnuplot and ccx: {said}")
contains(said, "ccx is not installed: without CalculiX", "gnuplot is not installed: no diagrams")
if shutil.which("gnuplot"):
    check(benchmark("--redraw", "tiny.toml"), f"--redraw: {said}")
    contains(content("tiny/tiny_stress_max_deviation.svg"), "<svg", of="the diagram")

# Results that the summary does not have, and the choice of --quick.
asks = TINY.replace('"area"]', '"arae"]').replace("\nrepeat = 1", '\ncontenders = ["ours"]')
(folder / "asks.toml").write_text(asks, encoding="utf-8")
check(benchmark("--quick", "--repeat", "1", "asks.toml"), f"missing results: {said}")
contains(content("asks/table.md"),
         "failed: summary.json has no results/contact/interface/arae", of="table.md")
check(sum("," in text for text in content("asks/results.csv").splitlines()) == 3,
      "--quick takes other contenders")


def refuses(pattern, replacement, message):
    """A changed campaign ends with a message."""
    changed = re.sub(pattern, replacement, TINY, flags=re.M)
    check(changed != TINY, f"nothing changed: {pattern}")
    (folder / "changed.toml").write_text(changed, encoding="utf-8")
    check(not benchmark("changed.toml"), f"accepted: {pattern}")
    contains(said, message)


refuses("^repeat", "repeats", "the campaign has no key 'repeats', did you mean 'repeat'?")
refuses("^pairings", "pairingz", "contender 1 has no key 'pairingz', did you mean 'pairing'?")
refuses("patch_test.prm", "patch.prm", "there is no scene")
refuses("^tension.*", "", "needs the key 'tension'")
refuses('"node to surface"', '"node to node"', "there is no 'node to node'")
refuses("^title = .*", "", "lacks the key 'title'")
refuses("^repeat = 3", 'repeat = "x"', "key 'repeat': 'x' is no int")
refuses("^title = ", "title ", "no TOML")
check(not benchmark("no_campaign"), "accepted an unknown campaign")
contains(said, "there is no campaign 'no_campaign'. There are cattaneo_mindlin,")


def same_measures(name, scene, settings):
    """The harness' errors of a run, from its contact surface, are those of the program."""
    result = run(name, prm / scene, settings, vtu=1)
    exported = launch("--export-model", f"{name}.json", *settings_options(settings), prm / scene)
    if exported.returncode:
        fail(exported.stdout)
        return
    model = json.loads(pathlib.Path(f"{name}.json").read_text(encoding="utf-8"))
    areas = surfaces.node_areas(model["pairs"][0]["slave"], model["nodes"], model["degree"])
    points, force, known = [], [0.0] * 3, {}
    for node in result.contact_nodes():
        # VTU files have positions in single precision, and no numbers of nodes.
        number = min(areas, key=lambda m, x=node.position: math.dist(model["nodes"][m], x))
        area = areas.pop(number)
        points.append(measures.Point(tuple(node.position), area, node.pressure, node.traction[0],
                                     node.status >= 1, node.status == 2))
        force = [f + area * t for f, t in zip(force, node.traction)]
        known[number] = node.traction
    check(not areas, f"{name}: {len(areas)} slave nodes are not in the VTU file")
    values = measures.reference_values(model["reference"]["values"])
    of = {what: fields.Field(model["pairs"][0]["slave"], model["nodes"], model["degree"],
                             {n: sign * t[axis] for n, t in known.items()})
          for what, axis, sign in (("pressure", 2, 1), ("shear", 0, 1))}
    if model["degree"] == 1:
        of = {what: field.recovered() for what, field in of.items()}
    computed = measures.OF_CONTACT[model["reference"]["type"]](points, force, values, of)
    check(set(computed) == set(result.summary["errors"]), f"{name}: other errors")
    for error, value in computed.items():
        print(f"{error}: program {result.error(error):.8f}, harness {value:.8f}", flush=True)
        check(abs(value - result.error(error)) < 2e-6, f"{name}, {error} differs")


same_measures("press_fit", "press_fit.prm",
              {"Body inner tube/Geometry/Cells": "2, 6, 1",
               "Body outer tube/Geometry/Cells": "2, 6, 1", DEGREE: 2})
# Of averaged rows the program has areas of the exact surface, not of the facets.
same_measures("hertz", "hertz_sphere.prm",
              {FACTOR: 0.5, "Contact pair contact/Pairing": "pointwise"})
same_measures("partial_slip", "benchmarks/cattaneo_mindlin.prm",
              {f"Body {body}/Geometry/{what}": value for body in ("upper", "lower")
               for what, value in (("Contact cells", 6), ("Contact layers", 2), ("Outer cells", 6),
                                   ("Outer layers", 5))})

# Shipped campaigns can be read.
check(benchmark("--list"), f"--list: {said}")
finish()
