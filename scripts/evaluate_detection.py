#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scores `ifa detect` against labelled recordings: F-measure per folder, as docs/detection.md tells.

    scripts/evaluate_detection.py build/release/bin/ifa RECORDINGS [-v] [-- options of ifa detect]

RECORDINGS holds one folder per kind of recording, with NAME.wav and NAME.txt anywhere below. Labels
and detected contacts are both merged at 10 ms before they are compared.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

MERGE_GAP = 0.010


def read_labels(path):
    labels = []
    for line in path.read_text(encoding="utf-8").splitlines():
        start, end = line.split("\t")[:2]
        labels.append((float(start), float(end)))
    return labels


def merged(labels):
    """(start, end) of every event; an event shorter than the gap is a point."""
    events = []
    for start, end in labels:
        if events and start - events[-1][1] < MERGE_GAP - 1e-9:
            events[-1] = (events[-1][0], max(end, events[-1][1]))
        else:
            events.append((start, end))
    return [(s, e if e - s >= MERGE_GAP - 1e-9 else s) for s, e in events]


def match(labelled, detected, tolerance):
    """Signed errors of the pairs, one to one, nearest first."""
    pairs = sorted((abs(a - b), i, j) for i, a in enumerate(labelled)
                   for j, b in enumerate(detected) if abs(a - b) <= tolerance)
    used_i, used_j, errors = set(), set(), []
    for _, i, j in pairs:
        if i not in used_i and j not in used_j:
            used_i.add(i)
            used_j.add(j)
            errors.append(detected[j] - labelled[i])
    return errors


def detect(program, sound, options, folder):
    output = pathlib.Path(folder) / "labels.txt"
    subprocess.run([program, "detect", str(sound), "-o", str(output), *options], check=True,
                   stdout=subprocess.DEVNULL)
    return read_labels(output)


class Score:
    def __init__(self):
        self.labelled = self.detected = self.files = 0
        self.errors = {0.010: [], 0.005: []}

    def add(self, labelled, detected):
        self.files += 1
        self.labelled += len(labelled)
        self.detected += len(detected)
        for tolerance, errors in self.errors.items():
            errors += match(labelled, detected, tolerance)

    def row(self, name):
        f = {t: 2 * len(e) / (self.labelled + self.detected) for t, e in self.errors.items()}
        found = self.errors[0.010]
        median = statistics.median(map(abs, found)) * 1000 if found else float("nan")
        return (f"| {name} | {self.files} | {self.labelled} | {f[0.010]:.3f} | {f[0.005]:.3f} "
                f"| {self.labelled - len(found)} | {self.detected - len(found)} | {median:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("recordings", type=pathlib.Path)
    parser.add_argument("-v", "--verbose", action="store_true", help="a row for every recording")
    parser.add_argument("options", nargs="*", help="for ifa detect, after --")
    arguments = parser.parse_args()
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        for sound in sorted(arguments.recordings.rglob("*.wav")):
            labels = sound.with_suffix(".txt")
            if not labels.exists():
                continue
            starts = [s for s, _ in merged(read_labels(labels))]
            found = [s for s, _ in merged(detect(arguments.program, sound, arguments.options, folder))]
            kind = sound.relative_to(arguments.recordings).parts[0]
            names = [kind]
            if kind == "single":
                names.append("single, checked" if sound.stem.endswith("_d") else "single, tuned on")
            if arguments.verbose:
                names.append(f"{kind}/{sound.stem}")
            for name in names:
                rows.setdefault(name, Score()).add(starts, found)
    if not rows:
        sys.exit(f"no NAME.wav with a NAME.txt under {arguments.recordings}")
    print("| recordings | files | events | F, 10 ms | F, 5 ms | missed | invented | median error, ms |")
    print("|---|---|---|---|---|---|---|---|")
    for name, score in sorted(rows.items()):
        print(score.row(name))


if __name__ == "__main__":
    main()
