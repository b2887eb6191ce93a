#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Eight takes against one: the table "Takes" of docs/results.md.

usage: scripts/takes.py IFA_PROGRAM [OBJECT-NN ...]

Without cases: the first two odd ones of each object of tests/evaluation. Seconds are of the processor, of the whole
call.
"""
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

OBJECTS = ["CoffeeCup", "Eraser", "Lego2x2", "Nut", "d4", "d6", "d8", "d10", "d12", "d20"]
EVALUATION = pathlib.Path(__file__).parent.parent / "tests" / "evaluation"


def children_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def sync(ifa, case, takes, folder):
    """Scores of the takes, best first, their largest bends, and the processor's seconds."""
    name = case.rsplit("-", 1)[0]
    begin = children_seconds()
    subprocess.run([ifa, "sync", str(EVALUATION / name / f"{case}.signature.json"), "--object", name, "--takes",
                    str(takes), "--formats", "json", "-o", folder], check=True, capture_output=True)
    seconds = children_seconds() - begin
    files = [pathlib.Path(folder) / f"take-{i + 1}" / "motion.json" for i in range(takes)]
    motions = [json.loads(f.read_text()) for f in (files if takes > 1 else [pathlib.Path(folder) / "motion.json"])
               if f.exists()]
    bends = [max([m["bend"]["max"]] + [c.get("arrival_bend", 0) for c in m["contacts"]]) for m in motions]
    return [m["score"] for m in motions], bends, seconds


def main():
    ifa = sys.argv[1]
    cases = sys.argv[2:] or [f"{name}-{number}" for name in OBJECTS for number in ("01", "03")]
    print("| case | one: Score | s | takes | Score of the first | of the last | largest bend | s | ratio |")
    print("|---|---|---|---|---|---|---|---|---|")
    for case in cases:
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as many:
            single, _, price = sync(ifa, case, 1, one + "/out")
            scores, bends, seconds = sync(ifa, case, 8, many + "/out")
        print(f"| {case} | {single[0]:.3f} | {price:.2f} | {len(scores)} | {scores[0]:.3f} | {scores[-1]:.3f} | "
              f"{max(bends):.2f} | {seconds:.2f} | {seconds / price:.2f} |", flush=True)


if __name__ == "__main__":
    main()
