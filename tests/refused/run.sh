#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# run.sh SCENE.prm MESSAGE FOLDER PROGRAM...: the program must fail on the scene and
# its message (standard error) must be that of the file MESSAGE. The scene may
# begin with a comment "# options: ..." for the command line.
set -eu
scene=$1 message=$2 folder=$3
shift 3

# The options of the scene tests would hide the scene's own folder.
export TOUCHSTONE_OPTIONS=--results-only
mkdir -p "$folder"
cd "$folder"
options=$(sed -n 's/^# options: //p' "$scene" | head -n 1)
code=0
eval "\"\$@\" $options \"\$scene\"" >stdout 2>stderr || code=$?
if [ "$code" -eq 0 ]; then
  echo "The program accepted the scene, but must not."
  cat stdout
  exit 1
fi
# The folder of the checkout is not part of the message.
sed "s|$(dirname -- "$scene")/||g" stderr >message
if ! diff -u "$message" message; then
  echo "Exit code $code, and another message than expected: see $folder/message"
  exit 1
fi
# A crash has no message that a user can use.
[ "$code" -lt 128 ] || { echo "The program crashed: exit code $code"; exit 1; }
