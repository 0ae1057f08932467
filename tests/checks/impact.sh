#!/bin/sh
# impact.sh PROGRAM PROJECT FOLDER: impacts of bodies with inertia. Large steps, cut steps,
# all enforcements and pairings, friction, gravity, free flight, Hertz's theory.
set -eu
. "$(dirname -- "$0")/common.sh"
bars=$source/prm/benchmarks/two_bars.prm
tests=$source/tests
sc="Time integration/Scheme" rho="Time integration/Spectral radius"
mass="Time integration/Mass"

# impact NAME LINE [WORD]: a word of what the run printed of its impact or energies; the
# first word has number 1.
impact() {
  awk -v line="$2" -v word="${3:-1}" '
    index($0, line) { rest = substr($0, index($0, line) + length(line)); split(rest, w, " ")
                      print w[word]; found = 1; exit }
    END { if (!found) print "missing" }' "$1.txt"
}

# off VALUE EXACT: relative difference. size VALUE: magnitude.
off() { echo "$1 $2" | awk '{ d = $1 / $2 - 1; print d < 0 ? -d : d }'; }
size() { echo "$1" | awk '{ print $1 < 0 ? -$1 : $1 }'; }

# history NAME TITLE: a column of the statistics, one value per line.
history() {
  awk -v title="$2" '
    /^#/ { number = $2 + 0; sub(/^# [0-9]+: /, ""); if ($0 == title) wanted = number; next }
    { print wanted ? $wanted : "missing" }' "$1/statistics"
}

# never_grows NAME TITLE SIGN ALLOWED: how far SIGN times a column rises in a step.
never_grows() {
  below "$1" "$2 rises in a step" "$(history "$1" "$2" | awk -v sign="$3" '
    NR > 1 && sign * ($1 - old) > worst { worst = sign * ($1 - old) } { old = $1 }
    END { print worst + 0 }')" "$4"
}

# two_bars NAME CELLS STEPS [OPTIONS]
two_bars() {
  name=$1 cells=$2 steps=$3
  shift 3
  run "$name" 1 "$bars" --set "Body left/Geometry/Cells=$cells,1,1" \
    --set "Body right/Geometry/Cells=$cells,1,1" --set "Load stepping/Steps=$steps" "$@"
}
# bounds NAME STRESS DURATION ENERGY: errors of a run, and contact opens once.
bounds() {
  below "$1" "contact stress" "$(size "$(value "$1" /errors/contact_stress)")" "$2"
  below "$1" "duration" "$(size "$(value "$1" /errors/contact_duration)")" "$3"
  below "$1" "energy" "$(size "$(value "$1" /errors/energy)")" "$4"
  below "$1" "further openings" "$(size "$(value "$1" /errors/openings)")" 0.5
  below "$1" "gain of energy in contact" "$(impact "$1" "  contact " | awk '{ print ($1 < 0 ? -$1 : 0) }')" 1e-5
}

# Every enforcement, both pairings and Belos, where mesh and step make no error.
for enforcement in elimination "lagrange multipliers" "augmented lagrange" penalty; do
  for pairing in pointwise averaged; do
    name=$(echo "${enforcement}_$pairing" | tr ' ' _)
    two_bars "$name" 20 50 --set "Contact/Enforcement=$enforcement" \
      --set "Contact pair impact/Pairing=$pairing"
    case $enforcement in
      penalty) bounds "$name" 0.02 0.05 0.01 ;;
      *) bounds "$name" 1e-5 1e-5 1e-5 ;;
    esac
  done
done
two_bars belos 20 50 --set "Linear solver/Type=Belos CG"
bounds belos 1e-5 1e-5 1e-5
run two_ranks 2 "$bars" --set "Body left/Geometry/Cells=20,1,1" \
  --set "Body right/Geometry/Cells=20,1,1" --set "Load stepping/Steps=50"
bounds two_ranks 1e-5 1e-5 1e-5

# In contact at time 0 with a velocity: no gap to close.
two_bars touching 20 50 --set "Body right/Geometry/Lower corner=0,0,0" \
  --set "Body right/Geometry/Upper corner=100,10,10"
bounds touching 1e-5 1e-5 1e-5

# Ten times the step in which a wave passes a cell: the bars and their impact last four steps.
for kind in consistent lumped; do
  two_bars "large_$kind" 20 5 --set "$sc=contact_stabilized" --set "$rho=automatic" \
    --set "$mass=$kind" --set "Load stepping/End time=4.833538583e-5"
  bounds "large_$kind" 0.35 0.35 0.05
done

# Awkward steps.
two_bars awkward 20 437 --set "$sc=contact_stabilized" --set "$mass=lumped"
two_bars even 20 400 --set "$sc=contact_stabilized" --set "$mass=lumped"
below awkward "duration differs from that of even steps" \
  "$(off "$(impact awkward "  from, to" 2)" "$(impact even "  from, to" 2)")" 0.01

# Nodes that do not rebound: Newmark's and the HHT method do not chatter, nor gain energy.
for scheme in newmark hht; do
  two_bars "$scheme" 40 200 --set "$sc=$scheme" --set "$mass=lumped"
  bounds "$scheme" 0.02 0.02 0.01
  below "$scheme" "balance error, gain" "$(impact "$scheme" "  balance error" | awk '{ print ($1 > 0 ? $1 : 0) }')" 1e-3
