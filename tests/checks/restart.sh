#!/bin/sh
# restart.sh PROGRAM PROJECT FOLDER: runs that are stopped and resumed are those that are not:
# to the last bit on the same ranks, to 1e-10 on others, whenever and however they are
# stopped; what does not fit is refused. On several ranks MUMPS adds up what arrives first,
# so that even the same run can differ in its last bits: there 1e-10 counts, and the bits
# with Belos.
set -eu
. "$(dirname -- "$0")/common.sh"
scene=$source/tests/checks/restart.prm
adaptive=$source/tests/adaptive_sliding.prm
plate=$source/tests/checks/thin_plate.prm

# start RANKS FOLDER OPTIONS...: the program on some ranks, not in a folder of its own.
start() {
  start_ranks=$1 start_folder=$2
  shift 2
  set -- "$program" --results-only --output "$start_folder" "$@"
  [ "$start_ranks" -eq 1 ] || set -- mpirun --oversubscribe -n "$start_ranks" "$@"
  "$@" >"$start_folder.txt" 2>&1
}

# newest FOLDER [N]: its newest checkpoint, or the N-th newest.
newest() { find "$1" -maxdepth 1 -name 'checkpoint_[0-9]*' ! -name '*.part' 2>/dev/null | sort -r | sed -n "${2:-1}p"; }

# figures FOLDER: summary.json without times, memory, and the balance of the work since the
# program began.
figures() {
  awk '/^  "balance"/ { skip = 1 } /^  "peak_memory_mb"/ { skip = 0; next }
    /"seconds"/ { skip = 1 } skip && /^  }/ { skip = 0; next } !skip' "$1/summary.json"
}

# goes_on NAME RANKS SCENE [OPTIONS]: a run with checkpoints, and another that is stopped
# after the last but one and resumed: all files are the same.
goes_on() {
  name=$1 ranks=$2 file=$3
  shift 3
  rm -rf "$name" "$name-resumed"
  start "$ranks" "$name" --set "Output/VTU interval=3" "$@" "$file" ||
    { fail "$name"; cat "$name.txt"; return; }
  [ "$(find "$name" -name 'checkpoint_[0-9]*' | wc -l)" -eq 2 ] || fail "$name: not two checkpoints"
  cp -r "$name" "$name-resumed"
  rm -r "$(newest "$name-resumed")"
  # As a run that died left it, with a row and a picture too many.
  rm "$name-resumed/summary.json"
  start "$ranks" "$name-resumed" --resume --set "Output/VTU interval=3" "$@" "$file" ||
    { fail "$name-resumed"; cat "$name-resumed.txt"; return; }
  figures "$name" >"$name.figures"
  figures "$name-resumed" >"$name-resumed.figures"
  cmp "$name.figures" "$name-resumed.figures" || fail "$name: another summary"
  for path in "$name"/statistics "$name"/*.vtu; do
    cmp "$path" "$name-resumed/${path#*/}" || fail "$name: another $path"
  done
  for path in "$name"/*.pvd; do # but for the date in a comment
    grep -v '^#\|generated\|^-->' "$path" >a.pvd
    grep -v '^#\|generated\|^-->' "$name-resumed/${path#*/}" >b.pvd
    cmp a.pvd b.pvd || fail "$name: another $path"
  done
  grep -q "goes on from checkpoint_[0-9]*: step" "$name-resumed/log" || fail "$name: the log is silent"
  echo "$name: bitwise the same on $ranks rank(s)"
}

goes_on elimination 1 "$scene"
goes_on multipliers 1 "$scene" --set "Contact/Enforcement=lagrange multipliers"
goes_on augmented 1 "$scene" --set "Contact/Enforcement=augmented lagrange"
goes_on pointwise 1 "$scene" --set "Contact pair contact/Pairing=pointwise" \
  --set "Contact/Friction=regularised"
goes_on smoothed 1 "$scene" --set "Contact pair contact/Master normal=smoothed"
goes_on finite 1 "$scene" --set "Body block/Material/Law=neo-Hookean"
goes_on frictionless 1 "$source/tests/moving_plane.prm" --set "Checkpoints/Steps between=3"
goes_on belos 1 "$scene" --set "Linear solver/Type=Belos GMRES"
goes_on cut 1 "$scene" --set "Newton/Maximum iterations=6" --set "Newton/Residual tolerance=1e-8" \
  --set "Newton/Gap tolerance=1e-6"
