#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# augmented_table.sh [PROGRAM] [FACTOR ...]: the set-up of published work on parallel
# augmented-Lagrange contact, as a Markdown table: two tubes, an outer loop of augmentations,
# three steps, conjugate gradients scaled by the diagonal. Default: factors 1 and 2.
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

echo "| factor | cells | unknowns | Newton | augmentations | CG a solve | CPU s | push force |"
echo "|---|---|---|---|---|---|---|---|"
for factor in "$@"; do
  rm -rf "$folder/run"
  "$program" --results-only --output "$folder/run" --set "Output/VTU interval=0" \
    --set "Discretisation/Refinement factor=$factor" --set "Load stepping/Steps=3" \
    --set "Contact/Enforcement=augmented lagrange" --set "Contact/Augmentation=outer" \
    --set "Linear solver/Type=Belos CG" --set "Linear solver/Preconditioner=diagonal" \
    --set "Linear solver/Maximum iterations=100000" "$root/prm/two_tubes.prm" \
    >"$folder/text" 2>&1 || { cat "$folder/text" >&2; exit 1; }
  # An augmentation puts a state that was in balance out of it, with the same rows.
  augmentations=$(awk '
    /^Step/ { last = 0 }
    NF == 6 && $1 + 0 > 0 && $2 ~ /e/ {
      n += (last > 0 && last < 1e-7 && $5 == 0 && $2 > 100 * last)
      last = $2
    }
    END { print n + 0 }' "$folder/run/log")
  force=$(awk '$1 == "force" { sub("-", "", $2); print $2; exit }' "$folder/text")
  echo "| $factor | $(number cells) | $(number unknowns) | $(number newton) | $augmentations |" \
    "$(number linear_mean | awk '{ printf "%.0f", $1 }') |" \
    "$(number cpu | awk '{ printf "%.1f", $1 }') | $force |"
done
