#!/bin/sh
# thin_bodies.sh PROGRAM PROJECT FOLDER: a block that goes through a thin plate in
# one increment ends on the side from which it came: the same state as in many
# small steps, with both pairings, on one and two ranks.
set -eu
. "$(dirname -- "$0")/common.sh"
scenes=$source/tests/checks
pair="Contact pair contact"

for scene in thin_plate; do
  for pairing in averaged pointwise; do
    name=${scene}_$pairing
    set -- --set "$pair/Pairing=$pairing"
    run "$name" 1 "$scenes/$scene.prm" "$@"
    run "${name}_small_steps" 1 "$scenes/$scene.prm" "$@" --set "Load stepping/Steps=8"
    run "${name}_2" 2 "$scenes/$scene.prm" "$@"
    # A plate in bending: forces are small differences.
    same "$name" "${name}_2" 1e-7
    same "$name" "${name}_small_steps" 1e-6
    below "$name" penetration "$(value "$name" /results/contact/contact/max_penetration)" 1e-7
    [ "$(value "$name" /results/contact/contact/active)" -gt 3 ] || fail "$name: hardly any contact"
  done
done

finish
