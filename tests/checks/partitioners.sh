#!/bin/sh
# partitioners.sh PROGRAM PROJECT FOLDER: results do not depend on how cells are spread
# over ranks (1e-8), and contact that counts is spread more evenly than contact that
# does not.
set -eu
. "$(dirname -- "$0")/common.sh"
tests=$source/tests
metis="Discretisation/Partitioner=METIS"

# both NAME SCENE [OPTIONS]
both() {
  name=$1 scene=$2
  shift 2
  run "$name" 1 "$scene" "$@"
  run "$name-metis-1" 1 "$scene" --set "$metis" "$@"
  same "$name" "$name-metis-1" 1e-8
  for ranks in 2 3; do
    for partitioner in p4est coordinates METIS; do
      run "$name-$partitioner-$ranks" $ranks "$scene" \
        --set "Discretisation/Partitioner=$partitioner" "$@"
      same "$name" "$name-$partitioner-$ranks" 1e-8
    done
  done
}

# Refined with its manifolds, and its exact surfaces: against Lame's pressure as well.
both press_fit "$tests/press_fit.prm" --set "Discretisation/Refinement factor=2" \
  --set "Body inner tube/Geometry/Cells=3, 8, 1" --set "Body outer tube/Geometry/Cells=3, 8, 1"
# With friction; the second from a mesh file.
sharp="Newton/Gap tolerance=1e-11"
both sliding "$tests/hard_mu_one.prm" --set "$sharp"
both warped "$tests/hard_warped_master.prm" --set "$sharp"

# imbalance NAME PHASE: largest over mean of the ranks.
imbalance() {
  awk -v phase="\"$2\":" '
    $1 == "\"balance\":" { inside = 1 }
    inside && $1 == phase { found = 1 }
    found && $1 == "\"imbalance\":" { print $2 + 0; exit }' "$1/summary.json"
}

# spread NAME PARTITIONER WEIGHT: two_tubes on 4 ranks.
spread() {
  run "$1" 4 "$source/prm/two_tubes.prm" --set "Load stepping/Steps=1" --set "$sharp" \
    --set "Discretisation/Partitioner=$2" --set "Discretisation/Contact weight=$3"
}

# fewer_rows A B: the busiest rank of B has fewer slave rows than that of A, by a tenth.
fewer_rows() {
  same "$1" "$2" 1e-6
  below "$2 on 4 ranks" "search against $1" "$(imbalance "$2" search_candidates)" \
    "$(awk -v x="$(imbalance "$1" search_candidates)" 'BEGIN { print 0.9 * x }')"
}

spread metis-cells "METIS, cells only" 0
spread metis METIS 0
fewer_rows metis-cells metis
spread curve p4est 0
spread curve-4 p4est 4
fewer_rows curve curve-4
# METIS is asked for 1.03 of the cells and 1.1 of the contact work, which is slave and
# master faces together, so that rows have more room.
below "METIS on 4 ranks" "cells" "$(imbalance metis cells)" 1.05
below "METIS on 4 ranks" "search" "$(imbalance metis search_candidates)" 1.5
# Across both tubes: all ranks have their share of what is searched.
spread coordinates coordinates 0
below "coordinates on 4 ranks" "cells" "$(imbalance coordinates cells)" 1.05
fewer_rows curve coordinates

# A cell that weighs more than all the others together: no rank goes without any.
column() {
  run "$1" "$2" "$source/prm/patch_test.prm" --set "Discretisation/Contact weight=$3" \
    --set "Body lower/Geometry/Upper corner=1, 1, 0.05" --set "Body lower/Geometry/Cells=1, 1, 1" \
    --set "Body upper/Geometry/Lower corner=0, 0, 0.05" --set "Body upper/Geometry/Cells=1, 1, 200"
}
column column 1 0
column column-heavy 3 1000
same column column-heavy 1e-8
finish
