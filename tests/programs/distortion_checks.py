#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What tests/programs/distortion.sh asks of pictures, computed here independently of the tools.

Usage: distortion_checks.py HELPER CHECK [ARGUMENT...]

HELPER is the program made of picture_pixels.cpp. Prints what is wrong; exit status 1 if anything is.
"""

import array
import math
import random
import subprocess
import sys

HELPER = sys.argv[1]
MEAN_SCALE = 6 / math.pi


class Picture:
    """Rows from the top; at(x, y) is the tuple of a pixel's channels."""

    def __init__(self, name):
        data = subprocess.run([HELPER, "pixels", name], stdout=subprocess.PIPE, check=True).stdout
        head, pixels = data.split(b"\n", 1)
        self.width, self.height, self.channels = map(int, head.split())
        self.values = array.array("f", pixels)

    def at(self, x, y):
        start = (y * self.width + x) * self.channels
        return self.values[start:start + self.channels]

    def first(self, x, y):
        return self.values[(y * self.width + x) * self.channels]


def expect(condition, *words):
    if not condition:
        print(*words)
        sys.exit(1)


def close(found, wanted, tolerance, *words):
    expect(abs(found - wanted) <= tolerance, *words, "is", found, "and should be", wanted)


def centre(i, size):
    return (2 * i + 1) / size - 1


# ---- values ----

def gnomonic(u, v):
    """All quantities in closed form, degrees for the angle."""
    square = 1 + u * u + v * v
    isotropy = math.sqrt(square)
    return {
        "scale": square ** 1.5,
        "area": square ** 1.5 / MEAN_SCALE,
        "isotropy": isotropy,
        "deformation": math.degrees(2 * math.asin((isotropy - 1) / (isotropy + 1))),
        "texel-aspect": math.sqrt((1 + v * v) / (1 + u * u)),
        "texel-area": math.sqrt((1 + u * u) * (1 + v * v)) / square ** 2 * MEAN_SCALE,
    }


def from_tangents(by_u, by_v):
    """All quantities from the derivatives of the direction."""
    uu = sum(a * a for a in by_u)
    vv = sum(a * a for a in by_v)
    uv = sum(a * b for a, b in zip(by_u, by_v))
    area = math.sqrt(uu * vv - uv * uv)
    mean = (uu + vv) / 2
    half = math.hypot((uu - vv) / 2, uv)
    isotropy = (mean + half) / area  # longer over shorter axis, squared lengths over their product
    return {
        "scale": 1 / area,
        "area": 1 / area / MEAN_SCALE,
        "isotropy": isotropy,
        "deformation": math.degrees(2 * math.asin((isotropy - 1) / (isotropy + 1))),
        "texel-aspect": math.sqrt(uu / vv),
        "texel-area": math.sqrt(uu * vv) * MEAN_SCALE,
    }


def check_gnomonic(quantity, name):
    """One face of values."""
    picture = Picture(name)
    expect(picture.channels == 1 and picture.width == picture.height, "not one face of numbers")
    for y in range(picture.height):
        for x in range(picture.width):
            wanted = gnomonic(centre(x, picture.width), -centre(y, picture.width))[quantity]
            close(picture.first(x, y), wanted, 2e-6 * max(1, wanted), quantity, x, y)


def check_differences(project, mapping, frame, pattern):
    """Strips of values against differences of what cubemap-project says."""
    step = 1e-5
    pictures = {quantity: Picture(pattern.replace("QUANTITY", quantity))
                for quantity in ("area", "isotropy", "texel-aspect", "texel-area")}
    size = pictures["area"].height
    first_row_v = -1 if frame == "gl" else 1
    random.seed(1)
    pixels = [(random.randrange(6 * size), random.randrange(size)) for _ in range(400)]
    # differences do not work across the creases of qsc and healpix
    pixels = [(x, y) for x, y in pixels if abs(centre(x % size, size)) != abs(centre(y, size))]
    lines = []
    for x, y in pixels:
        u, v = centre(x % size, size), -first_row_v * centre(y, size)
        for shift_u, shift_v in ((step, 0), (-step, 0), (0, step), (0, -step)):
            lines.append(f"{x // size} {u + shift_u!r} {v + shift_v!r}")
    text = subprocess.run([project, "-m", mapping, "--frame", frame, "-I", "--output", "xyz"],
                          input="\n".join(lines), stdout=subprocess.PIPE, check=True, text=True)
    points = [tuple(map(float, line.split())) for line in text.stdout.splitlines()]
    for i, (x, y) in enumerate(pixels):
        right, left, up, down = points[4 * i:4 * i + 4]
        wanted = from_tangents([(a - b) / (2 * step) for a, b in zip(right, left)],
                               [(a - b) / (2 * step) for a, b in zip(up, down)])
        for quantity, picture in pictures.items():
            tolerance = 2e-6 * max(1, wanted[quantity])
            close(picture.first(x, y), wanted[quantity], tolerance, mapping, quantity, x, y)


