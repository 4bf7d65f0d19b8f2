#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What colormap_cases.cpp asks of the files that cubemap-colormap has written, which lie in this folder.

A line each: "ok NAME" or "not ok NAME: not true: WHAT".
"""
import csv
import json
import os
import re
import subprocess
import sys
import traceback

MODELS = ["sequential-single", "sequential-rainbow", "sequential-custom", "sequential-saturation",
          "diverging-lightness", "diverging-saturation", "qualitative"]
UNIFORM = ["uniform-purple-yellow", "uniform-red-yellow", "uniform-blue", "uniform-green", "uniform-blue-red",
           "uniform-purple-green", "uniform-cyclic"]
GUIDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../docs/guide/colormaps.md")


def load(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


# ---- CIELUV, from the chromaticities of the primaries of sRGB and its white

def invert(m):
    """The inverse of a 3 by 3 matrix, by cofactors."""
    def minor(i, k):
        a, b = (x for x in range(3) if x != i)
        c, d = (x for x in range(3) if x != k)
        return (-1) ** (i + k) * (m[a][c] * m[b][d] - m[a][d] * m[b][c])
    whole = sum(m[0][k] * minor(0, k) for k in range(3))
    return [[minor(k, i) / whole for k in range(3)] for i in range(3)]


def xyz(x, y):
    return [x / y, 1, (1 - x - y) / y]


def times(m, v):
    return [sum(m[i][k] * v[k] for k in range(3)) for i in range(3)]


WHITE = xyz(0.3127, 0.3290)
PRIMARIES = [list(row) for row in zip(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06))]
BRIGHT = times(invert(PRIMARIES), WHITE)


def luv(srgb):
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in srgb]
    x, y, z = times(PRIMARIES, [c * b for c, b in zip(linear, BRIGHT)])
    if y <= 0:
        return [0, 0, 0]
    lightness = 116 * y ** (1 / 3) - 16 if y > 216 / 24389 else y * 24389 / 27
    whole, of_white = x + 15 * y + 3 * z, WHITE[0] + 15 + 3 * WHITE[2]
    return [lightness, 13 * lightness * (4 * x / whole - 4 * WHITE[0] / of_white),
            13 * lightness * (9 * y / whole - 9 / of_white)]


def worst_step(colors):
    """How far the worst distance of neighbours is from the mean, as a part of it, and the mean."""
    at = [luv(color) for color in colors]
    steps = [sum((a - b) ** 2 for a, b in zip(*pair)) ** 0.5 for pair in zip(at, at[1:])]
    mean = sum(steps) / len(steps)
    return max(abs(step / mean - 1) for step in steps), mean


# ---- the checks

def what_the_map_is():
    for name in MODELS + UNIFORM:
        data = load(name + ".json")
        uniform = name in UNIFORM
        assert data["model"] == name and data["inside"] and data["clipped"]["count"] == 0, name
        assert data["space"] == ("CAM16-UCS" if uniform else "CIELUV"), data["space"]
        assert data["specification"].split(":")[0] == name and (":" in data["specification"]) != uniform
        assert uniform or set(data["parameters"]) == {word.split("=")[0] for word in
                                                      data["specification"].split(":")[1].split(",")}
        count = {"qualitative": 8, "diverging": 257}.get(data["family"], 256)
        assert len(data["samples"]) == count, len(data["samples"])
        assert data["step"]["max_deviation_percent"] < 0.01, data["step"]
        assert data["step"]["max_deviation_without_corners_percent"] < 0.01, data["step"]
        assert (data["largest_saturation"] is None if uniform else
                data["largest_saturation"] > data["parameters"]["saturation"])
        for sample in data["samples"]:
            assert sample["inside"] and all(0 <= value <= 1 for value in sample["srgb"])
            assert sample["hex"] == "#" + "".join("%02x" % int(v * 255 + 0.5) for v in sample["srgb"])
        middle = [s["lch"][1] for s in data["samples"] if s["t"] == 0.5]
        assert data["family"] != "diverging" or len(middle) == 1 and middle[0] < (1e-9 if uniform else 1e-99), middle


def steps_are_even():
    for name in MODELS:
        data = load(name + ".256.json")
        with open(name + ".256.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        assert len(rows) == len(data["samples"]) == 256
        ts = [float(row["t"]) for row in rows]
        assert ts[0] == 0 and all(a < b for a, b in zip(ts, ts[1:])), name
        assert ts[-1] == 1 or name == "qualitative", ts[-1]
        for colors in ([s["srgb"] for s in data["samples"]],
                       [[float(row[c]) for c in ("red", "green", "blue")] for row in rows]):
            worst, mean = worst_step(colors)
            assert worst < 0.0001, (name, worst)
            assert abs(mean - data["step"]["mean"]) < 1e-6 * mean, (name, mean, data["step"])
            assert abs(100 * worst - data["step"]["max_deviation_percent"]) < 1e-5, (name, worst)


def unevenness_is_documented():
    """The guide's rows "| `NAME` ... | CAM16-UCS | CIEDE2000 |", in per cent, are what json says."""
    with open(GUIDE, encoding="utf-8") as file:
        rows = {match[1]: (float(match[2]), float(match[3])) for match in
                re.finditer(r"^\| `([\w-]+)`[^|]*\| ([\d.]+) \| ([\d.]+) \|$", file.read(), re.M)}
    assert set(rows) == set(MODELS + UNIFORM), rows
    for name, (own, other) in rows.items():
        measured = load(name + ".json")["step"]["unevenness_percent"]
        assert abs(measured["CAM16-UCS"] - own) < 0.0501, (name, measured, own)
        assert abs(measured["CIEDE2000"] - other) < 0.0501, (name, measured, other)
        assert name not in UNIFORM or measured["CIEDE2000"] < 9 and measured["CAM16-UCS"] < 0.01, measured


