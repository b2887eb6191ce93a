#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""evaluate_unlabelled.py IFA RECORDINGS: `ifa sync` without labels on each recording of a single
object (RECORDINGS/OBJECT/NAME.wav), and how many of the contacts that a person marked in NAME.txt
(merged at 10 ms, as a signature's are) a contact of the motion begins within 10 ms of."""
import json
import pathlib
import subprocess
import sys
import tempfile

MERGE = NEAR = 0.010  # s


def marks(path):
    """Starts of the labels, s; those that follow within the merge gap are the same event's."""
    starts, end = [], None
    for line in path.read_text().splitlines():
        fields = line.split("\t")
        if line.startswith("\\") or len(fields) < 2:
            continue
        begin, until = float(fields[0]), float(fields[1])
        if end is None or begin - end >= MERGE - 1e-9:
            starts.append(begin)
        end = max(end or 0, until)
    return starts


def met(wanted, there):
    """How many of `wanted` have one of `there` to themselves within NEAR."""
    left, count = list(there), 0
    for time in wanted:
        near = [other for other in left if abs(other - time) <= NEAR]
        if near:
            left.remove(min(near, key=lambda other: abs(other - time)))
            count += 1
    return count


def main():
    ifa, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    solved = found = wanted = sounds = 0
    score = 0.0
    print("| recording | marked | contacts | within 10 ms | left out, moved | solved | Score |")
    print("|---|---|---|---|---|---|---|")
    for sound in sorted(folder.glob("*/*.wav")):
        human = marks(sound.with_suffix(".txt"))
        with tempfile.TemporaryDirectory() as out:
            subprocess.run([ifa, "sync", sound, "--object", sound.parent.name, "-o", out,
                            "--formats", "json"], capture_output=True, check=False)
            motion = json.loads((pathlib.Path(out) / "motion.json").read_text())
        first = motion["sound"]["first_contact"]
        # A pre-roll longer than what comes before the sound puts silence in front of it.
        silence = motion["sound"]["duration"] - duration(sound)
        starts = [first - silence + contact["time"] for contact in motion["contacts"]]
        near = met(human, starts)
        moved = sum("moved" in contact for contact in motion["contacts"])
        print(f"| {sound.stem} | {len(human)} | {len(starts)} | {near} | "
              f"{len(motion.get('dropped', []))}, {moved} | {'yes' if motion['success'] else 'no'} | "
              f"{motion['score']:.3f} |", flush=True)
        sounds += 1
        wanted += len(human)
        found += near
        if motion["success"]:
            solved += 1
            score += motion["score"]
    print(f"\n{solved} of {sounds} solved, mean Score {score / max(1, solved):.3f}, "
          f"{found} of {wanted} marks ({found / max(1, wanted):.1%}) met within 10 ms")


def duration(sound):
    """Of a WAV file, s."""
    import wave

    with wave.open(str(sound)) as file:
        return file.getnframes() / file.getframerate()


if __name__ == "__main__":
    main()
