#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# fuzz.sh [SECONDS [TARGET...]]: builds the fuzzers (tests/fuzz) and runs each for so many seconds
# (600), as many at a time as there are cores. Ends with 1 if any finds something; the input is then
# in build/asan-ubsan/found/TARGET: mend the reader, and put the input into tests/fuzz/corpus/TARGET, which
# the tests of every build read. What they learn stays in build/asan-ubsan/corpus.
set -euo pipefail
cd "$(dirname "$0")/.."
export seconds=${1:-600} build=build/asan-ubsan
[ $# -gt 0 ] && shift
cmake --preset asan-ubsan >/dev/null
cmake --build --preset asan-ubsan --target fuzzers

# Targets that read files keep theirs in memory.
scratch=$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)")
trap 'rm -rf "$scratch"' EXIT
export TMPDIR=$scratch

run() {
  name=$1
  log=$build/fuzz_$name.log
  mkdir -p "$build/corpus/$name" "$build/found/$name"
  # libsndfile and assimp leak where they give up on a file; that is theirs to mend.
  # What assimp does not come to an end with is ended after little more than a second of its own.
  case $name in sound | mesh) leaks=0 timeout=120 ;; *) leaks=1 timeout=20 ;; esac
  if ASAN_OPTIONS=detect_leaks=$leaks "$build/bin/fuzz_$name" \
    -max_total_time="$seconds" -seed="${FUZZ_SEED:-0}" -max_len=16384 -timeout=$timeout \
    -rss_limit_mb=2500 -print_final_stats=1 -artifact_prefix="$build/found/$name/" \
    "$build/corpus/$name" "tests/fuzz/corpus/$name" >"$log" 2>&1; then
    echo "$name: nothing in $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs"
  else
    echo "$name: FOUND something ($log)"
    tail -n 60 "$log"
    return 1
  fi
}
export -f run
if [ $# -gt 0 ]; then printf '%s\n' "$@"; else ls tests/fuzz/corpus; fi |
  xargs -P "$(nproc)" -I{} bash -c 'run {}'
