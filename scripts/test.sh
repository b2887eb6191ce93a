#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds (optimised, warnings are errors) and runs all tests.
# Real recordings are used where IFA_RECORDINGS names their folder; those tests skip otherwise.
set -eu
cd "$(dirname "$0")/.."

scripts/install_packages.sh build test
scripts/install_validators.sh
cmake --preset dev
cmake --build --preset dev
scripts/build_studio.sh build/dev/share/inverse-foley/studio
ctest --preset dev -j "$(nproc)"
