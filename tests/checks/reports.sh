#!/bin/sh
# reports.sh PROGRAM PROJECT FOLDER: what a user must be told about hard input.
set -eu
. "$(dirname -- "$0")/common.sh"

# says SCENE TEXT: the log of a run has the text.
says() {
  run "$1" 1 "$source/tests/$1.prm"
  if grep -qF -- "$2" "$1/log"; then
    echo "$1: $2"
  else
    fail "$1 does not say: $2"
    cat "$1/log"
  fi
}

says dirichlet_on_slave "5 contact row(s) dropped"
says same_pair_twice "25 contact row(s) dropped"
says large_overlap "an initial overlap larger than a face, taken as interference"
says press_fit "an initial overlap, taken as interference"
says held_by_contact "held by contact alone, stabilised: body 'block' can move in x or move in y or turn about z"
says gap_closed "smallest gap 0.005"
finish
