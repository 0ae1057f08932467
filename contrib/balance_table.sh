#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# balance_table.sh [PROGRAM] [SCENE] [RANKS ...]: how evenly the partitioners spread the
# work of a scene, as a Markdown table. Work and messages are counted, not timed: more
# ranks than cores are welcome. Figures are largest over mean of the ranks; messages are
# those of one search, the most that a rank sends.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
program=${1:-$root/build/touchstone}
scene=${2:-$root/prm/two_tubes.prm}
[ $# -lt 2 ] || shift
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- 2 4 8 16
export OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# figure PHASE KEY: of the last run.
figure() {
  awk -v phase="\"$1\":" -v key="\"$2\":" '
    $1 == "\"balance\":" { inside = 1 }
    inside && $1 == phase { found = 1 }
    found && $1 == key { sub(",", "", $2); print $2; exit }' "$folder/run/summary.json"
}

echo "| partitioner, contact weight | ranks | cells | unknowns | slave rows | master faces | search | neighbours | messages |"
echo "|---|---|---|---|---|---|---|---|---|"
for partition in "coordinates:0" "p4est:0" "p4est:1" "p4est:4" "METIS, cells only:0" "METIS:0"; do
  partitioner=${partition%:*}
  weight=${partition#*:}
  for ranks in "$@"; do
    rm -rf "$folder/run"
    mpirun --oversubscribe -n "$ranks" "$program" --results-only --output "$folder/run" \
      --set "Output/VTU interval=0" --set "Load stepping/Steps=1" \
      --set "Discretisation/Partitioner=$partitioner" \
      --set "Discretisation/Contact weight=$weight" "$scene" >"$folder/text" 2>&1 ||
      { cat "$folder/text" >&2; exit 1; }
    searches=$(awk '$1 == "\"searches\":" { sub(",", "", $2); print $2 }' "$folder/run/summary.json")
    line="| $partitioner, $weight | $ranks |"
    for phase in cells unknowns slave_rows master_faces search_candidates; do
      line="$line $(figure $phase imbalance | awk '{ printf "%.2f", $1 }') |"
    done
    line="$line $(figure neighbours max) |"
    line="$line $(figure search_messages max | awk -v n="$searches" '{ printf "%.0f", $1 / n }') |"
    echo "$line"
  done
done
