#!/bin/sh
# benchmark.sh PROGRAM PROJECT FOLDER: the harness contrib/benchmark on a tiny campaign:
# columns, medians, failures, messages; its measures against those of the program; with
# and without CalculiX and gnuplot.
set -eu
. "$(dirname -- "$0")/common.sh"
python=$(python3 -c 'import sys, tomllib; print(sys.executable)' 2>/dev/null) || {
  echo "skipped: there is no Python 3.11"
  exit 0
}

export PYTHONDONTWRITEBYTECODE=1

# contains FILE TEXT
contains() {
  if grep -qF -- "$2" "$1"; then
    echo "found: $2"
  else
    fail "$1 does not say: $2"
    cat "$1"
  fi
}

# benchmark ARGUMENTS: what it says goes to said.txt.
benchmark() {
  "$python" "$source/contrib/benchmark" --program "$program" --output "$folder/results" "$@" \
    >said.txt 2>&1
}

cat >tiny.toml <<'TOML'
title = "Tiny"
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
TOML
rm -rf results
benchmark tiny.toml || { fail "the tiny campaign"; cat said.txt; }
csv=results/tiny/results.csv
contains $csv "campaign,contender,mesh,program,degree,element,pairing"
contains $csv "status,reason,nodes,unknowns,steps,newton,linear_mean,runs,user_seconds,user_seconds_min,user_seconds_max,system_seconds,wall_seconds,memory_mb,area,stress_max_deviation"
contains results/tiny/table.md "| gives up | 2 | 50 |"
contains results/tiny/table.md "failed: "
contains results/tiny/table.md "Input error in section 'Newton', key 'Maximum iteration'"
contains results/tiny/table.md "| stress_max_deviation | 0.1 % | ours, averaged, mesh 2 |"
contains results/tiny/runs/ours_averaged_2/command "Contact pair interface/Pairing=averaged"

# Three runs of each contender that converged, one of those that failed; the same nodes.
"$python" - "$source" "$csv" <<'PYTHON' || fail "the rows of $csv"
import sys
sys.path.insert(0, sys.argv[1] + "/contrib")
from benchmarking import calculix, campaign, processes, table
rows = {row["contender"]: row for row in table.read_csv(sys.argv[2])}
assert rows["ours, averaged"]["stress_max_deviation"] < 1e-10
assert 0.05 < rows["ours, pointwise"]["stress_max_deviation"] < 1
assert abs(rows["ours, averaged"]["area"] - 1) < 1e-10
for row in rows.values():
    assert row["runs"] == (1 if row["status"] == "failed" else 3), row
    assert row["user_seconds_min"] <= row["user_seconds"] <= row["user_seconds_max"], row
assert rows["gives up"]["status"] == rows["misspelt"]["status"] == "failed"
if calculix.installed():
    s = rows["CalculiX, surface to surface"]
    assert s["nodes"] == rows["ours, averaged"]["nodes"] == 50
    assert s["stress_max_deviation"] < 1e-4, s
    n = rows["CalculiX, node to surface"]["stress_max_deviation"]
    # Pointwise rows are node-to-surface contact.
    assert abs(n - rows["ours, pointwise"]["stress_max_deviation"]) < 0.01, n
else:
    assert len(rows) == 4

# Runs that take too long, and programs that are not there.
usage = processes.run(["sleep", "20"], ".", "sleep.log", 0.2)
assert usage.failure().startswith("time limit") and usage.wall_seconds < 10, usage
assert processes.run(["no such program"], ".", "no.log", 1).failure() == "exit code 127"

# The median, and the worst of several outcomes.
case = campaign.Case("x", "2", "touchstone", {}, {})
small = campaign.Campaign("c", "t", None, ["e"], 3, 1, {}, [0.1], {}, ["2"], [case])
run = {"reason": "", "system_seconds": 0, "wall_seconds": 0, "memory_mb": 0, "errors": {"e": 2}}
runs = [run | {"user_seconds": t} for t in (5, 1, 2)]
row = table.median_row(case, runs, small)
assert (row["user_seconds"], row["user_seconds_min"], row["user_seconds_max"]) == (2, 1, 5)
assert table.median_row(case, runs + [run | {"user_seconds": 1, "reason": "broke"}],
                        small)["reason"] == "broke"

# An error that is small by chance on a coarse mesh does not count.
line = [{"contender": "a", "status": "converged", "nodes": n, "e": e, "user_seconds": n}
        for n, e in ((1, 0.001), (2, 0.05), (3, 0.005), (4, 0.004))]
assert table.best(line, "e", 0.01)["nodes"] == 3
assert table.best(line, "e", 0.001) is None
PYTHON

