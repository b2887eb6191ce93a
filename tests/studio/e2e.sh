#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# e2e.sh IFA SOUND: the studio in a browser, with a real recording of a die where IFA_RECORDINGS names
# their folder, else with SOUND; exit 77 (skipped) where something for that is missing.
set -eu
web=$(cd "$(dirname "$0")/../../apps/studio/web" && pwd)
pages=$(cd "$(dirname "$1")/.." && pwd)/share/inverse-foley/studio
skip() {
  echo "Skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "node is not installed (scripts/install_packages.sh test)"
command -v chromium >/dev/null || skip "chromium is not installed (scripts/install_packages.sh test)"
[ -f "$pages/index.html" ] || skip "the pages are not built (scripts/build_studio.sh $pages)"
[ -d "$web/node_modules/playwright-core" ] || skip "npm ci was not run in apps/studio/web"
recording=${IFA_RECORDINGS:-}/single/d6/d6_plastic_wood_d.wav
if [ -f "$recording" ]; then sound=$recording; else sound=$2; fi
exec node "$web/e2e/run.mjs" "$1" "$sound"
