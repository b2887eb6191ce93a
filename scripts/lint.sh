#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lint.sh: clang-tidy (.clang-tidy) over src/ and apps/. Nothing is built: the commands are in build/lint,
# several files to one, since most of the time goes into the headers that they share. That each file includes
# what it needs is found by scripts/check_includes.py, as is the include of a source file.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset dev -B build/lint -DIFA_PRECOMPILED_HEADERS=OFF -DIFA_BUILD_TESTS=OFF -DIFA_BUILD_BENCHMARKS=OFF \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 >/dev/null
sed -i 's/ -Wno-subobject-linkage//' build/lint/compile_commands.json  # clang does not know it
sed -n 's/^ *"file": "\(.*\)",*$/\1/p' build/lint/compile_commands.json |
  xargs -P "$(nproc)" -n 1 clang-tidy -p build/lint --quiet --checks=-bugprone-suspicious-include \
    2> >(grep -v 'warnings generated' >&2)
echo "clang-tidy: nothing found"
