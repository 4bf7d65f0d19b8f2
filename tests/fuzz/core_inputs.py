# SPDX-License-Identifier: MIT
"""First inputs of the harnesses of the core: points, arrays, grids, cells, orientation."""
from input_words import (
    COUPLED, GNOMONIC, HEALPIX, PARAMETERS, QSC, RAW, SMOOTHSTEP, TANGENT, directions, fractions,
    middle_parameter, number, points, subject, word,
)


def points_inputs(form):
    body = b"".join(bytes([0]) + one for one in directions(form))
    body += b"".join(bytes([1]) + one + bytes([3]) for one in points(form))
    body += b"".join(bytes([2]) + one for one in points(form))
    return {
        "gnomonic": subject(GNOMONIC) + body,
        "coupled": subject(COUPLED) + body,
        "healpix": subject(HEALPIX) + body,
        "tangent-c": subject(TANGENT, PARAMETERS) + middle_parameter() + body,
        "smoothstep-c": subject(SMOOTHSTEP, PARAMETERS) + middle_parameter() + body,
    }


def arrays_inputs(form):
    places = bytes([5, 1, 0, 3])
    forward = word(0) + b"".join(directions(form)) + places + bytes([2])
    inverse = word(0) + b"".join(bytes([3]) + one for one in points(form)) + places + bytes([4, 1])
    return {
        "forward-6": subject(COUPLED) + bytes([1]) + word(6) + bytes([0, 3]) + forward,
        "inverse-6": subject(COUPLED) + bytes([1]) + word(6) + bytes([1, 1]) + inverse,
        "forward-513": subject(QSC, instructions=0) + bytes([0]) + word(513) + bytes([0, 1]) + forward,
        "inverse-257": subject(HEALPIX) + bytes([0]) + word(257) + bytes([1, 0]) + inverse,
        "none": subject(GNOMONIC) + bytes([1]) + word(0) + bytes([0, 0]),
    }


def threads_inputs():
    """How many threads, least and elements; the rest is read as a second one of these."""
    def one(threads, least, count):
        return bytes([threads]) + word(least) + number("Q", count)
    return {
        "none": one(4, 64, 0),
        "one": one(1, 64, 1000),
        "few": one(3, 64, 1000) + one(0, 0, 64),
        "many": one(16, 1, 16 * 64 + 1) + one(16, 64, 2**64 - 1),
    }


def lonlat_inputs():
    angles = [
        bytes([0]) + number("d", 0.7),
        bytes([1]) + fractions(0.25),
        bytes([2 + 4 * 5, 10]),
        bytes([3 + 4 * 3, 200]),
    ]
    both = [lon + lat for lon in angles for lat in angles]
    steps = zip(both, 3 * directions("d"), 3 * points("d"))
    body = b"".join(angle + direction + point + bytes([3]) for angle, direction, point in steps)
    return {"coupled": subject(COUPLED) + body, "healpix": subject(HEALPIX) + body}


def grid_inputs():
    """A mapping, an ellipsoid, a latitude, a rotation, and points of both sides."""
    ellipsoids = [bytes([0, 3]), bytes([0, 0]) + number("d", 0.1), bytes([0, 0]) + number("d", -9.0),
                  bytes([0, 2]) + fractions(0.9)]
    steps = zip(directions("d"), points("d"))
    body = b"".join(direction + point + bytes([2, 0]) + fractions(0.3, 0.4) for direction, point in steps)
    return {
        "grid-%d" % i: subject(mapping) + ellipsoid + bytes([3 + i]) + fractions(0.2, 0.1, -0.3) + bytes([i]) + body
        for i, (mapping, ellipsoid) in enumerate(zip([COUPLED, QSC, HEALPIX, TANGENT], ellipsoids))
    }


