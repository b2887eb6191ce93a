#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every relative link in the Markdown files leads to a file, that every page that
comments in the code name is there, and that no merge left its marks."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")
MERGE = re.compile(r"^(?:<{7}|>{7})(?: |$)", re.MULTILINE)
MENTION = re.compile(r"\bdocs/[\w/-]+\.md\b")


def problems():
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True)
    for name in names.stdout.splitlines():
        path = ROOT / name
        if path.suffix == ".md" and path.is_file():
            text = path.read_text(encoding="utf-8")
            if MERGE.search(text):
                yield f"{name}: marks of a merge"
            for link in LINK.findall(text):
                if "://" not in link and not (path.parent / link).exists():
                    yield f"{name}: no such file: {link}"
        elif path.suffix in (".h", ".cpp", ".txt", ".cmake", ".py") and path.is_file():
            for page in MENTION.findall(path.read_text(encoding="utf-8")):
                if not (ROOT / page).is_file():
                    yield f"{name}: no such page: {page}"


found = sorted(set(problems()))
print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
print(f"documentation: {len(found)} problems")
sys.exit(1 if found else 0)
