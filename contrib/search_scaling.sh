#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# search_scaling.sh [BUILD] [NODES ...]: times of the contact search alone against the
# number of slave nodes, and the exponents of their growth. One million nodes need about 8 GB.
set -eu
build=${1:-build}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- 1e4 3e4 1e5 3e5 1e6
test=$build/tests/unit/contact_search_scaling.release
[ -x "$test" ] || cmake --build "$build" --target contact_search_scaling
export OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
exec "$test" "$@"
