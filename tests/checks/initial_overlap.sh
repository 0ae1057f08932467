#!/bin/sh
# initial_overlap.sh PROGRAM PROJECT FOLDER: what becomes of an overlap of the bodies
# as they are placed. Nothing, if it is adjusted; the same as an interference at the
# end, if it is ramped, and half of it half way there.
set -eu
. "$(dirname -- "$0")/common.sh"
prm=$source/prm
overlap="Contact pair fit/Initial overlap"

# fit NAME [OPTIONS]
fit() {
  name=$1
  shift
  run "$name" 1 "$prm/press_fit.prm" --set "Body inner tube/Geometry/Cells=4, 12, 1" \
    --set "Body outer tube/Geometry/Cells=4, 12, 1" "$@"
}

force() {
  value "$1" /results/contact/fit/force | awk '{ print $1 }'
}

# deviation A B: of A from B, relative.
deviation() {
  awk -v a="$1" -v b="$2" 'BEGIN { d = a / b - 1; print d < 0 ? -d : d }'
}

fit interference --set "Contact pair fit/Sliding=small"
fit adjusted --set "$overlap=adjust"
fit ramped --set "Contact pair fit/Sliding=small" --set "$overlap=ramp" \
  --set "Load stepping/Steps=4"
below adjusted force "$(force adjusted | tr -d -)" 1e-9
below ramped "deviates from the interference" \
  "$(deviation "$(force ramped)" "$(force interference)")" 1e-8
# Columns 'time' and 'fit: force x' of the second of four steps.
half=$(awk '/^#/ { n = $2 + 0; sub(/^# [0-9]+: /, ""); if ($0 == "fit: force x") wanted = n; next }
            { rows++ } rows == 2 { print $wanted; exit }' ramped/statistics)
below ramped "half way" "$(deviation "$half" "$(awk -v f="$(force interference)" 'BEGIN { print f / 2 }')")" 1e-6
grep -q "adjusted to no gap" adjusted/log || fail "the log does not say that the overlap is adjusted"
finish
