#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# check_install.sh BUILD: installs that build to a temporary prefix, then configures, builds and runs
# examples/synchronize against it, and runs the installed program.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/dev}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
cmake -G Ninja -S examples/synchronize -B "$work/example" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/example"
(cd "$work" && "$work/example/synchronize")
(cd "$work" && "$work/prefix/bin/ifa" --version)
echo "installed program and library: good"
