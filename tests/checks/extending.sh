#!/bin/sh
# extending.sh PROGRAM PROJECT FOLDER: each sample of doc/extending.md is, line for
# line, the file of contrib/skeletons that the page names before it, and no file
# is missing. The unit tests extending_* compile and run them.
set -eu
. "$(dirname -- "$0")/common.sh"
page=$source/doc/extending.md
samples=$source/contrib/skeletons

rm -rf samples
mkdir samples
# A sample is the code after a line that ends with the name of its file.
awk '
  /^```/ && inside { inside = 0; close(file); next }
  /^```/           { inside = 1; file = "samples/" (name == "" ? "unnamed" : name); next }
  inside           { print > file; next }
  /contrib\/skeletons\/[a-z_]+\.[a-z]+`:$/ {
    name = $0; sub(/.*contrib\/skeletons\//, "", name); sub(/`:$/, "", name); next
  }
  /[^ ]/           { name = "" }' "$page"
rm -f samples/unnamed

for file in "$samples"/*; do
  name=${file##*/}
  [ -f "samples/$name" ] || { fail "doc/extending.md does not show contrib/skeletons/$name"; continue; }
  diff "samples/$name" "$file" || fail "doc/extending.md and contrib/skeletons/$name differ"
done
for file in samples/*; do
  [ -f "$samples/${file##*/}" ] || fail "doc/extending.md names ${file##*/}, which does not exist"
done

finish
