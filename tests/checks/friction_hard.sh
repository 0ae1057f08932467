#!/bin/sh
# friction_hard.sh PROGRAM PROJECT FOLDER: friction where slave nodes have less freedom than
# others or slip reverses. Every exact enforcement and both pairings converge to one answer.
set -eu
. "$(dirname -- "$0")/common.sh"
scenes=$source/tests/checks

# Stick beside a plane of symmetry, on meshes that do not match.
for pairing in averaged pointwise; do
  set -- --set "Contact pair c/Pairing=$pairing"
  run "washer_$pairing" 1 "$scenes/friction_beside_symmetry.prm" "$@"
  run washer_multipliers 1 "$scenes/friction_beside_symmetry.prm" "$@" \
    --set "Contact/Enforcement=lagrange multipliers"
  same "washer_$pairing" washer_multipliers 1e-6
  run washer_augmented 1 "$scenes/friction_beside_symmetry.prm" "$@" \
    --set "Contact/Enforcement=augmented lagrange"
  same "washer_$pairing" washer_augmented 1e-6
done

# Slave nodes with a prescribed displacement along the slip: F / G = mu, but for the dents in the
# base, whose slopes are those of the pressure over Young's modulus. G = 6 * 4 * 4, mu = 0.1.
answer=
for enforcement in elimination "lagrange multipliers" "augmented lagrange"; do
  run driven 1 "$scenes/friction_driven_nodes.prm" --set "Contact/Enforcement=$enforcement"
  force=$(value driven /results/contact/slope/force 1)
  answer=${answer:-$force}
  below "driven, $enforcement" "force $force differs from -9.6" \
    "$(awk -v f="$force" 'BEGIN { d = f / -9.6 - 1; print d < 0 ? -d : d }')" 1e-6
  below "driven, $enforcement" "force $force differs from $answer" \
    "$(awk -v f="$force" -v a="$answer" 'BEGIN { d = f / a - 1; print d < 0 ? -d : d }')" 1e-8
done

# A slave edge in the corner of two obstacles: what part of the force there is friction does not
# depend on the enforcement. (The default tolerance of gaps is 5e-6 of the pressure there.)
for degree in 1 2; do
  set -- --set "Discretisation/Degree=$degree" --set "Newton/Gap tolerance=1e-10"
  run "corner_$degree" 1 "$scenes/friction_corner.prm" "$@"
  run corner_multipliers 1 "$scenes/friction_corner.prm" "$@" \
    --set "Contact/Enforcement=lagrange multipliers"
  same "corner_$degree" corner_multipliers 1e-8
  run corner_augmented 1 "$scenes/friction_corner.prm" "$@" \
    --set "Contact/Enforcement=augmented lagrange"
  same "corner_$degree" corner_augmented 1e-6 area=1
done

# A belt on the cone from end to end, whose slip reverses: T2 / T1 = exp(mu pi / 2).
run belt 1 "$scenes/friction_belt.prm"
tension=$(value belt /results/reactions/belt/first_cut 2)
below belt "T2 = $tension differs from exp(mu pi / 2)" \
  "$(awk -v f="$tension" 'BEGIN { d = -f / exp(0.1 * 3.14159265358979) - 1; print d < 0 ? -d : d }')" \
  2e-3
finish
