#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# linearisation_table.sh [PROGRAM] [SCENE ...]: Newton iterations, iterations a linear solve, CPU
# seconds and steps cut with frozen and with consistent linearisation, as a Markdown table. A
# scene is a file, or "FILE KEY=VALUE ..." with settings. Default: the scenes with contact of prm/ and
# tests/.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
program=${1:-$root/build/touchstone}
[ $# -eq 0 ] || shift
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

scenes() {
  tubes=prm/two_tubes.prm
  friction="Contact pair cone/Behaviour=coulomb|Contact pair cone/Friction/Coefficient=0.2"
  echo "$tubes"
  echo "$tubes|Contact pair cone/Pairing=pointwise"
  echo "$tubes|Discretisation/Refinement factor=2"
  echo "$tubes|$friction"
  echo "$tubes|$friction|Contact pair cone/Pairing=pointwise"
  echo "$tubes|$friction|Discretisation/Refinement factor=2"
  echo "$tubes|$friction|Contact/Enforcement=lagrange multipliers"
  for scene in prm/press_fit prm/hertz_sphere prm/benchmarks/ironing prm/benchmarks/sliding_block \
    prm/benchmarks/sliding_block_force prm/benchmarks/twist tests/off_the_edge \
    tests/off_the_edge_swapped tests/rotating_block tests/large_overlap tests/large_bending \
    tests/cylinder_inside tests/v_block tests/rope tests/squeezed_ball tests/patch_coarse_slave \
    tests/two_pairs tests/hard_coarse_slave tests/hard_corner tests/hard_edge_and_back \
    tests/hard_edge_on_edge tests/hard_large_step tests/hard_lift_off tests/hard_mu_one \
    tests/hard_mu_two tests/hard_rocking tests/hard_stiffness_ratio tests/hard_warped_master \
    tests/hard_wedge; do
    echo "$scene.prm"
  done
}

# columns LINEARISATION SCENE [KEY=VALUE ...]: run; print iterations, CPU, cuts.
columns() {
  linearisation=$1 file=$2
  shift 2
  rm -rf "$folder/run"
  set -- "$@" "Contact/Linearisation=$linearisation" "Output/VTU interval=0"
  for setting in "$@"; do
    set -- "$@" --set "$setting"
    shift
  done
  if ! timeout "${LIMIT:-120}" "$program" --results-only --output "$folder/run" "$@" "$root/$file" \
    >"$folder/text" 2>&1; then
    printf ' %s | | | |' "stops ($?)"
    return
  fi
  python3 - "$folder/run" <<'P'
import json, sys
s = json.load(open(sys.argv[1] + "/summary.json"))
i = s["iterations"]
rows = [l.split() for l in open(sys.argv[1] + "/statistics") if not l.startswith("#")]
cut = sum(int(row[5]) for row in rows)
linear = f"{i['linear_mean']:.1f}" if i.get("linear_mean") else "–"
print(f" {i['newton']} | {linear} | {s['seconds']['cpu']:.1f} | {cut} |", end="")
P
}

echo "| scene | frozen: Newton | a solve | CPU s | cuts | consistent: Newton | a solve | CPU s | cuts |"
echo "|---|---|---|---|---|---|---|---|---|"
{
  if [ $# -gt 0 ]; then
    for scene in "$@"; do echo "$scene"; done
  else
    scenes
  fi
} | while IFS= read -r scene; do
  printf '| %s |' "$(echo "$scene" | sed 's/\.prm//; s/^\(prm\|tests\)\///; s/|[^|]*\//, /g; s/=/ /g')"
  IFS='|'
  set -f
  # shellcheck disable=SC2086 # to be split at bars
  set -- $scene
  unset IFS
  for linearisation in ${WHICH:-frozen consistent}; do
    columns "$linearisation" "$@" </dev/null
  done
  echo
done
