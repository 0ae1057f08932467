#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# incompressibility_table.sh [PROGRAM] [FACTOR]: conjugate gradients with multigrid alone, with what
# the program chooses, and MUMPS, on Hertz contact the nearer to incompressibility, as a Markdown
# table (doc/solvers.md). Default: factor 0.75; degree 2 takes half of it.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
program=${1:-$root/build/touchstone}
factor=${2:-0.75}
export OPENBLAS_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# number KEY: the first of that name in the summary.
number() {
  awk -v key="\"$1\":" '$1 == key { sub(",", "", $2); print $2; exit }' "$folder/run/summary.json"
}

# cells OPTION...: iterations of a solve, mean and most, and CPU seconds of a run.
cells() {
  rm -rf "$folder/run"
  code=0
  "$program" --output "$folder/run" --set "Output/VTU interval=0" \
    --set "Load stepping/Maximum cuts=0" --set "Linear solver/Maximum iterations=500" \
    "$@" "$root/prm/hertz_sphere.prm" >"$folder/text" 2>&1 || code=$?
  if [ "$code" -ne 0 ]; then
    printf ' > 500 | |'
    return
  fi
  most=$(awk '$1 ~ /^[0-9]+$/ && NF == 6 && $6 ~ /^[0-9]+$/ && $6 > most { most = $6 } END { print most + 0 }' "$folder/text")
  if [ "$most" -gt 0 ]; then
    printf ' %.0f, %d |' "$(number linear_mean)" "$most"
  else
    printf ' direct |'
  fi
  printf ' %.1f |' "$(number cpu)"
}

echo "| element | Poisson ratio | K/G | multigrid alone | CPU s | Belos CG | CPU s | MUMPS | CPU s |"
echo "|---|---|---|---|---|---|---|---|---|"
for element in b-bar full "degree 2"; do
  for nu in 0.45 0.48 0.49 0.495 0.499 0.4999; do
    set -- --set "Body ball/Material/Poisson ratio=$nu" \
      --set "Body block/Material/Poisson ratio=$nu"
    if [ "$element" = "degree 2" ]; then
      set -- "$@" --set "Discretisation/Degree=2" \
        --set "Discretisation/Refinement factor=$(awk -v f="$factor" 'BEGIN { print f / 2 }')"
    else
      set -- "$@" --set "Body ball/Element=$element" --set "Body block/Element=$element" \
        --set "Discretisation/Refinement factor=$factor"
    fi
    printf '| %s | %s | %.0f |' "$element" "$nu" \
      "$(awk -v nu="$nu" 'BEGIN { print 2 * (1 + nu) / (3 * (1 - 2 * nu)) }')"
    cells "$@" --set "Linear solver/Type=Belos CG" --set "Linear solver/Factorise up to=0"
    cells "$@" --set "Linear solver/Type=Belos CG"
    cells "$@" --set "Linear solver/Type=MUMPS"
    echo
  done
done
