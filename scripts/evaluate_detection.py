#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scores `ifa detect` against labelled sounds, beside aubio's onset detectors (docs/detection.md).

    scripts/evaluate_detection.py build/release/bin/ifa SOUNDS [-v] [--aubio [METHOD...]] [--cross]
        [--cross-windows] [--confidence]

SOUNDS holds one folder per kind of sound, with NAME.wav and NAME.txt anywhere below. Labels and
detected contacts are both merged at 10 ms before they are compared. In sounds that were made
(make_sounds), a contact labelled "hidden" need not be found, and who finds it or a "blow" that is no
contact by the definition is not wrong. --cross and --cross-windows need detect_settings beside the
program.
"""
import argparse
import concurrent.futures
import os
import pathlib
import random
import statistics
import subprocess
import sys

MERGE_GAP = 0.010
END_TOLERANCE = 0.040
RISES = [3, 3.5, 4, 4.5, 5, 5.25, 5.5, 5.75, 6, 6.5, 7, 8]  # what --cross chooses from, dB
METHODS = ["energy", "hfc", "complex", "phase", "specdiff", "kl", "mkl", "specflux"]
DEFAULT_WINDOW = (0.002, 0.008)  # --after and --before, s
# What --cross-windows chooses from besides: steps of the detector's 0.25 ms, and of 0.5 ms.
WINDOWS = [(after / 4e3, before / 2e3) for after in range(6, 13) for before in range(12, 21)]
HALVINGS = 200
THRESHOLDS = [0.1, 0.3, 0.6, 1.0]


class Case:
    def __init__(self, path, root):
        self.path = path
        self.kind = path.relative_to(root).parts[0]
        self.events, self.hidden, self.blows = [], [], []
        for line in path.with_suffix(".txt").read_text(encoding="utf-8").splitlines():
            start, end, *text = line.split("\t")
            event = (float(start), float(end))
            if text == ["blow"]:
                self.blows.append(event)
            else:
                self.events.append(event)
                self.hidden.append(bool(text) and text[0].startswith("hidden"))
        self.events, groups = merged(self.events)
        self.hidden = [all(self.hidden[i] for i in group) for group in groups]


def merged(labels):
    """(start, end) of every event, one shorter than the gap being a point; and of what each is made."""
    events, groups = [], []
    for i, (start, end) in enumerate(labels):
        if events and start - events[-1][1] < MERGE_GAP - 1e-9:
            events[-1] = (events[-1][0], max(end, events[-1][1]))
            groups[-1].append(i)
        else:
            events.append((start, end))
            groups.append([i])
    return [(s, e if e - s >= MERGE_GAP - 1e-9 else s) for s, e in events], groups


def match(labelled, detected, tolerance):
    """{label: detected}, one to one, nearest first."""
    pairs = sorted((abs(a - b), i, j) for i, (a, _) in enumerate(labelled)
                   for j, (b, _) in enumerate(detected) if abs(a - b) <= tolerance)
    found, used = {}, set()
    for _, i, j in pairs:
        if i not in found and j not in used:
            found[i] = j
            used.add(j)
    return found


def detect(program, sound, options):
    """(start, end, confidence) of every contact."""
    done = subprocess.run([program, "detect", str(sound), *options], capture_output=True, text=True)
    contacts = []
    for line in done.stdout.splitlines()[1:]:
        start, end, _, _, confidence = line.split()[:5]
        contacts.append((float(start), float(start if end == "-" else end), float(confidence)))
    return contacts


def aubio(sound, method, threshold):
    """With the finest step that suits contacts 10 ms apart."""
    done = subprocess.run(["aubioonset", "-i", str(sound), "-O", method, "-t", str(threshold), "-r", "0",
                           "-B", "512", "-H", "64", "-M", "0.010", "-s", "-70"],
                          capture_output=True, text=True)
    return [(float(time), float(time)) for time in done.stdout.split()]


class Score:
    def __init__(self):
        self.labelled = self.detected = self.neutral = self.files = 0
        self.found = {0.010: 0, 0.005: 0}
        self.errors, self.ends = [], []
        self.terminal = self.overlapping = 0

    def add(self, case, contacts):
        detected, _ = merged([contact[:2] for contact in contacts])
        self.files += 1
        self.labelled += case.hidden.count(False)
        for tolerance in self.found:
            pairs = match(case.events, detected, tolerance)
            self.found[tolerance] += sum(not case.hidden[i] for i in pairs)
            if tolerance != MERGE_GAP:
                continue
            self.errors += [detected[j][0] - case.events[i][0] for i, j in pairs.items()]
            kept = self.without_neutral(case, detected, pairs)
            self.detected += len(kept)
            self.neutral += len(detected) - len(kept)
            self.add_terminal(case, kept)

    @staticmethod
    def without_neutral(case, detected, pairs):
        of = {j: i for i, j in pairs.items()}
        return [event for j, event in enumerate(detected)
                if not (case.hidden[of[j]] if j in of else
                        any(s - MERGE_GAP <= event[0] <= e + MERGE_GAP for s, e in case.blows))]

    def add_terminal(self, case, detected):
        heard = [event for event, hidden in zip(case.events, case.hidden) if not hidden]
        if not heard or not detected:
            return
        (start, end), (found_start, found_end) = heard[-1], detected[-1]
        exact = abs(start - found_start) <= MERGE_GAP
        both = end > start and found_end > found_start and found_start < end and start < found_end
        self.terminal += exact
        self.overlapping += exact or both
        if exact or both:
            self.ends.append(abs(end - found_end))

    def f(self, tolerance):
        return 2 * self.found[tolerance] / max(1, self.labelled + self.detected)

    def row(self, name):
        found = self.found[0.010]
        median = statistics.median(map(abs, self.errors)) * 1000 if self.errors else float("nan")
        within = sum(error <= END_TOLERANCE for error in self.ends)
        return (f"| {name} | {self.files} | {self.labelled} | {self.f(0.010):.3f} | {self.f(0.005):.3f} "
                f"| {self.labelled - found} | {self.detected - found} | {self.neutral} | {median:.2f} "
                f"| {self.terminal} | {self.overlapping} | {within} |")


HEADER = ("| sounds | files | events | F, 10 ms | F, 5 ms | missed | invented | neither | median error, ms "
          "| last found | or overlapping | its end within 40 ms |\n" + "|---" * 12 + "|")


def scored(cases, contacts):
    score = Score()
    for case, found in zip(cases, contacts):
        score.add(case, found)
    return score


def in_parallel(function, cases):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(function, cases))


def print_kinds(cases, contacts, verbose):
    print(HEADER)
    for kind in sorted({case.kind for case in cases}):
        chosen = [i for i, case in enumerate(cases) if case.kind == kind]
        print(scored([cases[i] for i in chosen], [contacts[i] for i in chosen]).row(kind))
        for i in chosen if verbose else []:
            print(scored([cases[i]], [contacts[i]]).row(cases[i].path.stem))
    print(scored(cases, contacts).row("all"))


def print_aubio(cases, methods):
    """Every method at the threshold that suits it best on these very sounds."""
    for method in methods:
        scores = [(scored(cases, in_parallel(lambda c, t=threshold: aubio(c.path, method, t), cases)),
                   threshold) for threshold in THRESHOLDS]
        best, threshold = max(scores, key=lambda pair: pair[0].f(0.010))
        print(best.row(f"aubio {method}, -t {threshold}"))


def counted(program, case, settings):
    """Of one sound, for each setting: found within 10 and 5 ms, labelled and detected together."""
    tool = pathlib.Path(program).with_name("detect_settings")
    lines = "".join(f"{rise:g} {after:g} {before:g}\n" for rise, after, before in settings)
    done = subprocess.run([tool, str(case.path)], input=lines, capture_output=True, text=True, check=True)
    counts, contacts = [], []
    for line in done.stdout.split("\n")[:-1]:
        if line:
            contacts.append(tuple(map(float, line.split())))
            continue
        score = scored([case], [contacts])
        counts.append((score.found[0.010], score.found[0.005], score.labelled + score.detected))
        contacts = []
    return counts


def f_measures(counts, chosen):
    """F at 10 and at 5 ms over the sounds at the places `chosen`."""
    near, nearer, both = (sum(counts[i][k] for i in chosen) for k in range(3))
    return 2 * near / max(1, both), 2 * nearer / max(1, both)


def best_of(table, chosen):
    """The place of the best setting: F at 10 ms, among equals F at 5 ms."""
    return max(range(len(table)), key=lambda i: f_measures(table[i], chosen))


def print_cross(program, cases, windows):
    """What suits the even cases of the list best, reported on the odd ones, and back; then the same with
    halves drawn by lot, for two halves are only one draw."""
    settings = [(rise, *window) for window in windows for rise in RISES]
    table = list(zip(*in_parallel(lambda c: counted(program, c, settings), cases)))
    halves = [list(range(start, len(cases), 2)) for start in (0, 1)]
    if len(windows) == 1:
        print("\nF at 10 ms over --min-rise: " + ", ".join(
            f"{rise}: {f_measures(row, halves[0])[0]:.3f} {f_measures(row, halves[1])[0]:.3f}"
            for rise, row in zip(RISES, table)))
    print(f"\nChosen among {len(settings)} settings\n" + HEADER)
    for chosen, name in ((0, "even"), (1, "odd")):
        rise, after, before = settings[best_of(table, halves[chosen])]
        best = ["--min-rise", f"{rise:g}", "--after", f"{after:g}", "--before", f"{before:g}"]
        for half, label in ((chosen, f"{name} half, chosen here: {' '.join(best)}"),
                            (1 - chosen, "the other half with it")):
            part = cases[half::2]
            print(scored(part, in_parallel(lambda c: detect(program, c.path, best), part)).row(label))
    source, others = random.Random(1), []
    for _ in range(HALVINGS):
        order = source.sample(range(len(cases)), len(cases))
        best = best_of(table, order[::2])
        others.append(f_measures(table[best], order[1::2]))
    for k, tolerance in enumerate(("10 ms", "5 ms")):
        values = sorted(pair[k] for pair in others)
        print(f"{HALVINGS} halves by lot, F of the other half at {tolerance}: mean {statistics.mean(values):.3f}, "
              f"lowest tenth under {values[HALVINGS // 10]:.3f}")


def print_confidence(program, cases):
    """What share was true of all that was found with a confidence, softer rises included."""
    bins = [(0, 0.3), (0.3, 0.6), (0.6, 0.8), (0.8, 0.95), (0.95, 1.01)]
    print("\n| confidence | half | contacts | said | true |\n|---|---|---|---|---|")
    for half in (0, 1):
        pairs = []
        chosen = cases[half::2]
        found = in_parallel(lambda c: detect(program, c.path, ["--min-rise", "3"]), chosen)
        for case, contacts in zip(chosen, found):
            true = case.events + case.blows
            pairs += [(confidence, any(s - MERGE_GAP <= start <= e + MERGE_GAP for s, e in true))
                      for start, _, confidence in contacts]
        for low, high in bins:
            inside = [pair for pair in pairs if low <= pair[0] < high]
            if inside:
                print(f"| {low} to {min(high, 1)} | {('even', 'odd')[half]} | {len(inside)} "
                      f"| {statistics.mean(p[0] for p in inside):.2f} "
                      f"| {statistics.mean(p[1] for p in inside):.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("sounds", type=pathlib.Path)
    parser.add_argument("-v", "--verbose", action="store_true", help="a row for every sound")
    parser.add_argument("--aubio", nargs="*", choices=METHODS, help="the same of aubioonset (all methods)")
    parser.add_argument("--cross", action="store_true", help="choose on one half, report on the other")
    parser.add_argument("--cross-windows", action="store_true", help="the same, --after and --before too")
    parser.add_argument("--confidence", action="store_true", help="how often a confidence is right")
    parser.add_argument("options", nargs="*", help="for ifa detect, after --")
    arguments = parser.parse_args()
    cases = [Case(sound, arguments.sounds) for sound in sorted(arguments.sounds.rglob("*.wav"))
             if sound.with_suffix(".txt").exists()]
    if not cases:
        sys.exit(f"no NAME.wav with a NAME.txt under {arguments.sounds}")
    contacts = in_parallel(lambda c: detect(arguments.program, c.path, arguments.options), cases)
    print_kinds(cases, contacts, arguments.verbose)
    if arguments.aubio is not None:
        print_aubio(cases, arguments.aubio or METHODS)
    if arguments.cross:
        print_cross(arguments.program, cases, [DEFAULT_WINDOW])
    if arguments.cross_windows:
        print_cross(arguments.program, cases, WINDOWS)
    if arguments.confidence:
        print_confidence(arguments.program, cases)


if __name__ == "__main__":
    main()
