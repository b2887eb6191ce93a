#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page of scripts/experiments.sh, from what `ifa evaluate` reported.

usage: experiments_page.py best REPORT.json   the case to show: of those with many contacts, the best
       experiments_page.py page WORK OUT      writes OUT/README.md
       experiments_page.py check OUT          whether the page has all sections and whole charts
"""
import datetime
import json
import math
import os
import pathlib
import platform
import re
import sys
from xml.etree import ElementTree

CASES = "\n## Cases"
PART = "\n### "

# report, heading, what is shown of it beside its table (None: all), text
SECTIONS = [
    ("hybrid", "Table 1", None, "Planner `hybrid`, the default, beside the paper's figures for its own recordings (its search "
     "times are minutes on 32 cores, shown in seconds). Ten signatures a row, odd-numbered ones of the "
     "[evaluation sets](../evaluation.md): drops of another engine, with wrong restitution and size, heard with errors. "
     "*f_v* is the geometric mean over contacts."),
    ("planners", "Planners side by side", ["Charts"], "The first five signatures of each row. `graph` is the paper's search, with "
     "events that also stand for their images under the body's symmetry, no early exit. The limit of 60 s and *s to 0.3* are of the processor; *search* and *wall* "
     "are by the clock, several searches at a time. Why it misses some: [branch-and-bound.md](../branch-and-bound.md)."),
    ("paper_cut", "The paper's own cut of events", ["Charts"], "Planner `graph` as above, but every impulse above zero is "
     "part of an event, as in the paper: databases, and signatures of the same drops, cut likewise. The first three of each "
     "row."),
    ("readings", "Other readings of the paper", ["Charts"], "Planner `graph` without images under symmetry; as printed "
     "(the reference of velocities, and flights that are blended and shown at another pace); the latter with the paper's "
     "own cut of events."),
    ("table2", "Table 2: places", ["Places"], "Known places of each drop's contacts were labelled with normal errors of 5 mm on x and "
     "y, and the planner was given the labels. Errors are against the true places. Drops whose path's box has a side "
     "of 20 cm or more, garlic 30 cm, the tape dispenser 35 cm: near the paper's, as far as drops go so far."),
    ("orientations", "Orientations", ["Orientations"], "`--orient last:FACE=up`: the body is to come to rest so."),
    ("database_size", "Figure 16: Score against the size of the database", ["Charts"], "Planner `graph`, one sound an object, the "
     "same for all sizes, no early exit. Times as of `graph` above."),
]

ON_REQUEST = ("paper_cut", "readings")  # not among what is measured without being named


def read(path):
    """The reports of a file, or none."""
    if not path.exists():
        return []
    report = json.loads(path.read_text())
    return report.get("reports", [report])


def best(path):
    cases = [c for report in read(path) for c in report["cases"] if c["solved"]]
    if not cases:
        return ""
    enough = sum(c["n"] for c in cases) / len(cases)
    return max((c for c in cases if c["n"] >= enough), key=lambda c: c["score"])["name"]


def extreme(rows, value, choose):
    """"0.912 (d4 (desk))" of the rows that have solved cases."""
    row = choose((r for r in rows if r["solved"]), key=value, default=None)
    return "nothing solved" if row is None else f"{value(row):.3f} ({row['name']})"


def of_hybrid(report):
    rows, total = report["objects"], report["total"]
    yield (f"`hybrid` solves all signatures of all 31 rows",
           f"{total['solved']} of {total['cases']} on {len(rows)} rows")
    yield "mean Score of each row at least 0.85", f"lowest {extreme(rows, lambda r: r['mean_score'], min)}"
    yield "mean search of each row under 3 s", \
        f"longest {extreme(rows, lambda r: r['mean_search_seconds'], max)} s, of all {total['mean_search_seconds']:.2f} s"


def of_planner(report):
    """Rows on which a search of the database falls behind the paper's."""
    rows = [r for r in report["objects"] if r["paper"]]
    fewer = [r["name"] for r in rows if r["solved"] * r["paper"]["sounds"] < r["paper"]["solved"] * r["cases"]]
    scored = [r for r in rows if r["solved"]]
    worse = [r["name"] for r in scored if r["mean_score"] < r["paper"]["score"]]
    yield f"`{report['label']}`: solved as many as the paper's, on every row", \
        f"{len(rows) - len(fewer)} of {len(rows)} rows" + (f"; not {', '.join(fewer)}" if fewer else "")
    total, sounds = report["total"], sum(r["paper"]["sounds"] for r in rows)
    solved = sum(r["paper"]["solved"] for r in rows)
    yield f"`{report['label']}`: solved of all", \
        f"{total['solved']} of {total['cases']} ({100 * total['solved'] / total['cases']:.0f} %); the paper's {solved} " \
        f"of {sounds} ({100 * solved / sounds:.0f} %)"
    yield f"`{report['label']}`: Score as high as the paper's", \
        f"{len(scored) - len(worse)} of {len(scored)} rows with any solved" + (f"; not {', '.join(worse)}" if worse else "")


