#!/bin/sh
# approach.sh PROGRAM PROJECT FOLDER: nodes that touch within a step. The way of their
# approach is no slip, so that a block that comes down askew on a corner finds the
# friction of small steps with large ones. The force along x, friction alone, is 0.567
# with 64 steps; counted as slip, the approach makes it 0.43 with 6 steps, 0.47 with 8
# and 0.54 with 32.
set -eu
. "$(dirname -- "$0")/common.sh"
scene=$source/tests/hard_corner.prm

# fall NAME RANKS STEPS [OPTIONS]
fall() {
  name=$1 ranks=$2 steps=$3
  shift 3
  run "$name" "$ranks" "$scene" --set "Load stepping/Steps=$steps" "$@"
}

fall small 1 32
for steps in 6 8 16; do
  fall "steps_$steps" 1 "$steps"
  below "$steps steps" "force along x differs from that of 32 steps" \
    "$(echo "$(value "steps_$steps" /results/contact/contact/force 1) \
      $(value small /results/contact/contact/force 1)" |
      awk '{ d = ($1 - $2) / $2; print d < 0 ? -d : d }')" \
    "$(awk -v steps="$steps" 'BEGIN { print steps < 8 ? 0.1 : steps < 16 ? 0.04 : 0.01 }')"
done
fall ranks 2 8
same steps_8 ranks 1e-6
fall multipliers 1 8 --set "Contact/Enforcement=lagrange multipliers"
same steps_8 multipliers 1e-6
fall augmented 1 8 --set "Contact/Enforcement=augmented lagrange"
same steps_8 augmented 1e-6
finish
