#!/bin/sh
# agreement.sh PROGRAM PROJECT FOLDER: what must be the same is the same: one rank
# and two, elimination and multipliers (1e-8), MUMPS and Belos CG or GMRES (1e-6), one
# load step and ten, and the same scene in other units.
set -eu
. "$(dirname -- "$0")/common.sh"
tests=$source/tests

multipliers="Contact/Enforcement=lagrange multipliers"
belos="Linear solver/Type=Belos CG"
sharp="Newton/Residual tolerance=1e-10"

all_ways() {
  name=$1 scene=$2
  shift 2
  run "$name" 1 "$scene" "$@"
  run "$name-2" 2 "$scene" "$@"
  same "$name" "$name-2" 1e-8 newton=1
  run "$name-multipliers" 1 "$scene" --set "$multipliers" "$@"
  same "$name" "$name-multipliers" 1e-8
  run "$name-belos" 1 "$scene" --set "$belos" "$@"
  same "$name" "$name-belos" 1e-6
  run "$name-belos-2" 2 "$scene" --set "$belos" "$@"
  same "$name" "$name-belos-2" 1e-6
}

all_ways press_fit "$tests/press_fit.prm"
all_ways non_matching "$tests/press_fit_fine_slave.prm" --set "$sharp"
# A gap of 1e-8 faces, the default tolerance, makes 2e-7 of the force.
closed="Newton/Gap tolerance=1e-11"
all_ways two_tubes "$source/prm/two_tubes.prm" --set "Load stepping/Steps=1" --set "$sharp" \
  --set "$closed"
all_ways hertz "$tests/hertz_sphere.prm" --set "$sharp"
all_ways tied "$tests/tied_non_matching.prm"
all_ways sphere "$tests/sphere_obstacle.prm" --set "$sharp"

gmres="Linear solver/Type=Belos GMRES"
run non_matching-gmres 1 "$tests/press_fit_fine_slave.prm" --set "$sharp" --set "$gmres"
same non_matching non_matching-gmres 1e-6
run tied-gmres-2 2 "$tests/tied_non_matching.prm" --set "$gmres"
same tied tied-gmres-2 1e-6

# Without friction the way to the load does not count.
run one_step 1 "$tests/sphere_obstacle.prm" --set "$sharp" --set "Load stepping/Steps=1"
run ten_steps 1 "$tests/sphere_obstacle.prm" --set "$sharp" --set "Load stepping/Steps=10"
same one_step ten_steps 1e-8
run tubes_ten_steps 1 "$source/prm/two_tubes.prm" --set "$sharp" --set "$closed" \
  --set "Load stepping/Steps=10"
same two_tubes tubes_ten_steps 1e-7

# N, mm, MPa and N, m, Pa: the same iterations.
run units_mm 1 "$tests/units_mm.prm"
run units_si 1 "$tests/units_si.prm"
same units_mm units_si 1e-8 newton=1 moment=1e-3 area=1e-6 max_pressure=1e6

finish
