#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds (optimised, warnings are errors) and runs all tests.
# Real recordings are used where IFA_RECORDINGS names their folder; those tests skip otherwise.
set -eu
cd "$(dirname "$0")/.."

scripts/install_packages.sh build test
if [ -f tests/export/package.json ] &&
  ! [ tests/export/node_modules/.package-lock.json -nt tests/export/package-lock.json ]; then
  (cd tests/export && npm ci --no-audit --no-fund)
fi
cmake --preset dev
cmake --build --preset dev
ctest --preset dev -j "$(nproc)"
