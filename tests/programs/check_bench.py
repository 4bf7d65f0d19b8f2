#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks cubemap-bench: that its table, JSON and CSV are whole and their figures can be, that advise keeps
the limits, and what it says to wrong usage.

Usage: check.py CUBEMAP-BENCH
"""

import csv
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

FEW = ["--quick", "--repetitions", "3", "--points", "500", "--random", "200", "--hard", "200"]
QUANTITIES = ["area", "isotropy", "deformation", "scale", "texel-aspect", "texel-area"]


def check(condition, *what):
    if not condition:
        sys.exit("not so: " + " ".join(str(each) for each in what))


def call(*command, **more):
    return subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **more)


def run(*command):
    done = call(*command)
    check(done.returncode == 0 and done.stderr == "", command, done)
    return done.stdout


def check_quantity(name, of):
    check(of["minimum"] <= of["maximum"], name, of)
    error = max(of["maximum"] - of["ideal"], of["ideal"] - of["minimum"])
    check(math.isclose(of["maximum_error"], error, abs_tol=1e-12), name, of)
    for measure in ("over_face", "over_sphere"):
        means = of[measure]
        slack = means["mean_error"] + 1e-9
        check(of["minimum"] - slack <= means["mean"] <= of["maximum"] + slack, name, means)
        check(0.0 <= means["rmse"] <= of["maximum_error"] + 1e-9, name, means)
        values = list(means["percentiles"].values())
        check(len(values) == 5 and values == sorted(values), name, means)


def check_speed(row, has_errors):
    check(0.0 < row["ns_best"] <= row["ns_lower_quartile"] <= row["ns_median"]
          <= row["ns_upper_quartile"], row)
    bound = 5e-9 if row["precision"] == "double" else 6.4
    for key in ("worst_random_m", "rms_random_m", "worst_hard_m", "rms_hard_m"):
        check((row[key] is not None) == has_errors, row)
        check(row[key] is None or 0.0 <= row[key] < bound, row)
    check(row[key] is None or row["rms_hard_m"] <= row["worst_hard_m"], row)


def check_json(results, mappings):
    check(results["program"] == "cubemap-bench" and results["machine"]["cpu"], results["machine"])
    check([m["specification"] for m in results["mappings"]] == mappings, "mappings")
    has_errors = results["mappings"][0]["speed"][0]["worst_random_m"] is not None
    for mapping in results["mappings"]:
        check(sorted(mapping["distortion"]) == sorted(QUANTITIES), mapping["distortion"].keys())
        for name, of in mapping["distortion"].items():
            check_quantity(name, of)
        for row in mapping["speed"]:
            check_speed(row, has_errors)
        kinds = {(r["precision"], r["form"], r["direction"]) for r in mapping["speed"]}
        check({("double", "array", "forward"), ("float", "single", "inverse")} <= kinds, kinds)
        check(abs(mapping["distortion"]["area"]["over_sphere"]["mean"] - 1.0) < 1e-5, mapping)
    equal = {m["specification"]: m["distortion"]["area"]["maximum_error"] < 1e-12
             for m in results["mappings"]}
    check(all(equal[m["specification"]] == m["equal_area"] for m in results["mappings"]), equal)
    return sum(len(m["speed"]) for m in results["mappings"]), has_errors


def check_csv(text, count):
    rows = list(csv.DictReader(text.splitlines()))
    check(len(rows) == count and all(None not in row for row in rows), "rows of CSV", len(rows))
    corner = [float(r["isotropy_max"]) for r in rows if r["mapping"] == "gnomonic"]
    check(corner and all(abs(x - math.sqrt(3.0)) < 1e-8 for x in corner), corner)


def check_results(program, folder):
    mappings = ["gnomonic", "qsc", "tangent:c=1.1823"]
    files = [folder / name for name in ("results.json", "results.csv")]
    table = run(program, *FEW, "--largest", "300", "--map", "5", "--json", str(files[0]), "--csv",
                str(files[1]), "gnom*", *mappings[1:])
    results = json.loads(files[0].read_text())
    count, has_errors = check_json(results, mappings)
    check_csv(files[1].read_text(), count)
    check(all(f"\n{mapping}" in table for mapping in mappings), table)
    lengths = {row["points"] for row in results["mappings"][0]["scaling"]}
    check(lengths == {1, 2, 4, 8, 16, 32, 64, 100, 300}, lengths)
    if has_errors:
        errors = results["mappings"][1]["error_map"]
        check(errors["pixels"] == 5 and len(errors["forward_m"]) == 25, errors)
    check(len(list(folder.iterdir())) == 2, "files beside the results")
    only = json.loads(run(program, *FEW, "--precision", "float", "--form", "single", "--json", "-", "s2"))
    check({(r["precision"], r["form"]) for r in only["mappings"][0]["speed"]} == {("float", "single")},
          "filters")


def check_advise(program, folder):
    file = folder / "advice.json"
    text = run(program, "advise", "--quick", "--max-area-error", "0.2", "--max-isotropy", "1.8",
               "--equal-area", "no", "--json", str(file))
    candidates = json.loads(file.read_text())["candidates"]
    costs = [each["cost_ns"] for each in candidates]
    good = [each for each in candidates if each["qualifies"]]
    check(costs == sorted(costs) and len(candidates) >= 16, costs)
    names = {each["specification"] for each in good}
    check({"coupled", "algebraic", "qsc", "unicube"} <= names, names)
    check(not {"gnomonic", "s2", "everitt", "healpix"} & names, names)
    for each in candidates:
        error = each["area_error"] # null: infinite
        within = error is not None and error <= 0.2 and each["isotropy"] <= 1.8
        check(within == each["qualifies"], each)
    lines = text.splitlines()
    listed = [line.split()[0] for line in lines if line.split()[:1] and line.split()[0] in names]
    check(listed[:len(good)] == [each["specification"] for each in good], text)
    check("Cheaper than " in text or "None is cheaper" in text, text)
    equal = run(program, "advise", "--quick", "--equal-area", "yes", "--json", "-")
    names = {c["specification"] for c in json.loads(equal)["candidates"] if c["qualifies"]}
    check({"qsc", "healpix", "slice", "arvo"} <= names and "coupled" not in names, names)
    none = call(program, "advise", "--quick", "--max-area-error", "0.001", "--max-isotropy", "1.1")
    check(none.returncode == 1 and "No mapping qualifies" in none.stdout and none.stderr == "", none)


def check_options(program, folder):
    for order in (["--points", "100", "--quick"], ["--quick", "--points", "100"]):
        results = json.loads(run(program, *order, "--repetitions", "2", "--random", "9", "--hard", "9",
                                 "--json", "-", "s2"))
        check(results["settings"]["points"] == 100, order, results["settings"])
    # a mapping without a fast tier is advised with its exact one; no promise without standard parameters
    text = run(program, "advise", "--quick", "--precision", "fast", "gnomonic", "tangent")
    check("gnomonic" in text and "tangent" in text, text)
    done = call(program, "advise", "--quick", "--max-error", "1", "cobe:legacy=1")
    check(done.returncode == 1 and "no promise" in done.stdout, done)
    nothing = call(program, "--precision", "fast", "gnomonic")
    check(nothing.returncode == 2 and nothing.stderr.count("\n") == 1, nothing)
    same = str(folder / "same")
    done = call(program, "--json", same, "--csv", same)
    check(done.returncode == 2 and not pathlib.Path(same).exists(), done)


def check_files(program, folder):
    """Links are followed, devices written to, and nothing is left by a signal."""
    real, link = folder / "real.json", folder / "link.json"
    real.write_text("old", encoding="ascii")
    link.symlink_to(real)
    run(program, *FEW, "--json", str(link), "--csv", "/dev/null", "s2")
    check(link.is_symlink() and json.loads(real.read_text())["program"] == "cubemap-bench", "links")
    check(pathlib.Path("/dev/null").is_char_device(), "/dev/null")
    before = sorted(folder.iterdir())
    running = subprocess.Popen([program, "--repetitions", "100000", "--json", str(folder / "never")],
                               stdout=subprocess.DEVNULL)
    while sorted(folder.iterdir()) == before:
        time.sleep(0.01)
    running.terminate()
    check(running.wait() == -signal.SIGTERM and sorted(folder.iterdir()) == before, "after a signal",
          list(folder.iterdir()))


def check_wrong_usage(program, folder):
    for wrong in (["--points", "0"], ["--points", "many"], ["--nothing"], ["no_such_mapping"],
                  ["no_such_*"], ["--precision", "half"], ["--tolerance", "1"], ["tangent:c=-1"],
                  ["--instructions", "mmx"], ["--map", "1.5"], ["advise", "--max-isotropy", "0.5"],
                  ["advise", "--equal-area", "maybe"], ["advise", "--direction", "up"],
                  ["advise", "nothing"], ["papers", "no_such_table"], ["papers", "--wrong"]):
        done = call(program, *wrong)
        check(done.returncode == 2 and done.stdout == "" and done.stderr.count("\n") == 1, wrong, done)
    for wrong in (["--json", str(folder / "no" / "file")], ["--csv", str(folder / "no" / "file")],
                  ["advise", "--json", str(folder / "no" / "file")]):
        done = call(program, *wrong, "s2")
        check(done.returncode == 1 and "cannot write" in done.stderr, wrong, done)
    check(not list(folder.iterdir()), list(folder.iterdir()))
    if pathlib.Path("/dev/full").is_char_device():
        for wanted in ([*FEW, "s2"], ["--help"], ["--list"], ["advise", "--help"], ["papers", "s2"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([program, *wanted], stdout=full, stderr=subprocess.PIPE, check=False)
            check(done.returncode == 1 and b"standard output" in done.stderr, wanted, done)
        done = call(program, *FEW, "--json", "/dev/full", "s2")
        check(done.returncode == 1 and "cannot write /dev/full" in done.stderr, done)
        check(pathlib.Path("/dev/full").is_char_device(), "/dev/full")


def check_words(program):
    check(run(program, "--version").startswith("cubemap-bench (libcubemap) "), "version")
    for command in ([], ["advise"], ["papers"]):
        text = run(program, *command, "--help")
        check(text.startswith("Usage: cubemap-bench") and max(map(len, text.splitlines())) <= 100, text)
    listed = run(program, "--list").splitlines()
    check(len(listed) >= 16 and "coupled" in listed, listed)
    check(run(program, "--list", "t*").split() == ["tangent", "tanh"], "patterns")
    environment = {**os.environ, "CUBEMAP_INSTRUCTIONS": "mmx"}
    done = call(program, "--list", env=environment)
    check(done.returncode == 2 and "mmx" in done.stderr, done)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    program = sys.argv[1]
    check_words(program)
    for each in (check_results, check_advise, check_options, check_files, check_wrong_usage):
        with tempfile.TemporaryDirectory() as folder:
            each(program, pathlib.Path(folder))


if __name__ == "__main__":
    main()
