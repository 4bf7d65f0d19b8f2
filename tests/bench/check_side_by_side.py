#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks side-by-side in its quick mode: that its JSON and CSV are whole and its figures can be.

Usage: check.py SIDE-BY-SIDE
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

MAPPINGS = ["gnomonic", "coupled", "difference", "healpix"]  # of none to three parameters
NUMBERS = ["ns_best", "ns_lower_quartile", "ns_median", "ns_upper_quartile", "ratio",
           "worst_random_m", "worst_hard_m"]


def run(*command):
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}: {done.stderr}")
    return done.stdout


def check(condition, *what):
    if not condition:
        sys.exit("not so: " + " ".join(str(each) for each in what))


def check_contestant(each):
    for key in NUMBERS:
        check(math.isfinite(each[key]) and each[key] >= 0.0, key, each)
    check(0.0 < each["ns_best"] <= each["ns_median"] <= each["ns_upper_quartile"], each)
    check(each["direction"] in ("forward", "inverse") and each["mapping"] in MAPPINGS, each)
    check(each["refused"] <= each["tried"], each)
    check(len(each["ns_samples"]) == 10 and math.isclose(min(each["ns_samples"]), each["ns_best"], rel_tol=1e-5), each)
    if each["library"] == "libcubemap" and each["tier"] == "exact":
        # the bounds of mapping.h; longitude and latitude add the roundings of two conversions
        bound = 6.4 if each["precision"] == "float" else 5e-9 if each["array"] else 10e-9
        check(max(each["worst_random_m"], each["worst_hard_m"]) < bound, each)
        check(each["refused"] == 0, each)


def check_json(results):
    contestants, scaling = results["contestants"], results["scaling"]
    check(len(results["date"]) == 20 and results["commit"] and results["clock_tick_ns"] > 0.0, "what the run is of")
    for each in contestants:
        check_contestant(each)
    for mapping in MAPPINGS:
        own = [c["ratio"] for c in contestants if c["mapping"] == mapping and c["array"]
               and c["precision"] == "double" and c["tier"] == "exact"]
        check(1.0 in own, "no path of ratio 1:", mapping)
    lengths = {row["points"] for row in scaling}
    check({1, 64, 100, 1000} <= lengths and max(lengths) == 1000, sorted(lengths))
    check(all(row["ns"] > 0.0 for row in scaling), "times of arrays")
    return len(contestants)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder) / name for name in ("results.json", "results.csv")]
        table = run(program, "--quick", "--scaling", "--largest", "1000", "--json", str(files[0]),
                    "--csv", str(files[1]), *MAPPINGS)
        count = check_json(json.loads(files[0].read_text()))
        with files[1].open(newline="") as text:
            rows = list(csv.DictReader(text))
        check(len(rows) == count and None not in rows[0], "rows of CSV", len(rows), count)
        check(len(list(pathlib.Path(folder).iterdir())) == 2, "files beside the results")
    check(all(mapping in table for mapping in MAPPINGS), table)
    listed = run(program, "--list", *MAPPINGS).splitlines()
    check(2 * len(listed) == count, len(listed), "listed")
    for wrong in (["--points", "0"], ["--points", "many"], ["--nothing"], ["no_such_mapping"]):
        done = subprocess.run([program, *wrong], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        check(done.returncode == 2 and done.stderr.count(b"\n") == 1, wrong, done)


if __name__ == "__main__":
    main()
