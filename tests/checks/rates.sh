#!/bin/sh
# rates.sh PROGRAM PROJECT FOLDER: exact and manufactured solutions whose contact pressure varies
# along the interface, each on four meshes (doc/benchmarks.md, "Rates of convergence"). The
# exponents of displacement and contact pressure in the cell size, errors in the norm of L2, are
# fitted by least squares and have lower bounds.
set -eu
. "$(dirname -- "$0")/common.sh"
scenes=$source/tests/checks
table=$folder/table.md
printf '| solution | displacement | rate | pressure | rate |\n|---|---|---|---|---|\n' >"$table"

# rates TITLE SCENE DEGREE DISPLACEMENT PRESSURE MASTER SLAVE MESHES: the fitted exponents are
# at least DISPLACEMENT and PRESSURE. MASTER and SLAVE are the entries of the bodies' cells with
# k for the number of the mesh, '3*k, 1, 2*k', MESHES the values of k.
rates() {
  title=$1 name=$2 degree=$3 displacement=$4 pressure=$5
  case $name in curved) master=inner slave=outer ;; *) master=lower slave=upper ;; esac
  errors=$folder/errors
  : >"$errors"
  for k in $8; do
    run mesh 1 "$scenes/rates_$name.prm" --set "Discretisation/Degree=$degree" \
      --set "Body $master/Geometry/Cells=$(cells "$6" "$k")" \
      --set "Body $slave/Geometry/Cells=$(cells "$7" "$k")"
    echo "$k $(value mesh /errors/displacement_l2) $(value mesh /errors/pressure_l2)" >>"$errors"
  done
  line=$(fit 2) # first and last error, exponent
  above "$title, displacement" "${line##* }" "$displacement"
  row="| $title | ${line% *} | ${line##* } |"
  line=$(fit 3)
  above "$title, pressure" "${line##* }" "$pressure"
  echo "$row ${line% *} | ${line##* } |" >>"$table"
}

# cells LIST K: the list with its products "3*k" computed.
cells() {
  echo "$1" | awk -F ', ' -v k="$2" '{
    for (i = 1; i <= NF; ++i) {
      n = split($i, factor, "[*]")
      printf "%s%d", (i > 1 ? ", " : ""), (n > 1 ? factor[1] * k : $i)
    } }'
}

# fit COLUMN: the errors on the coarsest and finest mesh and the exponent, or "missing".
fit() {
  awk -v column="$1" '
    $column !~ /^[0-9]/ || $column + 0 <= 0 { bad = 1; next }
    { x = log($1); y = -log($column); last = $column; if (!n++) first = last
      sx += x; sy += y; sxx += x * x; sxy += x * y }
    END { if (bad || n != 4) print "missing"
          else printf "%.1e to %.1e %.2f\n", first, last, (n * sxy - sx * sy) / (n * sxx - sx * sx) }' \
    "$errors"
}

# above WHAT EXPONENT BOUND
above() {
  if awk -v x="$2" -v bound="$3" 'BEGIN { exit !(x ~ /^[0-9]/ && x + 0 >= bound) }'; then
    echo "$1: exponent $2, at least $3"
  else
    fail "$1: exponent $2 is less than $3"
  fi
}

four="1 2 4 8"
rates "flat, matching" wave 1 1.9 1.5 '4*k, 1, 4*k' '4*k, 1, 4*k' "$four"
rates "flat, 3 : 2" wave 1 1.9 1.5 '6*k, 1, 6*k' '4*k, 1, 4*k' "$four"
rates "flat, 3 : 2, degree 2" flat 2 2.4 1.5 '3*k, 1, 3*k' '2*k, 1, 2*k' "1 2 4 6"
rates "friction, 3 : 2" friction 1 1.9 1.5 '6*k, 1, 6*k' '4*k, 1, 4*k' "$four"
rates "curved, matching" curved 1 1.9 1.0 '2*k, 4*k, 1' '2*k, 4*k, 1' "$four"
rates "curved, 3 : 2" curved 1 1.9 1.0 '3*k, 6*k, 1' '2*k, 4*k, 1' "$four"
rates "curved, 3 : 2, degree 2" curved 2 2.4 1.5 '3*k, 6*k, 1' '2*k, 4*k, 1' "1 2 3 4"
# The pressure has a slope at the edges of the slave surface, where nodal pressures are of the
# first order in the cell size: the exponent tends to 1.5 from below.
rates "in space, 3 : 2, with edges" space 1 1.9 1.4 '3*k, 3*k, 3*k' '2*k, 2*k, 2*k' "1 2 3 4"
cat "$table"
finish
