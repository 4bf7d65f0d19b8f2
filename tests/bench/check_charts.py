#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bench/charts/bench-chart on small results, whole ones, ones that lack something and broken ones.

Usage: bench_chart.py SCRIPT

Prints what is wrong; exit status 1 if anything is, 77 without matplotlib.
"""

import collections
import contextlib
import functools
import importlib.machinery
import importlib.util
import io
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

SCRIPT = sys.argv[1]
CHARTS = {"bench-speed-accuracy", "bench-speed-distortion", "bench-area-isotropy", "bench-quantiles",
          "bench-forward-inverse", "bench-scaling", "bench-error-map"}
UNTIMED = {"bench-area-isotropy", "bench-quantiles"}
LIMIT = 300_000  # bytes of a file
# the mappings of the small results: name, family, how much area and isotropy are distorted, ns
MAPPINGS = (("gnomonic", "univariate", 0.4642, 0.3242, 1.4),
            ("tangent:c=1.1823", "univariate", 0.08, 0.29, 3.0),
            ("qsc", "bivariate", 0.0, 0.3471, 6.0))
PIXELS = 8


def expect(condition, *words):
    if not condition:
        print(*words)
        sys.exit(1)


# ---- Results ----

def quantity(least, most, rmse):
    """From the least to the most, with percentiles in even steps between."""
    steps = [least + (most - least) * k / 6 for k in range(7)]
    means = {"mean": steps[3], "mean_error": 0.0, "rmse": rmse, "rmse_error": 0.0,
             "percentiles": dict(zip(("5", "25", "50", "75", "95"), steps[1:6]))}
    return {"unit": "1", "ideal": 1, "minimum": least, "maximum": most,
            "maximum_error": max(1.0 - least, most - 1.0), "ratio": most / least,
            "over_face": means, "over_sphere": means}


def speed(ns):
    rows = []
    for precision, factor, error in (("double", 1.0, 8e-10), ("float", 0.4, 0.5), ("fast", 0.5, 0.6)):
        for form, times in (("array", 1.0), ("single", 9.0)):
            for direction, more in (("forward", 1.0), ("inverse", 1.2)):
                if precision == "fast" and (form == "single" or direction == "forward"):
                    continue  # a tier that lacks a direction
                time = ns * factor * times * more
                rows.append({
                    "precision": precision, "form": form, "direction": direction, "ns_median": time,
                    "ns_lower_quartile": 0.98 * time, "ns_upper_quartile": 1.03 * time,
                    "worst_random_m": 0.8 * error * more, "worst_hard_m": error * more})
    return rows


def mapping(name, family, area, isotropy, ns):
    errors = [1e-10 * (1.0 + (7 * k) % 11) for k in range(PIXELS * PIXELS)]
    return {
        "specification": name, "identifier": name.split(":")[0], "name": name, "family": family,
        "smooth_face": "analytic", "equal_area": area == 0.0,
        "distortion": {"area": quantity(1.0 - area, 1.0 + 2.0 * area, area),
                       "isotropy": quantity(1.0, 1.732, isotropy)},
        "speed": speed(ns),
        "scaling": [{"precision": precision, "direction": direction, "points": points,
                     "ns": ns * factor * (1.0 + 20.0 / points)}
                    for precision, factor in (("double", 1.0), ("float", 0.4))
                    for direction in ("forward", "inverse") for points in (1, 10, 1000)],
        "error_map": {"precision": "double", "face": 0, "pixels": PIXELS, "forward_m": errors,
                      "inverse_m": errors[::-1]},
    }


def results():
    return {"program": "cubemap-bench", "version": "0.1.0", "format": 1,
            "machine": {"cpu": "A processor", "system": "Linux, x86_64", "compiler": "gcc 12.2.0",
                        "flags": "-O3", "instructions": "avx2", "cores_used": 1},
            "settings": {"points": 8192, "repetitions": 30, "random_points": 20000,
                         "hard_points": 20000, "tolerance": 1e-9},
            "mappings": [mapping(*each) for each in MAPPINGS]}


# ---- Running it ----

Done = collections.namedtuple("Done", "returncode stdout stderr")


def run(*arguments):
    """As a function, for matplotlib takes a second to load."""
    said, complained = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(complained):
        status = loaded().main([str(each) for each in arguments])
    return Done(status, said.getvalue(), complained.getvalue())


def run_program(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, encoding="utf-8", check=False)


@functools.lru_cache
def loaded():
    """The script as a module."""
    sys.dont_write_bytecode = True  # it would be written beside the script
    loader = importlib.machinery.SourceFileLoader("bench_chart_script", SCRIPT)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def draw(folder, record, how=run):
    """What it prints, and {chart: file} of those that it says it wrote."""
    folder.mkdir()
    source = folder / "results.json"
    source.write_text(json.dumps(record))
    done = how(source, folder / "charts")
    expect(done.returncode == 0, "exit status", done.returncode, "\n", done.stderr)
    expect(done.stderr == "", "said on standard error:", done.stderr)
    names = [pathlib.Path(line) for line in done.stdout.splitlines() if line.endswith((".svg", ".png"))]
    expect(set(names) == set((folder / "charts").iterdir()), "says it wrote", names)
    return done.stdout, {name.stem: name for name in names if name.suffix == ".svg"}


def check_files(charts):
    for name, svg in charts.items():
        png = svg.with_suffix(".png")
        expect(png.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", png, "is no PNG")
        for path in (svg, png):
            expect(1000 < path.stat().st_size < LIMIT, name, "has", path.stat().st_size, "bytes")
        root = xml.etree.ElementTree.parse(svg).getroot()
        expect(root.tag.endswith("}svg"), svg, "is no SVG, but", root.tag)


def texts(svg):
    """Of an SVG of matplotlib, which draws letters as paths and says in comments what they are."""
    builder = xml.etree.ElementTree.TreeBuilder(insert_comments=True)
    tree = xml.etree.ElementTree.parse(svg, xml.etree.ElementTree.XMLParser(target=builder))
    return "\n".join(each.text for each in tree.iter(xml.etree.ElementTree.Comment))


def check_names(charts, names):
    for chart, svg in charts.items():
        found = texts(svg)
        for name in names:
            expect(name in found, chart, "does not name", name)
        # distortion is the same by all
        expect(("gcc 12.2.0" in found) == (chart not in UNTIMED), chart, "and which compiler")


# ---- Checks ----

def whole(folder):
    said, charts = draw(folder / "whole", results())
    expect("left out" not in said, said)
    expect(set(charts) == CHARTS, "charts are", sorted(charts))
    check_files(charts)
    check_names(charts, [each[0] for each in MAPPINGS])
    _, again = draw(folder / "again", results(), run_program)
    for name, svg in charts.items():
        expect(svg.read_bytes() == again[name].read_bytes(), name, "differs when drawn again")


def one(folder):
    record = results()
    record["mappings"] = record["mappings"][-1:]
    _, charts = draw(folder / "one", record)
    expect(set(charts) == CHARTS, "charts of one are", sorted(charts))
    check_files(charts)


def many(folder):
    """So many that not all labels find room, close to each other, and some with long names."""
    record = results()
    record["mappings"] = [
        mapping(f"tangent:c={1.0 + k / 100},a=0.123456789,b={k}" if k % 4 == 0 else f"tanh:c={k}",
                "hybrid" if k % 3 else "bivariate", 0.1 + 0.02 * math.sin(k),
                0.3 + 0.01 * math.cos(2.0 * k), 2.0 + 0.002 * k) for k in range(24)]
    _, charts = draw(folder / "many", record)
    expect(set(charts) == CHARTS, "charts of many are", sorted(charts))
    check_files(charts)
    expect("for want of room" in texts(charts["bench-speed-accuracy"]), "labels 72 marks in a crowd")


def without_truth(folder):
    """What a build without quadruple precision measures quickly."""
    record = results()
    for each in record["mappings"]:
        each["scaling"] = []
        del each["error_map"]
        for row in each["speed"]:
            row["worst_random_m"] = row["worst_hard_m"] = None
    said, charts = draw(folder / "without", record)
    missing = {"bench-speed-accuracy", "bench-scaling", "bench-error-map"}
    expect(set(charts) == CHARTS - missing, "without errors, charts are", sorted(charts))
    for name in missing:
        expect(f"left out: {name}: " in said, "does not say that it leaves out", name)
    check_files(charts)


def partly(folder):
    """One mapping without errors, and another whose distortion has no limit."""
    record = results()
    for row in record["mappings"][0]["speed"]:
        row["worst_hard_m"] = None
    area = record["mappings"][1]["distortion"]["area"]
    area["maximum"] = area["maximum_error"] = None
    said, charts = draw(folder / "partly", record)
    expect(set(charts) == CHARTS, "charts of some are", sorted(charts))
    expect("bench-speed-accuracy: without gnomonic: " in said, said)
    expect("at the worst point: without tangent:c=1.1823: " in said, said)


def one_way(folder):
    """cubemap-bench --precision float --form single."""
    record = results()
    for each in record["mappings"]:
        each["speed"] = [row for row in each["speed"]
                         if row["precision"] == "float" and row["form"] == "single"]
    _, charts = draw(folder / "float", record)
    expect(set(charts) == CHARTS, "charts of float are", sorted(charts))
    check_files(charts)


def broken_records():
    """(what is wrong, results, a word of the message)"""
    yield "another program", {**results(), "program": "side-by-side"}, "not the results of cubemap-bench"
    yield "another format", {**results(), "format": 2}, "format 2"
    yield "a list", [1, 2], "not the results of cubemap-bench"
    yield "no mappings", {**results(), "mappings": []}, "no mappings"
    yield "mappings no list", {**results(), "mappings": 7}, "not as cubemap-bench writes it"
    for key in ("specification", "distortion", "speed"):
        record = results()
        del record["mappings"][1][key]
        yield f"no {key}", record, key
    record = results()
    record["mappings"][0]["error_map"]["forward_m"].pop()
    yield "a map too small", record, "not as cubemap-bench writes it"


def endless(folder):
    """A mapping whose area is infinite at the corners is shown with an arrow, or missed with a note."""
    record = results()
    area = record["mappings"][0]["distortion"]["area"]
    area["maximum"] = area["maximum_error"] = area["ratio"] = None
    (folder / "endless.json").write_text(json.dumps(record))
    done = run(folder / "endless.json", folder / "endless", "bench-quantiles", "bench-area-isotropy")
    expect(done.returncode == 0, "infinite area", done)
    expect({each.name for each in (folder / "endless").iterdir()} ==
           {f"{name}.{suffix}" for name in ("bench-quantiles", "bench-area-isotropy") for suffix in ("svg", "png")},
           "two charts are asked for, and there are others")
    quantiles = texts(folder / "endless" / "bench-quantiles.svg")
    expect("∞" in quantiles and "An arrow: without end, at the corners of gnomonic" in quantiles,
           "no arrow for gnomonic", quantiles)
    expect(len(re.findall(r"^ *[0-9.]+ *$", quantiles, re.MULTILINE)) >= 6, "few ticks", quantiles)
    expect("Not shown: gnomonic" in texts(folder / "endless" / "bench-area-isotropy.svg"),
           "no note that gnomonic is missing")


def ticks(folder):
    """An axis from 1 to 300, as that of bench-scaling, has more than two."""
    del folder
    chart = loaded()
    figure, axes = chart.plt.subplots()
    axes.set(xscale="log", xlim=(1.01, 345.0))
    chart.log_axis(axes.xaxis)
    shown = [tick for tick in axes.xaxis.get_majorticklocs() if 1.01 <= tick <= 345.0]
    expect(len(shown) >= 6, "few ticks", shown)
    chart.plt.close(figure)


def refuses(done, status, word, what):
    expect(done.returncode == status, what, "ends with", done.returncode, done.stderr)
    expect(done.stderr.count("\n") == 1 and word in done.stderr, what, "says", done.stderr)


def broken(folder):
    source = folder / "broken.json"
    for what, record, word in broken_records():
        source.write_text(json.dumps(record))
        refuses(run(source, folder / "none"), 1, word, what)
    source.write_text(json.dumps(results())[:-9])
    refuses(run(source, folder / "none"), 1, "not JSON", "half a file")
    source.write_bytes(b"\xff\xfe\x00")
    refuses(run(source, folder / "none"), 1, "not JSON", "no text")
    refuses(run_program(folder / "missing.json", folder / "none"), 1, "No such file", "a missing file")
    expect(not (folder / "none").exists(), "made the folder for nothing")
    source.write_text(json.dumps(results()))
    refuses(run(source, source), 1, "exists", "a folder that is a file")


def usage(folder):
    for arguments in ((), (folder / "a.json",), ("a", "b", "c"), ("--what", folder)):
        refuses(run_program(*arguments), 2, "usage", f"bench-chart with {len(arguments)} arguments")
    done = run("--help")
    expect(done.returncode == 0 and "RESULTS.json FOLDER" in done.stdout, "--help says", done.stdout)


def main():
    if importlib.util.find_spec("matplotlib") is None:
        print("matplotlib is missing")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        for check in (whole, one, many, without_truth, partly, one_way, endless, ticks, broken, usage):
            check(pathlib.Path(folder))


if __name__ == "__main__":
    main()
