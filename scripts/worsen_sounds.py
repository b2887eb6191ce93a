#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Copies labelled sounds with a fault added, for evaluate_detection.py.

    scripts/worsen_sounds.py SOUNDS FOLDER noise-40|clip-12|hum-20

noise-N: white noise N dB under the peak (RMS); clip-N: clipped N dB under the peak; hum-N: 100 Hz,
N dB under the peak. SOUNDS: WAV files of one channel and 16 bits with their labels, anywhere below.
"""
import array
import math
import pathlib
import random
import shutil
import sys
import wave


def noise(samples, level, _):
    source = random.Random(1)
    return [x + source.gauss(0, level) for x in samples]


def clip(samples, level, _):
    return [max(-level, min(level, x)) for x in samples]


def hum(samples, level, rate):
    return [x + level * math.sin(2 * math.pi * 100 * i / rate) for i, x in enumerate(samples)]


def main():
    source, target, fault = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    kind, decibels = fault.split("-")
    worsen = {"noise": noise, "clip": clip, "hum": hum}[kind]
    for path in sorted(source.rglob("*.wav")):
        with wave.open(str(path)) as file:
            parameters = file.getparams()
            samples = array.array("h", file.readframes(file.getnframes()))
        level = max(map(abs, samples)) * 10 ** (-float(decibels) / 20)
        worse = worsen(samples, level, parameters.framerate)
        scale = min(1, 32767 / max(map(abs, worse)))
        out = target / path.relative_to(source)
        out.parent.mkdir(parents=True, exist_ok=True)
        with wave.open(str(out), "wb") as file:
            file.setparams(parameters)
            file.writeframes(array.array("h", [round(x * scale) for x in worse]).tobytes())
        shutil.copy(path.with_suffix(".txt"), out.with_suffix(".txt"))


if __name__ == "__main__":
    main()
