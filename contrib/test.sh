#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# From a fresh Debian 12 to the result of the tests: install, build, test.
# The last line says "N passed, N failed".
#
# Usage: contrib/test.sh [LABEL]     full (the default), quick, debug or nightly: tests/README.md
set -eu
. "$(dirname -- "$0")/setup.sh"
label=${1:-full}
case $label in
  full | quick | nightly) targets="all unit_tests" ;;
  debug) targets=debug_tests ;;
  *) sed -n '2,5s/^# *//p' "$0" >&2; exit 2 ;;
esac
install_packages
# shellcheck disable=SC2086
build_program $targets

say "Testing"
# Each run waits for a processor per rank (tests/processors.py): with twice as many tests as
# processors there is always one that has what is free.
jobs=$((2 * $(number_of_jobs)))
log=$build/test.log
failed=$build/test.failed
rm -f "$failed"
# Everything has been built.
export TOUCHSTONE_TESTS_BUILT=1
{ (cd "$build" && ctest -L "^$label\$" --output-on-failure -j"$jobs") || touch "$failed"; } | tee "$log"

# ctest says "95% tests passed, 1 tests failed out of 20".
awk '/tests passed,/ { failed = $4; total = $NF; found = 1 }
     END { if (!found) failed = total = 1
           printf "%d passed, %d failed\n", total - failed, failed
           exit (failed > 0) }' "$log" || touch "$failed"
[ ! -f "$failed" ]
