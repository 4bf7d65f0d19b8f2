#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks with 60 digits what the programs of this folder say of the failures of other libraries.

Usage: truth.py PROGRAM...

Runs each program with the argument failures, takes its lines "failure; ...", and computes the
distance between the answer of the other library and the truth anew. The formulas are those of
research/vectors/vectors, and of Calabretta and Roukema 2007 for HEALPix; nothing comes from libcubemap.
Needs mpmath; without it the exit status is 77.
"""
import importlib.machinery
import importlib.util
import pathlib
import re
import subprocess
import sys

SCRIPT = pathlib.Path(__file__).resolve().parent.parent.parent / "research" / "vectors" / "vectors"
loader = importlib.machinery.SourceFileLoader("vectors", str(SCRIPT))
sys.dont_write_bytecode = True
vectors = importlib.util.module_from_spec(importlib.util.spec_from_loader("vectors", loader))
loader.exec_module(vectors)
from mpmath import mp, mpf, asin, atan2, cos, floor, pi, sin, sqrt  # noqa: E402

mp.dps = 60
EARTH_RADIUS = mpf("6371007.2")
UNITS = {"nm": "1e-9", "um": "1e-6", "mm": "1e-3", "cm": "1e-2", "m": "1", "km": "1e3"}

# S2's faces: docs/guide/frames.md


def direction(lon, lat):
    return [cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)]


def angle(a, b):
    cross = [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
    return atan2(sqrt(sum(w * w for w in cross)), sum(v * w for v, w in zip(a, b)))


def healpix_to_sphere(x, y):
    """HEALPix's plane, x from -4 to 4 and y from -2 to 2, to standard HEALPix's directions."""
    if abs(y) <= 1:
        return direction(x * pi / 4, asin(2 * y / 3))
    sigma = 2 - abs(y)
    middle = 2 * floor(x / 2) + 1
    lon = middle + (x - middle) / sigma if sigma else middle
    sine = (1 - sigma ** 2 / 3) * (1 if y > 0 else -1)
    rho = sigma * sqrt((2 - sigma ** 2 / 3) / 3)
    return [rho * cos(lon * pi / 4), rho * sin(lon * pi / 4), sine]


def healpix_from_sphere(x, y, z):
    lon, sine = atan2(y, x) * 4 / pi, z / sqrt(x * x + y * y + z * z)
    if 3 * abs(sine) <= 2:
        return lon, 3 * sine / 2
    sigma = sqrt(3 * (1 - abs(sine)))
    middle = 2 * floor(lon / 2) + 1
    return middle + (lon - middle) * sigma, (2 - sigma) * (1 if z > 0 else -1)


# ---- The planes of the other libraries: place to direction --------------------------------------

def fits_cube(name, legacy):
    def to_sphere(place):
        x, y = place["x"] / 45, place["y"] / 45
        face = 0 if y > 1 else 5 if y < -1 else 1 + min(int(floor((x + 1) / 2)), 3)
        u = x - (0 if face in (0, 5) else 2 * (face - 1))
        v = y - {0: 2, 5: -2}.get(face, 0)
        return vectors.to_sphere(name, "fits", face, u, v, legacy)
    return to_sphere


def hpx(place):
    return healpix_to_sphere(place["x"] / 45, place["y"] / 45)


def xph(place):
    x, y = (place[w] / 45 / sqrt(mpf(2)) for w in "xy")
    quarter = 0 if x <= 0 < y else 1 if x < 0 else 2 if y < 0 else 3
    xi, eta = [(-x - y, x - y), (x - y, x + y), (x + y, -x + y), (-x + y, -x - y)][quarter]
    return healpix_to_sphere(xi + 2 * quarter - 3, eta + 2)


def proj_qsc(place):
    u, v = (place[w] / EARTH_RADIUS for w in "xy")
    return vectors.to_sphere("qsc", "geo", int(place["chart"]), u, v, None)


def proj_s2(place):
    u, v = (2 * place[w] - 1 for w in "xy")
    return vectors.to_sphere("s2", "s2", int(place["chart"]), u, v, None)


def proj_healpix(place):
    return healpix_to_sphere(*(place[w] / EARTH_RADIUS * 4 / pi for w in "xy"))


# For each mapping what takes a place forward's way back, and what the inverse ought to be.
PLANES = {
    "TSC": [fits_cube("gnomonic", None)] * 2,
    "CSC": [fits_cube("cobe", 0), fits_cube("cobe", 1)],
    "QSC": [fits_cube("qsc", None)] * 2,
    "HPX": [hpx] * 2,
    "XPH": [xph] * 2,
    "qsc": [proj_qsc] * 2,
    "s2": [proj_s2] * 2,
    "healpix": [proj_healpix] * 2,
}


def pixel_place(nside, number):
    """Base pixel, column and row of a nested number."""
    base, inside = divmod(number, nside * nside)
    return base, *(sum((inside >> 2 * i + k & 1) << i for i in range(30)) for k in (0, 1))


def base_middle(base):
    return 2 * (base % 4) + (base // 4 != 1), 1 - base // 4


def pixel_distance(nside, number, point):
    """Of a direction from the nearest of 4 * 64 points on the edge of a pixel of HEALPix."""
    base, column, row = pixel_place(nside, number)
    middle_x, middle_y = base_middle(base)
    edges = [(mpf(i) / 64, k) for i in range(65) for k in (0, 1)]
    places = [((column + a) / mpf(nside), (row + b) / mpf(nside))
              for pair in edges for a, b in (pair, pair[::-1])]
    return min(angle(point, healpix_to_sphere(middle_x + a - b, middle_y + a + b - 1))
               for a, b in places)


def is_in_pixel(nside, number, point):
    """To 2e-6 of a pixel, or 24 nm at the most."""
    base, column, row = pixel_place(nside, number)
    middle_x, middle_y = base_middle(base)
    x, y = healpix_from_sphere(*point)
    across, up = (x - middle_x + 4) % 8 - 4, y - middle_y
    places = nside * (up + 1 + across) / 2 - column, nside * (up + 1 - across) / 2 - row
    return all(-mpf("2e-6") <= place <= 1 + mpf("2e-6") for place in places)


# ---- Lines --------------------------------------------------------------------------------------

NUMBER = re.compile(r"([a-z]+) (-?\d[^ ,]*|-?nan|-?inf)")


def numbers(text):
    """{"lon": 1, ...} of "lon 1 lat 2 degrees", exactly."""
    return {name: mpf(float(value)) for name, value in NUMBER.findall(text)}


def point_of(text):
    """The direction of a longitude and latitude."""
    point = numbers(text)
    unit = 1 if text.endswith("radians") else pi / 180
    return direction(point["lon"] * unit, point["lat"] * unit)


def distance(mapping, way, given, answer):
    """The true distance in radians."""
    if mapping not in PLANES:
        nside = int(re.search(r"nside (\d+)", mapping)[1])
        return pixel_distance(nside, int(answer.split()[1]), list(numbers(given).values()))
    place = numbers(answer)
    if way == "forward":
        return angle(point_of(given), PLANES[mapping][0](place))
    found = point_of(answer)
    return angle(found, PLANES[mapping][1](place) if way == "inverse" else point_of(given))


def is_right(mapping, way, given, answer, right):
    """Is what the program prints as the right answer right, to 20 nm?"""
    if mapping not in PLANES:
        nside = int(re.search(r"nside (\d+)", mapping)[1])
        return is_in_pixel(nside, int(right.split()[1]), list(numbers(given).values()))
    if way == "forward":
        radians = angle(point_of(given), PLANES[mapping][0](numbers(right)))
    elif way == "inverse":
        radians = angle(point_of(right), PLANES[mapping][1](numbers(answer)))
    else:
        radians = angle(point_of(right), point_of(given))
    return radians * EARTH_RADIUS < mpf("20e-9")


def is_good_question(mapping, way, given, answer):
    """Is what it refuses a place on its map, and if it is its own, within 0.1 mm of the point?"""
    there = PLANES[mapping][0](numbers(answer))
    return way == "inverse" or angle(there, point_of(given)) * EARTH_RADIUS < mpf("1e-4")


def check(line):
    """Does the truth agree with the line? To 2 %, as they are printed, and 10 nm."""
    _, peer, mapping, way, given, answer, right, claimed, _, _ = line.split("; ", 9)
    if way == "call":
        return True
    print(f"{peer}, {mapping}, {way}, {given}: ", end="")
    agrees = is_right(mapping, way, given, answer, right)
    if claimed == "refused":
        agrees = agrees and is_good_question(mapping, way, given, answer)
        print("refused, and ought not to be", end="")
    else:
        metres = distance(mapping, way, given, answer) * EARTH_RADIUS
        value, unit = claimed.split()
        printed = mpf(value) * mpf(UNITS[unit])
        agrees = agrees and abs(metres - printed) <= printed / 50 + mpf("1e-8")
        print(f"{claimed}, with 60 digits {float(metres / mpf(UNITS[unit])):.5g} {unit}", end="")
    print("" if agrees else ": THE LINE IS WRONG")
    return agrees


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: truth.py PROGRAM...")
    wrong = count = 0
    for program in sys.argv[1:]:
        output = subprocess.run([program, "failures"], stdout=subprocess.PIPE, text=True,
                                check=False).stdout
        for line in output.split("\n"):
            if line.startswith("failure; "):
                count += 1
                wrong += not check(line)
    print(f"{count} lines, {wrong} of them not what is printed")
    sys.exit(wrong != 0)


if __name__ == "__main__":
    main()
