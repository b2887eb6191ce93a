#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# table1.sh [IFA_PROGRAM [SECONDS [SIMULATIONS]]]: planner "graph" on the evaluation set as in the
# paper's Table 1, with both velocity references: the first five odd-numbered signatures of each
# object, SECONDS (60) of search each, databases of SIMULATIONS (400000) drops. Databases are made,
# used and deleted one after another. Prints Markdown. Takes over an hour on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."
ifa=$(realpath "${1:-build/release/bin/ifa}")
seconds=${2:-60}
simulations=${3:-400000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_CACHE_HOME=$work/cache

# search OBJECT NAME [OPTION...]: one row, as JSON
search() {
  local object=$1 name=$2
  shift 2
  "$ifa" evaluate "$work/set" --parity odd --limit 5 --jobs 2 --planner graph --early-exit 1 \
    --simulations "$simulations" --time-limit "$seconds" -o "$work/$object-$name" "$@" \
    >/dev/null 2>>"$work/log"
}

for folder in tests/evaluation/*/; do
  object=$(basename "$folder")
  rm -rf "$work/set" "$work/cache"
  mkdir "$work/set"
  cp -r "$folder" "$work/set/$object"
  echo "$object" >&2
  "$ifa" database build "$object" -n "$simulations" >/dev/null 2>>"$work/log"
  search "$object" blend
  search "$object" printed --printed-velocity --connection blend
done
python3 scripts/table1.py "$work"
