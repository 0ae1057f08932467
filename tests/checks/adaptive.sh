#!/bin/sh
# adaptive.sh PROGRAM PROJECT FOLDER: meshes that change. Hanging nodes on either side
# of a contact pass the patch test; history goes over to a new mesh without loss; the
# error of Hertz contact falls; sliding on a mesh that follows is sliding on a fine
# mesh; all the same on any number of ranks.
set -eu
. "$(dirname -- "$0")/common.sh"
tests=$source/tests
prm=$source/prm

# patch NAME RANKS SCENE [OPTIONS]
patch() {
  patch_name=$1 patch_ranks=$2 patch_scene=$3
  shift 3
  run "$patch_name" "$patch_ranks" "$tests/adaptive_patch_$patch_scene.prm" "$@"
  below "$patch_name" stress_max_deviation \
    "$(value "$patch_name" /errors/stress_max_deviation)" 1e-10
}

for side in slave master both; do
  patch "$side" 1 $side
  patch "${side}_2" 2 $side
  patch "${side}_3" 3 $side
  same "$side" "${side}_2" 1e-8
  same "$side" "${side}_3" 1e-8
  patch "${side}_degree_2" 2 $side --set "Discretisation/Degree=2"
  patch "${side}_multipliers" 1 $side --set "Contact/Enforcement=lagrange multipliers"
  patch "${side}_augmented" 1 $side --set "Contact/Enforcement=augmented lagrange"
done

# Pressed, then sheared below the limit of friction; then the mesh changes under a
# constant load. The stress stays uniform, and all nodes stick.
stick() {
  stick_name=$1 stick_ranks=$2
  shift 2
  shear="1.176 * min(max(t - 1, 0), 1)"
  for body in base block; do
    set -- "$@" --set "Body $body/Boundary left/Traction z=-$shear" \
      --set "Body $body/Boundary right/Traction z=$shear"
  done
  run "$stick_name" "$stick_ranks" "$prm/benchmarks/sliding_block_force.prm" \
    --set "Body block/Boundary top/Traction x=$shear" \
    --set "Load stepping/End time=3" --set "Load stepping/Steps=3" \
    --set "Refinement/Estimator=region" --set "Refinement/Cycles=0" \
    --set "Refinement/Region=if(t > 2.5, 0.3 - (x - 1.2)^2 - (z - 0.1)^2, -1)" "$@"
  below "$stick_name" stress_max_deviation \
    "$(value "$stick_name" /errors/stress_max_deviation)" 1e-10
}
stick stick 1
stick stick_2 2
same stick stick_2 1e-8
stick stick_finite 1 --set "Contact pair contact/Sliding=finite"
stick stick_regularised 1 --set "Contact/Friction=regularised"
stick stick_penalty 1 --set "Contact/Enforcement=penalty"

# Press fit: the pressure on a mesh with hanging nodes.
run fit 1 "$tests/press_fit.prm" --set "Contact pair fit/Pairing=averaged" \
  --set "Refinement/Estimator=region" --set "Refinement/Cycles=1" --set "Refinement/Region=y - x"
below fit "mean pressure" "$(value fit /errors/contact_pressure_mean)" 5e-3
below fit "largest pressure" "$(value fit /errors/contact_pressure_max_deviation)" 2e-2

# Hertz: the error of the pressure profile, and ranks.
run hertz 1 "$tests/adaptive_hertz.prm"
run hertz_2 2 "$tests/adaptive_hertz.prm"
run hertz_3 3 "$tests/adaptive_hertz.prm"
same hertz hertz_2 1e-8
same hertz hertz_3 1e-8
below hertz pressure_l2 "$(value hertz /errors/pressure_l2)" 0.07

run hertz_finer 1 "$prm/hertz_sphere_adaptive.prm"
below hertz_finer pressure_l2 "$(value hertz_finer /errors/pressure_l2)" 0.01
# Few cells and many cycles: where slave faces became finer than the master faces they met,
# the peak was off by 3.9e-2 and the profile by 1.35e-2.
run hertz_cycles 1 "$prm/hertz_sphere_adaptive.prm" --set "Refinement/Cycles=5" \
  --set "Refinement/Refine fraction=0.3"
# The pressure is per reference area, the exact one per deformed area, which is 0.6 % smaller under
# the peak: per deformed area the peak is off by 1e-3.
below hertz_cycles peak_pressure "$(value hertz_cycles /errors/peak_pressure)" 8e-3
below hertz_cycles pressure_l2 "$(value hertz_cycles /errors/pressure_l2)" 8e-3

# Sliding.
run sliding 1 "$tests/adaptive_sliding.prm"
run sliding_2 2 "$tests/adaptive_sliding.prm"
same sliding sliding_2 1e-8
run sliding_fine 1 "$tests/adaptive_sliding.prm" --set "Refinement/Estimator=none" \
  --set "Discretisation/Refinement factor=4"
for direction in 1 3; do
  below sliding "reaction $direction against a fine mesh" \
    "$(echo "$(value sliding /results/reactions/block/top $direction)" \
      "$(value sliding_fine /results/reactions/block/top $direction)" |
      awk '{ d = $1 / $2 - 1; print d < 0 ? -d : d }')" 0.01
done
finish
