#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# From a real recording of a thrown die (Debian's gnubg-data) to a motion of a die that fits it:
# installs what is missing, builds, and writes out/demo/. The second time it is quick.
set -eu
cd "$(dirname "$0")/.."

scripts/install_packages.sh build demo
cmake --preset release
cmake --build --preset release --target ifa_program

sound=/usr/share/gnubg/sounds/roll.wav
echo "Synchronising a die to $sound ..."
build/release/bin/ifa sync "$sound" --labels examples/roll.txt --object d6 -o out/demo
echo "Open out/demo/motion.glb in Blender or any glTF viewer, lay out/demo/sound.wav beside it at time 0,"
echo "and look at out/demo/timeline.svg in a browser."
