#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Checks of the sources that need no build.
#
# Usage: contrib/check_sources.sh headers   all files have a license line
#        contrib/check_sources.sh format    all sources are formatted by .clang-format
#        contrib/check_sources.sh layers    no #include runs against the order of the folders
#        contrib/check_sources.sh mutations the faults of contrib/mutations fit the sources
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
cd "$root"

format()
{
  # Other versions format differently.
  version=14
  if ! command -v clang-format >/dev/null; then
    . contrib/setup.sh
    packages=clang-format
    (install_packages) >/dev/null 2>&1 || :
  fi
  if ! clang-format --version 2>/dev/null | grep -q " $version\\."; then
    echo "skipped: clang-format $version is not installed"
    return 0
  fi
  find include source tests contrib -name '*.cc' -o -name '*.h' | sort |
    xargs clang-format --dry-run --Werror
}

case ${1-} in
  headers) python3 contrib/check_headers ;;
  format) format ;;
  layers) python3 contrib/check_layers ;;
  mutations) python3 contrib/mutations --check ;;
  *) sed -n '2,7s/^# *//p' "$0" >&2; exit 2 ;;
esac
