#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every #include keeps to the layers of src/CMakeLists.txt.

A folder of src/ may include itself, the public headers and the folders that it DEPENDS on; the
public headers include only each other; the folders form no cycle. Link lists alone do not see
an include that needs no symbol.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = (".h", ".cpp", ".inl")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
# What a folder may see whatever it says it depends on: the audit shares nothing with what it audits.
LIMITS = {"audit": {"base", "model", "body"}}


def read_layers():
    text = re.sub(r"#.*", "", (ROOT / "src/CMakeLists.txt").read_text())
    layers = {}
    for name, rest in re.findall(r"ifa_folder\((\w+)([^)]*)\)", text):
        depends = re.search(r"DEPENDS((?:\s+(?!LIBRARIES)\w+)*)", rest)
        layers[name] = set(depends.group(1).split()) if depends else set()
    return layers


def check_layers(layers):
    """A folder comes after all that it depends on, so there can be no cycle."""
    seen = set()
    for name, depends in layers.items():
        for other in sorted(depends - seen):
            yield f"src/CMakeLists.txt: {name} depends on {other}, which is not above it"
        for other in sorted(depends - LIMITS.get(name, depends)):
            yield f"src/CMakeLists.txt: {name} must not depend on {other}"
        seen.add(name)
    for folder in sorted(path.name for path in (ROOT / "src").iterdir() if path.is_dir()):
        if folder not in layers:
            yield f"src/{folder}: not in src/CMakeLists.txt"


def includes_of(path):
    text = path.read_text(encoding="utf-8")
    for match in INCLUDE.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, match.group(1)


def files_below(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SOURCES)


def check_file(path, allowed):
    """Includes in quotes are ours: FOLDER/FILE below src/, ifa/FILE below include/, or a neighbour."""
    for line, name in includes_of(path):
        place = f"{path.relative_to(ROOT)}:{line}"
        folder = name.split("/")[0] if "/" in name else None
        if folder is None and (path.parent / name).is_file():
            continue
        if path.is_relative_to(ROOT / "apps") and (ROOT / "apps" / name).is_file():
            continue
        if folder == "ifa" and (ROOT / "include" / name).is_file():
            continue
        if folder is None or not (ROOT / "src" / name).is_file():
            yield f"{place}: no such header of ours: {name}"
        elif folder not in allowed:
            yield f"{place}: may not include {name}"


def main():
    layers = read_layers()
    problems = list(check_layers(layers))
    count = 0
    for folder, depends in layers.items():
        for path in files_below(ROOT / "src" / folder):
            problems += check_file(path, depends | {folder})
            count += 1
    for path in files_below(ROOT / "include"):
        problems += check_file(path, set())
        count += 1
    for path in files_below(ROOT / "apps"):
        problems += check_file(path, set(layers))
        count += 1
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"includes: {count} files, {len(layers)} folders, {len(problems)} problems")
    return 1 if problems or not layers or not count else 0


if __name__ == "__main__":
    sys.exit(main())
