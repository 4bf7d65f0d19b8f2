#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks cubemap-bench: that its table, JSON and CSV are whole and their figures can be, that advise keeps
the limits, and what it says to wrong usage.

Usage: check.py CUBEMAP-BENCH
"""

import csv
import datetime
import json
import math
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time

COUNTS = ["--repetitions", "3", "--points", "500", "--random", "200", "--hard", "200"]
FEW = ["--quick", *COUNTS]
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
    samples = row["ns_samples"]
    check(len(samples) == 3 and row["calls_a_sample"] >= 1, row)
    check(math.isclose(statistics.median(samples), row["ns_median"], rel_tol=1e-5)
          and math.isclose(min(samples), row["ns_best"], rel_tol=1e-5), row)
    bound = 5e-9 if row["precision"] == "double" else 6.4
    for key in ("worst_random_m", "rms_random_m", "worst_hard_m", "rms_hard_m"):
        check((row[key] is not None) == has_errors, row)
        check(row[key] is None or 0.0 <= row[key] < bound, row)
    check(row[key] is None or row["rms_hard_m"] <= row["worst_hard_m"], row)


def check_json(results, mappings):
    check(results["program"] == "cubemap-bench" and results["machine"]["cpu"], results["machine"])
    check(results["machine"]["compiler"] and "-O" in results["machine"]["flags"], results["machine"])
    date = datetime.datetime.strptime(results["date"], "%Y-%m-%dT%H:%M:%SZ")
    age = datetime.datetime.now(datetime.timezone.utc).replace(tzinfo=None) - date
    check(0.0 <= age.total_seconds() < 3600.0, results["date"], age)
    check(re.fullmatch("[0-9a-f]{7,40}(-dirty)?|unknown", results["commit"]), results["commit"])
    check(0.0 < results["clock_tick_ns"] < 1e7 and results["seconds"] > 0.0, results["clock_tick_ns"])
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
    table = run(program, *COUNTS, "--tolerance", "1e-6", "--largest", "300", "--map", "5", "--json", str(files[0]),
                "--csv", str(files[1]), "gnom*", *mappings[1:])
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


def check_quick(program, folder):
    """Everything in some seconds, and what is left out is null; of a mapping all of whose faces are alike one is enough."""
    began = time.process_time() + os.times().children_user
    table = run(program, "--quick")
    took = time.process_time() + os.times().children_user - began
    check(took < 10.0, "--quick needs", took, "s of a processor") # 2 to 3 on an idle one
    told = re.search(r"; \d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ, (\d+\.\d) s\n", table)
    check(told and float(told[1]) > 0.8 * took, "--quick says", table.splitlines()[0], took)
    words = ["--random", "50", "--hard", "50", "--repetitions", "2", "--json", "-", "gnomonic", "healpix", "difference:mild"]
    quick = json.loads(run(program, "--quick", *words))
    whole = json.loads(run(program, "--tolerance", "1e-4", "--largest", "0", "--map", "0", "--points", "99", *words))
    for one, other in zip(quick["mappings"], whole["mappings"]):
        for name, of in one["distortion"].items():
            for measure in ("over_face", "over_sphere"):
                full = other["distortion"][name][measure]
                check(set(of[measure]["percentiles"].values()) == {None}, name, of)
                check(None not in full["percentiles"].values(), name, full)
                # each is rounded to digits that its error leaves: to five of it at most
                slack = 6 * (of[measure]["mean_error"] + full["mean_error"]) + 1e-9
                check(abs(of[measure]["mean"] - full["mean"]) <= slack, name, of, full)
            for key in ("minimum", "maximum"):
                check(math.isclose(of[key], other["distortion"][name][key], rel_tol=1e-9, abs_tol=1e-9),
                      name, key, of)


def check_short(program, _folder):
    """Arrays of one point take their time, not the clock's ticks: samples are of many calls, and of many values."""
    results = json.loads(run(program, "--quick", "--points", "1", "--repetitions", "30", "--json", "-", "gnomonic"))
    tick = results["clock_tick_ns"]
    for row in results["mappings"][0]["speed"]:
        check(row["calls_a_sample"] * row["ns_median"] > 500.0 * tick, tick, row)
        check(len({round(sample, 6) for sample in row["ns_samples"]}) > 3, "ticks", row)


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
    # of all mappings that takes as long again as the first, which has shown that all are asked
    equal = run(program, "advise", "--quick", "--equal-area", "yes", "--json", "-", "qsc", "healpix", "slice", "arvo", "coupled")
    names = {c["specification"] for c in json.loads(equal)["candidates"] if c["qualifies"]}
    check({"qsc", "healpix", "slice", "arvo"} <= names and "coupled" not in names, names)
    none = call(program, "advise", "--quick", "--max-area-error", "0.001", "--max-isotropy", "1.1", "qsc", "conformal", "coupled")
    check(none.returncode == 1 and "No mapping qualifies" in none.stdout and none.stderr == "", none)
    for each in (check_torn, check_limits, check_precisions, check_sizes, check_uses):
        each(program, folder)


