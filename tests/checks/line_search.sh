#!/bin/sh
# line_search.sh PROGRAM PROJECT FOLDER: the rope in one step. With line search no step
# is cut, and the iterations are fewer than without it; the result is that of small steps.
# Without it a step is cut; with the springs of a penalty Newton's method may also find another
# equilibrium on its wild way, which depends on round-off.
set -eu
. "$(dirname -- "$0")/common.sh"
rope=$source/tests/rope.prm

for enforcement in elimination "lagrange multipliers" penalty; do
  short=$(echo "$enforcement" | tr ' ' _)
  set -- --set "Contact/Enforcement=$enforcement"
  run "$short" 1 "$rope" "$@"
  run "small_$short" 1 "$rope" "$@" --set "Newton/Line search=none" --set "Load stepping/Steps=8"
  run "full_$short" 1 "$rope" "$@" --set "Newton/Line search=none"
  same "$short" "small_$short" 1e-6
  ! grep -q "trying again" "$short/log" || fail "$short: a step was cut"
  [ "$enforcement" = penalty ] || grep -q "trying again" "full_$short/log" || fail "$short: no step was cut without line search"
  below "$short" "iterations with line search" "$(value "$short" /iterations/newton)" \
    "$(value "full_$short" /iterations/newton)"
done
finish
