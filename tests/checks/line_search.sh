#!/bin/sh
# line_search.sh PROGRAM PROJECT FOLDER: the rope in one step. With line search no step
# is cut, the iterations are no more than 15, or 25 with the springs of a penalty, and fewer than
# without it; the result is that of small steps. Without it Newton's method goes
# a wild way that depends on round-off, 24 to 55 iterations: a step is cut with one of the
# enforcements at least, and with a penalty it may find another equilibrium.
set -eu
. "$(dirname -- "$0")/common.sh"
rope=$source/tests/rope.prm
cut=0

for enforcement in elimination "lagrange multipliers" penalty; do
  short=$(echo "$enforcement" | tr ' ' _)
  set -- --set "Contact/Enforcement=$enforcement"
  run "$short" 1 "$rope" "$@"
  run "small_$short" 1 "$rope" "$@" --set "Newton/Line search=none" --set "Load stepping/Steps=8"
  run "full_$short" 1 "$rope" "$@" --set "Newton/Line search=none"
  same "$short" "small_$short" 1e-6
  ! grep -q "trying again" "$short/log" || fail "$short: a step was cut"
  bound=16
  [ "$enforcement" != penalty ] || bound=26
  full=$(value "full_$short" /iterations/newton)
  [ "$full" -ge "$bound" ] || bound=$full
  ! grep -q "trying again" "full_$short/log" || cut=$((cut + 1))
  below "$short" "iterations with line search" "$(value "$short" /iterations/newton)" "$bound"
done
[ "$cut" -gt 0 ] || fail "no step was cut without line search"
finish
