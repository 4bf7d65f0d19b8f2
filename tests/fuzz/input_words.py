# SPDX-License-Identifier: MIT
"""What inputs of harnesses are made of: numbers in the order in which harnesses take them."""
import struct

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


def amounts(*values):
    """Small numbers as the harnesses of scenes take them: a kind of which the rest by 8 is the number, and halves of 1."""
    return b"".join(bytes([32 + int(value)]) if value == int(value) else bytes([200]) + fractions(value)
                    for value in values)
