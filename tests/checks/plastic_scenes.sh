#!/bin/sh
# plastic_scenes.sh PROGRAM PROJECT FOLDER: what the shipped scenes of large deformation,
# plasticity and impact promise, on meshes that are quick.
set -eu
. "$(dirname -- "$0")/common.sh"
prm=$source/prm/benchmarks

error_below() {
  below "$1" "$2" "$(value "$1" "/errors/$2")" "$3"
}

# Loaded, and unloaded again: the residual stress. Errors fall with the cells.
values=$(sed -n 's/^ *set Values = //p' "$prm/hill_tube.prm")
run hill 1 "$prm/hill_tube.prm"
error_below hill contact_pressure_mean 1e-3
error_below hill elastic_plastic_radius 2e-3
error_below hill stress_l2 0.005
run residual 2 "$prm/hill_tube.prm" --set "Load stepping/End time=2" --set "Load stepping/Steps=20" \
  --set "Reference solution/Values=$values, unloaded: 1"
error_below residual elastic_plastic_radius 2e-3
error_below residual stress_l2 0.01

# Near-incompressible: full integration of degree 1 locks and misses by half.
run f_bar 1 "$prm/cook.prm" --set "Body membrane/Geometry/Cells=16, 16, 1"
error_below f_bar point_displacement 0.012
run degree_2 1 "$prm/cook.prm" --set "Body membrane/Geometry/Cells=8, 8, 1" \
  --set "Discretisation/Degree=2"
error_below degree_2 point_displacement 0.045

# The plate and Taylor's bar, coarse and for a while: the same on two ranks, energies add up.
for ranks in 1 2; do
  run "plate_$ranks" "$ranks" "$source/prm/plate_drop.prm" --set "Discretisation/Refinement factor=0.25" \
    --set "Load stepping/End time=5e-7" --set "Load stepping/Steps=25"
  run "taylor_$ranks" "$ranks" "$prm/taylor_bar.prm" --set "Body rod/Geometry/Cells=2, 2, 12" \
    --set "Load stepping/End time=1e-5" --set "Load stepping/Steps=50"
done
same plate_1 plate_2 1e-6
# Plastic cells take more work than the linear ones of the ground: a rank has fewer of them.
share=$(awk '/"balance"/ { b = 1 } b && /"cells"/ { c = 1 }
  c && /"imbalance"/ { gsub(/[^0-9.]/, "", $2); print $2; exit }' plate_2/summary.json)
below plate_2 "cells of a rank over the mean, but 1.1 or more ($share)" \
  "$(awk -v s="$share" 'BEGIN { print (s >= 1.1 ? 0 : 9) }')" 1
same taylor_1 taylor_2 1e-4
finish
