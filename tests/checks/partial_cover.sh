#!/bin/sh
# partial_cover.sh PROGRAM PROJECT FOLDER: averaged rows where slave faces are covered in part:
# pressures bounded wherever the edge of the master surface lies, forces exact and smooth as it
# moves, none between bodies that only touch.
set -eu
. "$(dirname -- "$0")/common.sh"
checks=$source/tests/checks

# Pressed with 10; with the basis dual on the covered part alone 16, 50, 344 for 1.2, 1.05, 1.01.
for width in 1.0001 1.01 1.05 1.18 1.25 1.32 1.4999; do
  run "edge_$width" 1 "$checks/pressed_over_edge.prm" \
    --set "Body pad/Geometry/Upper corner=$width,$width,0"
  below "edge_$width" max_pressure "$(value "edge_$width" /results/contact/c/max_pressure)" 22
  below "edge_$width" "force off by" "$(value "edge_$width" /results/contact/c/force 3 |
    awk -v w="$width" '{ d = $1 / (10 * w * w) - 1; print (d < 0 ? -d : d) }')" 1e-9
done

# Touching, and 0.01 apart above; coarse balls too.
for cells in "3, 4" "2, 2" "2, 5"; do
  for top in 2 2.01; do
    name="ball_$(echo "$cells" | tr -d ' ,')_$top"
    run "$name" 1 "$checks/ball_between_plates.prm" --set "Body ball/Geometry/Cells=$cells" \
      --set "Body high/Geometry/Lower corner=-1.5,-1.5,$top"
    for pair in a b; do
      below "$name" "force of $pair" "$(value "$name" /results/contact/$pair/force 3 |
        awk '{ print ($1 < 0 ? -$1 : $1) }')" 1e-12
    done
  done
done

# The force changes by a tenth when the mesh does.
for cells in 12 13 20; do
  run "punch_$cells" 1 "$checks/slave_larger_than_master.prm" \
    --set "Body low/Geometry/Cells=$cells, $cells, 2"
  below "punch_$cells" "differs from a fine mesh" \
    "$(value "punch_$cells" /results/contact/c/force 3 |
      awk '{ d = $1 / -36 - 1; print (d < 0 ? -d : d) }')" 0.1
done

# Both edges of the base go over more than a face of the block, in positions half a percent of a
# face apart: rows come and go, and the force changes by less than half a percent each time.
run slide 1 "$checks/sliding_edge.prm" --set "Load stepping/Steps=480"
below slide "largest change of the force" "$(awk '
  !/^#/ && NF > 8 && $2 >= 1 {
    if (n++ > 0 && ($9 / last - 1) ^ 2 > most ^ 2) most = $9 / last - 1
    last = $9
  }
  END { print (most < 0 ? -most : most) }' slide/statistics)" 5e-3

finish
