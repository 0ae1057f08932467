#!/bin/sh
# From a fresh Debian 12 to the result of all tests: install, build, test.
# The last line says "N passed, N failed".
set -eu
. "$(dirname -- "$0")/setup.sh"
install_packages
build_program all unit_tests

say "Testing"
# Two at a time at most: everything has been built, and no test compares times, but some
# run on several ranks.
jobs=$(number_of_jobs)
[ "$jobs" -le 2 ] || jobs=2
log=$build/test.log
failed=$build/test.failed
rm -f "$failed"
{ (cd "$build" && ctest --output-on-failure -j"$jobs") || touch "$failed"; } | tee "$log"

# ctest says "95% tests passed, 1 tests failed out of 20".
awk '/tests passed,/ { failed = $4; total = $NF; found = 1 }
     END { if (!found) failed = total = 1
           printf "%d passed, %d failed\n", total - failed, failed
           exit (failed > 0) }' "$log" || touch "$failed"
[ ! -f "$failed" ]
