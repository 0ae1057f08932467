# Read by the checks, which are called with PROGRAM PROJECT FOLDER: how to run scenes
# and compare their summaries.

program=$1
source=$2 # the project's folder
folder=$3
unset TOUCHSTONE_OPTIONS
export OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
mkdir -p "$folder"
cd "$folder"
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

finish() {
  [ "$failures" -eq 0 ] || { echo "$failures check(s) failed"; exit 1; }
}

# run NAME RANKS SCENE [OPTIONS]: results into the folder NAME, its figures into
# NAME.numbers.
run() {
  run_name=$1 run_ranks=$2 run_scene=$3
  shift 3
  rm -rf "$run_name" "$run_name.numbers"
  set -- "$program" --results-only --output "$run_name" --set "Output/VTU interval=0" \
    "$@" "$run_scene"
  [ "$run_ranks" -eq 1 ] || set -- mpirun --oversubscribe -n "$run_ranks" "$@"
  if "$@" >"$run_name.txt" 2>&1; then
    numbers "$run_name/summary.json" >"$run_name.numbers"
  else
    fail "$*"
    cat "$run_name.txt"
    : >"$run_name.numbers"
  fi
}

# numbers FILE: lines "kind path index value" of all results and errors in it.
numbers() {
  awk '
    /^  "iterations"/ { part = 1 }
    /^  "counts"/     { part = 0 }
    /^  "results"/    { part = 2 }
    /^  "errors"/     { part = 3 }
    part == 0         { next }
    {
      line = $0
      if (!match(line, /"[^"]*"/)) next
      name = substr(line, RSTART + 1, RLENGTH - 2)
      indent = match(line, /[^ ]/)
      path[indent] = name
      rest = line
      sub(/^ *"[^"]*": */, "", rest)
      if (part == 3 && name != "errors" && indent < 5) exit
      gsub(/[][{},]/, " ", rest)
      n = split(rest, value, " ")
      key = ""
      for (i = 3; i <= indent; i += 2) key = key "/" path[i]
      gsub(/ /, "_", key)
      kind = part == 1 ? name : part == 3 ? "error" : key ~ /reactions/ ? "force" : name
      for (i = 1; i <= n; ++i) print kind, key, i, value[i]
    }' "$1"
}

# same A B TOLERANCE [KIND=FACTOR ...]: the results of A times FACTOR are those of
# B. Forces and moments are compared to the largest of their kind; penetrations
# are round-off. Iterations count only if the factor "newton" is given.
same() {
  a=$1 b=$2 tolerance=$3
  shift 3
  if ! awk -v tolerance="$tolerance" -v factors="$*" -v title="$a and $b" '
    function abs(x) { return x < 0 ? -x : x }
    BEGIN { n = split(factors, f, " "); for (i = 1; i <= n; ++i) { split(f[i], p, "="); factor[p[1]] = p[2] } }
    { x = $4 * ($1 in factor && FILENAME == ARGV[1] ? factor[$1] : 1) }
    FILENAME == ARGV[1] { value[$2, $3] = x; kind[$2, $3] = $1
                          if (abs(x) > scale[$1]) scale[$1] = abs(x); ++count; next }
    $1 == "max_penetration" || $1 == "contact" || $1 == "damped" || $1 ~ /^linear/ { --count; next }
    $1 == "newton" && !("newton" in factor) { --count; next }
    { --count; ++compared
      if (!(($2, $3) in value)) { print "  " $2 " is new"; bad = 1; next }
      # Errors are relative to the exact solution already.
      size = $1 == "error" ? 1 : $1 == "force" || $1 == "moment" ? scale[$1] : abs(x)
      d = abs(value[$2, $3] - x)
      if (!(d <= tolerance * size)) { printf "  %s %d: %.12g and %.12g\n", $2, $3, value[$2, $3], x; bad = 1 }
      if (size > 0 && d / size > worst) worst = d / size }
    END { if (count != 0) { print "  not the same number of results"; bad = 1 }
          if (compared < 8) { print "  hardly anything to compare"; bad = 1 }
          printf "%s: %d figures, largest difference %.1e, allowed %.1e\n", title, compared, worst, tolerance
          exit bad }' "$a.numbers" "$b.numbers"; then
    fail "$a and $b differ"
  fi
}

# value NAME PATH [INDEX]: one figure of the run NAME.
value() {
  awk -v key="$2" -v i="${3:-1}" '$2 == key && $3 == i { print $4; found = 1 }
    END { if (!found) print "missing" }' "$1.numbers"
}

# below NAME WHAT VALUE BOUND: VALUE is a number, not negative, and less than BOUND.
below() {
  if awk -v x="$3" -v bound="$4" 'BEGIN { exit !(x ~ /^[0-9]/ && x + 0 < bound) }'; then
    echo "$1, $2: $3, bound $4"
  else
    fail "$1, $2: $3 is not below $4"
  fi
}
