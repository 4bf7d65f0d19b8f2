#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The example makes the faces it should: test_faces.py PROGRAM FOLDER.

Of the map that it makes, gnomonic faces have in every pixel what the map's formula has in its direction; where the map
has a hole they are black, and nowhere else.
"""

import array
import math
import pathlib
import subprocess
import sys

SIZE = 64

# The axes of the frame geo: outward, u, v of each face.
FACES = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((0, 1, 0), (-1, 0, 0), (0, 0, 1)), ((-1, 0, 0), (0, -1, 0), (0, 0, 1)),
         ((0, -1, 0), (1, 0, 0), (0, 0, 1)), ((0, 0, 1), (0, 1, 0), (-1, 0, 0)), ((0, 0, -1), (0, 1, 0), (1, 0, 0))]


def formula(x, y, z):
    """What the map has in a direction, and how near to its hole that is."""
    spot = 0.36 * x + 0.8 * y + 0.48 * z
    return math.cos(9 * (0.6 * x + 0.8 * z)) + 2 * math.exp(40 * (spot - 1)), spot


def main(program, folder):
    folder = pathlib.Path(folder)
    sky, faces = folder / "sky.fits", folder / "faces.pgm"
    subprocess.run([program, "--make", str(sky)], check=True)
    subprocess.run([program, str(sky), "gnomonic", str(SIZE), str(faces)], check=True)
    head, comment, size, _, pixels = faces.read_bytes().split(b"\n", 4)
    low, high = (float(comment.split()[index].rstrip(b",")) for index in (1, 4))
    assert head == b"P5" and size == b"%d %d" % (6 * SIZE, SIZE), "another picture"
    stored = array.array("H", pixels)
    stored.byteswap()
    worst, black, holes, wrong_holes = 0.0, 0, 0, 0
    for index, number in enumerate(stored):
        row, face, column = index // (6 * SIZE), index // SIZE % 6, index % SIZE
        u, v = (2 * column + 1) / SIZE - 1, 1 - (2 * row + 1) / SIZE
        vector = [out + u * along + v * up for out, along, up in zip(*FACES[face])]
        length = math.sqrt(sum(part * part for part in vector))
        value, spot = formula(*(part / length for part in vector))
        black += number == 0
        holes += spot < -0.999
        wrong_holes += spot < -0.999 and number != 0
        if spot > -0.99:
            worst = max(worst, abs(low + (high - low) * number / 65535 - value))
    print(f"worst difference {worst:.4f} of {high - low:.3f}; {black} black pixels, {holes} in the middle of the hole")
    # a pixel of the map is 0.9 degrees wide, in which the wave changes by up to 0.15
    return 0 if worst < 0.02 and 0 < holes <= black < 80 and wrong_holes == 0 else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
