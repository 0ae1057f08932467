#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# record_table.sh [PROGRAM]: Hertz contact of a ball on a block on meshes that follow the edge of
# the contact (prm/benchmarks/hertz_rings.prm), as a Markdown table: unknowns, CPU seconds and
# relative L2 errors of the contact pressure. The first run is made on a coarse mesh around the
# edge of half spaces; the others follow the edge that it finds, and their CPU seconds
# include those of the first. A second table is of partial slip after Cattaneo and Mindlin
# (contrib/record_partial_slip.prm), whose meshes follow the edges of stick and contact.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
program=${1:-$root/build/touchstone}
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# number KEY: the first of that name in the summary.
number() {
  awk -v key="\"$1\":" '$1 == key { sub(",", "", $2); print $2; exit }' "$folder/run/summary.json"
}

# row EDGE CONSTANTS: run, and print a line.
row() {
  rm -rf "$folder/run"
  /usr/bin/time -f %U -o "$folder/time" "$program" --output "$folder/run" \
    --set "Output/VTU interval=0" --set "Constants=e = $1, $2" \
    "$root/prm/benchmarks/hertz_rings.prm" >"$folder/text" 2>&1 ||
    { cat "$folder/text" >&2; exit 1; }
  cpu=$(echo "$(tail -n 1 "$folder/time") ${first:-0}" | awk '{ printf "%.2f", $1 + $2 }')
  printf '| %s | %s | %s | %s | %.2e | %.2e |\n' "$(echo "$2" | tr -d ' ')" "$(number unknowns)" \
    "$(number newton)" "$cpu" "$(number pressure_field_l2)" "$(number pressure_l2)"
}

echo "| mesh | unknowns | Newton | CPU s | pressure, L2 of the field | L2 of nodal values |"
echo "|---|---|---|---|---|---|"
row 0.1 "n = 4, h = 0.002, s = 0.015, c = 0.03"
first=$cpu
# a = (3 P R / 4 E*)^(1/3) at the force of the whole model.
edge=$(sed -n 's/^force of the whole model: //p' "$folder/text" | tail -n 1 |
  awk '{ printf "%.5f", exp(log(3 * $1 * 100 / (4 * 210000 / (2 * (1 - 0.09)))) / 3) }')
row "$edge" "n = 6, h = 0.001, s = 0.008, c = 0.03"
row "$edge" "n = 8, h = 0.0003, s = 0.005, c = 0.02"
row "$edge" "n = 12, h = 0.0003, s = 0.005, c = 0.03"
row "$edge" "n = 12, h = 0.0002, s = 0.004, c = 0.025, k = 1.35"
row "$edge" "n = 14, h = 0.0003, s = 0.003, c = 0.02, g = 1.3"
row "$edge" "n = 14, h = 0.00025, s = 0.0025, c = 0.02, g = 1.3"
# Wherever the edge lies in its ring: moved outwards by parts of the narrowest one.
for part in 0.25 0.5 0.75; do
  row "$(echo "$edge $part" | awk '{ printf "%.6f", $1 + $2 * 0.0003 }')" \
    "n = 14, h = 0.0003, s = 0.003, c = 0.02, g = 1.3"
done

# slip EDGES SIZE LARGEST GROWTH LAYER: the same for partial slip; finds the edges.
slip() {
  python3 "$root/contrib/graded_cylinders.py" "$folder/cylinders.msh" "$1" "$2" "$3" "$4" \
    layer="$5" outer=2 radius=10000 width=200 height=200
  rm -rf "$folder/run"
  /usr/bin/time -f %U -o "$folder/time" "$program" --output "$folder/run" \
    --set "Output/VTU interval=0" "$folder/partial_slip.prm" >"$folder/text" 2>&1 ||
    { cat "$folder/text" >&2; exit 1; }
  cpu=$(echo "$(tail -n 1 "$folder/time") ${first:-0}" | awk '{ printf "%.2f", $1 + $2 }')
  printf '| h = %s, s = %s, g = %s, k = %s | %s | %s | %s | %.2e | %.2e | %.1e |\n' "$2" "$3" "$4" \
    "$5" "$(number unknowns)" "$(number newton)" "$cpu" "$(number shear_traction_field_l2)" \
    "$(number pressure_field_l2)" "$(number stick_half_width)"
  # a^2 = 4 P R / (pi E*) and c = a (1 - Q / (mu P))^(1/2), with 1/R = 2/10000 and E* of two bodies.
  edges=$(sed -n 's/.*P \([^,]*\), Q [^,]*, Q\/(mu P) \(.*\)$/\1 \2/p' "$folder/text" | tail -n 1 |
    awk '{ a = sqrt(4 * $1 * 5000 * 2 * (1 - 0.09) / (atan2(0, -1) * 210000))
           printf "%.5f,%.5f", a * sqrt(1 - $2), a }')
}

first=0
cp "$root/contrib/record_partial_slip.prm" "$folder/partial_slip.prm"
echo
echo "| mesh | unknowns | Newton | CPU s | shear traction, L2 of the field | pressure | stick half-width |"
echo "|---|---|---|---|---|---|---|"
slip 0.5,0.75 0.02 0.1 1.5 1.4
first=$cpu
here=$edges
slip "$edges" 0.01 0.05 1.3 1.3
slip "$edges" 0.005 0.03 1.25 1.25
slip "$edges" 0.003 0.03 1.25 1.25
slip "$edges" 0.0015 0.02 1.2 1.2
# Both edges moved outwards by parts of a cell.
found=$(echo "$here" | tr ',' ' ')
for part in 0.25 0.5 0.75; do
  slip "$(echo "$found $part" | awk '{ printf "%.5f,%.5f", $1 + $3 * 0.003, $2 + $3 * 0.003 }')" \
    0.003 0.03 1.25 1.25
done
