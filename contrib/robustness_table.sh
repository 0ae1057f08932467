#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Print the tables of doc/robustness.md: runs all hard cases (tests/checks/hard_cases.py), and
# the scenes below as they are shipped: no key but those that make the case is set.
#
# Usage: contrib/robustness_table.sh [PROGRAM] [FOLDER]     (build/touchstone, output/robustness)
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
program=$(realpath "${1:-$root/build/touchstone}")
mkdir -p "${2:-$root/output/robustness}"
folder=$(CDPATH= cd -- "${2:-$root/output/robustness}" && pwd)
python3 "$root/tests/checks/hard_cases.py" "$program" "$root" "$folder" >"$folder/report" 2>&1 ||
  grep '^FAILED' "$folder/report" >&2
cat "$folder/robustness.md"

export OPENBLAS_NUM_THREADS=1
unset TOUCHSTONE_OPTIONS
printf '\n| case | scene | steps | cut | Newton | penetration | test |\n|---|---|---|---|---|---|---|\n'
# CASE | SCENE below tests | TEST | OPTIONS
while IFS='|' read -r title scene test options; do
  rm -rf "$folder/scene"
  eval "timeout 120 \"\$program\" --results-only --output \"\$folder/scene\" --set 'Output/VTU interval=0' \
    $options \"\$root/tests/\$scene.prm\"" >"$folder/scene.txt" 2>&1 </dev/null && code=0 || code=$?
  if [ "$code" -ne 0 ]; then
    result="– | – | ends with exit code $code | –"
  else
    cuts=$(awk '!/^#/ { sum += $6; ++steps } END { print steps, "|", sum + 0 }' "$folder/scene/statistics")
    result="$cuts | $(sed -n 's/^ *"newton": \([0-9]*\).*/\1/p' "$folder/scene/summary.json" | head -n 1) | $(
      sed -n 's/.*"max_penetration": \([^,]*\).*/\1/p' "$folder/scene/summary.json" |
        awk '{ if ($1 > x) x = $1 } END { printf "%.0e", x }')"
  fi
  echo "| $title | \`$scene\` | $result | $test |"
done <<'END'
held by contact alone|held_by_contact|golden
held by contact alone, Belos CG|held_by_contact_belos|golden
held by contact alone, a gap first|held_by_contact_gap|golden
held by another body alone|held_by_a_body|golden
half a washer, held by friction beside a plane of symmetry|checks/friction_beside_symmetry|checks/friction_hard
block pushed by its slave nodes|checks/friction_driven_nodes|checks/friction_hard
belt on a drum, slip reverses|checks/friction_belt|checks/friction_hard
slave node with a prescribed displacement|dirichlet_on_slave|golden
the same, multipliers|dirichlet_on_slave_multipliers|golden
a slave boundary in two pairs|two_pairs|golden
the same, multipliers|two_pairs_multipliers|golden
the same pair twice|same_pair_twice|golden
both sides are slaves|checks/two_pass|checks/two_pass
three bodies in a ring of pairs|checks/ring|checks/circles
block in a V of two planes|v_block|golden
off the edge|off_the_edge|golden
off the edge, slave and master swapped|off_the_edge_swapped|golden
plate pressed over the edge of a pad|checks/pressed_over_edge|checks/partial_cover
sliding over an edge|checks/sliding_edge|checks/partial_cover
90 % of the slave surface faces nothing|checks/slave_larger_than_master|checks/partial_cover
ball that touches two plates, or nearly|checks/ball_between_plates|checks/partial_cover
boxes on their edges, crossed|crossed_edges|golden, checks/edge_contact
edges of turned cubes that cross|edge_across_edge|golden, checks/edge_contact
a vertex inside a slave face|vertex_in_slave_face|golden, checks/edge_contact
overlap larger than a cell|large_overlap|golden
rings that overlap by four cells|deep_overlap|golden
gap closed under load|gap_closed|golden
soft on stiff|soft_on_stiff|golden
stiff on soft|stiff_on_soft|golden
stiff slave|stiff_slave|golden
soft on stiff, Belos CG|stiffness_ratio_belos|golden
coarse slave, non-matching|patch_coarse_slave|golden
press fit 4 : 3, coarse slave|press_fit_coarse_slave|golden
press fit, facets that do not match|press_fit_non_matching_faceted|golden
two tubes, facets|two_tubes_faceted|golden
two tubes in one step, Belos CG|two_tubes_one_step_belos|golden
soft ball squeezed, large strain|squeezed_ball|golden
nearly incompressible strip bent by contact|large_bending|golden
nearly incompressible, B-bar|nearly_incompressible_b_bar|golden
strip that carries as a rope|rope|golden
plastic blocks, finite strain|plastic_patch_finite|golden
sphere as an obstacle|sphere_obstacle|golden
the same, multipliers|sphere_obstacle_multipliers|golden
inside a rigid bore|cylinder_inside|golden
obstacle that moves|moving_plane|golden
the mesh follows the contact|adaptive_sliding|golden
through a thin plate|checks/thin_plate|checks/thin_bodies
block that bounces|bouncing_block|golden
oblique impact with friction|oblique_impact|golden
impact after Hertz|hertz_impact|golden
END
