# SPDX-License-Identifier: Apache-2.0
"""make_clicks.py SIGNATURE NAME: writes NAME.wav, a click for each contact of a signature and noise for
one that lasts, and NAME.txt, its labels."""
import json
import math
import pathlib
import random
import struct
import sys
import wave

RATE = 48000
LEAD = 0.1  # s before the first contact

signature = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
name = sys.argv[2]
events = signature["events"]
last = events[-1]["time"] + events[-1]["duration"]
samples = [0.0] * round((LEAD + last + 0.3) * RATE)
noise = random.Random(1)
for event in events:
    start = (LEAD + event["time"]) * RATE
    for i in range(math.ceil(start), math.ceil(start + (event["duration"] + 0.02) * RATE)):
        age = max((i - start) / RATE - event["duration"], 0)
        samples[i] += 0.5 * event["amplitude"] * math.exp(-age / 0.002) * noise.uniform(-1, 1)
with wave.open(f"{name}.wav", "wb") as file:
    file.setnchannels(1)
    file.setsampwidth(2)
    file.setframerate(RATE)
    whole = (round(32767 * max(-1, min(1, sample))) for sample in samples)
    file.writeframes(b"".join(struct.pack("<h", sample) for sample in whole))
with open(f"{name}.txt", "w", encoding="utf-8") as labels:
    for i, event in enumerate(events):
        ending = " terminal" if signature["terminal"] and event is events[-1] else ""
        start = LEAD + event["time"]
        labels.write(f"{start:.6f}\t{start + event['duration']:.6f}\tc{i + 1}{ending}\n")
