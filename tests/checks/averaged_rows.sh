#!/bin/sh
# averaged_rows.sh PROGRAM PROJECT FOLDER: averaged rows pass the patch test with
# every enforcement, both slave choices, both degrees, flat and inclined, nearly
# incompressible, on one and two ranks; and are as good on curved surfaces.
set -eu
. "$(dirname -- "$0")/common.sh"
prm=$source/prm
pair="Contact pair interface"

# patch NAME RANKS [OPTIONS]
patch() {
  patch_name=$1 patch_ranks=$2
  shift 2
  run "$patch_name" "$patch_ranks" "$prm/patch_test.prm" --set "$pair/Pairing=averaged" "$@"
  below "$patch_name" stress_max_deviation \
    "$(value "$patch_name" /errors/stress_max_deviation)" 1e-10
}

for enforcement in elimination "lagrange multipliers" "augmented lagrange" penalty; do
  short=$(echo "$enforcement" | tr ' ' _)
  set -- --set "Contact/Enforcement=$enforcement"
  patch "fine_$short" 1 "$@"
  set -- "$@" --set "$pair/Slave body=upper" --set "$pair/Slave boundaries=bottom" \
    --set "$pair/Master body=lower" --set "$pair/Master boundaries=top"
  patch "coarse_$short" 2 "$@"
done
patch outer_augmentation 1 --set "Contact/Enforcement=augmented lagrange" \
  --set "Contact/Augmentation=outer"
patch degree_2 1 --set "Discretisation/Degree=2"
patch nearly_incompressible 2 --set "Body lower/Element=b-bar" --set "Body upper/Element=b-bar" \
  --set "Body lower/Material/Poisson ratio=0.4999" --set "Body upper/Material/Poisson ratio=0.4999"
patch belos 2 --set "Linear solver/Type=Belos CG" --set "Linear solver/Tolerance=1e-8" \
  --set "Newton/Residual tolerance=1e-13"

patch smoothed 2 --set "$pair/Contact geometry=faceted" --set "$pair/Master normal=smoothed"

# Pointwise rows must not pass, or the test shows nothing.
run pointwise 1 "$prm/patch_test.prm" --set "Contact pair interface/Pairing=pointwise"
awk -v e="$(value pointwise /errors/stress_max_deviation)" 'BEGIN { exit !(e > 0.1) }' ||
  fail "pointwise rows pass the patch test"

# Meshes 4:3 of the press fit, both slave choices: bounds for the mean and for the
# largest deviation of a node.
for enforcement in elimination "lagrange multipliers" "augmented lagrange"; do
  for coarse in inner outer; do
    name="fit_${coarse}_$(echo "$enforcement" | tr ' ' _)"
    run "$name" 1 "$prm/press_fit.prm" --set "Contact pair fit/Pairing=averaged" \
      --set "Contact/Enforcement=$enforcement" \
      --set "Body inner tube/Geometry/Cells=8, 48, 3" \
      --set "Body outer tube/Geometry/Cells=8, 48, 3" \
      --set "Body $coarse tube/Geometry/Cells=8, 36, 3"
    below "$name" mean "$(value "$name" /errors/contact_pressure_mean)" 1e-3
    below "$name" deviation "$(value "$name" /errors/contact_pressure_max_deviation)" 2e-2
  done
done

# From facets, with both sides smoothed: without, the overlap of 1e-3 drowns.
for coarse in inner outer; do
  name=fit_smoothed_$coarse
  run "$name" 1 "$prm/press_fit.prm" --set "Contact pair fit/Pairing=averaged" \
    --set "Contact pair fit/Contact geometry=faceted" \
    --set "Contact pair fit/Master normal=smoothed" \
    --set "Body inner tube/Geometry/Cells=8, 48, 3" \
    --set "Body outer tube/Geometry/Cells=8, 48, 3" \
    --set "Body $coarse tube/Geometry/Cells=8, 36, 3"
  below "$name" mean "$(value "$name" /errors/contact_pressure_mean)" 1e-2
  below "$name" deviation "$(value "$name" /errors/contact_pressure_max_deviation)" 5e-2
done

# Slave and master swapped in the insertion: the push force changes by less than
# 1 %, where pointwise rows allow 10 %. Enforcements agree to 1e-6, the penalty to 1e-2.
cone="Contact pair cone"
push() {
  value "$1" /results/reactions/inner_tube/end
}
difference() {
  awk -v a="$1" -v b="$2" 'BEGIN { d = (a - b) / b; print d < 0 ? -d : d }'
}
set -- --set "Load stepping/Steps=1" --set "$cone/Pairing=averaged"
run tubes 1 "$prm/two_tubes.prm" "$@"
run tubes_2 2 "$prm/two_tubes.prm" "$@"
below tubes "ranks differ" "$(difference "$(push tubes)" "$(push tubes_2)")" 1e-8
run multipliers 1 "$prm/two_tubes.prm" "$@" --set "Contact/Enforcement=lagrange multipliers"
below tubes "multipliers differ" "$(difference "$(push multipliers)" "$(push tubes)")" 1e-6
run augmented 1 "$prm/two_tubes.prm" "$@" --set "Contact/Enforcement=augmented lagrange" \
  --set "Linear solver/Type=Belos CG"
below tubes "augmented Lagrange differs" "$(difference "$(push augmented)" "$(push tubes)")" 1e-6
run penalty 1 "$prm/two_tubes.prm" "$@" --set "Contact/Enforcement=penalty"
below tubes "penalty differs" "$(difference "$(push penalty)" "$(push tubes)")" 1e-2
run swapped 1 "$prm/two_tubes.prm" "$@" \
  --set "$cone/Slave body=inner tube" --set "$cone/Slave boundaries=outer" \
  --set "$cone/Master body=outer tube" --set "$cone/Master boundaries=inner"
below tubes "swapped differs" "$(difference "$(push swapped)" "$(push tubes)")" 1e-2
set -- "$@" --set "$cone/Contact geometry=faceted" --set "$cone/Master normal=smoothed"
run smoothed 1 "$prm/two_tubes.prm" "$@"
below smoothed "differs from the exact surfaces" "$(difference "$(push smoothed)" "$(push tubes)")" 1e-2
run smoothed_swapped 2 "$prm/two_tubes.prm" "$@" \
  --set "$cone/Slave body=inner tube" --set "$cone/Slave boundaries=outer" \
  --set "$cone/Master body=outer tube" --set "$cone/Master boundaries=inner"
below smoothed "swapped differs" "$(difference "$(push smoothed_swapped)" "$(push smoothed)")" 1e-2

finish
