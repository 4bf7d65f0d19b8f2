#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes those first inputs of the harnesses that are not text into corpus/, beside this script.

Each function below packs what the harness of that name takes from its input, in the same order. The
inputs that are text stand in corpus/ as they are.
"""
import pathlib
import struct
import zlib

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"

STANDARD, PARAMETERS = 1, 129  # what follows the number of a mapping: also the number of a frame
GNOMONIC, TANGENT, QSC, COUPLED, SMOOTHSTEP, HEALPIX = 0, 1, 4, 10, 13, 15

# the kinds of directions and points
RAW, FRACTION, ANY_SIZE, BESIDE, HARD = range(5)


def word(value):
    return struct.pack("<I", value & 0xFFFFFFFF)


def number(form, *values):
    return struct.pack("<%d%s" % (len(values), form), *values)


def fractions(*values):
    """Numbers in [-1, 1)."""
    return b"".join(word(int((value + 1) * 2**31)) for value in values)


def subject(mapping, choice=STANDARD, instructions=3):
    """instructions: the number of the set, modulo how many there are; 0 is scalar."""
    return bytes([mapping, choice, instructions])


def middle_parameter():
    return fractions(0.0) + bytes([3])


def directions(form):
    """One of each kind, without what stands before it."""
    return [
        bytes([RAW]) + number(form, 1.0, 0.5, -0.25),
        bytes([RAW]) + number(form, float("nan"), 0.0, 1.0),
        bytes([FRACTION]) + fractions(0.3, -0.2, 0.9),
        bytes([ANY_SIZE]) + word(4711),
        bytes([BESIDE]) + word(123456) + bytes([9, 7, 8]),
        bytes([HARD]) + word(1000001),
    ]


def points(form):
    """One of each kind; those of BESIDE are numbered otherwise than those of directions."""
    return [
        bytes([0]) + number(form, 0.5, -0.25),
        bytes([0]) + number(form, float("inf"), 0.0),
        bytes([1]) + fractions(0.3, -0.99),
        bytes([2]) + word(97) + bytes([9, 7]),
        bytes([3]) + word(98) + bytes([255, 120]),
        bytes([4]) + word(1234),
    ]


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
    body = b"".join(angle + direction + point for angle, direction, point in steps)
    return {"coupled": subject(COUPLED) + body, "healpix": subject(HEALPIX) + body}


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


def number_inputs():
    values = [0.1, -1.0, 2.0 / 3.0, 1e22, 1e-7, 123456.789, 5e-324, 1.7976931348623157e308]
    return {
        "bytes": b"".join(bytes([i % 17]) + number("d", value) for i, value in enumerate(values))
    }


def point_lines_inputs():
    """Here only what is long."""
    return {"long-line": b"\x08\x80" + 1200 * b"1 2 " + b"\n3 4\n"}


def png_chunk(name, content):
    check = zlib.crc32(name + content)
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", check)


def whole_png_inputs():
    signature = b"\x89PNG\r\n\x1a\n"
    head = signature + png_chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
    whole = head + png_chunk(b"IDAT", zlib.compress(b"\0\x80")) + png_chunk(b"IEND", b"")
    return {"whole": whole, "cut": whole[:-6], "more": whole + b"more", "other": b"no PNG file"}


INPUTS = {
    "points_double": points_inputs("d"),
    "points_float": points_inputs("f"),
    "arrays_double": arrays_inputs("d"),
    "arrays_float": arrays_inputs("f"),
    "threads": threads_inputs(),
    "lonlat": lonlat_inputs(),
    "frames": frames_inputs(),
    "degrees": degrees_inputs(),
    "number": number_inputs(),
    "point_lines": point_lines_inputs(),
    "whole_png": whole_png_inputs(),
}


def main():
    for harness, inputs in INPUTS.items():
        folder = CORPUS / harness
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in inputs.items():
            (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
