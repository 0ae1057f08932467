#!/bin/sh
# fuzz_scenes.sh PROGRAM PROJECT FOLDER: fixed scenes of contrib/fuzz_scenes. All converge and are as
# they must be, in one variant each. Mirrored are those that once depended on the directions of the
# mesh: on the line that the frame of friction followed, and on the corner of a smoothed surface.
set -eu
python=$(python3 -c 'import sys; assert sys.version_info >= (3, 9); print(sys.executable)') || {
  echo "skipped: there is no Python 3.9"
  exit 0
}
unset TOUCHSTONE_OPTIONS
export PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# scenes PROGRAM PROJECT FOLDER SEED NUMBERS [OPTION...]
scenes() {
  program=$1 project=$2 folder=$3 seed=$4 numbers=$5
  shift 5
  "$python" "$project/contrib/fuzz_scenes" --quick --strict --time-limit 60 --program "$program" \
    --output "$folder" --only "$numbers" "$@" 0 "$seed"
}
scenes "$1" "$2" "$3" 1 0,2,6,8,9,17,19,23,24,30,33,37,39,41,43,44,50,55,56,57,60,66
scenes "$1" "$2" "$3" 2 3,5,38,70,71,91
scenes "$1" "$2" "$3" 2 35,47,63,111 --variants mirrored