def healpix_inputs():
    def resolution(kind, nside, order):
        return bytes([kind]) + number("q", nside) + bytes([order, 3])

    points = b"".join(bytes([0]) + word(977 * i) for i in range(7))
    points += b"".join(bytes([1]) + number("d", 0.5 * i, 0.1, -0.7) for i in range(6))
    points += b"".join(bytes([2]) + fractions(0.1 * i, 0.5, -0.9) for i in range(6))
    pixels = b"".join(bytes([i % 4]) + number("Q", 2**40 * i + i) for i in range(19))
    maps = bytes([2]) + bytes([3, 1, 7, 0, 0, 1]) + fractions(-0.5)
    maps += number("d", *[0.5 * i for i in range(20)], float("nan"), -1.6375e30)
    return {
        "nested": resolution(0, 29, 1) + points + pixels + maps,
        "ring": resolution(0, 29, 0) + points + pixels + maps,
        "seven": resolution(100, 7, 0) + points + pixels + maps,
        "one": resolution(0, 0, 1) + points + pixels + maps,
        "none": resolution(200, -1, 0) + maps,
    }


def frames_inputs():
    table = bytes([0]) + bytes([3, 1, 2, 0, 3, 6, 1, 5, 0, 2, 0, 7])
    body = b"".join(directions("d"))
    axes = ((1, 2, 3), (2, -1, 3), (-1, -2, 3), (-2, 1, 3), (3, 2, -1), (-3, 2, 1))
    # size, two texts, the sign of rows and padding, then a text, three axes and padding a face
    raw = number("Q", 0, 0, 0) + number("i", 1, 0)
    raw += b"".join(number("Q", 0) + number("b", *axis) + bytes(5) for axis in axes)
    return {
        "any": bytes([2]) + table + subject(COUPLED) + body,
        "spoilt": bytes([1]) + table + bytes([12, 4]) + subject(COUPLED) + body,
        "spoilt-not": bytes([1]) + table + bytes([1, 1]) + subject(QSC) + body,
        "raw": bytes([0]) + raw + subject(GNOMONIC) + body,
    }


def degrees_inputs():
    steps = zip(range(0, 60, 10), directions("d"))
    inputs = {"one-of-each": b"".join(bytes([turn]) + one + bytes([9]) for turn, one in steps)}
    for name, components in {
        "smallest": (5e-324, 5e-324, 5e-324),
        "small": (1e-310, -2e-310, 3e-310),
        "largest": (1.7976931348623157e308,) * 3,
    }.items():
        inputs[name] = bytes([0, RAW]) + number("d", *components) + bytes([9])
    return inputs


def rotation_inputs():
    """A direction, three angles, an element to change, one of the table, a text."""
    def one(direction, angles, text):
        return direction + angles + bytes([4]) + number("d", 0.5) + bytes([0]) + text
    turned = b"".join(bytes([0]) + number("d", angle) for angle in (17.0, -10.0, 32.0))
    quarters = b"".join(bytes([1 + 3 * turn, 8]) for turn in (5, 4, 2))
    texts = [b"17,-10,32", b"0,90", b"land-coupled", b"1,91,0", b"1,2,3,4"]
    return {
        "one-%d" % i: one(direction, quarters if i % 2 else turned, text)
        for i, (direction, text) in enumerate(zip(directions("d"), texts))
    }


def cells_inputs():
    """A grid, a number, a level and steps, a place, room for a token, points, a region, cells, a text."""
    def one(grid, cell, region, kind, text):
        body = bytes([grid, 1 + 4 * (7 + grid)]) + number("Q", cell) + bytes([5]) + number("q", -77)
        body += bytes([3, 9, 0, 0]) + word(100) + word(300) + bytes([17, 12])
        body += b"".join(9 * directions("d")[:1])
        for angle in region:
            body += number("d", angle) + bytes([0])
        body += bytes([kind]) + (bytes([1, 0]) if kind == 3 else b"")
        body += bytes([0, 12, 20, 0]) + directions("d")[0]
        return body + bytes([2, 5]) + number("Q", 1) + bytes([5]) + number("Q", 2) + text
    corner = (1.0, 2.5, 1.0, 0.1) + 12 * (0.0,)
    box = (0.1, 0.5, 0.7, 1.5) + 12 * (0.0,)
    triangle = (0.1, 0.25, 0.5, 0.3, 0.3, 1.5, 0.2, 1.0) + 8 * (0.0,)
    return {
        "cap": one(0, 1 << 40, corner, 0, b"89c25"),
        "metres": one(2, 12345, (0.3, 0.1, 0.5, 0.0) + 12 * (0.0,), 1, b"X"),
        "box": one(1, 999999, box, 2, b"morton"),
        "polygon": one(3, 31, triangle, 3, b"123g"),
    }


