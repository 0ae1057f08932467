#!/bin/sh
# partial_slip.sh PROGRAM PROJECT FOLDER: Cattaneo and Mindlin, loading and unloading,
# against the exact tractions on three meshes, with every enforcement and both
# pairings.
set -eu
. "$(dirname -- "$0")/common.sh"
scene=$source/prm/benchmarks/cattaneo_mindlin.prm
values="radius: 50, young modulus: 210000, poisson ratio: 0.3, friction coefficient: 0.3, depth: 0.25"

# slip NAME CELLS HALF-WIDTHS PRESSURE SHEAR [OPTIONS]: cells over the fine part of the
# surface, bounds of errors. The width of that part puts the edge of the contact at the
# same place in a cell of each mesh.
slip() {
  name=$1 cells=$2 widths=$3 pressure=$4 shear=$5
  shift 5
  case $cells in 6) width=1.24 ;; 12) width=1.2 ;; 24) width=1.183 ;; esac
  for body in upper lower; do
    set -- "$@" --set "Body $body/Geometry/Contact cells=$cells" \
      --set "Body $body/Geometry/Contact layers=$cells" \
      --set "Body $body/Geometry/Contact width=$width"
  done
  run "$name" "$([ "$name" = ranks ] && echo 2 || echo 1)" "$scene" "$@"
  below "$name" contact_half_width "$(value "$name" /errors/contact_half_width)" "$widths"
  below "$name" stick_half_width "$(value "$name" /errors/stick_half_width)" "$widths"
  below "$name" pressure_l2 "$(value "$name" /errors/pressure_l2)" "$pressure"
  below "$name" shear_traction_l2 "$(value "$name" /errors/shear_traction_l2)" "$shear"
}

slip coarse 6 0.04 0.01 0.08
slip medium 12 0.025 0.006 0.02
slip ranks 12 0.025 0.006 0.02
same medium ranks 1e-6
slip multipliers 12 0.025 0.006 0.02 --set "Contact/Enforcement=lagrange multipliers"
same medium multipliers 1e-6
slip augmented 12 0.025 0.006 0.02 --set "Contact/Enforcement=augmented lagrange"
slip averaged 12 0.025 0.006 0.02 --set "Contact pair contact/Pairing=averaged"
slip penalty 12 0.025 0.006 0.025 --set "Contact/Enforcement=penalty"
slip fine 24 0.006 0.005 0.012
for error in contact_half_width stick_half_width pressure_l2 shear_traction_l2; do
  [ "$error" = contact_half_width ] || # has hardly any error from the second mesh on
    below fine "$error, to fall with the mesh" "$(value fine /errors/$error)" \
      "$(value medium /errors/$error)"
  below medium "$error, to fall with the mesh" "$(value medium /errors/$error)" \
    "$(value coarse /errors/$error)"
done

# back NAME CELLS TIME RUN HALF-WIDTHS SHEAR: down from the peak, which is the force of
# RUN: half way to the other side at time 14, all the way at 16.
back() {
  peak=$(value "$4" /results/contact/contact/force 1 | awk '{ print -$1 }')
  slip "$1" "$2" "$5" 0.006 "$6" --set "Load stepping/End time=$3" \
    --set "Load stepping/Steps=$3" \
    --set "Reference solution/Values=$values, peak tangential force: $peak"
}

back reversed 12 14 medium 0.03 0.05
back other_side 12 16 medium 0.025 0.02

# Masing: going back, the force changes by twice what it took to go half as far at first,
# Q* - Q(t) = 2 Q(4 + (t - 8) / 2).
if ! awk '/^# [0-9]+: contact: force x/ { column = $2 + 0 } /^#/ { next } { force[$2 + 0] = $column }
  END { for (t = 10; t <= 16; t += 2) {
          d = (force[8] - force[t]) / force[8] - 2 * force[4 + (t - 8) / 2] / force[8]
          if (d < 0) d = -d
          printf "hysteresis at t = %d: off by %.1e of the peak\n", t, d
          if (!(d < 1e-4)) bad = 1 }
        exit bad || column == 0 }' other_side/statistics; then
  fail "the force does not follow Masing's rule"
fi
finish
