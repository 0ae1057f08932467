#!/bin/sh
# tubes_with_friction.sh PROGRAM PROJECT FOLDER: the conical insertion with a
# coefficient of friction of 0.2: the push force is the same with every enforcement
# (1e-3; penalty 1e-2) and solver, and much larger than without friction.
set -eu
. "$(dirname -- "$0")/common.sh"

push() {
  name=$1 ranks=$2 bound=$3
  shift 3
  run "$name" "$ranks" "$source/prm/two_tubes.prm" \
    --set "Contact pair cone/Behaviour=coulomb" --set "Contact pair cone/Friction/Coefficient=0.2" \
    --set "Contact pair cone/Pairing=pointwise" "$@"
  force=$(value "$name" /results/reactions/inner_tube/end)
  first=${first:-$force}
  below "$name" "push force $force differs from $first" \
    "$(awk -v a="$first" -v b="$force" 'BEGIN { d = (a - b) / a; print d < 0 ? -d : d }')" "$bound"
}

push elimination 1 1e-12
push elimination_2 2 1e-8
push gmres 1 1e-6 --set "Linear solver/Type=Belos GMRES"
push multipliers 1 1e-3 --set "Contact/Enforcement=lagrange multipliers"
push augmented 1 1e-3 --set "Contact/Enforcement=augmented lagrange"
push penalty 1 1e-2 --set "Contact/Enforcement=penalty"
below elimination "push force $first differs from -670.4" \
  "$(awk -v a="$first" 'BEGIN { d = a / -670.4 - 1; print d < 0 ? -d : d }')" 1e-3
finish
