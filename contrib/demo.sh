#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# From a fresh Debian 12 to a first result: install, build, run the press fit,
# and say which files to open.
set -eu
. "$(dirname -- "$0")/setup.sh"
install_packages
build_program touchstone

cd "$root"
say "Running prm/press_fit.prm"
"$build/touchstone" prm/press_fit.prm

say "Open in ParaView:"
echo "   $root/output/press_fit/solution.pvd   displacement and stress of the tubes"
echo "   $root/output/press_fit/contact.pvd    pressure and gap between them"
say "Without ParaView (each says which package it needs):"
echo "   contrib/plot output/press_fit                     pressure along a line, convergence"
echo "   /usr/bin/python3 contrib/render.py output/press_fit press_fit.png"
say "All figures:"
echo "   $root/output/press_fit/summary.json"
say "From here: doc/tutorials/README.md, doc/gallery.md"