# ---- colours ----

def check_colors(specification, low, high, middle, values, name, reverse="no"):
    """A picture of colours against values and the map itself; middle 0 for a linear scale."""
    low, high, middle = float(low), float(high), float(middle)
    numbers, picture = Picture(values), Picture(name)
    places = []
    for value in numbers.values:
        value = min(max(value, low), high)
        if middle > 0:
            half = max(abs(math.log(low / middle)), abs(math.log(high / middle)))
            place = 0.5 + 0.5 * math.log(value / middle) / half
        else:
            place = 1 - (value - low) / (high - low)
        places.append(1 - place if reverse == "yes" else place)
    text = subprocess.run([HELPER, "colors", specification], input=" ".join(map(repr, places)),
                          stdout=subprocess.PIPE, check=True, text=True).stdout
    colors = [tuple(map(float, line.split())) for line in text.splitlines()]
    expect(len(colors) == picture.width * picture.height, "sizes differ")
    for i, color in enumerate(colors):
        found = picture.at(i % picture.width, i // picture.width)
        for channel in range(3):
            wanted = min(max(color[channel], 0), 1)
            close(found[channel], wanted, 0.8 / 255, "pixel", i, "channel", channel)


def check_symmetric(name, levels):
    """One face: mirrored left to right, upside down, and by its diagonal it is the same."""
    picture = Picture(name)
    last = picture.width - 1
    for y in range(picture.height):
        for x in range(picture.width):
            for other in (picture.at(last - x, y), picture.at(x, last - y), picture.at(y, x)):
                for one, two in zip(picture.at(x, y), other):
                    close(two, one, float(levels) / 255 + 1e-6, "mirror image of", x, y)


def check_uniform(name, red, green, blue):
    picture = Picture(name)
    for i in range(0, len(picture.values), picture.channels):
        for channel, wanted in enumerate((red, green, blue)):
            close(picture.values[i + channel], float(wanted), 0.6 / 255, "pixel", i // 3)


# ---- ellipses, white on black with lines 2 wide ----

HALF_LINE = 1.0


def outline_rows(picture, left, top, right, bottom):
    """For each row of a part of the picture the first and the last pixel of the outline's core."""
    rows = []
    for y in range(top, bottom):
        core = [x for x in range(left, right) if picture.first(x, y) >= 0.5]
        if core:
            rows.append((y, core[0], core[-1]))
    return rows


def ellipse_in_cell(picture, i, j, cells, size, face_x=0, face_y=0):
    """Area and semi-axes, in pixels, of the ellipse in a cell of a face: from the convex region that
    its outline, half a line wider, surrounds."""
    left, right = round(i * size / cells), round((i + 1) * size / cells)
    top, bottom = round(j * size / cells), round((j + 1) * size / cells)
    rows = outline_rows(picture, face_x + left, face_y + top, face_x + right, face_y + bottom)
    area = sum(last - first + 1 for _, first, last in rows)
    mean_x = sum((last - first + 1) * (first + last + 1) / 2 for _, first, last in rows) / area
    mean_y = sum((last - first + 1) * (y + 0.5) for y, first, last in rows) / area
    xx = yy = xy = 0.0
    for y, first, last in rows:
        count = last - first + 1
        middle = (first + last + 1) / 2 - mean_x
        xx += count * (middle * middle + (count * count - 1) / 12)
        yy += count * (y + 0.5 - mean_y) ** 2
        xy += count * middle * (y + 0.5 - mean_y)
    mean, half = (xx + yy) / 2 / area, math.hypot((xx - yy) / 2, xy) / area
    major, minor = 2 * math.sqrt(mean + half), 2 * math.sqrt(mean - half)
    turned = 0.5 * math.atan2(2 * xy, xx - yy)
    return area, major - HALF_LINE, minor - HALF_LINE, turned, (mean_x, mean_y)


def perimeter(a, b):
    """Ramanujan's approximation."""
    return math.pi * (3 * (a + b) - math.sqrt((3 * a + b) * (a + 3 * b)))


def check_gnomonic_ellipses(name, cells, degrees):
    """One face of gnomonic: a = 1 + u^2 + v^2 along the radius, b = sqrt of that across."""
    picture, cells, radius = Picture(name), int(cells), math.radians(float(degrees))
    size = picture.width
    for j in range(cells):
        for i in range(cells):
            u, v = centre(i, cells), -centre(j, cells)
            square = 1 + u * u + v * v
            a, b = square * radius * size / 2, math.sqrt(square) * radius * size / 2
            area, major, minor, turned, middle = ellipse_in_cell(picture, i, j, cells, size)
            # Steiner: what is within a distance of a convex figure
            wanted = math.pi * a * b + perimeter(a, b) * HALF_LINE + math.pi * HALF_LINE ** 2
            close(area, wanted, 0.25 * math.sqrt(perimeter(a, b)) + 0.002 * wanted, "area of", i, j)
            close(major, a, 0.3, "major axis of", i, j)
            close(minor, b, 0.3, "minor axis of", i, j)
            close(middle[0], (i + 0.5) * size / cells, 0.1, "middle of", i, j)
            close(middle[1], (j + 0.5) * size / cells, 0.1, "middle of", i, j)
            if u or v:
                away = (turned - math.atan2(-v, u) + math.pi / 2) % math.pi - math.pi / 2
                close(away, 0, 0.02, "direction of", i, j)


def check_circle(name, cells):
    """The ellipse in the middle of a face is a circle."""
    picture, cells = Picture(name), int(cells)
    _, major, minor, _, _ = ellipse_in_cell(picture, cells // 2, cells // 2, cells, picture.width)
    close(major / minor, 1, 0.005, "the ratio of axes")


def check_equirect_ellipses(name, degrees):
    """Of 3 x 3 gnomonic cells a face, those of the front and the back one."""
    picture, radius = Picture(name), math.radians(float(degrees))
    per_radian = picture.width / (2 * math.pi)
    for v in (-2 / 3, 0, 2 / 3):
        for u in (-2 / 3, 0, 2 / 3):
            lon, lat = math.atan(u), math.atan2(v, math.hypot(1, u))
            x, y = (lon + math.pi) * per_radian, (math.pi / 2 - lat) * per_radian
            a, b = radius / math.cos(lat) * per_radian, radius * per_radian
            for turn in (0, picture.width / 2):
                for along, across, half in ((1, 0, a), (0, 1, b)):
                    profile = [picture.first(round(x + turn + k * along - 0.5) % picture.width,
                                             round(y + k * across - 0.5))
                               for k in range(-round(half) - 4, round(half) + 5)]
                    core = [k - round(half) - 4 for k, value in enumerate(profile) if value >= 0.5]
                    close(core[-1] - core[0] + 1, 2 * (half + HALF_LINE), 1.6, "ellipse at", u, v)


def check_count(name, wanted):
    """So many separate figures, one that goes over the left and right edge being one."""
    picture = Picture(name)
    width, height = picture.width, picture.height
    inside = bytearray(value > 0.3 for value in picture.values)
    count = 0
    for start in range(width * height):
        if not inside[start]:
            continue
        count += 1
        pending = [start]
        inside[start] = 0
        while pending:
            at = pending.pop()
            x, y = at % width, at // width
            for to_x, to_y in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)):
                to = to_y * width + to_x % width
                if 0 <= to_y < height and inside[to]:
                    inside[to] = 0
                    pending.append(to)
    expect(count == int(wanted), count, "figures where there should be", wanted)


# ---- lines ----

def line_centres(values):
    """Where lines, white on black, cross a row of pixels."""
    centres, weight, moment = [], 0.0, 0.0
    for i, value in enumerate(list(values) + [0.0]):
        if value > 0:
            weight += value
            moment += value * (i + 0.5)
        elif weight > 0:
            centres.append(moment / weight)
            weight = moment = 0.0
    return centres


def column(picture, x, top=0, bottom=None):
    bottom = picture.height if bottom is None else bottom
    return [picture.first(x, y) for y in range(top, bottom)]


def row(picture, y, left=0, right=None):
    right = picture.width if right is None else right
    return [picture.first(x, y) for x in range(left, right)]


def check_lines(found, wanted, tolerance, *words):
    expect(len(found) == len(wanted), *words, "has lines at", found, "and should at", wanted)
    for one, other in zip(found, wanted):
        close(one, other, tolerance, *words)


def check_equirect_graticule(name, source):
    """30 degrees over 720 x 360 pixels, lines 2 wide: the two pixels beside a line are all line, the
    next two casing, all others as they were."""
    picture, before = Picture(name), Picture(source)
    for y in range(360):
        for x in range(720):
            zone_of_pole = y < 60 or y >= 300
            step = 180 if zone_of_pole else 60
            to_meridian = abs((x + 0.5 + step / 2) % step - step / 2)
            to_parallel = abs((y + 0.5 + 30) % 60 - 30) if 30 < y < 330 else 99
            distance = min(to_meridian, to_parallel)
            if distance < 1:
                close(picture.first(x, y), 1, 0, "line at", x, y)
            elif distance > 2.6:
                close(picture.first(x, y), before.first(x, y), 0, "no line at", x, y)
            elif distance < 2:
                expect(picture.first(x, y) < before.first(x, y), "no casing at", x, y)


def check_cube_graticule(name):
    """A cross of gnomonic, 15 degrees: meridians of the front face, parallels beside its edges, the
    four meridians and the circles around the pole."""
    picture = Picture(name)
    size = picture.width // 4
    middle = 1.5 * size
    front = row(picture, int(size * 1.5) + size // 16, size, 2 * size)
    wanted = [size / 2 * (1 + math.tan(math.radians(lon))) for lon in (-30, -15, 0, 15, 30)]
    # the edges lie on the meridians of 45 degrees: half of each line is on the face
    check_lines(line_centres(front)[1:-1], wanted, 0.05, "front")
    for lon in range(-30, 31, 15):
        x = round(size * 1.5 + size / 2 * math.tan(math.radians(lon)) - size / 12)
        u = (x + 0.5 - middle) / (size / 2)
        wanted = [middle - size / 2 * math.hypot(1, u) * math.tan(math.radians(lat))
                  for lat in (30, 15, 0, -15, -30)]
        found = [y for y in line_centres(column(picture, x, size, 2 * size))]
        check_lines([y + size for y in found], wanted, 0.1, "parallels at", lon)
    for y in range(size, 2 * size):
        close(picture.first(size - 1, y), picture.first(size, y), 1 / 255, "seam at", y)
    for degrees, meridians in ((80, 4), (70, 24), (50, 24)):
        radius = size / 2 / math.tan(math.radians(degrees))
        around = []
        for k in range(7200):
            angle = math.radians((k + 0.5) / 20 + 5)
            around.append(picture.first(int(middle + radius * math.cos(angle)),
                                        int(size / 2 + radius * math.sin(angle))) >= 0.5)
        crossings = sum(1 for k in range(7200) if around[k] and not around[k - 1])
        expect(crossings == meridians, crossings, "meridians at", degrees, "degrees, not", meridians)


def check_cube_grid(name, cells):
    """One face of a cube, lines 2 wide: at multiples of a cell, half of them at the edges."""
    picture, cells = Picture(name), int(cells)
    wanted = [picture.width * k / cells for k in range(1, cells)]
    for line in (row(picture, picture.width // cells // 2),
                 column(picture, picture.width // cells // 2)):
        check_lines(line_centres(line)[1:-1], wanted, 0.01, "grid")
        close(line[0], 1, 0, "the edge")
        close(line[-1], 1, 0, "the edge")


def check_equirect_grid(name):
    """720 x 360, 3 x 3 cells of gnomonic: near the equator at its lines of u, at the pole at one circle."""
    picture = Picture(name)
    third = math.degrees(math.atan(1 / 3))
    wanted = [2 * (180 + face + lon) for face in (-180, -90, 0, 90, 180) for lon in (-45, -third, third)]
    check_lines(line_centres(row(picture, 175)), [x for x in wanted if 0 < x < 720], 0.05, "equator")
    close(sum(row(picture, 175)), 2 * 12, 0.2, "the width of all lines")
    top = [2 * lat for lat in (third, 45, 90 - third, 90 + third, 135, 180 - third)]
    check_lines(line_centres(column(picture, 359)), top, 0.1, "lon 0")


def check_isolines(name, step):
    """A face of gnomonic with isolines of area in red, 4 wide: circles of (1 + r^2)^1.5 pi/6 = k step."""
    picture, step = Picture(name), float(step)
    middle = picture.width // 2
    red = [1.0 if tuple(picture.at(x, middle)) == (1.0, 0.0, 0.0) else 0.0
           for x in range(middle, picture.width)]
    wanted, k = [], 0
    while len(wanted) < 100:
        k += 1
        square = (k * step * MEAN_SCALE) ** (2 / 3) - 1
        if square > 1:
            break
        if square > 0:
            wanted.append(math.sqrt(square) * picture.width / 2)
    check_lines([x - 0.5 for x in line_centres(red)], wanted, 0.8, "isolines")


def check_pixel(name, x, y, *wanted):
    found = Picture(name).at(int(x), int(y))
    expect(len(found) == len(wanted), "channels:", len(found))
    for one, other in zip(found, wanted):
        close(one, float(other), 1e-3, "pixel", x, y)


def check_finite(name):
    expect(not any(math.isnan(value) for value in Picture(name).values), "there is a NaN")


if __name__ == "__main__":
    globals()["check_" + sys.argv[2]](*sys.argv[3:])
