#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Print doc/parameters.md, the reference of all sections and keys of scene files,
# as the program itself documents them in --print-parameters and --print-own-keys.
#
# Usage: contrib/make_parameter_reference.sh PROGRAM > doc/parameters.md
#        contrib/make_parameter_reference.sh --check PROGRAM   fails if that is old
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)

if [ "${1-}" = --check ]; then
  [ $# -eq 2 ] || { sed -n '2,7s/^# *//p' "$0" >&2; exit 2; }
  # Independent of what the program prints.
  python3 "$root/contrib/check_parameter_keys" || exit 1
  if "$0" "$2" | diff -u "$root/doc/parameters.md" -; then
    echo "doc/parameters.md is up to date"
    exit 0
  fi
  echo "doc/parameters.md is out of date: run" >&2
  echo "  contrib/make_parameter_reference.sh $2 > doc/parameters.md" >&2
  exit 1
fi
[ $# -eq 1 ] || { sed -n '2,7s/^# *//p' "$0" >&2; exit 2; }

# Options of the surroundings, such as those of the tests, are not for this.
printed=$(TOUCHSTONE_OPTIONS= "$1" --print-parameters "$root/doc/all_sections.prm"
  TOUCHSTONE_OPTIONS= "$1" --print-own-keys)

cat <<'END'
# Scene files: all sections and keys

Made by `contrib/make_parameter_reference.sh` from what the program prints with
`--print-parameters`; do not edit. [user_guide.md](user_guide.md) says how the
sections belong together. `touchstone --print-parameters scene.prm` prints the
same for the sections of one scene, with the values that it sets.

Units are those of the scene's own consistent system. A value in the column
"default" counts where a scene does not set the key. Sections "with KEY = CLASS"
have the keys that exist beside this KEY where it names this CLASS.
END

printf '%s\n' "$printed" | awk '
  function open_section(name) {
    # One body of each geometry stands for all bodies: what they share is
    # documented with the first, and what follows the geometry with the last.
    if (name ~ /^Body [a-z ]+$/) { geometry = substr(name, 6); name = "Body NAME" }
    path[++depth] = name
    title = path[1]
    for (i = 2; i <= depth; ++i) title = title "/" path[i]
    if (title == "Body NAME/Geometry") title = title " with Type = " geometry
    skip = (title in done)
    if (path[1] == "Body NAME" && depth == 2 && name != "Geometry") skip = (geometry != last)
    done[title] = 1
    header = 0
  }
  function row(key, value, text) {
    if (skip) return
    if (!header) {
      print "\n## " title "\n\n| key | default | meaning |\n|---|---|---|"
      header = 1
    }
    gsub(/\|/, "\\|", text)
    gsub(/</, "\\&lt;", text)
    print "| " key " | " (value == "" ? "" : "`" value "`") " | " text " |"
  }
  BEGIN { title = "Top level" }
  /^ *# Listing of Parameters/ || /^ *# -+$/ { next }
  /^ *# / { line = $0; sub(/^ *# /, "", line); text = text (text == "" ? "" : " ") line; next }
  /^ *subsection / { name = $0; sub(/^ *subsection /, "", name); open_section(name); next }
  /^ *end *$/ {
    --depth
    title = path[1]
    for (i = 2; i <= depth; ++i) title = title "/" path[i]
    skip = 1
    next
  }
  /^ *set / {
    line = $0
    sub(/^ *set /, "", line)
    position = index(line, "=")
    key = substr(line, 1, position - 1)
    value = substr(line, position + 1)
    # What all_sections.prm had to set: the default follows in a comment.
    if (match(value, /# default:/)) value = substr(value, RSTART + RLENGTH)
    gsub(/^ +| +$/, "", key)
    gsub(/^ +| +$/, "", value)
    if (key == "Bodies") { last = line; sub(/ *# default:.*/, "", last); sub(/.*[,=] */, "", last) }
    if (text ~ /Required\./) value = "required"
    if (key == "Type" && geometry != "" && title ~ /Geometry/) {
      if (!explained++) types = text
      value = ""
      text = "The geometry `" geometry "`: " description(text, geometry)
    }
    row(key, value, text)
    text = ""
  }
  # "... NAME: its text. OTHER: ..." with the names in quotation marks.
  function description(text, name,    from, rest) {
    from = index(text, "\047" name "\047: ")
    rest = substr(text, from + length(name) + 4)
    if (match(rest, / \047[a-z ]+\047: /)) rest = substr(rest, 1, RSTART - 1)
    return rest
  }'
