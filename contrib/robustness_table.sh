#!/bin/sh
# Print the table of doc/robustness.md: runs all hard cases (tests/checks/hard_cases.sh).
#
# Usage: contrib/robustness_table.sh [PROGRAM] [FOLDER]     (build/touchstone, output/robustness)
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
program=$(realpath "${1:-$root/build/touchstone}")
mkdir -p "${2:-$root/output/robustness}"
folder=$(CDPATH= cd -- "${2:-$root/output/robustness}" && pwd)
sh "$root/tests/checks/hard_cases.sh" "$program" "$root" "$folder" >"$folder/report" 2>&1 ||
  grep '^FAILED' "$folder/report" >&2
cat "$folder/robustness.md"
