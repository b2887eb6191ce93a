#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# check_film.sh [IFA_PROGRAM]: makes films and checks them with ffmpeg: what ffprobe says of them, and
# that every bounce in the decoded pictures is heard in the decoded sound within half a frame of 60
# a second (apps/tools/check_film.cpp, beside the program). The pictures are 240 in a second of the
# motion, which tell bounces apart that follow each other too fast for 60. Fails at the first
# finding. Takes a real recording from IFA_RECORDINGS: one in which each contact is an onset of its
# own; else clicks.
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

# sync NAME OBJECT SOUND LABELS. What is checked is the film: how many bounces a motion has is a
# matter of the planner, so one that needs nothing but the object.
sync() {
  quietly "$ifa" sync "$3" --object "$2" --labels "$4" --planner shoot -o "$work/$1" --formats json
}

# clicks OBJECT CASE: the same for a click at every contact of a case of the evaluation
clicks() {
  python3 scripts/make_clicks.py "tests/evaluation/$1/$2.signature.json" "$work/clicks-$2"
  sync "$2" "$1" "$work/clicks-$2.wav" "$work/clicks-$2.txt"
}

# film NAME WIDTH HEIGHT FPS MOTION... OPTION...: renders and asks ffprobe
film() {
  local film=$work/$1.mp4 width=$2 height=$3 fps=$4
  shift 4
  quietly "$ifa" render "$@" --size "${width}x$height" --fps "$fps" -o "$film"
  ffprobe -v error -count_frames -show_streams -of json "$film" |
    python3 scripts/check_streams.py "$film" "$width" "$height" "$fps" || fail 'ffprobe sees another film'
}

# compare NAME WIDTH HEIGHT FPS SPEED LEAST [SAMPLES_LATE]
compare() {
  ffmpeg -v error -y -i "$work/$1.mp4" -f f32le -ac 1 -ar 48000 "$work/all"
  tail -c +$((4 * ${7:-0} + 1)) "$work/all" >"$work/samples"
  ffmpeg -v error -i "$work/$1.mp4" -f rawvideo -pix_fmt yuv444p - |
    "$tool" "$2" "$3" "$4" "$5" "$6" "$work/samples"
}

# check NAME WIDTH HEIGHT FPS SPEED LEAST MOTION: there are at least LEAST bounces. A shutter that
# opens for no time makes sharp outlines; carpet mirrors nothing.
check() {
  local name=$1 width=$2 height=$3 fps=$4 speed=$5 least=$6
  film "$name" "$width" "$height" "$fps" "$work/$7" --speed "$speed" --camera low --shutter 0 \
    --floor carpet
  echo "$name, ${width}x$height, $fps frames a second"
  compare "$name" "$width" "$height" "$fps" "$speed" "$least" ||
    fail "picture and sound differ in $name"
}

clicks d6 d6-01
check 'd6 and clicks' 1280 720 240 1 6 d6-01
if compare 'd6 and clicks' 1280 720 240 1 6 800 >"$work/log" 2>&1; then
  fail 'a sound that comes a frame early is not noticed'
fi
# Of the cases one whose motion comes down steeply: a corner that hovers a pixel over the floor
# before it touches is seen to touch too early.
clicks d20 d20-11
check 'd20 and clicks' 1280 720 240 1 9 d20-11
clicks Eraser Eraser-04
check 'eraser and clicks' 960 540 240 1 4 Eraser-04
check 'd6 and clicks, quarter speed' 1280 720 60 0.25 6 d6-01
sound=${IFA_RECORDINGS:-}/single/d6/d6_metal_wood_c
if [ -f "$sound.wav" ]; then
  sync recording d6 "$sound.wav" "$sound.txt"
  check 'd6 and d6_metal_wood_c' 960 540 240 1 9 recording
fi

film follow 320 180 60 "$work/d6-01" --camera follow
film beside 480 180 60 "$work/d6-01" "$work/Eraser-04" --side-by-side
echo 'camera that follows, two motions side by side: as ffprobe should see them'
