#!/bin/sh
# documented_figures.sh PROGRAM PROJECT FOLDER: figures in doc that a quick run can reproduce are
# what the runs give.
set -eu
python=$(python3 -c 'import sys; assert sys.version_info >= (3, 9); print(sys.executable)') || {
  echo "skipped: there is no Python 3.9"
  exit 0
}
"$python" "$2/contrib/check_figures" --program "$1"
