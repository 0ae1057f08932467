#!/bin/sh
# fuzz_inputs.sh PROGRAM PROJECT FOLDER: inputs with one fault each, always the same ones, are
# refused with section, line and remedy, or are right; none shows the text of a library.
set -eu
python=$(python3 -c 'import sys; assert sys.version_info >= (3, 9); print(sys.executable)') || {
  echo "skipped: there is no Python 3.9"
  exit 0
}
unset TOUCHSTONE_OPTIONS
export OPENBLAS_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1
"$python" "$2/contrib/fuzz_inputs" --program "$1" --output "$3" --time-limit 2 30 7
