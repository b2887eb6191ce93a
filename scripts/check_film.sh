#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# check_film.sh [IFA_PROGRAM]: makes films and checks them with ffmpeg: what ffprobe says of them, and
# that every bounce in the decoded pictures is heard in the decoded sound within half a frame
# (apps/tools/check_film.cpp, beside the program). Fails at the first finding. Takes real recordings
# from IFA_RECORDINGS, the roll of a die from Debian's gnubg-data.
set -euo pipefail
cd "$(dirname "$0")/.."
ifa=$(realpath "${1:-build/release/bin/ifa}")
tool=$(dirname "$ifa")/check_film
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "check_film: $1" >&2
  exit 1
}

if ! command -v ffmpeg >/dev/null || ! command -v ffprobe >/dev/null; then
  echo 'skipped: ffmpeg is not installed'
  exit 0
fi

quietly() {
  "$@" >"$work/log" 2>&1 || {
    cat "$work/log" >&2
    fail "failed: $*"
  }
}

# sync NAME OBJECT SOUND LABELS
sync() { quietly "$ifa" sync "$3" --object "$2" --labels "$4" -o "$work/$1" --formats json; }

# clicks OBJECT CASE: the same for a click at every contact of a case of the evaluation
clicks() {
  python3 scripts/make_clicks.py "tests/evaluation/$1/$2.signature.json" "$work/clicks-$2"
  sync "$2" "$1" "$work/clicks-$2.wav" "$work/clicks-$2.txt"
}

# film NAME WIDTH HEIGHT MOTION... OPTION...: renders and asks ffprobe
film() {
  local film=$work/$1.mp4 width=$2 height=$3
  shift 3
  quietly "$ifa" render "$@" --size "${width}x$height" -o "$film"
  ffprobe -v error -count_frames -show_streams -of json "$film" |
    python3 scripts/check_streams.py "$film" "$width" "$height" || fail 'ffprobe sees another film'
}

# compare NAME WIDTH HEIGHT SPEED [SAMPLES_LATE]
compare() {
  ffmpeg -v error -y -i "$work/$1.mp4" -f f32le -ac 1 -ar 48000 "$work/all"
  tail -c +$((4 * ${5:-0} + 1)) "$work/all" >"$work/samples"
  ffmpeg -v error -i "$work/$1.mp4" -f rawvideo -pix_fmt yuv444p - |
    "$tool" "$2" "$3" 60 "$4" "$work/samples"
}

# check NAME WIDTH HEIGHT SPEED MOTION [OPTION...]
check() {
  local name=$1 width=$2 height=$3 speed=$4
  shift 4
  film "$name" "$width" "$height" "$work/$1" "${@:2}" --speed "$speed" --camera fixed
  echo "$name, ${width}x$height"
  compare "$name" "$width" "$height" "$speed" || fail "picture and sound differ in $name"
}

# Dice are ivory: carpet is the floor from which all their sides stand out.
clicks d6 d6-03
check 'd6 and clicks' 1280 720 1 d6-03 --floor carpet
if compare 'd6 and clicks' 1280 720 1 800 >"$work/log" 2>&1; then
  fail 'a sound that comes a frame early is not noticed'
fi
clicks Eraser Eraser-06
check 'eraser and clicks, half speed' 640 360 0.5 Eraser-06
roll=/usr/share/gnubg/sounds/roll.wav
if [ -f "$roll" ]; then
  sync roll d6 "$roll" examples/roll.txt
  check 'd6 and roll.wav' 1280 720 1 roll
  check 'd6 and roll.wav, quarter speed' 640 360 0.25 roll --floor carpet
fi
for recording in d12/d12_plastic_wood_d d6/die_plastic_roll_a; do
  sound=${IFA_RECORDINGS:-}/single/$recording
  name=${recording#*/}
  [ -f "$sound.wav" ] || continue
  sync "$name" "${recording%/*}" "$sound.wav" "$sound.txt"
  check "$name" 1280 720 1 "$name" --floor carpet
done

film follow 320 180 "$work/d6-03" --camera follow
film beside 480 180 "$work/d6-03" "$work/Eraser-06" --side-by-side
echo 'camera that follows, two motions side by side: as ffprobe should see them'
