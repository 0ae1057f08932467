#!/bin/sh
# solver_choice.sh PROGRAM PROJECT FOLDER: the solver that the program chooses by itself,
# and what multigrid needs on finer meshes, with stiff springs and on two ranks,
# and what takes its place where it is slow.
set -eu
. "$(dirname -- "$0")/common.sh"
tubes=$source/prm/two_tubes.prm

# tubes NAME RANKS FACTOR [OPTION...]
tubes() {
  tubes_name=$1 tubes_ranks=$2 tubes_factor=$3
  shift 3
  run "$tubes_name" "$tubes_ranks" "$tubes" --set "Load stepping/Steps=1" \
    --set "Discretisation/Refinement factor=$tubes_factor" "$@"
}

# count NAME KEY
count() {
  sed -n "s/.*\"$2\": \([0-9]*\),*/\1/p" "$1/summary.json"
}

tubes small 1 0.75
[ "$(count small factorisations)" -gt 0 ] || fail "MUMPS does not solve small systems"
[ "$(value small /iterations/linear_total)" -eq 0 ] || fail "iterations for small systems"

tubes large 1 1.5
[ "$(count large factorisations)" -eq 0 ] || fail "large systems are factorised"
tubes factorised 1 1.5 --set "Linear solver/Type=MUMPS"
tubes fallen_back 1 1.5 --set "Linear solver/Maximum iterations=3"
[ "$(count fallen_back preconditioner_setups)" -eq 1 ] || fail "tried again after it failed"
[ "$(count fallen_back factorisations)" -gt 0 ] || fail "MUMPS does not take over"
[ "$(grep -c "MUMPS from now on" fallen_back/log)" -eq 1 ] || fail "the log does not say once why"
[ "$(count fallen_back steps)" -eq 1 ] || fail "the step is cut where MUMPS takes over"
same large factorised 1e-7
same large fallen_back 1e-7
tubes assembled 1 1.5 --set "Linear solver/Contact operator=assembled"
same large assembled 1e-7

# Iterations hardly grow with the mesh, and are the same on two ranks: aggregates that
# went through the contact surface took 14.2, and 15.6 on the finer mesh.
tubes two_ranks 2 1.5
same large two_ranks 1e-7
tubes finer 1 2
for name in large two_ranks finer; do
  below "$name" iterations "$(value "$name" /iterations/linear_mean)" 8
done
tubes springs 1 1.5 --set "Contact/Enforcement=augmented lagrange" --set "Contact/Penalty factor=1000"
below springs iterations "$(value springs /iterations/linear_mean)" 10

# Friction makes systems unsymmetric: GMRES.
tubes friction 1 1 --set "Contact pair cone/Behaviour=coulomb" \
  --set "Contact pair cone/Friction/Coefficient=0.2"
[ "$(count friction factorisations)" -eq 0 ] || fail "large systems with friction are factorised"
below friction iterations "$(value friction /iterations/linear_mean)" 15

# Near incompressibility multigrid would take 462 iterations a solve.
thick() {
  run "$1" 1 "$source/tests/nearly_incompressible_degree_2.prm" --set "Linear solver/Type=$2"
}
thick thick_mumps MUMPS
for solver in CG GMRES; do
  thick "thick_$solver" "Belos $solver"
  below "thick_$solver" iterations "$(value "thick_$solver" /iterations/linear_mean)" 60
  grep -q "multigrid would take" "thick_$solver/log" || fail "the log of $solver does not say why"
  same "thick_$solver" thick_mumps 1e-7
done

# The diagonal has the same solution, of many more iterations.
tubes diagonal 1 0.75 --set "Linear solver/Type=Belos CG" \
  --set "Linear solver/Preconditioner=diagonal"
same diagonal small 1e-7
[ "$(count diagonal factorisations)" -eq 0 ] || fail "the diagonal is factorised"

finish
