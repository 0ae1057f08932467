#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# search_costs.sh [BUILD] [FACES ...]: what the methods of global search cost in four scenes, as in
# the tables of doc/searches.md: nanoseconds per face of the first call and of a later one, the
# exponents of their growth, and bytes per face.
set -eu
build=${1:-build}
[ $# -eq 0 ] || shift
test=$build/tests/unit/collision_searches.release
[ -x "$test" ] || cmake --build "$build" --target unit_tests
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
exec "$test" --costs "$@"
