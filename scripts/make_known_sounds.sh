#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes about 200 sounds whose contacts are known, in a room and in noise, for evaluate_detection.py: of
# the motions that ifa sync finds for five objects of the evaluation set, and of 100 drops by ODE.
#
#   scripts/make_known_sounds.sh build/release/bin FOLDER
set -eu
[ $# -eq 2 ] || { echo "usage: $0 BIN FOLDER" >&2; exit 2; }
bin=$1
folder=$2
cases=$(dirname "$0")/../tests/evaluation

for object in d4 Eraser CoffeeCup Nut Lego2x2; do
  for number in 00 01 02 03 04 05 06 07 08 09 10 11 12 13 14 15 16 17 18 19; do
    # What takes over a minute is left out; none did.
    timeout 60 "$bin/ifa" sync "$cases/$object/$object-$number.signature.json" --object "$object" \
      --formats json -o "$folder/motions/$object-$number" >/dev/null 2>&1 || true
  done
done
"$bin/make_sounds" -o "$folder/sounds/motions" "$folder"/motions/*/motion.json
"$bin/make_sounds" -o "$folder/sounds/drops" --drops 100
