#!/bin/sh
# no_convergence.sh PROGRAM PROJECT FOLDER: a run that does not converge says so with
# exit code and reason, and leaves the last converged state on disk.
set -eu
. "$(dirname -- "$0")/common.sh"

for ranks in 1 2; do
  rm -rf results
  code=0
  set -- "$program" --output results "$source/tests/checks/no_convergence.prm"
  [ $ranks -eq 1 ] || set -- mpirun -n $ranks "$@"
  "$@" >stdout 2>stderr || code=$?
  [ $code -eq 2 ] || fail "exit code $code instead of 2"
  grep -q "^Not converged: no convergence in 1 Newton iterations: residual .*cut 1 times)" stderr ||
    { fail "the reason is missing"; cat stderr; }
  grep -q '"converged": false' results/summary.json || fail "summary.json says that it converged"
  grep -q '"steps": 1,' results/summary.json || fail "summary.json must count one step"
  grep -q '"failure": "no convergence in 1 Newton iterations' results/summary.json ||
    fail "summary.json does not name the reason"
  grep -q 'The run did not converge' results/log || fail "the log does not say it"
  grep -q 'trying again with a step of 0.5' results/log || fail "no step was cut"
  grep -q 'timestep="1"' results/solution.pvd || fail "no picture of the last converged state"
  ! grep -q 'timestep="\(1.5\|2\)"' results/solution.pvd || fail "a picture of a failed state"
  [ "$(grep -vc '^#' results/statistics)" -eq 1 ] || fail "statistics must have one row"
done
finish
