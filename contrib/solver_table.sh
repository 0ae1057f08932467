#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# solver_table.sh [PROGRAM] [FACTOR ...]: multigrid of the program, of Trilinos (ML), and of PETSc
# (GAMG, BoomerAMG) on two tubes, as a Markdown table (doc/solvers.md). Default: factors 1 and 2; BoomerAMG takes minutes.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
program=${1:-$root/build/touchstone}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- 1 2
export OPENBLAS_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# number KEY: the first of that name in the summary.
number() {
  awk -v key="\"$1\":" '$1 == key { sub(",", "", $2); print $2; exit }' "$folder/run/summary.json"
}

# row FACTOR NAME [OPTION...]
row() {
  factor=$1 name=$2
  shift 2
  rm -rf "$folder/run"
  "$program" --results-only --output "$folder/run" --set "Output/VTU interval=0" \
    --set "Discretisation/Refinement factor=$factor" "$@" "$root/prm/two_tubes.prm" \
    >"$folder/text" 2>&1 || { cat "$folder/text" >&2; exit 1; }
  force=$(awk '$1 == "force" { sub("-", "", $2); print $2; exit }' "$folder/text")
  echo "| $factor | $(number unknowns) | $name | $(number newton) |" \
    "$(number linear_total) | $(number linear_mean | awk '{ printf "%.1f", $1 }') |" \
    "$(number preconditioner_setups) |" \
    "$(number cpu | awk '{ printf "%.1f", $1 }') |" \
    "$(number peak_memory_mb | awk '{ printf "%.2f", $1 / 1000 }') | $force |"
}

echo "| factor | dofs | preconditioner | Newton | CG | CG a solve | set-ups | CPU s | memory GB | push force |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for factor in "$@"; do
  cg='Linear solver/Type=Belos CG' petsc='Linear solver/Type=PETSc'
  row "$factor" "own multigrid" --set "$cg"
  row "$factor" "ML" --set "$cg" --set "Linear solver/Preconditioner=ML"
  row "$factor" "GAMG" --set "$petsc" --set "Linear solver/PETSc options=-ksp_type cg"
  row "$factor" "BoomerAMG" --set "$petsc" \
    --set "Linear solver/PETSc options=-ksp_type cg -pc_type hypre"
done
