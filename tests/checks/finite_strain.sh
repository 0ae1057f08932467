#!/bin/sh
# finite_strain.sh PROGRAM PROJECT FOLDER: bodies with large strain on one rank and
# two, with both solvers and all enforcements; F-bar against degree 2 and the element
# that locks; cells that turn inside out.
set -eu
. "$(dirname -- "$0")/common.sh"
tests=$source/tests
sharp="Newton/Residual tolerance=1e-11"
bending="$tests/large_bending.prm"
ball="$tests/squeezed_ball.prm"

# The way to the solution does not count.
run ball 1 "$ball" --set "$sharp"
run ball-2 2 "$ball" --set "$sharp"
same ball ball-2 1e-8 newton=1
run multipliers 2 "$ball" --set "$sharp" --set "Contact/Enforcement=lagrange multipliers"
same ball multipliers 1e-8
run augmented 1 "$ball" --set "$sharp" --set "Contact/Enforcement=augmented lagrange"
same ball augmented 1e-6
run belos 2 "$ball" --set "$sharp" --set "Linear solver/Type=Belos CG"
same ball belos 1e-7
run ten 1 "$ball" --set "$sharp" --set "Load stepping/Steps=10"
same ball ten 1e-8
run degree_2 1 "$ball" --set "$sharp" --set "Discretisation/Degree=2"
run degree_2-2 2 "$ball" --set "$sharp" --set "Discretisation/Degree=2"
same degree_2 degree_2-2 1e-8 newton=1

# error NAME: deviation of the tip from the place of a fine mesh of degree 2.
error() {
  value "$1" /errors/point_displacement
}

# F-bar is right within 1 % and as good as the fine mesh on a finer one; the element
# without it does not move.
run bending 1 "$bending"
below bending tip "$(error bending)" 1e-2
run bending_fine 2 "$bending" --set "Discretisation/Refinement factor=2"
below bending_fine tip "$(error bending_fine)" 1e-3
run bending_locked 1 "$bending" --set "Body strip/Element=full"
awk -v e="$(error bending_locked)" 'BEGIN { exit !(e > 0.9) }' ||
  fail "full integration does not lock: error $(error bending_locked)"

# In one step the cells turn inside out: it is cut, and the way does not count.
run bending_cut 1 "$bending" --set "Load stepping/Steps=1" --set "$sharp"
grep -q "not converged: a cell turns inside out" bending_cut/log || fail "no step was cut"
run bending_sharp 1 "$bending" --set "$sharp"
same bending_sharp bending_cut 1e-7

# Nothing can be squeezed through itself: the step is cut, and the run ends with the
# reason and the last converged state. Pulled as far it converges.
for ranks in 1 2; do
  rm -rf results
  code=0
  set -- "$program" --output results --set "Load stepping/Maximum cuts=2" \
    "$source/tests/checks/finite_strain.prm"
  [ $ranks -eq 1 ] || set -- mpirun -n $ranks "$@"
  "$@" >stdout 2>stderr || code=$?
  [ $code -eq 2 ] || fail "exit code $code instead of 2"
  grep -q "^Not converged: a cell turns inside out (det F <= 0).*cut 2 times)" stderr ||
    { fail "the reason is missing"; cat stderr; }
  grep -q "trying again with a step of 0.5" results/log || fail "no step was cut"
  grep -q 'timestep="0.75"' results/solution.pvd || fail "no picture of the last converged state"
done
run pulled 1 "$source/tests/checks/finite_strain.prm" \
  --set "Body block/Boundary top/Displacement z=1.2*t"

finish
