#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every #include keeps to the layers of src/CMakeLists.txt, and that none is missing.

A folder of src/ may include itself, the public headers and the folders that it DEPENDS on; the
public headers include only each other; the folders form no cycle. Link lists alone do not see
an include that needs no symbol.

A file names the header of what it uses of the standard library, Eigen and fmt, or a header of
ours that does. Precompiled headers and files that are compiled together hide where one is missing.
"""
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = (".h", ".cpp", ".inl")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
ANY_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*")


def functions(names):
    return rf"\bstd::(?:ranges::)?(?:{names.replace(' ', '|')})\s*[(<]"


def types(names):
    return rf"\bstd::(?:{names.replace(' ', '|')})\b"


# What is used -> the headers of which one must be there.
USES = {re.compile(pattern): set(headers.split()) for pattern, headers in (
    (functions("sort stable_sort min max clamp minmax find find_if count count_if any_of all_of none_of"
               " min_element max_element minmax_element lower_bound upper_bound binary_search equal_range"
               " partition partition_point nth_element partial_sort copy copy_n copy_if fill fill_n"
               " transform reverse rotate unique remove remove_if generate mismatch is_sorted push_heap"
               " pop_heap make_heap sort_heap replace merge adjacent_find search for_each"
               " next_permutation set_difference includes"), "algorithm"),
    (functions("accumulate iota inner_product partial_sum adjacent_difference reduce gcd lcm midpoint"),
     "numeric"),
    (functions("sqrt abs sin cos tan asin acos atan atan2 exp exp2 expm1 log log2 log10 log1p pow cbrt"
               " hypot floor ceil round lround llround trunc rint nearbyint fmod remainder isfinite isnan"
               " isinf signbit copysign ldexp frexp nextafter erf erfc fma sinh cosh tanh"),
     "cmath complex"),
    (r"\b(?:NAN|INFINITY)\b", "cmath"),
    (types("array to_array"), "array"),
    (types("atomic"), "atomic"),
    (types("chrono"), "chrono"),
    (types("deque"), "deque"),
    (types("filesystem"), "filesystem"),
    (types("function hash less greater plus"), "functional"),
    (types("ifstream ofstream"), "fstream"),
    (types("istringstream ostringstream stringstream"), "sstream"),
    (types("map multimap"), "map"),
    (types("mutex lock_guard scoped_lock unique_lock"), "mutex"),
    (types("numeric_limits"), "limits"),
    (types("numbers"), "numbers"),
    (types("optional nullopt"), "optional"),
    (types("set multiset"), "set"),
    (types("span"), "span"),
    (types("string to_string"), "string"),
    (types("string_view"), "string_view string"),
    (types("thread"), "thread"),
    (types("tuple tie"), "tuple"),
    (types("unique_ptr shared_ptr make_unique make_shared weak_ptr"), "memory"),
    (types("unordered_map"), "unordered_map"),
    (types("unordered_set"), "unordered_set"),
    (types("variant visit"), "variant"),
    (types("vector"), "vector"),
    (r"\bEigen::", "Eigen/Core Eigen/Geometry Eigen/Dense Eigen/Eigenvalues Eigen/SVD Eigen/LU"),
    (r"\bfmt::", "fmt/format.h fmt/core.h fmt/ranges.h fmt/color.h"),
)}
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


@functools.cache
def headers_of(path):
    """All that a file includes, by itself or through headers of ours."""
    found, ours, waiting = set(), set(), [path]
    while waiting:
        file = waiting.pop()
        ours.add(file)
        for name in ANY_INCLUDE.findall(file.read_text(encoding="utf-8")):
            places = (file.parent, *(ROOT / root for root in ("src", "include", "apps", "tests")))
            here = next((place / name for place in places if (place / name).is_file()), None)
            if here is None:
                found.add(name)
            elif here not in ours:
                waiting.append(here)
    return found


def check_uses(path):
    text = COMMENT.sub("", path.read_text(encoding="utf-8"))
    headers = headers_of(path)
    for line, name in includes_of(path):
        if name.endswith(".cpp"):
            yield f"{path.relative_to(ROOT)}:{line}: {name} is no header"
    for pattern, known in USES.items():
        use = pattern.search(text)
        if use and not known & headers:
            line = text.count("\n", 0, use.start()) + 1
            yield f"{path.relative_to(ROOT)}:{line}: {use.group()} needs <{sorted(known)[0]}>"


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
    for folder in ("src", "include", "apps", "tests", "bench"):
        for path in files_below(ROOT / folder):
            if "node_modules" not in path.parts:
                problems += check_uses(path)
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"includes: {count} files, {len(layers)} folders, {len(problems)} problems")
    return 1 if problems or not layers or not count else 0


if __name__ == "__main__":
    sys.exit(main())