def advised(program, *options):
    """Rows of the table: specification, precision and edges of each that qualifies, in its order."""
    done = call(program, "advise", "--quick", *options)
    check(done.returncode in (0, 1) and done.stderr == "", options, done)
    head, _, rest = done.stdout.partition("edges\n")
    check(rest, done.stdout)
    rows = [line.split() for line in rest.split("\n\n")[0].splitlines() if not rest.startswith("\n")]
    return [(row[0], row[-2], row[-1]) for row in rows], done.stdout


def check_torn(program, folder):
    """A torn map is never the first, unless it is all there is, and says what it is."""
    rows, text = advised(program, "--equal-area", "yes", "arvo", "qsc", "slice")
    check([row[0] for row in rows][-1] == "arvo" and len(rows) == 3 and "arvo is torn" in text, text)
    check({row[0]: row[2] for row in rows} == {"arvo": "torn", "qsc": "continuous", "slice": "smooth"}, rows)
    rows, text = advised(program, "--equal-area", "yes", "--edge", "continuous", "arvo", "qsc", "slice")
    check({row[0] for row in rows} == {"qsc", "slice"} and "torn across edges" in text, text)
    rows, _ = advised(program, "--edge", "smooth", "arvo", "qsc", "slice", "conformal")
    check({row[0] for row in rows} == {"slice", "conformal"}, rows)
    rows, text = advised(program, "--smooth", "c1", "arvo", "qsc", "coupled")
    check([row[0] for row in rows] == ["coupled"] and "torn across edges" in text, text)


def check_limits(program, folder):
    """Exact mappings keep the limits 0 and 1; means have limits and columns; presets do not vanish."""
    for options, exact in ((["--max-deformation", "0"], "conformal"), (["--max-isotropy", "1"], "conformal"),
                           (["--max-area-error", "0"], "qsc"), (["--max-area-rmse", "0"], "qsc")):
        rows, text = advised(program, *options, "conformal", "qsc", "coupled")
        check([row[0] for row in rows] == [exact], options, text)
    rows, text = advised(program, "--max-isotropy-mean", "1.2", "--max-deformation-rmse", "9", "--max-area-rmse",
                         "0.2", "--max-isotropy-rmse", "0.2", "--max-deformation-mean", "8", "difference", "s2")
    check([row[0] for row in rows] == ["difference"] and "mean isotropy 1.256, 0.0563 more than 1.2" in text, text)
    check("D_I mean" in text and "area RMSE" in text and "deg RMSE" in text, text)
    rows, text = advised(program, "--max-error", "1e-8", "difference*", "tangent:c=1.5")
    check({row[0] for row in rows} >= {"difference", "difference:mild", "difference:isotropic"}, text)
    rows, text = advised(program, "--max-isotropy", "1.5", "slice", "seamless", "difference:mild")
    check([row[0] for row in rows] == ["slice"] and "seamless" in text and "difference:mild" in text, text)


def check_precisions(program, folder):
    """Float is proposed where it is accurate enough, and double where float is not."""
    rows, text = advised(program, "--max-error", "2", "algebraic", "slice")
    check({row[:2] for row in rows} >= {("algebraic", "float"), ("algebraic", "fast"), ("slice", "double")}, text)
    check(("slice", "float") not in {row[:2] for row in rows} and "error 2.089 m" in text, text)
    check("Precision, for 2.00 m: float, 1.03 m at most\n" in text, text)
    rows, text = advised(program, "--max-error", "1", "algebraic")
    check({row[1] for row in rows} == {"double"} and "double, 1.9 nm at most; float instead: 1.03 m" in text, text)
    rows, _ = advised(program, "algebraic")
    check([row[1] for row in rows] == ["double"], rows)
    rows, text = advised(program, "--precision", "float", "--max-error", "1e-6", "algebraic", "slice")
    check(not rows and "But double would do: " in text, text)


def check_sizes(program, folder):
    """How big: the size is that of the closed form, whatever the unit; and what less would lose is said."""
    for options, pixels in ((["--source", "8192"], 2608), (["--resolution", "0.5deg"], 230),
                            (["--resolution", "30arcmin"], 230), (["--resolution", "30arcsec"], 13751),
                            (["--resolution", "1e-3rad"], 2000), (["--resolution", "6.3710072km"], 2000),
                            (["--resolution", "6371007.2m"], 2)):
        _, text = advised(program, *options, "gnomonic")
        check(f"faces of {pixels} pixels" in text, options, text)
    _, text = advised(program, "--source", "8192", "gnomonic", "tangent")
    check("4096 as a power of two" in text and "2048 instead: the coarsest 3.357 arcmin, 1.27 times" in text, text)
    check("fewer are enough with tangent: 2365" in text and "in float is off by" in text, text)
    _, text = advised(program, "--source", "100", "smoothstep:c=1")
    check("no size is enough" in text, text)
    file = folder / "advice.json"
    run(program, "advise", "--quick", "--source", "8192", "--json", str(file), "gnomonic", "tangent")
    pixels = {each["specification"]: each["face_pixels"] for each in json.loads(file.read_text())["candidates"]}
    check(pixels == {"gnomonic": 2608, "tangent": 2365}, pixels)