def of_places(reports):
    places = [c["places"] for r in reports for c in r["cases"] if c["places"]]
    count = sum(len(r["cases"]) for r in reports)
    relative = [(p["mean"] / p["longest_side"], p["largest"] / p["longest_side"]) for p in places]
    if relative:
        means, largest = zip(*relative)
        yield "places: mean error at most 0.03 of the path's longest side", \
            f"{sum(means) / len(means):.3f} over {len(means)} of {count} motions, {min(means):.3f} to {max(means):.3f}"
        yield "places: largest error at most 0.06", f"{min(largest):.3f} to {max(largest):.3f}"


def of_orientations(reports):
    cases = [c for r in reports for c in r["cases"] if c["orientation_errors"]]
    met = sum(c["solved"] and max(c["orientation_errors"]) <= math.radians(4) for c in cases)
    if cases:
        yield "all final poses within 4 degrees of what was asked", f"{met} of {len(cases)}"


def asked(work):
    """Lines "asked | found" of what there is."""
    for report in read(work / "hybrid.json"):
        yield from of_hybrid(report)
    for report in read(work / "planners.json") + read(work / "paper_cut.json"):
        if report["planner"] == "graph":
            yield from of_planner(report)
    yield from of_places(read(work / "table2.json"))
    yield from of_orientations(read(work / "orientations.json"))


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.processor()


def days(work):
    """First and last day of the measurements."""
    times = [p.stat().st_mtime for p in work.glob("*/*.json")]
    texts = [datetime.datetime.fromtimestamp(t, datetime.timezone.utc).date().isoformat()
             for t in (min(times), max(times))] if times else []
    return " to ".join(dict.fromkeys(texts))


def summary(path, wanted):
    """What a report says but its title, single cases, and parts that are not wanted."""
    table, *parts = path.read_text().split(CASES)[0].split(PART)
    shown = [PART.strip() + " " + part.strip() for part in parts if wanted is None or part.split("\n")[0] in wanted]
    return "\n\n".join([table.split("\n", 2)[2].strip()] + shown)


def page(work, out):
    note = work / "note"
    lines = ["# Experiments", "",
             "The paper's experiments, made again by `scripts/experiments.sh`; do not edit. Measured "
             f"{days(work)} with `ifa` on {os.cpu_count()} cores of {processor()}. "
             + (note.read_text().strip() if note.exists() else ""), "",
             "| asked | found |", "|---|---|"]
    lines += [f"| {wanted} | {found} |" for wanted, found in asked(work)]
    for name, heading, wanted, text in SECTIONS:
        report = out / f"{name}.md"
        if report.exists():
            lines += ["", f"## {heading}", "", text, "", summary(report, wanted), "", f"[Each case]({name}.md)"]
    if (out / "reel.mp4").exists():
        lines += ["", "## Reel", "", "[reel.mp4](reel.mp4): a motion of each row, the best of those with many contacts, with "
                  "the sound that `ifa sonify` makes for it (acrylic, where it knows none of the material)."]
    (out / "README.md").write_text("\n".join(lines) + "\n")


def check(out):
    """Problems of the page, as texts."""
    text = (out / "README.md").read_text()
    for name, heading, *_ in SECTIONS:
        if f"## {heading}" not in text and name not in ON_REQUEST:
            yield f"no section {heading}"
    for link in re.findall(r"\]\(([^)]+)\)", text):
        if not (out / link).exists() and not link.startswith("../"):
            yield f"{link} is not there"
    charts = list(out.glob("*.svg"))
    for chart in charts:
        if not list(ElementTree.parse(chart).iter("{http://www.w3.org/2000/svg}path")):
            yield f"{chart.name} shows nothing"
    if len(charts) < len(SECTIONS):
        yield f"only {len(charts)} charts"


def main():
    if sys.argv[1:2] == ["best"] and len(sys.argv) == 3:
        print(best(pathlib.Path(sys.argv[2])))
    elif sys.argv[1:2] == ["page"] and len(sys.argv) == 4:
        page(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
    elif sys.argv[1:2] == ["check"] and len(sys.argv) == 3:
        problems = list(check(pathlib.Path(sys.argv[2])))
        sys.exit("\n".join(problems) if problems else None)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
