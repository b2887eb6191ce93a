#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# From a real recording of a thrown die (Debian's gnubg-data) to a film of a die that fits it:
# installs what is missing, builds, and writes out/demo/. The second time it is quick.
set -eu
cd "$(dirname "$0")/.."

scripts/install_packages.sh build demo
cmake --preset release
cmake --build --preset release --target ifa_program

sound=/usr/share/gnubg/sounds/roll.wav
echo "Synchronising a die to $sound ..."
build/release/bin/ifa sync "$sound" --labels examples/roll.txt --object d6 -o out/demo
echo "Rendering ..."
build/release/bin/ifa render out/demo --quality final --overlay -o out/demo/film.mp4
echo "The film is $PWD/out/demo/film.mp4"
echo "out/demo/motion.glb opens in Blender or any glTF viewer, with out/demo/sound.wav at time 0."