def steps_are_not_even():
    data = load("fold.json")
    assert data["step"]["max_deviation_percent"] > 99, data["step"]
    assert abs(data["step"]["max_deviation_t"] - 0.5) < 0.01, data["step"]
    assert worst_step([s["srgb"] for s in data["samples"]])[0] > 0.99
    assert data["step"]["max_deviation_without_corners_percent"] < 1e-6, data["step"]


def one_sample():
    data = load("one.json")
    assert data["step"] is None and len(data["samples"]) == 1


def what_is_cut():
    data = load("cut.json")
    outside = [i for i, sample in enumerate(data["samples"]) if not sample["inside"]]
    assert not data["inside"] and data["clipped"]["count"] == len(outside) > 0
    assert data["clipped"]["first"] == outside[0]
    assert data["clipped"]["first_t"] == data["samples"][outside[0]]["t"]
    assert data["clipped"]["excess"] > 0.01
    assert 2.2 < data["largest_saturation"] < 2.21


MATPLOTLIB = """
import matplotlib
import mine
try:
    registered = matplotlib.colormaps["mine"], matplotlib.colormaps["mine_r"]
except AttributeError:
    registered = matplotlib.cm.get_cmap("mine"), matplotlib.cm.get_cmap("mine_r")
assert registered[0].N == 257 and registered[0](0.0) == registered[1](1.0)
assert max(registered[0](0.5)[:3]) - min(registered[0](0.5)[:3]) < 1e-9, registered[0](0.5)
assert mine.colormap.name == "mine"
"""


def matplotlib_python():
    """A Python that has matplotlib, which Debian installs for /usr/bin/python3; None if there is none."""
    for python in (sys.executable, "/usr/bin/python3"):
        find = "import importlib.util, sys; sys.exit(importlib.util.find_spec('matplotlib') is None)"
        if os.path.exists(python) and subprocess.run([python, "-c", find], check=False).returncode == 0:
            return python
    return None


def matplotlib_takes_it():
    ran = subprocess.run([matplotlib_python(), "-c", MATPLOTLIB], check=False, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr.strip().replace("\n", "; ")


def check(name, function):
    try:
        function()
        print("ok", name)
    except Exception as exception:  # whatever a damaged file brings
        print(f"not ok {name}: not true: {exception!r} in", traceback.extract_tb(exception.__traceback__)[-1].line)


def main():
    check("json: colours, steps and what the map is", what_the_map_is)
    check("steps of 256 colours are even, corners included, and json says so", steps_are_even)
    check("json's unevenness is that of the guide", unevenness_is_documented)
    check("json says where steps are not even", steps_are_not_even)
    check("one sample", one_sample)
    check("json says what is cut", what_is_cut)
    if matplotlib_python() is None:
        print("skipped: there is no matplotlib")
    else:
        check("matplotlib takes it", matplotlib_takes_it)


if __name__ == "__main__":
    main()
