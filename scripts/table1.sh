#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# [VARIANTS="blend images printed paper"] [JOBS=2] [WORK=DIR]
#   table1.sh [IFA_PROGRAM [SECONDS [SIMULATIONS [OBJECT...]]]]
# Planner "graph" on the evaluation set as in the paper's Table 1: the first five odd-numbered
# signatures of each object, SECONDS (60) of processor time each, databases of SIMULATIONS (400000) drops,
# JOBS searches at a time. Variants: "blend" compares v_blend with v_i+, flights exact; "images" does
# so with every event also as its images under the body's symmetry; "printed" compares and blends as
# the paper prints it; "paper" does that with the paper's own cut of contact events, signatures of
# the same drops included. Databases are made, used and deleted one after another. Prints Markdown.
# Takes about half an hour a variant on two cores; rows that are in WORK already are not made again.
set -euo pipefail
cd "$(dirname "$0")/.."
ifa=$(realpath "${1:-build/release/bin/ifa}")
seconds=${2:-60}
simulations=${3:-400000}
objects=("${@:4}")
if [ ${#objects[@]} -eq 0 ]; then
  for folder in tests/evaluation/*/; do objects+=("$(basename "$folder")"); done
fi
variants=" ${VARIANTS:-blend images printed paper} "
if [ -n "${WORK:-}" ]; then
  mkdir -p "$WORK"
  work=$(realpath "$WORK")
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
export XDG_CACHE_HOME=$work/cache

# search OBJECT VARIANT CUT SIGNATURES [OPTION...]: one row, as JSON
search() {
  local object=$1 name=$2 cut=$3 signatures=$4
  shift 4
  [[ $variants == *" $name "* && ! -e $work/$object-$name.json ]] || return 0
  echo "$object, $name" >&2
  rm -rf "$work/set"
  mkdir "$work/set"
  cp -r "$signatures/$object" "$work/set/$object"
  "$ifa" database build "$object" -n "$simulations" --cut "$cut" >/dev/null 2>>"$work/log"
  "$ifa" evaluate "$work/set" --parity odd --limit 5 --jobs "${JOBS:-2}" --planner graph \
    --early-exit 1 --simulations "$simulations" --cut "$cut" --processor-time --time-limit "$seconds" \
    -o "$work/$object-$name" "$@" >/dev/null 2>>"$work/log"
}

for object in "${objects[@]}"; do
  search "$object" blend audible tests/evaluation --no-symmetry
  search "$object" images audible tests/evaluation
  search "$object" printed audible tests/evaluation --no-symmetry --printed-velocity \
    --connection blend
  rm -rf "$work/cache"
  if [[ $variants == *" paper "* ]]; then
    "$(dirname "$ifa")/make_evaluation" "$object" --cut paper -o "$work/paper" >/dev/null
  fi
  search "$object" paper paper "$work/paper" --no-symmetry --printed-velocity --connection blend
  rm -rf "$work/cache"
done
python3 scripts/table1.py "$work"
