#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long the tests of a build took, suite by suite and room by room, beside their budgets.

Usage: ledger.py LOG             writes the ledger of a run, of which LOG is BUILD/meson-logs/testlog.json
       ledger.py --check LOG     writes only which suite or room broke its budget; the exit status is 1 if one did
       ledger.py --failed LOG    writes only the tests that failed, each with the end of what it wrote

The budgets are those of tests/budgets.txt. A build with a sanitizer has the budget for that. A machine that is slower
at the moment than the one that they are of has more seconds in proportion.
"""

import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import statistics
import sys
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUDGETS = ROOT / "tests" / "budgets.txt"
SUITES = ("unit", "truth", "programs", "measure")
LONGEST = 5  # tests that the ledger names
LAST_LINES = 25  # of the output of a test that failed
GOOD = ("OK", "EXPECTEDFAIL", "SKIP")
# What a fixed work takes on the machine that the budgets are of (EPYC of the third generation, 2.45 GHz), idle, and the
# most that a machine's slowness is taken for: a suite is to be named that has become slow, not the neighbours.
SECONDS_OF_WORK, SLOWEST = 0.47, 3.0


def is_sanitized(build):
    options = json.loads((build / "meson-info" / "intro-buildoptions.json").read_text(encoding="utf-8"))
    return any(each["name"] == "b_sanitize" and each["value"] not in ("none", []) for each in options)


def budgets(sanitized):
    """{suite or room: seconds}"""
    found = {}
    for line in BUDGETS.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            name, *seconds = line.split()
            found[name] = float(seconds[sanitized])
    return found


def work(_):
    """Seconds of a fixed work: numbers, memory, text and bytes, as tests do."""
    begun = time.perf_counter()
    numbers = random.Random(1)
    drawn = sorted(numbers.random() for _ in range(300000))
    zlib.compress("".join(f"{each:.6f} " for each in drawn).encode(), 6)
    return time.perf_counter() - begun


def slowness():
    """How many times as long as the budgets' machine this one takes, at least 1; with all processors busy, as in a run of
    the tests."""
    count = os.cpu_count() or 1
    with concurrent.futures.ProcessPoolExecutor(count) as pool:
        seconds = statistics.median(pool.map(work, range(3 * count)))
    return min(max(seconds / SECONDS_OF_WORK, 1.0), SLOWEST)


def durations(log):
    """(test, its suites and rooms, seconds). A name is "cubemap:unit+earth / grid"."""
    tests = []
    for line in log.read_text(encoding="utf-8").splitlines():
        record = json.loads(line)
        found = re.fullmatch(r"(?:[^:/]*:)?([^/]*) / (.*)", record["name"])
        suites, name = (found[1].split("+"), found[2]) if found else ([], record["name"])
        tests.append((name, suites, record["duration"]))
    return tests


def sums_of(tests):
    """{suite or room: seconds}; the suites first."""
    sums = collections.Counter()
    for _, suites, seconds in tests:
        for suite in suites:
            sums[suite] += seconds
    return {name: sums[name] for name in sorted(sums, key=lambda name: (name not in SUITES, -sums[name]))}


def broken_of(sums, limits):
    over = {name: seconds for name, seconds in sums.items() if seconds > limits.get(name, float("inf"))}
    factor = slowness() if over else 1.0
    return [f"{name} took {seconds:.0f} s of {factor * limits[name]:.0f} s"
            + (f" ({limits[name]:.0f} s, and this machine takes {factor:.2f} times as long)" if factor > 1.0 else "")
            for name, seconds in over.items() if seconds > factor * limits[name]]


def write(tests, sums, limits):
    print(f"{'suite or room':24} {'seconds':>8} {'budget':>7}")
    for name, seconds in sums.items():
        limit = f"{limits[name]:7.0f}" if name in limits else " " * 7
        print(f"{name:24} {seconds:8.1f} {limit}")
    print(f"{'all tests':24} {sum(each[2] for each in tests):8.1f}")
    longest = sorted(tests, key=lambda each: -each[2])[:LONGEST]
    print("longest:", ", ".join(f"{name} {seconds:.0f}" for name, _, seconds in longest))


def write_failed(log):
    for line in log.read_text(encoding="utf-8").splitlines():
        record = json.loads(line)
        if record["result"] in GOOD:
            continue
        print(f"{record['name']}: {record['result']} after {record['duration']:.0f} s")
        for stream in ("stdout", "stderr"):
            for each in record.get(stream, "").splitlines()[-LAST_LINES:]:
                print("   ", each)


def main(arguments):
    what = arguments[0] if arguments[:1] in (["--check"], ["--failed"]) else None
    if len(arguments) != 1 + (what is not None):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    log = pathlib.Path(arguments[-1])
    if what == "--failed":
        write_failed(log)
        return 0
    tests = durations(log)
    sums = sums_of(tests)
    limits = budgets(is_sanitized(log.parent.parent))
    if what is None:
        write(tests, sums, limits)
        return 0
    broken = broken_of(sums, limits)
    for each in broken:
        print("broke its budget:", each)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
