#!/bin/sh
# fuzz_scenes.sh PROGRAM PROJECT FOLDER: fixed scenes of contrib/fuzz_scenes. All converge and are as
# they must be, in one variant each.
set -eu
python=$(python3 -c 'import sys; assert sys.version_info >= (3, 9); print(sys.executable)') || {
  echo "skipped: there is no Python 3.9"
  exit 0
}
unset TOUCHSTONE_OPTIONS
export PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# scenes PROGRAM PROJECT FOLDER SEED NUMBERS
scenes() {
  "$python" "$2/contrib/fuzz_scenes" --quick --strict --time-limit 60 --program "$1" \
    --output "$3" --only "$5" 0 "$4"
}
scenes "$1" "$2" "$3" 1 0,2,6,8,9,17,19,23,24,30,33,37,39,41,43,44,50,55,56,57,60,66
scenes "$1" "$2" "$3" 2 70