done
# Left to rebound they do, and the run ends with the reason.
if "$program" --results-only --output gain --set "Output/VTU interval=0" --set "$sc=newmark" \
  --set "Body left/Geometry/Cells=40,1,1" --set "Body right/Geometry/Cells=40,1,1" \
  --set "Load stepping/Steps=200" --set "$mass=lumped" --set "Time integration/Impact=elastic" \
  "$bars" >gain.txt 2>&1; then
  fail "a gain of energy did not end the run"
fi
grep -q "came from nowhere" gain.txt || fail "the gain of energy was not named"

# A block that falls, bounces and falls again.
run bouncing 1 "$tests/bouncing_block.prm"
below bouncing "impacts but two or more" "$(impact bouncing "  opened" | awk '{ print ($1 >= 2 ? 0 : 9) }')" 1
never_grows bouncing "energy: contact" -1 1e-9
below bouncing "balance error" "$(size "$(impact bouncing "  balance error")")" 1e-6

# Oblique impact.
run oblique 1 "$tests/oblique_impact.prm"
below oblique "impulse along the plane is not mu times that across" \
  "$(off "$(impact oblique "  impulse" 1)" "$(impact oblique "  impulse" 3 | awk '{ print -0.2 * $1 }')")" 1e-4
never_grows oblique "energy: friction" -1 1e-9
# Steps that are cut in the middle of it: the iterations allowed do not suffice.
askew="Body block/Initial velocity z=-1 + 0.2 * x + 0.1 * y"
run uncut 1 "$tests/oblique_impact.prm" --set "$askew"
run cut 1 "$tests/oblique_impact.prm" --set "$askew" --set "Newton/Maximum iterations=3" \
  --set "Newton/Residual tolerance=1e-8" --set "Newton/Gap tolerance=1e-7"
below cut "cuts but three or more" "$(awk '!/^#/ { cuts += $6 } END { print (cuts >= 3 ? 0 : 9) }' cut/statistics)" 1
below cut "impulse differs from that of whole steps" \
  "$(off "$(impact cut "  impulse" 3)" "$(impact uncut "  impulse" 3)")" 0.01
never_grows cut "energy: contact" -1 1e-9
run sticking 1 "$tests/oblique_impact.prm" --set "Contact pair contact/Friction/Coefficient=50"
never_grows sticking "energy: friction" -1 1e-9
below sticking "gain of energy" "$(impact sticking "  balance error" | awk '{ print ($1 > 0 ? $1 : 0) }')" 1e-6

# Free flight: angular momentum about the origin, and its error with half the step.
spin() {
  for d in x y z; do history "$1" "angular momentum $d" | awk 'NR == 1 { first = $1 } END { print $1 - first }'; done |
    awk '{ sum += $1 * $1 } END { print sqrt(sum) }'
}
drift() {
  history "$1" "momentum $2" | awk 'NR == 1 { first = $1 } { d = $1 - first; d = d < 0 ? -d : d; if (d > worst) worst = d } END { print worst + 0 }'
}
run flight 1 "$tests/rotating_block.prm"
run flight_half 1 "$tests/rotating_block.prm" --set "Load stepping/Steps=100"
for d in x y z; do below flight "momentum $d drifts" "$(drift flight $d)" 1e-9; done
below flight "angular momentum drifts" "$(spin flight)" 1e-3
below flight_half "drift with half the step, over a quarter" \
  "$(echo "$(spin flight) $(spin flight_half)" | awk '{ print $2 / ($1 / 4) }')" 1.2

# The mesh changes in flight, and in an impact: momentum stays, and ranks agree.
run flight_adaptive 1 "$tests/rotating_block.prm" --set "Refinement/Estimator=region" \
  --set "Refinement/Region=sin(100*t)*x" --set "Refinement/Maximum level=1"
for d in x y z; do below flight_adaptive "momentum $d drifts" "$(drift flight_adaptive $d)" 1e-9; done
below flight_adaptive "angular momentum drifts" "$(spin flight_adaptive)" 1e-3
below flight_adaptive "balance error" "$(size "$(impact flight_adaptive "  balance error")")" 1e-3
meshes=$(grep -c "  mesh" flight_adaptive/log)
below flight_adaptive "meshes but ten or more" "$((meshes >= 10 ? 0 : 9))" 1
for ranks in 1 2; do
  run "adaptive_$ranks" "$ranks" "$tests/bouncing_block.prm" --set "$sc=generalized_alpha" \
    --set "Refinement/Estimator=Kelly" --set "Refinement/Cycles=1" --set "Refinement/Maximum level=1"
  below "adaptive_$ranks" "gain of energy" "$(impact "adaptive_$ranks" "  balance error" | awk '{ print ($1 > 0 ? $1 : 0) }')" 1e-6
done
same adaptive_1 adaptive_2 1e-6

# Hertz: K = 4/3 sqrt(R) E*, the mass from the momentum at the start.
run hertz 1 "$tests/hertz_impact.prm"
momentum=$(history hertz "momentum z" | head -n 1)
set -- $(echo "$momentum" | awk '{ v = 200; m = -4 * $1 / v; K = 4 / 3 * sqrt(10) * 210000 / 0.91
  d = exp(0.4 * log(1.25 * m * v * v / K)); print 2.9432 * d / v, K * exp(1.5 * log(d)) }')
below hertz "duration of contact" \
  "$(off "$(echo "$(impact hertz "  from, to" 1) $(impact hertz "  from, to" 2)" | awk '{ print $2 - $1 }')" "$1")" 0.05
below hertz "largest force" "$(off "$(impact hertz "  peak force")" "$(echo "$2" | awk '{ print $1 / 4 }')")" 0.05
finish
