#!/bin/sh
# hard_cases.sh PROGRAM PROJECT FOLDER: contact and friction where they are hard. Each
# case must converge without a cut step and obey: the forces of both sides balance,
# no penetration, no tension, no traction beyond the friction cone. Writes a table of
# what it found to robustness.md, which contrib/robustness_table.sh prints.
set -eu
. "$(dirname -- "$0")/common.sh"
tests=$source/tests
table=$folder/robustness.md
{
  echo "| case | ranks | steps | cut | Newton | forces out of balance | penetration | tension | beyond the cone |"
  echo "|---|---|---|---|---|---|---|---|---|"
} >"$table"

# hard TITLE MASTER MU RANKS SCENE [OPTIONS]: the pair is called "contact", the body
# MASTER has no loads but its supports.
hard() {
  title=$1 master=$2 mu=$3 ranks=$4 scene=$5
  shift 5
  name=$(echo "$title" | tr -c 'a-zA-Z0-9\n' '_')_$ranks
  before=$failures
  run "$name" "$ranks" "$tests/hard_$scene.prm" --set "Output/VTU interval=100000" "$@"
  if [ "$failures" -ne "$before" ]; then
    echo "| $title | $ranks | – | – | not converged | | | | |" >>"$table"
    return 0
  fi
  # Supports of the master carry what the slave is pushed back with.
  balance=$(awk -v master="$master" '
    $2 ~ "^/results/contact/contact/force$" { f[$3] = $4 }
    $2 ~ "^/results/reactions/" master "/" { r[$3] += $4 }
    END { for (i = 1; i <= 3; ++i) { d = f[i] - r[i]; s += d * d; q += f[i] * f[i] }
          print (q > 0 ? sqrt(s / q) : sqrt(s)) }' "$name.numbers")
  penetration=$(value "$name" /results/contact/contact/max_penetration)
  # Of tractions: the least pressure and the worst excess, over the largest pressure.
  # Pictures have six digits.
  set -- $(perl "$source/tests/checks/contact_points.pl" "$name"/contact_*.vtu | awk -v mu="$mu" '
    { p = $7; n = $11 * $8 + $12 * $9 + $13 * $10
      t = sqrt(($11 - n * $8)^2 + ($12 - n * $9)^2 + ($13 - n * $10)^2)
      if (p > top) top = p
      if (-p > tension) tension = -p
      if (t - mu * p > beyond) beyond = t - mu * p; ++count }
    END { s = top > 0 ? top : 1; print tension / s, beyond / s, count + 0 }')
  tension=$1 beyond=$2
  [ "$3" -gt 3 ] || fail "$name: hardly any contact points"
  cuts=$(awk '!/^#/ { sum += $6; ++steps } END { print sum + 0, steps }' "$name/statistics")
  below "$name" "forces out of balance" "$balance" 1e-9
  below "$name" penetration "$penetration" 1e-7
  below "$name" tension "$tension" 1e-6
  below "$name" "beyond the cone" "$beyond" 1e-5
  below "$name" "steps cut" "${cuts% *}" 0.5
  printf '| %s | %d | %d | %d | %d | %.0e | %.0e | %.0e | %.0e |\n' "$title" "$ranks" "${cuts#* }" \
    "${cuts% *}" "$(value "$name" /iterations/newton)" "$balance" "$penetration" "$tension" "$beyond" >>"$table"
}

pair="Contact pair contact"
hard "coefficient 1" base 1 1 mu_one
hard "coefficient 2" base 2 1 mu_two
hard "wedge just below self-locking" incline 0.27 1 wedge
hard "stiffness ratio 1e6" base 0.3 1 stiffness_ratio
hard "both nearly incompressible" base 0.3 1 incompressible
hard "slave 4 times coarser" base 0.3 1 coarse_slave
hard "slave 4 times finer" block 0.3 1 coarse_slave --set "$pair/Slave body=base" \
  --set "$pair/Slave boundaries=top" --set "$pair/Master body=block" \
  --set "$pair/Master boundaries=bottom"
hard "first contact at a corner" base 0.3 1 corner
hard "opening and closing in one step" base 0.3 1 rocking
hard "off the edge and back" base 0.3 1 edge_and_back
hard "slave edge along a master edge" base 0.3 1 edge_on_edge
hard "warped master faces" base 0.3 1 warped_master
hard "ten times too large a step" base 0.3 1 large_step
hard "all contact lost" base 0.3 1 lift_off
for ranks in 1 2; do
  hard "friction lagged beside stiff springs" base 0.3 $ranks warped_master \
    --set "Linear solver/Type=Belos CG" --set "Contact/Enforcement=augmented lagrange" \
    --set "$pair/Pairing=pointwise"
done
for ranks in 2 3 4; do
  hard "off the edge and back" base 0.3 $ranks edge_and_back
  same "off_the_edge_and_back_1" "off_the_edge_and_back_$ranks" 1e-8
done

# Beyond self-locking nothing holds the wedge, and the program must say so.
before=$failures
run wedge_beyond 1 "$tests/hard_wedge.prm" --set "$pair/Friction/Coefficient=0.266" >beyond.report || true
if [ "$failures" -eq "$before" ]; then
  fail "a wedge beyond self-locking was held"
else
  failures=$before
  grep -q '^Not converged: ' wedge_beyond.txt || { fail "the reason is missing"; cat wedge_beyond.txt; }
  echo "| wedge just beyond self-locking | 1 | – | – | refused, as it must | | | | |" >>"$table"
fi
cat "$table"
finish
