#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run the tests on one rank with several kernels of OpenBLAS, as on other processors: their
# sums differ by round-off, and nothing that a golden holds may follow it.
#
# Usage: contrib/test_kernels.sh [--build BUILD] [--tests REGEX] [KERNEL...]
#
# BUILD: a build directory with its tests (build). REGEX: names of tests (all scenes and
# drive_* on one rank). KERNEL: SkylakeX (needs AVX-512), Haswell (AVX2), Nehalem, ...; the
# first two and the last without any. The exit code is 1 if a test fails.
set -u
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
build=$root/build pattern=.
while [ $# -gt 1 ]; do
  case $1 in
    --build) build=$(realpath "$2") ;;
    --tests) pattern=$2 ;;
    *) break ;;
  esac
  shift 2
done
if [ $# -eq 0 ]; then
  set -- Haswell Nehalem
  ! grep -q avx512vl /proc/cpuinfo || set -- SkylakeX "$@"
fi
type=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' "$build/CMakeCache.txt" | tr '[:upper:]' '[:lower:]')
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 TOUCHSTONE_OPTIONS="--results-only --output results"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
unset LD_PRELOAD
failures=0
for kernel in "$@"; do
  export OPENBLAS_CORETYPE=$kernel
  # A library that is not OpenBLAS, or was built for one processor, takes no notice.
  OPENBLAS_VERBOSE=2 "$build/touchstone" --version 2>&1 | grep -q "Core: $kernel" ||
    { echo "$kernel: this BLAS does not take that kernel"; exit 1; }
  count=0
  for golden in "$root"/tests/*.output; do
    name=$(basename "$golden" .output)
    case $name in *.mpirun=*) continue ;; esac
    echo "$name" | grep -Eq "$pattern" || continue
    folder=$build/tests/kernels/$kernel/$name
    mkdir -p "$folder" && cd "$folder" || exit 1
    if [ -e "$root/tests/$name.prm" ]; then
      program=$build/touchstone scene=$root/tests/$name.prm
    elif [ "${name#drive_}" != "$name" ] && [ -x "$build/tests/unit/$name.$type" ]; then
      program=$build/tests/unit/$name.$type scene=
    else
      continue
    fi
    count=$((count + 1))
    timeout 300 "$program" ${scene:+"$scene"} >output 2>errors
    code=$?
    # As run_golden.sh compares.
    numdiff -a 1e-6 -r 1e-8 -s ' \t\r\n=,:;<>[](){}^' "$golden" output >difference ||
      code="$code, and differences"
    if [ "$code" != 0 ]; then
      echo "$kernel: $name FAILED (exit code $code), see $folder"
      grep '^ *\(<==\|==>\)' difference | head -6
      failures=$((failures + 1))
    fi
  done
  echo "$kernel: $count tests, $failures failures so far"
done
[ "$failures" -eq 0 ]
