#!/bin/sh
# partial_slip.sh PROGRAM PROJECT FOLDER: Cattaneo and Mindlin, loading and unloading,
# against the exact tractions, with every enforcement.
set -eu
. "$(dirname -- "$0")/common.sh"
scene=$source/prm/benchmarks/cattaneo_mindlin.prm
values="radius: 50, young modulus: 210000, poisson ratio: 0.3, friction coefficient: 0.3, depth: 0.25"

# slip NAME CELLS HALF-WIDTHS PRESSURE SHEAR [OPTIONS]: cells over the fine part of the
# surface, bounds of errors.
slip() {
  name=$1 cells=$2 widths=$3 pressure=$4 shear=$5
  shift 5
  for body in upper lower; do
    set -- "$@" --set "Body $body/Geometry/Contact cells=$cells" \
      --set "Body $body/Geometry/Contact layers=$((cells / 2))"
  done
  run "$name" 1 "$scene" "$@"
  below "$name" contact_half_width "$(value "$name" /errors/contact_half_width)" "$widths"
  below "$name" stick_half_width "$(value "$name" /errors/stick_half_width)" "$widths"
  below "$name" pressure_l2 "$(value "$name" /errors/pressure_l2)" "$pressure"
  below "$name" shear_traction_l2 "$(value "$name" /errors/shear_traction_l2)" "$shear"
}

slip coarse 12 0.01 0.015 0.06
slip multipliers 12 0.01 0.015 0.06 --set "Contact/Enforcement=lagrange multipliers"
same coarse multipliers 1e-6
slip augmented 12 0.01 0.015 0.06 --set "Contact/Enforcement=augmented lagrange"
slip fine 24 0.005 0.01 0.06

# Back again: the peak is the force of the run before.
peak=$(value fine /results/contact/contact/force 1 | awk '{ print -$1 }')
slip unloaded 24 0.01 0.01 0.2 --set "Load stepping/End time=9" --set "Load stepping/Steps=9" \
  --set "Reference solution/Values=$values, peak tangential force: $peak"
finish
