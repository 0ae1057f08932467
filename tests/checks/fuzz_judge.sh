#!/bin/sh
# fuzz_judge.sh PROGRAM PROJECT FOLDER: the judge of contrib/fuzz_scenes flags results that
# were falsified on purpose.
set -eu
python=$(python3 -c 'import sys; assert sys.version_info >= (3, 9); print(sys.executable)') || {
  echo "skipped: there is no Python 3.9"
  exit 0
}
unset TOUCHSTONE_OPTIONS
export PYTHONDONTWRITEBYTECODE=1
exec "$python" "$2/tests/checks/fuzz_judge.py" "$1" "$2" "$3"
