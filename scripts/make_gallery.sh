#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_gallery.sh [IFA_PROGRAM]: makes docs/gallery again: for each object a contact sheet and three
# stills (a contact, a flight, the end), and two stills of each music example. Needs ffmpeg
# (scripts/install_packages.sh foreign), which turns the pictures into small JPEG files.
set -euo pipefail
cd "$(dirname "$0")/.."
ifa=$(realpath "${1:-build/release/bin/ifa}")
out=docs/gallery
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

jpeg() {
  ffmpeg -v error -y -i "$1" -q:v "$3" -bitexact "$2"
}

# show OBJECT FLOOR INPUT TIME TIME TIME [OPTION...]
show() {
  local object=$1 floor=$2 input=$3 times=("$4" "$5" "$6") number=0
  shift 6
  "$ifa" sync "$input" --object "$object" -o "$work/$object" --formats json "$@" >/dev/null
  "$ifa" render "$work/$object" -o "$work/sheet.png" --quality final --floor "$floor" >/dev/null
  jpeg "$work/sheet.png" "$out/$object-contacts.jpg" 5
  for time in "${times[@]}"; do
    number=$((number + 1))
    "$ifa" render "$work/$object" -o "$work/still.png" --at "$time" --camera close-up \
      --quality final --size 640x360 --floor "$floor" >/dev/null
    jpeg "$work/still.png" "$out/$object-$number.jpg" 4
  done
  echo "$object"
}

cases=tests/evaluation
show d6 desk /usr/share/gnubg/sounds/roll.wav 0.571 0.68 1.5 --labels examples/roll.txt
show d20 carpet $cases/d20/d20-07.signature.json 0.344 0.57 1.6
show CoffeeCup wood $cases/CoffeeCup/CoffeeCup-09.signature.json 0.454 0.54 1.6
show Nut desk $cases/Nut/Nut-09.signature.json 0.428 0.5 2.2
show Lego2x2 carpet $cases/Lego2x2/Lego2x2-03.signature.json 0.738 0.84 2.1
show Eraser wood $cases/Eraser/Eraser-03.signature.json 0.5 0.55 1.4
du -ch "$out"/*.jpg | tail -n 1

# play SCORE TIME...
play() {
  local name=$1 number=0
  shift
  "$ifa" ensemble "examples/music/$name.score.json" -o "$work/$name" --no-film >/dev/null
  for time in "$@"; do
    number=$((number + 1))
    "$ifa" render "$work/$name" -o "$work/still.png" --at "$time" --overlay \
      --quality final --size 640x360 >/dev/null
    jpeg "$work/still.png" "$out/$name-$number.jpg" 4
  done
  echo "$name"
}

play shave 0.88 1.2
play drums 3.2 4.4
