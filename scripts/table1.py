#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""table1.py DIR: what there is of OBJECT-blend.json, OBJECT-images.json, OBJECT-printed.json and
OBJECT-paper.json of `ifa evaluate` as one table, each row beside the paper's (Langlois and James 2014, Table 1; its
search times are minutes, made seconds)."""
import json
import pathlib
import sys

# nodes, mean n, solved, tried, minutes, Score
PAPER = {
    "CoffeeCup": (5710615, 7.1, 15, 16, 38.2, 0.24),
    "Eraser": (2003606, 4.6, 47, 48, 2.1, 0.50),
    "Lego2x2": (4065133, 9.3, 9, 9, 16.3, 0.36),
    "Nut": (3790909, 8.3, 9, 10, 12.1, 0.33),
    "d4": (3750746, 15.7, 6, 10, 62.7, 0.17),
    "d6": (6751058, 20.4, 13, 14, 12.1, 0.41),
    "d8": (4867818, 22.0, 6, 12, 53.9, 0.27),
    "d10": (7623610, 25.7, 11, 14, 18.6, 0.38),
    "d12": (9934621, 26.0, 4, 7, 24.2, 0.39),
    "d20": (9427739, 26.8, 9, 10, 37.7, 0.31),
}
VARIANTS = {"blend": "v_blend − v_i+, exact", "images": "the same, with images",
            "printed": "printed", "paper": "printed, paper's cut"}
HEAD = ("| object | | events | mean n | solved | s to Score 0.3 | Score | without sound | f_v | "
        "bend, median | largest | arrival bend, median | largest |")


def cells(values):
    return "| " + " | ".join(values) + " |"


def paper_row(name):
    events, n, solved, tried, minutes, score = PAPER[name]
    blank = [""] * 6
    return cells([name, "paper", str(events), f"{n:.1f}", f"{solved}/{tried}",
                  f"{60 * minutes:.0f}", f"{score:.2f}"] + blank)


def our_row(path, label):
    row = json.loads(path.read_text())["total"]
    bend = row["bend"]
    good = f"{row['mean_seconds_to_good']:.1f} ({row['good']})" if row["good"] else "none"
    return cells(["", label, str(row["database_events"]), f"{row['mean_n']:.1f}",
                  f"{row['solved']}/{row['cases']}", good, f"{row['mean_score']:.2f}",
                  f"{row['mean_score_without_sound']:.2f}", f"{row['mean_f_v']:.3f}",
                  f"{bend['median']:.2f}", f"{bend['max']:.2f}",
                  f"{row['arrival_bend']['median']:.2f}", f"{row['arrival_bend']['max']:.2f}"])


def main():
    folder = pathlib.Path(sys.argv[1])
    print(HEAD)
    print("|---" * (HEAD.count("|") - 1) + "|")
    for name in PAPER:
        rows = [(folder / f"{name}-{variant}.json", label) for variant, label in VARIANTS.items()]
        rows = [our_row(path, label) for path, label in rows if path.exists()]
        if rows:
            print(paper_row(name), *rows, sep="\n")


if __name__ == "__main__":
    main()
