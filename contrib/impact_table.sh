#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Impact of two bars with several schemes, masses and steps: the table of
# doc/time_integration.md.
#
# Usage: contrib/impact_table.sh [PROGRAM [CELLS]]      (build/touchstone 200)
set -eu
program=${1:-build/touchstone}
cells=${2:-200}
cd "$(dirname -- "$0")/.."
runs=output/impact_table
mkdir -p "$runs"

echo "| scheme | mass | Courant number | stress, mean | overshoot | duration | energy | openings |"
echo "|---|---|---|---|---|---|---|---|"

# row NAME MASS [OPTIONS]: at each Courant number; the end time is 50 passages of a
# cell on a mesh of 20.
row() {
  scheme=$1 mass=$2
  shift 2
  for courant in 0.25 0.5 1 2 10; do
    steps=$(awk -v c="$courant" -v n="$cells" 'BEGIN { print 2.5 * n / c }')
    if "$program" --results-only --output "$runs" --set "Output/VTU interval=0" \
      --set "Body left/Geometry/Cells=$cells,1,1" --set "Body right/Geometry/Cells=$cells,1,1" \
      --set "Load stepping/Steps=$steps" --set "Time integration/Mass=$mass" "$@" \
      prm/benchmarks/two_bars.prm >"$runs/text" 2>&1; then
      awk -v name="| $scheme | $mass | $courant |" '
        /^Error/ { sub(/:/, "", $2); value[$2] = $3 }
        /^  opened/ { openings = $2 }
        END { printf "%s %+.2f %% | %+.1f %% | %+.2f %% | %+.3f %% | %d |\n", name,
                100 * value["contact_stress"], 100 * value["stress_overshoot"],
                100 * value["contact_duration"], 100 * value["energy"], openings }' "$runs/text"
    else
      echo "| $scheme | $mass | $courant | $(grep -a '^Not converged\|error' "$runs/text" | head -n 1) |"
    fi
  done
}

key="Time integration/Scheme"
row newmark lumped --set "$key=newmark"
row "newmark, γ = 0.65" lumped --set "$key=newmark" --set "Time integration/Newmark gamma=0.65"
row "hht, α = 0.2" consistent --set "$key=hht" --set "Time integration/HHT alpha=0.2"
row "generalized_alpha, ρ = 0.8" consistent --set "$key=generalized_alpha" \
  --set "Time integration/Spectral radius=0.8"
row contact_stabilized lumped --set "$key=contact_stabilized" \
  --set "Time integration/Spectral radius=1"
row contact_stabilized "dispersion corrected" --set "$key=contact_stabilized" \
  --set "Time integration/Spectral radius=1"
row "generalized_alpha, ρ = 1" "dispersion corrected"
