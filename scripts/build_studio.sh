#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# build_studio.sh FOLDER: builds the pages of `ifa studio` into FOLDER, with what
# apps/studio/web/package-lock.json names. Quick when nothing has changed.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
target=$(cd "$1" && pwd)
cd "$here/apps/studio/web"
[ node_modules/.package-lock.json -nt package-lock.json ] || npm ci --no-audit --no-fund
if [ -f "$target/index.html" ] && [ -z "$(find . ../../../docs/objects -newer "$target/index.html" \
  -type f ! -path './node_modules/*' | head -n 1)" ]; then
  exit 0
fi
npm run --silent build -- --outDir "$target" --logLevel warn
