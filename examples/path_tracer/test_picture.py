#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The example renders what it should: test_picture.py PROGRAM FOLDER.

Both ways to choose directions have the same mean, and one far less variance; the picture has a bright sky, a checkered
ground that is darker in the shadow of a ball than beside it, and balls of their colours.
"""

import pathlib
import re
import subprocess
import sys


def mean(pixels, width, left, top, right, bottom):
    """The mean red, green and blue of a rectangle."""
    rows = [pixels[3 * (row * width + left):3 * (row * width + right)] for row in range(top, bottom)]
    return [sum(sum(row[channel::3]) for row in rows) / ((right - left) * (bottom - top)) for channel in range(3)]


def main(program, folder):
    path = pathlib.Path(folder) / "path_tracer.ppm"
    text = subprocess.run([program, str(path)], check=True, text=True, stdout=subprocess.PIPE).stdout
    print(text)
    even, chosen = [list(map(float, re.findall(r"[\d.]+", line)[:2])) for line in text.splitlines()[1:3]]
    paths = 360 * 240 * 32
    doubt = 4 * ((even[1] + chosen[1]) / paths) ** 0.5
    head, size, _, pixels = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    checks = {
        "is a picture": (head, width, height, len(pixels)) == (b"P6", 360, 240, 360 * 240 * 3),
        "the means are the same": abs(even[0] - chosen[0]) < doubt,
        "the variance is less": chosen[1] * 50 < even[1],
    }
    sky = mean(pixels, width, 10, 10, 60, 40)
    red = mean(pixels, width, 70, 95, 95, 115)
    blue = mean(pixels, width, 240, 100, 265, 120)
    lit = mean(pixels, width, 280, 170, 350, 230)
    shadow = mean(pixels, width, 55, 172, 80, 182)
    print(f"sky {sky}\nred ball {red}\nblue ball {blue}\nlit ground {lit}\nshadow {shadow}")
    checks["the sky is blue"] = sky[2] > sky[0] + 20
    checks["a ball is red"] = red[0] > 1.5 * red[2]
    checks["a ball is blue"] = blue[2] > 1.3 * blue[0]
    checks["there is a shadow"] = sum(shadow) < 0.7 * sum(lit)
    for name, is_good in checks.items():
        print(f"{'ok' if is_good else 'not ok'}: {name}")
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
