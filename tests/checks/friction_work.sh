#!/bin/sh
# friction_work.sh PROGRAM PROJECT FOLDER: what friction dissipates. A block that sticks
# is pushed to and fro and dissipates nothing, though the springs of regularised
# friction give way; one that slides dissipates mu N times its way.
set -eu
. "$(dirname -- "$0")/common.sh"
prm=$source/prm/benchmarks

# friction_work NAME STEP: work done against friction up to a step.
friction_work() {
  awk -v step="$2" '/^# [0-9]+: .*friction/ { column = $2 + 0 } /^#/ { next }
    $1 == step { print column ? $column : "missing" }' "$1/statistics"
}

# pushed NAME [OPTIONS]: a shear traction of 0.98 mu N on the top and the sides, to one
# side, to the other and back to nothing.
pushed() {
  name=$1
  shift
  load="1.176 * (max(t - 1, 0) - 2 * max(t - 2, 0) + 2 * max(t - 4, 0))"
  for body in base block; do
    set -- "$@" --set "Body $body/Boundary left/Traction z=-$load" \
      --set "Body $body/Boundary right/Traction z=$load"
  done
  run "$name" 1 "$prm/sliding_block_force.prm" --set "Body block/Boundary top/Traction x=$load" \
    --set "Load stepping/End time=5" --set "Load stepping/Steps=10" \
    --set "Reference solution/Values=szz: -4, sxz: 0, pressure: 4" "$@"
  # Springs give way by t h/(10 E) = 6e-5 under a force of 4.7.
  below "$name" "work in a closed loop of stick" \
    "$(friction_work "$name" 10 | awk '{ print $1 < 0 ? -$1 : $1 }')" 1e-12
}

pushed exact
pushed regularised --set "Contact/Friction=regularised"
pushed penalty --set "Contact/Enforcement=penalty"

# slides NAME [OPTIONS]: 0.016 a step; in full slip the bodies' strains stay, so that is
# the slip of each node, under mu N = 4.8.
slides() {
  name=$1
  shift
  run "$name" 1 "$prm/sliding_block.prm" --set "Load stepping/End time=2.4" \
    --set "Load stepping/Steps=12" "$@"
  below "$name" "work of one step differs from mu N times the way" \
    "$(echo "$(friction_work "$name" 12) $(friction_work "$name" 11)" |
      awk '{ d = ($1 - $2) / (4.8 * 0.016) - 1; print d < 0 ? -d : d }')" 1e-6
}

slides slide_exact
slides slide_regularised --set "Contact/Friction=regularised"
slides slide_penalty --set "Contact/Enforcement=penalty"
finish
