#!/bin/sh
# plastic_steps.sh PROGRAM PROJECT FOLDER: a ball is pressed into a plastic block, in steps of
# the right size, in ten times too large ones, and in a single one: the same result but for
# the error of large steps, never garbage. On two ranks and with conjugate gradients the same.
set -eu
. "$(dirname -- "$0")/common.sh"
scene=$source/tests/checks/plastic_steps.prm
sharp="Newton/Residual tolerance=1e-11"
kinematic="Body block/Material/Plasticity/Kinematic modulus=30"
recovery="Body block/Material/Plasticity/Kinematic recovery=10"

run right 1 "$scene" --set "$sharp"
run ranks 2 "$scene" --set "$sharp"
run cg    1 "$scene" --set "$sharp" --set "Linear solver/Type=Belos CG"
same right ranks 1e-7
same right cg 1e-6

# Without cuts, or with: the steps that remain differ.
run two 1 "$scene" --set "Load stepping/Steps=2"
run one 1 "$scene" --set "Load stepping/Steps=1"
same right two 0.1 contact=0
same right one 0.3 contact=0

# The pictures show the plastic strain.
"$program" --results-only --output pictures --set "Load stepping/Steps=1" \
  --set "Output/VTU interval=1" "$scene" >pictures.txt 2>&1 || fail "pictures"
grep -q equivalent_plastic_strain pictures/solution_0001.vtu || fail "no plastic strain in pictures"

# Unsymmetric tangent.
run unsymmetric 1 "$scene" --set "$sharp" --set "$kinematic" --set "$recovery"
run both        2 "$scene" --set "$sharp" --set "$kinematic" --set "$recovery"
run lagged      1 "$scene" --set "$sharp" --set "$kinematic" --set "$recovery" \
  --set "Linear solver/Type=Belos CG"
same unsymmetric both 1e-7
same unsymmetric lagged 1e-6
below unsymmetric "Newton iterations a step, 20 times" "$(value unsymmetric /iterations/newton)" 180
finish
