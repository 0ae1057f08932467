#!/bin/sh
# tutorials.sh PROGRAM PROJECT FOLDER: the commands of doc/tutorials/*.md print what the pages show
# (tutorials.py).
exec python3 "$(dirname -- "$0")/tutorials.py" "$@"
