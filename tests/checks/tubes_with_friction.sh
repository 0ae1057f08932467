#!/bin/sh
# tubes_with_friction.sh PROGRAM PROJECT FOLDER: the conical insertion with a
# coefficient of friction of 0.2 has one answer: the push force is the same to 1e-6 with
# every exact enforcement, solver and number of ranks, to 1e-4 with springs, and to 1 % in
# 1, 4 and 16 steps; the two planes of symmetry bear the same force to 1e-8. A row that
# comes into contact within a step shows in each of these.
set -eu
. "$(dirname -- "$0")/common.sh"

# push NAME RANKS REFERENCE BOUND OPTIONS: the push force lies within BOUND of REFERENCE.
push() {
  name=$1 ranks=$2 reference=$3 bound=$4
  shift 4
  run "$name" "$ranks" "$source/prm/two_tubes.prm" \
    --set "Contact pair cone/Behaviour=coulomb" --set "Contact pair cone/Friction/Coefficient=0.2" \
    "$@"
  force=$(value "$name" /results/reactions/inner_tube/end)
  below "$name" "push force $force differs from $reference" "$(relative "$force" "$reference")" \
    "$bound"
  below "$name" "forces on the planes of symmetry differ" \
    "$(relative "$(value "$name" /results/reactions/inner_tube/first_cut 3)" \
      "$(value "$name" /results/reactions/inner_tube/second_cut 2)")" 1e-8
}

relative() {
  awk -v a="$1" -v b="$2" 'BEGIN { d = a / b - 1; print d < 0 ? -d : d }'
}

# Large-sliding integral contact of a general finite element library gives 672.7.
gmres="Linear solver/Type=Belos GMRES"
push elimination 1 -672.7 3e-3 --set "$gmres"
answer=$force
push elimination_2 2 "$answer" 1e-8 --set "$gmres"
push conjugate_gradients 1 "$answer" 1e-6 --set "Linear solver/Type=Belos CG"
push direct 1 "$answer" 1e-6 --set "Linear solver/Type=MUMPS"
push multipliers 1 "$answer" 1e-6 --set "Contact/Enforcement=lagrange multipliers"
push augmented 1 "$answer" 1e-6 --set "Contact/Enforcement=augmented lagrange" --set "$gmres"
push regularised 1 "$answer" 1e-4 --set "Contact/Friction=regularised" --set "$gmres"
push penalty 1 "$answer" 1e-2 --set "Contact/Enforcement=penalty"
push stiff_penalty 1 "$answer" 1e-5 --set "Contact/Enforcement=penalty" --set "$gmres" \
  --set "Contact/Penalty factor=100" --set "Contact/Linearisation=consistent"
below stiff_penalty "Newton iterations in 4 steps" "$(value stiff_penalty /iterations/newton)" 24
below stiff_penalty "iterations of GMRES in the mean" \
  "$(value stiff_penalty /iterations/linear_mean)" 20
push one_step 1 "$answer" 1e-2 --set "$gmres" --set "Load stepping/Steps=1"
push sixteen_steps 1 "$answer" 1e-2 --set "$gmres" --set "Load stepping/Steps=16"

# No harder with more friction.
for coefficient in 0.5 1; do
  run "coefficient_$coefficient" 1 "$source/prm/two_tubes.prm" --set "$gmres" \
    --set "Contact pair cone/Behaviour=coulomb" \
    --set "Contact pair cone/Friction/Coefficient=$coefficient"
  below "coefficient_$coefficient" "Newton iterations in 4 steps" \
    "$(value "coefficient_$coefficient" /iterations/newton)" 48
done

# Pointwise rows are another discretisation with an answer of their own.
run pointwise 1 "$source/prm/two_tubes.prm" --set "$gmres" \
  --set "Contact pair cone/Behaviour=coulomb" --set "Contact pair cone/Friction/Coefficient=0.2" \
  --set "Contact pair cone/Pairing=pointwise"
below pointwise "push force differs from -672.7" \
  "$(relative "$(value pointwise /results/reactions/inner_tube/end)" -672.7)" 1e-2
finish
