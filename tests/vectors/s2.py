#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes s2.txt: S2's quadratic projection with 50 digits, in the format of the other vectors.

Needs mpmath (apt: python3-mpmath). Usage: s2.py > s2.txt
"""
import random
from mpmath import mp, mpf, sqrt, nstr

mp.dps = 50
RIM = [0.0, 1.0, -1.0, 0.3, -0.5, 0.25, 1e-8, -1e-15, 1e-300, 5e-324, 2.2250738585072014e-308,
       0.9999999999999999, 0.999999999999999, -0.99999999, 2.0 ** -27, 0.999]
AXES = [("+x", 0, (-3, -2)), ("-x", 1, (3, -2)), ("+y", 2, (1, 3)), ("-y", 3, (1, -3)),
        ("+z", 4, (1, -2)), ("-z", 5, (-1, -2))]  # the table of the frame gl: s and t axes


def forward(w):
    w = mpf(w)
    return (3 * w / (1 + sqrt(1 + 3 * abs(w))))


def inverse(w):
    w = mpf(w)
    return w * (2 + abs(w)) / 3


def number(x):
    return nstr(x, 25, strip_zeros=True, min_fixed=-3, max_fixed=3)


def project(xyz):
    major = max(range(3), key=lambda i: (abs(xyz[i]), -i))
    face = 2 * major + (xyz[major] < 0)
    scale = abs(mpf(xyz[major]))
    return face, [mpf(xyz[abs(a) - 1]) * (1 if a > 0 else -1) / scale for a in AXES[face][2]]


def unproject(face, p, q):
    xyz = [mpf(0)] * 3
    xyz[face // 2] = mpf(1 if face % 2 == 0 else -1)
    for axis, w in zip(AXES[face][2], (p, q)):
        xyz[abs(axis) - 1] = w if axis > 0 else -w
    length = sqrt(sum(c * c for c in xyz))
    return [c / length for c in xyz]


def main():
    source = random.Random(7)
    print("# s2")
    print("# specification s2")
    print("# frame gl")
    print("# F p q -> u v, I u v -> p q, D x y z -> face u v, R face u v -> x y z")
    pairs = [(source.choice(RIM), source.choice(RIM)) for _ in range(60)]
    pairs += [(source.uniform(-1, 1), source.uniform(-1, 1)) for _ in range(60)]
    for a, b in pairs:
        print("F", repr(a), repr(b), number(forward(a)), number(forward(b)))
        print("I", repr(a), repr(b), number(inverse(a)), number(inverse(b)))
    for _ in range(80):
        xyz = [source.gauss(0, 1) for _ in range(3)]
        face, pq = project(xyz)
        print("D", *map(repr, xyz), face, *(number(forward(w)) for w in pq))
    for _ in range(80):
        face, u, v = source.randrange(6), source.uniform(-1, 1), source.uniform(-1, 1)
        print("R", face, repr(u), repr(v), *map(number, unproject(face, inverse(u), inverse(v))))


if __name__ == "__main__":
    main()
