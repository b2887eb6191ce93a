#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The web studio from a fresh clone: installs what is missing, builds, and opens it in the browser.
# Options go to `ifa studio`. The second time it is quick.
set -eu
cd "$(dirname "$0")/.."

scripts/install_packages.sh build studio
cmake --preset release
cmake --build --preset release --target ifa_program studio_pages
exec build/release/bin/ifa studio --open "$@"
