#!/bin/sh
# circles.sh PROGRAM PROJECT FOLDER: pairs whose surfaces are slave and master of each other
# in a circle pass the patch test, on matching and non-matching meshes, with forces in
# balance, on one and two ranks; and the rows that say the same thing twice are dropped and
# reported.
set -eu
. "$(dirname -- "$0")/common.sh"
scenes=$source/tests/checks

# dropped NAME: how many rows the run says that it has dropped.
dropped() {
  sed -n 's/.*: *\([0-9][0-9]*\) contact row(s) dropped.*/\1/p; s/^ *\([0-9][0-9]*\) contact row(s) dropped.*/\1/p' \
    "$1/log" | tail -1
}

# stress NAME: the patch test, and the forces of all pairs and supports along z.
stress() {
  below "$1" stress_max_deviation "$(value "$1" /errors/stress_max_deviation)" 1e-9
}

for enforcement in elimination "lagrange multipliers" "augmented lagrange" penalty; do
  short=$(echo "$enforcement" | tr ' ' _)
  for mesh in matching non_matching; do
    name=two_pass_${mesh}_$short
    set -- --set "Contact/Enforcement=$enforcement"
    [ "$mesh" = non_matching ] || set -- "$@" --set "Body upper/Geometry/Cells=6, 6, 3"
    run "$name" 1 "$scenes/two_pass.prm" "$@"
    run "${name}_2" 2 "$scenes/two_pass.prm" "$@"
    stress "$name"
    stress "${name}_2"
    same "$name" "${name}_2" 1e-8
    # Both pairs together carry the load.
    below "$name" "force out of balance" "$(awk -v a="$(value "$name" /results/contact/interface/force 3)" \
      -v b="$(value "$name" /results/contact/back/force 3)" \
      'BEGIN { d = (b - a) / 10 - 1; print d < 0 ? -d : d }')" 1e-9
    if [ "$enforcement" = penalty ]; then
      [ -z "$(dropped "$name")" ] || fail "$name: springs need not be dropped"
    else
      # All rows of the second pair.
      nodes=25
      [ "$mesh" = non_matching ] || nodes=49
      [ "$(dropped "$name")" = "$nodes" ] ||
        fail "$name: $(dropped "$name") rows dropped and reported, expected $nodes"
    fi
  done
  name=ring_$short
  # What gap an augmented Lagrangian leaves is an error of the stress, of E times that.
  set -- --set "Contact/Enforcement=$enforcement"
  [ "$short" != augmented_lagrange ] || set -- "$@" --set "Newton/Gap tolerance=1e-12"
  run "$name" 1 "$scenes/ring.prm" "$@"
  run "${name}_2" 2 "$scenes/ring.prm" "$@"
  [ "$enforcement" = penalty ] || stress "$name"
  same "$name" "${name}_2" 1e-8
  below "$name" "weight out of balance" "$(awk -v a="$(value "$name" /results/reactions/base/bottom 3)" \
    'BEGIN { d = a / 20 - 1; print d < 0 ? -d : d }')" 1e-9
done

finish
