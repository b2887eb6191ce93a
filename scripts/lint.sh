#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lint.sh BUILD: clang-tidy (.clang-tidy) over src/ and apps/, with the commands of that build but without
# its precompiled headers: each file must include what it needs.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/dev}
commands=$(mktemp -d)
trap 'rm -rf "$commands"' EXIT
sed -E 's/ -Winvalid-pch//; s/ -Wno-(restrict|stringop-[a-z]+)//g; s/ -include [^ ]*cmake_pch\.hxx//g' "$build/compile_commands.json" \
  >"$commands/compile_commands.json"
git ls-files 'src/*.cpp' 'apps/*.cpp' |
  xargs -P "$(nproc)" -n 4 clang-tidy -p "$commands" --quiet 2> >(grep -v 'warnings generated' >&2)
echo "clang-tidy: nothing found"