def check_uses(program, folder):
    """Single points cost more than those of arrays; on an ellipsoid the latitude costs time, shape and accuracy."""
    def cost(*options):
        return {(each["specification"], each["precision"]): each for each in json.loads(run(
            program, "advise", "--quick", *options, "--json", "-", "qsc", "conformal"))["candidates"]}
    plain, single = cost(), cost("--form", "single")
    check(all(single[key]["cost_ns"] > plain[key]["cost_ns"] for key in plain), plain, single)
    earth = cost("--ellipsoid", "WGS84")
    for key, latitude in ((("qsc", "double"), "authalic"), (("conformal", "double"), "conformal")):
        check(earth[key]["latitude"] == latitude and plain[key]["latitude"] == "geographic", earth[key])
        check(earth[key]["round_trip_bound_m"] > plain[key]["round_trip_bound_m"], earth[key])
    check(1.0 < earth["qsc", "double"]["isotropy"] / plain["qsc", "double"]["isotropy"] < 1.004, earth)
    check(earth["qsc", "double"]["area_error"] < 1e-12 and earth["conformal", "double"]["isotropy"] < 1.0 + 1e-12,
          earth)
    _, text = advised(program, "--ellipsoid", "WGS84", "--max-error", "0.01", "qsc")
    check("Latitude: authalic, 3 terms of its series, 21.6 um cut off" in text and "; with 2 1.6 cm" in text, text)
    single = cost("--ellipsoid", "WGS84", "--form", "single")
    check(all(single[key]["cost_ns"] > earth[key]["cost_ns"] for key in earth), earth, single)


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
                  ["advise", "--edge", "torn"], ["advise", "--max-area-rmse", "-1"],
                  ["advise", "--resolution", "30"], ["advise", "--resolution", "-1deg"],
                  ["advise", "--resolution", "arcsec"], ["advise", "--resolution", "nandeg"],
                  ["advise", "--resolution", "181deg"], ["advise", "--source", "0"], ["advise", "--source", "1"],
                  ["advise", "--ellipsoid", "WGS48"], ["advise", "--form", "both"],
                  ["advise", "--form", "single", "--precision", "fast"],
                  ["no_such_*"], ["--precision", "half"], ["--tolerance", "1"], ["tangent:c=-1"],
                  ["--instructions", "mmx"], ["--map", "1.5"], ["advise", "--max-isotropy", "0.5"],
                  ["advise", "--equal-area", "maybe"], ["advise", "--direction", "up"],
                  ["advise", "nothing"], ["papers", "no_such_table"], ["papers", "--wrong"],
                  ["compare"], ["compare", "one.json"], ["compare", "1", "2", "3"], ["compare", "-", "-"],
                  ["compare", "--gate", "-1", "1", "2"], ["compare", "--alpha", "0", "1", "2"]):
        done = call(program, *wrong)
        check(done.returncode == 2 and done.stdout == "" and done.stderr.count("\n") == 1, wrong, done)
    for wrong in (["--json", str(folder / "no" / "file")], ["--csv", str(folder / "no" / "file")],
                  ["advise", "--json", str(folder / "no" / "file")]):
        done = call(program, *wrong, "s2")
        check(done.returncode == 1 and "cannot write" in done.stderr, wrong, done)
    check(not list(folder.iterdir()), list(folder.iterdir()))
    if pathlib.Path("/dev/full").is_char_device():
        for wanted in ([*FEW, "s2"], ["--help"], ["--list"], ["advise", "--help"], ["compare", "--help"],
                       ["papers", "s2"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([program, *wanted], stdout=full, stderr=subprocess.PIPE, check=False)
            check(done.returncode == 1 and b"standard output" in done.stderr, wanted, done)
        done = call(program, *FEW, "--json", "/dev/full", "s2")
        check(done.returncode == 1 and "cannot write /dev/full" in done.stderr, done)
        check(pathlib.Path("/dev/full").is_char_device(), "/dev/full")


def check_words(program):
    check(run(program, "--version").startswith("cubemap-bench (libcubemap) "), "version")
    for command in ([], ["advise"], ["compare"], ["papers"]):
        text = run(program, *command, "--help")
        check(text.startswith("Usage: cubemap-bench") and max(map(len, text.splitlines())) <= 100, text)
    listed = run(program, "--list").splitlines()
    check(len(listed) >= 16 and "coupled" in listed, listed)
    starting_so = [name for name in listed if name.startswith("t")]
    check(run(program, "--list", "t*").split() == starting_so and "tanh" in starting_so, "patterns")
    environment = {**os.environ, "CUBEMAP_INSTRUCTIONS": "mmx"}
    done = call(program, "--list", env=environment)
    check(done.returncode == 2 and "mmx" in done.stderr, done)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    program = sys.argv[1]
    check_words(program)
    for each in (check_results, check_quick, check_short, check_advise, check_options, check_files, check_wrong_usage):
        with tempfile.TemporaryDirectory() as folder:
            each(program, pathlib.Path(folder))


if __name__ == "__main__":
    main()