def orient_inputs():
    """Patience, mapping, measure, over, resolution, width, height, twelve values, a name."""
    def one(patience, mapping, measure, over, values, name):
        return bytes([patience, mapping, measure, over, 3, 4, 3]) + bytes(values) + name
    land = [0, 1, 0, 2, 1, 1, 0, 0, 0, 4, 0, 0]
    return {
        "deformation": one(0, TANGENT, 0, 1, land, b"deformation"),
        "edges": one(0, COUPLED, 4, 1, land, b"edges"),
        "over-face": one(0, GNOMONIC, 2, 0, land, b"area"),
        "stopped": one(2, QSC, 1, 1, land, b""),
        "no-mask": one(0, TANGENT, 0, 1, [8] * 12, b"none"),
    }


def advise_inputs():
    terms = bytes([0, 0, 10, 0, 3])                    # WGS 84, a millimetre, geographic to authalic
    sizes = bytes([1]) + fractions(0.0) + bytes([30, 3, 0]) # gnomonic
    limits = bytes([11, 11, 8, 8, 2, 3, 3, 3, 12, 3])  # their numbers
    row = bytes([0, 0, 1, 1, 3, 3])                    # gnomonic in double
    torn = bytes([1, 1, 2, 2, 3, 3])                   # arvo in float

    def request(limited, more):
        return bytes([2, 0]) + word(limited) + bytes([0]) + limits + bytes(more)

    free = [0, 0, 0, 0, 0, 0, 0]
    wishes = [1, 2, 1, 7, 3, 1, 1]  # equal areas, C1, continuous edges, all precisions, single points, WGS 84
    return {
        "terms": terms,
        "sizes": sizes,
        "all": request(0, free) + bytes([2]) + row + torn + bytes([0, 0]),
        "limits": request(0x3FF, free) + bytes([2]) + row + torn + bytes([0, 0]),
        "wishes": request(0x201, wishes) + bytes([2]) + torn + row + bytes([1, 2]),
        "none": request(0, free) + bytes([0]),
        "refused": request(0, [0, 5, 0, 8, 4, 0, 0]) + bytes([1]) + row,
    }


def number_inputs():
    values = [0.1, -1.0, 2.0 / 3.0, 1e22, 1e-7, 123456.789, 5e-324, 1.7976931348623157e308]
    return {
        "bytes": b"".join(bytes([i % 17]) + number("d", value) for i, value in enumerate(values))
    }


def point_lines_inputs():
    """Here only what is long."""
    return {"long-line": b"\x08\x80" + 1200 * b"1 2 " + b"\n3 4\n"}


def latitudes_inputs():
    """An ellipsoid, two latitudes, a tolerance, an instruction set, latitudes and directions."""
    inputs = {}
    for first in range(7):
        second = (first + 3) % 7
        inputs["pair-%d" % first] = (
            bytes([first]) + bytes([1]) + fractions(0.067) + bytes([first, second, 2, 3])
            + b"".join(bytes([1]) + fractions(0.1 * i) + one
                       for i, one in enumerate(directions("d")[:4])))
    inputs["far"] = bytes([0]) + bytes([2 + 3 * 4]) + bytes([3, 4, 2, 3]) + bytes([2, 3])
    inputs["wrong"] = bytes([254, 2, 0, 7])
    return inputs


INPUTS = {
    "points_double": points_inputs("d"),
    "points_float": points_inputs("f"),
    "arrays_double": arrays_inputs("d"),
    "arrays_float": arrays_inputs("f"),
    "threads": threads_inputs(),
    "latitudes": latitudes_inputs(),
    "healpix": healpix_inputs(),
    "lonlat": lonlat_inputs(),
    "frames": frames_inputs(),
    "degrees": degrees_inputs(),
    "cells": cells_inputs(),
    "number": number_inputs(),
    "grid": grid_inputs(),
    "rotation": rotation_inputs(),
    "orient": orient_inputs(),
    "advise": advise_inputs(),
    "point_lines": point_lines_inputs(),
}