goes_on plate 1 "$plate" --set "Load stepping/Steps=2" --set "Checkpoints/Steps between=1"
goes_on adaptive 1 "$adaptive" --set "Checkpoints/Steps between=4"
goes_on adaptive-belos 1 "$adaptive" --set "Checkpoints/Steps between=4" \
  --set "Linear solver/Type=Belos GMRES"
goes_on belos-2 2 "$scene" --set "Linear solver/Type=Belos GMRES"

# other FROM TO_RANKS SCENE [OPTIONS]: the run FROM of goes_on() resumed on other ranks.
other() {
  from=$1 name=$1-on-$2 ranks=$2 file=$3
  shift 3
  rm -rf "$name"
  cp -r "$from" "$name"
  rm -r "$(newest "$name")" "$name/summary.json"
  start "$ranks" "$name" --resume "$@" "$file" || { fail "$name"; cat "$name.txt"; return; }
  numbers "$from/summary.json" >"$from.numbers"
  numbers "$name/summary.json" >"$name.numbers"
  same "$from" "$name" 1e-10
}

rm -rf elimination-2
start 2 elimination-2 --set "Output/VTU interval=3" "$scene" || fail elimination-2
other elimination-2 2 "$scene"
other elimination-2 1 "$scene"
other elimination 3 "$scene"
goes_on metis-2 2 "$scene" --set "Discretisation/Partitioner=METIS" \
  --set "Linear solver/Type=Belos GMRES"
other metis-2 1 "$scene" --set "Discretisation/Partitioner=METIS"
other adaptive 3 "$adaptive" --set "Checkpoints/Steps between=4"
# Newton's tolerance bounds what runs of different ways have in common.
goes_on adaptive-2 2 "$adaptive" --set "Checkpoints/Steps between=4" \
  --set "Discretisation/Contact weight=4" --set "Linear solver/Type=Belos GMRES" \
  --set "Newton/Residual tolerance=1e-11"
other adaptive-2 1 "$adaptive" --set "Checkpoints/Steps between=4" \
  --set "Newton/Residual tolerance=1e-11"

# A finished run goes on to a later end.
rm -rf later
start 1 later --set "Load stepping/End time=1" --set "Load stepping/Steps=4" "$scene"
start 1 later --resume "$scene" || fail "later end"
numbers later/summary.json >later.numbers
numbers elimination/summary.json >elimination.numbers
same elimination later 1e-10
start 1 later --resume "$scene" || fail "a finished run resumed"
cp later.numbers again.numbers
numbers later/summary.json >later.numbers
cmp later.numbers again.numbers || fail "a finished run resumed is another"

# refused NAME WORDS OPTIONS...: the message has these words, and the folder stays as it is.
refused() {
  name=$1 words=$2
  shift 2
  ls -l --time-style=full-iso later >before.list
  if start 1 later --resume "$@" "$scene"; then
    fail "$name is not refused"
  elif ! grep -q -e "$words" later.txt; then
    fail "$name: another message"
    cat later.txt
  fi
  ls -l --time-style=full-iso later >after.list
  cmp before.list after.list || fail "$name: the folder has changed"
}
refused modulus "'Body base/Material', key 'Young modulus', value '999'.*value, '1000'" \
  --set "Body base/Material/Young modulus=999"
refused enforcement "'Contact', key 'Enforcement', value 'penalty'.*'elimination'" \
  --set "Contact/Enforcement=penalty"
refused end "key 'End time', value '1'.*later time 1.5" --set "Load stepping/End time=1"
refused partitioner "key 'Partitioner'" --set "Discretisation/Partitioner=METIS"
refused pairs "key 'Pairing', value 'pointwise'" --set "Contact pair contact/Pairing=pointwise"
start 1 later --resume --set "Body base/Material/Young modulus=1.0e3" --set "Title=Other" \
  --set "Newton/Gap tolerance=1e-9" --set "Linear solver/Type=Belos GMRES" "$scene" ||
  fail "harmless changes are refused"
