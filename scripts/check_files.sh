#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# check_files.sh [IFA_PROGRAM]: makes motions of several objects and checks their files with programs
# that are not ours: the Khronos validator, three.js, TinyUSDZ, ffmpeg, and Blender where there is
# one (scripts/install_packages.sh foreign). Fails at the first of them that finds something.
# Takes real recordings from IFA_RECORDINGS, the roll of a die from Debian's gnubg-data.
set -euo pipefail
cd "$(dirname "$0")/.."
ifa=$(realpath "${1:-build/release/bin/ifa}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "check_files: $1" >&2
  exit 1
}

# make OBJECT INPUT [OPTION...]: a folder named after the input
make() {
  local object=$1 input=$2 name
  shift 2
  name=$(basename "$input")
  name=${name%.wav}
  "$ifa" sync "$input" --object "$object" -o "$work/${name%.signature.json}" \
    --formats json,glb,usda,csv "$@" >"$work/log" 2>&1 || {
    cat "$work/log" >&2
    fail "no motion of $object for $input"
  }
}

echo 'Making motions'
for case in d6/d6-06 d20/d20-02 d20/d20-07 d4/d4-06 CoffeeCup/CoffeeCup-01 CoffeeCup/CoffeeCup-09 \
  Nut/Nut-01 Nut/Nut-09 Lego2x2/Lego2x2-03 Lego2x2/Lego2x2-07; do
  make "${case%/*}" "tests/evaluation/$case.signature.json"
done
roll=/usr/share/gnubg/sounds/roll.wav
[ ! -f "$roll" ] || make d6 "$roll" --labels examples/roll.txt
if [ -n "${IFA_RECORDINGS:-}" ]; then
  recording=$(find "$IFA_RECORDINGS/single/d6" -name '*.wav' 2>/dev/null | sort | head -n 1)
  [ -z "$recording" ] || make d6 "$recording" --labels "${recording%.wav}.txt"
fi
rm "$work/log"

printf '\nKhronos validator\n'
scripts/install_validators.sh
node tests/export/validate_glb.mjs "$work"/*/motion.glb >"$work/log" || {
  cat "$work/log" >&2
  fail 'the Khronos validator finds errors or warnings in motion.glb'
}
rm "$work/log"
echo "$(find "$work" -name motion.glb | wc -l) files, no errors, no warnings"

printf '\nthree.js and TinyUSDZ, lengths in mm\n'
node tests/export/check_animations.mjs "$work"/*/ || fail 'three.js or TinyUSDZ see another motion'

printf '\nffmpeg\n'
if command -v ffprobe >/dev/null; then
  for sound in "$work"/*/sound.wav; do
    [ -f "$sound" ] || continue
    ffprobe -v error -show_entries stream=sample_rate,duration -of json "$sound" |
      python3 scripts/check_sound.py "$sound" || fail 'ffmpeg hears another sound'
  done
else
  echo 'skipped: ffmpeg is not installed'
fi

printf '\nBlender, lengths in mm\n'
if ! command -v blender >/dev/null; then
  echo 'skipped: blender is not installed'
  exit 0
fi
if ! blender -b --factory-startup --python-exit-code 1 --python-expr 'import numpy' &>/dev/null; then
  echo 'skipped: Blender lacks numpy, which its glTF importer needs (python3-numpy)'
  exit 0
fi
blender -b --factory-startup --python-exit-code 1 -P scripts/check_blender.py -- "$work"/*/ \
  >"$work/log" 2>"$work/errors" && good=1 || good=
# Blender's importer tells of itself between the rows.
grep -v -e '^Data are loaded' -e '^glTF import' -e '^Blender ' -e '^$' "$work/log" || true
if [ -z "$good" ]; then
  cat "$work/errors" >&2
  fail 'Blender sees another motion'
fi
