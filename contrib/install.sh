#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Install the Debian 12 packages that Touchstone needs, as root or with sudo.
set -eu
. "$(dirname -- "$0")/setup.sh"
install_packages
