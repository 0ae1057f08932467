#!/bin/sh
# extending.sh PROGRAM PROJECT FOLDER: the table of doc/extending.md names every sample of
# contrib/skeletons with its number of lines, and no other file; and every sample is compiled
# and run by a test.
set -eu
. "$(dirname -- "$0")/common.sh"
page=$source/doc/extending.md
samples=$source/contrib/skeletons

sed -n 's/^| [^|]* | `\([a-z_/]*\.cc\)` | \([0-9]*\) |.*| 0 |$/\1 \2/p' "$page" | sort >named
for file in "$samples"/*.cc "$samples"/outside/main.cc; do
  echo "${file#"$samples"/} $(awk 'END { print NR }' "$file")"
done | sort >there
diff named there || fail "doc/extending.md (<) and contrib/skeletons (>) differ: files and their lines"

for file in "$samples"/*.cc; do
  grep -q "skeletons/${file##*/}" "$source"/tests/extending_*.cc ||
    fail "no test compiles contrib/skeletons/${file##*/}"
done
for file in $(grep -o '`[a-z_]*\.prm`' "$page" | tr -d '`'); do
  [ -f "$samples/$file" ] || [ -f "$source/doc/$file" ] || fail "doc/extending.md names $file"
done

finish