# Decks, which need no CalculiX to be written: all nodes, numbers that it can read, the
# whole load, and on quadratic faces the negative loads of corners.
"$python" - "$source" "$program" <<'PYTHON' || fail "the decks"
import pathlib, sys
sys.path.insert(0, sys.argv[1] + "/contrib")
from benchmarking import calculix, campaign
tiny = campaign.load(pathlib.Path("tiny.toml"), pathlib.Path(sys.argv[1]))
for degree, element, nodes in ((1, "C3D8I", 50), (2, "C3D20", 147)):
    case = [c for c in tiny.cases if c.program == "calculix"][0]
    case.settings["Discretisation/Degree"] = degree
    case.choices |= {"degree": degree, "element": element}
    model = calculix.prepare(sys.argv[2], case, tiny, pathlib.Path("deck").resolve())
    blocks, name = {}, None
    for line in pathlib.Path("deck/deck.inp").read_text().splitlines():
        if line.startswith("*"):
            name = blocks.setdefault(line, [])
        else:
            name.append([word.strip() for word in line.split(",")])
    assert len(blocks["*NODE, NSET=ALL"]) == len(model.nodes) == nodes, len(model.nodes)
    assert all(len(w) <= 20 for rows in blocks.values() for row in rows for w in row)
    assert len(blocks["*SURFACE, NAME=SLAVE, TYPE=ELEMENT"]) == 9
    assert {side for _, side in blocks["*SURFACE, NAME=SLAVE, TYPE=ELEMENT"]} == {"S2"}
    assert {side for _, side in blocks["*SURFACE, NAME=MASTER, TYPE=ELEMENT"]} == {"S1"}
    loads = [float(row[2]) for row in blocks["*CLOAD"] if row[1] == "3"]
    assert abs(sum(loads) + 10) < 1e-9, loads
    # Four corners of one face each: a quarter of it, or minus a twelfth.
    corner = {1: -10 / 16, 2: 10 / 48}[degree]
    assert sum(abs(load - corner) < 1e-9 for load in loads) == 4, loads
    assert abs(sum(model.areas.values()) - 1) < 1e-12
PYTHON

# Without the two optional programs.
mkdir -p bin
for tool in sh mpirun env; do
  ln -sf "$(command -v $tool)" bin/
done
(PATH=$folder/bin && benchmark --quick tiny.toml) || fail "without gnuplot and ccx: $(cat said.txt)"
contains said.txt "ccx is not installed: without CalculiX"
contains said.txt "gnuplot is not installed: no diagrams"
if command -v gnuplot >/dev/null; then
  benchmark --redraw tiny.toml || fail "--redraw: $(cat said.txt)"
  contains results/tiny/tiny_stress_max_deviation.svg "<svg"
fi

# Results that the summary does not have, and the choice of --quick.
sed -e 's/"area"\]/"arae"]/' -e 's/^repeat = 1/contenders = ["ours"]/' tiny.toml >asks.toml
benchmark --quick --repeat 1 asks.toml || fail "missing results: $(cat said.txt)"
contains results/asks/table.md "failed: summary.json has no results/contact/interface/arae"
[ "$(grep -c , results/asks/results.csv)" -eq 3 ] || fail "--quick takes other contenders"

# refuses SED MESSAGE: a changed campaign ends with a message.
refuses() {
  sed "$1" tiny.toml >changed.toml
  if benchmark changed.toml; then
    fail "accepted: $1"
  fi
  contains said.txt "$2"
}
refuses 's/^repeat/repeats/' "the campaign has no key 'repeats', did you mean 'repeat'?"
refuses 's/^pairings/pairingz/' "contender 1 has no key 'pairingz', did you mean 'pairing'?"
refuses 's/patch_test.prm/patch.prm/' "there is no scene"
refuses 's/^tension.*//' "needs the key 'tension'"
refuses 's/"node to surface"/"node to node"/' "there is no 'node to node'"
refuses 's/^title = .*//' "lacks the key 'title'"
refuses 's/^repeat = 3/repeat = "x"/' "key 'repeat': 'x' is no int"
refuses 's/^title = /title /' "no TOML"
if benchmark no_campaign; then fail "accepted an unknown campaign"; fi
contains said.txt "there is no campaign 'no_campaign'. There are cattaneo_mindlin,"

# measures NAME SCENE OPTIONS: the harness' errors of a run are those of the program.
measures() {
  name=$1 scene=$source/prm/$2.prm
  shift 2
  run "$name" 1 "$scene" "$@" --set "Output/VTU interval=1"
  "$program" --export-model "$name.json" "$@" "$scene"
  picture=$(ls "$name"/contact_*.vtu | tail -n 1)
  perl "$source/tests/checks/contact_points.pl" "$picture" >"$name.points"
  "$python" "$source/tests/checks/benchmark_measures.py" "$source" "$name.json" "$name.points" \
    "$name/summary.json" || fail "measures of $name"
}
measures press_fit press_fit --set "Body inner tube/Geometry/Cells=2, 6, 1" \
  --set "Body outer tube/Geometry/Cells=2, 6, 1" --set "Discretisation/Degree=2"
# Of averaged rows the program has areas of the exact surface, not of the facets.
measures hertz hertz_sphere --set "Discretisation/Refinement factor=0.5" \
  --set "Contact pair contact/Pairing=pointwise"
set --
for body in upper lower; do
  set -- "$@" --set "Body $body/Geometry/Contact cells=6" --set "Body $body/Geometry/Contact layers=2" \
    --set "Body $body/Geometry/Outer cells=6" --set "Body $body/Geometry/Outer layers=5"
done
measures partial_slip benchmarks/cattaneo_mindlin "$@"

# Shipped campaigns can be read.
benchmark --list || fail "--list: $(cat said.txt)"
finish
