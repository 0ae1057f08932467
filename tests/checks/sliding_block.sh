#!/bin/sh
# sliding_block.sh PROGRAM PROJECT FOLDER: the limit of friction. A block that is
# pushed by a displacement needs mu N in full slip (1e-6) with every enforcement and
# solver; pushed by 0.98 mu N it sticks at all nodes, and pushed by 1.02 mu N there
# is no equilibrium, which the program must say.
set -eu
. "$(dirname -- "$0")/common.sh"
prm=$source/prm/benchmarks

# column NAME TITLE: the last value of a column of the run's statistics.
column() {
  awk -v title="$2" '
    /^#/ { number = $2 + 0; sub(/^# [0-9]+: /, ""); if ($0 == title) wanted = number; next }
    { last = $wanted }
    END { print wanted ? last : "missing" }' "$1/statistics"
}

# slides NAME RANKS [OPTIONS]
slides() {
  name=$1 ranks=$2
  shift 2
  run "$name" "$ranks" "$prm/sliding_block.prm" "$@"
  below "$name" "reaction differs from mu N" \
    "$(value "$name" /results/reactions/block/top | awk '{ d = $1 / 4.8 - 1; print d < 0 ? -d : d }')" 1e-6
  [ "$(column "$name" 'contact: slip nodes')" = "$(column "$name" 'contact: active nodes')" ] ||
    fail "$name: not all nodes slip"
  below "$name" "nodes that stick" "$(column "$name" 'contact: stick nodes')" 0.5
}

slides elimination 1
slides elimination_2 2
same elimination elimination_2 1e-8
slides gmres 1 --set "Linear solver/Type=Belos GMRES"
same elimination gmres 1e-6
slides multipliers 1 --set "Contact/Enforcement=lagrange multipliers"
same elimination multipliers 1e-8
slides augmented 1 --set "Contact/Enforcement=augmented lagrange"
slides penalty 1 --set "Contact/Enforcement=penalty"

# pushed NAME TRACTION [OPTIONS]: the shear traction on top and sides.
pushed() {
  name=$1 traction=$2
  shift 2
  for body in base block; do
    set -- "$@" --set "Body $body/Boundary left/Traction z=-$traction * max(t - 1, 0)" \
      --set "Body $body/Boundary right/Traction z=$traction * max(t - 1, 0)"
  done
  run "$name" 1 "$prm/sliding_block_force.prm" \
    --set "Body block/Boundary top/Traction x=$traction * max(t - 1, 0)" "$@"
}

for enforcement in elimination "lagrange multipliers" "augmented lagrange" penalty; do
  name=stick_$(echo "$enforcement" | tr ' ' _)
  pushed "$name" 1.176 --set "Contact/Enforcement=$enforcement"
  [ "$(column "$name" 'contact: stick nodes')" = 27 ] || fail "$name: not all 27 nodes stick"
  below "$name" "stress deviates" "$(value "$name" /errors/stress_max_deviation)" 1e-8
done

# There must be a run that fails: it counts as failure only here.
before=$failures
pushed beyond 1.224 >beyond.report || true
if [ "$failures" -eq "$before" ]; then
  fail "1.02 mu N was held"
else
  failures=$before
  grep -q '^Not converged: .*held by contact alone' beyond.txt || { fail "the reason is missing"; cat beyond.txt; }
fi
finish
