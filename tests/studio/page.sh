#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The page's own tests and its types; exit 77 (skipped) where npm or its packages are missing.
set -eu
cd "$(dirname "$0")/../../apps/studio/web"
command -v npm >/dev/null && [ -d node_modules/vitest ] || {
  echo "Skipped: npm ci was not run in apps/studio/web (scripts/test.sh does)"
  exit 77
}
npm run --silent check
npm run --silent test
