# SPDX-License-Identifier: LGPL-2.1-or-later
# Functions that the scripts of this folder share; sourced, not run.
# Platform: Debian 12. Everything can be repeated, the second time is quick.

# The folder of the project, whatever the present one is.
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
build=${TOUCHSTONE_BUILD:-$root/build}

# libdeal.ii-dev brings p4est, Trilinos, MPI, Boost and muParser with it.
# Debian's default BLAS is the reference one; with OpenBLAS MUMPS runs 4 to 5
# times faster. numdiff and perl compare the tests' output, python3 runs checks and contrib/benchmark.
packages="g++ cmake ninja-build libdeal.ii-dev libmumps-dev libmetis-dev openmpi-bin
  libopenmpi-dev libopenblas0-pthread numdiff perl python3"

say()
{
  echo "== $*"
}

install_packages()
{
  missing=
  for package in $packages; do
    # A package of another architecture does not count twice.
    status=$(dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null |
      head -n 1)
    [ "$status" = installed ] || missing="$missing $package"
  done
  if [ -z "$missing" ]; then
    say "All packages are installed."
    return
  fi

  if ! command -v apt-get >/dev/null; then
    echo "Missing packages:$missing" >&2
    echo "This is no Debian: install their like and build with cmake, see README.md." >&2
    exit 1
  fi
  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Missing packages:$missing" >&2
      echo "Run this script as root, or install them or sudo." >&2
      exit 1
    fi
    as_root=sudo
  fi
  say "Installing$missing (the first time this takes minutes)"
  install="env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends"
  # The package lists of a fresh system are empty, those of an old one point to
  # versions that are gone: fetch them only then.
  if ! $as_root $install $missing 2>/dev/null; then
    $as_root apt-get update
    $as_root $install $missing
  fi
}

# As many compilers at a time as there are cores, and 2 GB of memory for each:
# deal.II's headers need that much. nproc would count the threads of OpenMP, of which
# the program is to have one.
number_of_jobs()
{
  cores=$(env -u OMP_NUM_THREADS nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 2000000) }' /proc/meminfo)
  jobs=$cores
  [ "$memory" -ge "$jobs" ] || jobs=$memory
  [ "$jobs" -ge 1 ] || jobs=1
  echo "$jobs"
}

# build_program TARGET...
build_program()
{
  if [ ! -f "$build/CMakeCache.txt" ]; then
    say "Configuring $build"
    # Several sources at a time are compiled in a third of the time. Options of
    # TOUCHSTONE_CMAKE_OPTIONS, which .ci/run sets, count more.
    # shellcheck disable=SC2086
    cmake -G Ninja -DCMAKE_BUILD_TYPE=Release -DTOUCHSTONE_UNITY=ON ${TOUCHSTONE_CMAKE_OPTIONS:-} \
      -S "$root" -B "$build"
  elif [ ! -f "$build/build.ninja" ] && [ ! -f "$build/Makefile" ]; then
    say "Configuring $build again"
    cmake -S "$root" -B "$build"
  fi
  say "Building in $build"
  cmake --build "$build" --parallel "$(number_of_jobs)" --target "$@"
}

# One thread per rank: threads in BLAS would compete with the ranks.
export OPENBLAS_NUM_THREADS=1
export OMP_NUM_THREADS=1
# Open MPI refuses to run as root unless told twice.
export OMPI_ALLOW_RUN_AS_ROOT=1
export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
