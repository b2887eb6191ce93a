#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the readers of glTF and USD that tests/export/package-lock.json names, when they are not
# there yet.
set -eu
cd "$(dirname "$0")/../tests/export"
[ node_modules/.package-lock.json -nt package-lock.json ] || npm ci --no-audit --no-fund
