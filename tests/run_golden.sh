#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# run_golden.sh BUILD TARGET GOLDEN FOLDER NORMALIZE COMMAND...: what the command prints in the
# empty folder FOLDER, made comparable by deal.II's script NORMALIZE, is the golden: numbers to
# 1e-8 of their size or 1e-6. A test that writes a file 'output' is judged by that instead.
set -u
build=$1 target=$2 golden=$3 folder=$4 normalize=$5
shift 5

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder" || exit 1
# Tests that run at the same time must not build at the same time.
if [ -z "${TOUCHSTONE_TESTS_BUILT:-}" ]; then
  flock "$build/tests/lock" cmake --build "$build" --target "$target" >built 2>&1 ||
    { cat built; echo "$target: not built"; exit 1; }
fi
"$@" >stdout 2>&1
code=$?
[ -f output ] || cp stdout output
if [ "$code" -ne 0 ]; then
  echo "exit code $code; $folder/output:"
  cat output stdout | head -n 100
  exit 1
fi
perl -pi "$normalize" output
if ! numdiff -a 1e-6 -r 1e-8 -s ' \t\r\n=,:;<>[](){}^' "$golden" output >diff; then
  echo "$folder/output differs from $golden; numdiff, the golden first:"
  head -n 40 diff
  exit 1
fi
