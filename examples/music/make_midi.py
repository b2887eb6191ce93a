#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the MIDI files of the two examples beside itself: shave.mid and drums.mid."""
import pathlib
import struct

TICKS = 96  # of a quarter note
HAT, BASS, SNARE = 42, 36, 38  # General MIDI's drum notes
DRUMS = 9  # channel 10


def quantity(value):
    """A variable-length quantity."""
    data = [value & 0x7F]
    while value := value >> 7:
        data.append(0x80 | value & 0x7F)
    return bytes(reversed(data))


def track(name, notes, channel=0, tempo=None):
    """notes: (start in ticks, length, key, velocity)."""
    events = []
    for start, length, key, velocity in notes:
        events.append((start, 1, bytes([0x90 | channel, key, velocity])))
        events.append((start + length, 0, bytes([0x80 | channel, key, 0])))
    data = b"\0\xff\x03" + quantity(len(name)) + name.encode()
    if tempo:
        data += b"\0\xff\x51\x03" + round(60e6 / tempo).to_bytes(3, "big")
    now = 0
    for time, _, message in sorted(events):
        data += quantity(time - now) + message
        now = time
    data += b"\0\xff\x2f\0"
    return b"MTrk" + struct.pack(">I", len(data)) + data


def write(name, tracks):
    head = b"MThd" + struct.pack(">IHHH", 6, 1, len(tracks), TICKS)
    (pathlib.Path(__file__).parent / name).write_bytes(head + b"".join(tracks))


def shave():
    """Shave and a hair-cut, two bits: seven knocks."""
    beats = [0, 1, 1.5, 2, 3, 5, 6]
    notes = [(round(beat * TICKS), 24, 60, 100) for beat in beats]
    write("shave.mid", [track("knocks", notes, tempo=360)])


def drums():
    """Two bars: even sixteenths of the high hat, and a broken beat of bass and snare below."""
    step = TICKS // 4
    hats = [(i * step, 12, HAT, 90 if i % 4 == 0 else 75) for i in range(32)]
    bass = [0, 2, 10, 13, 16, 18, 22, 26, 27]
    snare = [4, 7, 9, 12, 15, 20, 23, 25, 28, 30]
    beat = [(i * step, 12, BASS, 110) for i in bass] + [(i * step, 12, SNARE, 100) for i in snare]
    write("drums.mid", [track("hats", hats, DRUMS, tempo=105), track("beat", beat, DRUMS)])


if __name__ == "__main__":
    shave()
    drums()
