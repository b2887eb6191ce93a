#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_suites.py BUILD [EXCLUDE]: runs the tests of a build, one process for each suite and not, as
ctest does, for each test: what a suite sets up is set up once. EXCLUDE is a regular expression over
ctest's names, folder.Suite.Test. As many at a time as there are cores, the long ones first. Prints
what failing suites say, then the slowest; ends with 1 if any failed."""
import collections
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SECONDS = 900


def suites_of(program, exclude):
    """suite -> the tests of it to run. A test's name ends where the comment with its value begins."""
    folder = program.name.removeprefix("ifa_").removesuffix("_test")
    suites, suite = collections.defaultdict(list), ""
    listed = subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, text=True)
    for line in listed.stdout.splitlines():
        name = line.split("#")[0].strip()
        if not line.startswith(" "):
            suite = name
        elif not exclude.search(f"{folder}.{suite}{name}"):
            suites[suite].append(suite + name)
    return suites


def run(program, tests, build):
    environment = dict(os.environ, XDG_CACHE_HOME=str(build / "tests/cache"),
                       LSAN_OPTIONS=f"suppressions={ROOT}/cmake/leaks.supp:print_suppressions=0")
    start = time.monotonic()
    try:
        done = subprocess.run([program, "--gtest_brief=1", "--gtest_filter=" + ":".join(tests)],
                              cwd=build / "tests", env=environment, timeout=SECONDS,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        said, good = done.stdout, done.returncode == 0
    except subprocess.TimeoutExpired as late:
        said, good = (late.stdout or b"") + b"\nnot done in time\n", False
    return good, said.decode(errors="replace"), time.monotonic() - start


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    exclude = re.compile(sys.argv[2] if len(sys.argv) > 2 else "^$")
    jobs = [(program, suite, tests) for program in sorted((build / "bin").glob("ifa_*_test"))
            for suite, tests in suites_of(program, exclude).items()]
    jobs.sort(key=lambda job: -len(job[2]))
    failed, took = 0, []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        running = {pool.submit(run, program, tests, build): suite for program, suite, tests in jobs}
        for future in concurrent.futures.as_completed(running):
            good, said, seconds = future.result()
            took.append((seconds, running[future]))
            if not good:
                failed += 1
                print(f"\n{running[future]} failed:\n{said}", flush=True)
    for seconds, suite in sorted(took, reverse=True)[:10]:
        print(f"{seconds:7.1f} s  {suite.rstrip('.')}")
    print(f"{sum(len(tests) for _, _, tests in jobs)} tests in {len(jobs)} suites, {failed} suites failed")
    return 1 if failed or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())
