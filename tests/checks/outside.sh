#!/bin/sh
# outside.sh PROGRAM PROJECT FOLDER: the program of contrib/skeletons/outside, which has a
# main() of its own, is configured and built with the installed library and run; and is
# configured and compiled with the sources by add_subdirectory(). There the library would
# be compiled anew, several minutes: that is left out unless TOUCHSTONE_OUTSIDE=full.
set -eu
. "$(dirname -- "$0")/common.sh"
build=$(dirname -- "$program")
sample=$source/contrib/skeletons/outside

step() {
  what=$1
  shift
  "$@" >"$what.log" 2>&1 || { fail "$what: $*"; tail -n 30 "$what.log"; finish; }
}

rm -rf prefix installed subdirectory
step install cmake --install "$build" --prefix "$folder/prefix"
step configure cmake -S "$sample" -B installed -DCMAKE_PREFIX_PATH="$folder/prefix" \
  -DCMAKE_BUILD_TYPE=Release
step build cmake --build installed
step run installed/outside "$source/prm/patch_test.prm"
grep -q '^step 1, t = 1: largest displacement 0.[0-9]*, largest pressure [0-9.]*$' run.log ||
  fail "unexpected output: $(cat run.log)"
echo "nonsense" >bad.prm
if installed/outside bad.prm >bad.log 2>&1; then fail "a bad scene has exit code 0"; fi

step configure_subdirectory cmake -G "Unix Makefiles" -S "$sample" -B subdirectory \
  -DCMAKE_BUILD_TYPE=Release -DTOUCHSTONE_SOURCE_DIR="$source" -DTOUCHSTONE_UNITY=ON
grep -q 'TOUCHSTONE_TESTS:BOOL=OFF' subdirectory/CMakeCache.txt ||
  fail "the tests are configured though the project is not at the top"
if [ "${TOUCHSTONE_OUTSIDE:-}" = full ]; then
  step build_subdirectory cmake --build subdirectory -j2 --target outside
  step run_subdirectory subdirectory/outside "$source/prm/patch_test.prm"
  cmp run.log run_subdirectory.log || fail "another result with add_subdirectory"
else
  # The object file alone: headers, flags and definitions must come with the target.
  step compile_subdirectory cmake --build subdirectory --target main.cc.o
fi
finish