grep -q "Linear solver/Type is now 'Belos GMRES', was 'automatic'" later/log || fail "changes not told"
rm -rf nothing nothing.txt
mkdir nothing
if start 1 nothing --resume "$scene"; then fail "resumed from nothing"; fi
grep -q "no complete checkpoint in the folder nothing.*Remedy: " nothing.txt || fail "no remedy"

# Damage of any kind: the checkpoint before is taken. cut FILE BYTES
cut_file() { dd if="$1" of=cut.tmp bs=1 count="$2" 2>/dev/null && mv cut.tmp "$1"; }
for damage in cut empty lost contents first last byte; do
  rm -rf damaged
  cp -r elimination damaged
  victim=$(newest damaged)
  size=$(wc -c <"$victim/piece_0.bin")
  case $damage in
    cut) cut_file "$victim/piece_0.bin" $((size / 2)) ;;
    empty) : >"$victim/piece_0.bin" ;;
    lost) rm "$victim/piece_0.bin" ;;
    contents) rm "$victim/contents" ;;
    first) cut_file "$victim/contents" 40 ;;
    last) cut_file "$victim/contents" $(($(wc -c <"$victim/contents") - 2)) ;;
    byte) printf 'x' | dd of="$victim/piece_0.bin" bs=1 seek=$((size - 9)) conv=notrunc 2>/dev/null ;;
  esac
  start 1 damaged --resume --set "Output/VTU interval=3" "$scene" ||
    { fail "damaged, $damage"; cat damaged.txt; }
  grep -q "^checkpoint checkpoint_000002 is skipped: " damaged/log || fail "$damage is not told"
  grep -q "goes on from checkpoint_000001: " damaged/log || fail "$damage: another one"
  cmp elimination/statistics damaged/statistics || fail "damaged, $damage: another result"
done
rm -r "$(newest damaged)"/contents "$(newest damaged 2)"/contents
if start 1 damaged --resume "$scene"; then fail "resumed from damaged ones"; fi
grep -q "no complete checkpoint.*is skipped.*Remedy" damaged.txt || fail "no remedy for damage"

# kill -9 while a checkpoint is written, again and again: what is there in the end is complete,
# and the same as without. Each program must get one step further than the last.
long() {
  "$program" --results-only --set "Load stepping/Steps=24" --set "Checkpoints/Steps between=1" \
    --set "Output/VTU interval=0" --output "$@" "$scene"
}
complete() { find killed -maxdepth 1 -name 'checkpoint_[0-9]*' ! -name '*.part' 2>/dev/null | wc -l; }
rm -rf whole killed
long whole >whole.txt 2>&1 || fail "whole"
in_the_middle=0
resume=
for kill in 1 2 3 4 5 6; do
  before=$(newest killed)
  # The shell's own words only, or the moment would be over.
  "$program" --results-only --set "Load stepping/Steps=24" \
    --set "Checkpoints/Steps between=1" --set "Output/VTU interval=0" --output killed $resume \
    "$scene" >killed.txt 2>&1 &
  job=$!
  while kill -0 $job 2>/dev/null; do
    set -- killed/checkpoint_*.part
    [ -d "$1" ] || continue
    # Held, or the moment would be over before the rest is looked at.
    kill -STOP $job
    # Later within the writing from time to time.
    if [ "$(newest killed)" = "$before" ] ||
      { [ $((kill % 3)) -ne 0 ] && [ ! -e "$1/piece_0.bin" ]; } ||
      { [ $((kill % 3)) -eq 2 ] && [ ! -e "$1/contents" ]; }; then
      kill -CONT $job
      continue
    fi
    kill -9 $job
    break
  done
  wait $job 2>/dev/null || :
  set -- killed/checkpoint_*.part
  [ ! -d "$1" ] || in_the_middle=$((in_the_middle + 1))
  resume=--resume
done
echo "killed 6 times, $in_the_middle times in the middle of a checkpoint"
[ "$in_the_middle" -gt 0 ] || fail "never killed in the middle of a checkpoint"
long killed --resume >killed.txt 2>&1 || { fail "killed"; cat killed.txt; }
cmp whole/statistics killed/statistics || fail "killed and resumed: another result"
[ "$(find killed -name 'checkpoint_*' -maxdepth 1 | wc -l)" -eq 2 ] ||
  fail "killed and resumed: unfinished checkpoints are left"
finish
