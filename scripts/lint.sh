#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lint.sh BUILD: clang-tidy (.clang-tidy) over src/ and apps/, with the commands of that build.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/dev}
git ls-files 'src/*.cpp' 'apps/*.cpp' |
  xargs -P "$(nproc)" -n 4 clang-tidy -p "$build" --quiet 2> >(grep -v 'warnings generated' >&2)
echo "clang-tidy: nothing found"
