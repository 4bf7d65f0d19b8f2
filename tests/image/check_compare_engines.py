#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""compare_engines: that its judge finds faces out of place, and that its tables have figures, which can be.

Usage: check_compare_engines.py SCRIPT BUILD
"""

import pathlib
import subprocess
import sys
import tempfile

SCENE, CUBE = "waves:0.12", "cube/gnomonic/64"


def say(*words, folder=None):
    return subprocess.run([str(word) for word in words], cwd=folder, check=True, capture_output=True, text=True).stdout


def decibels(judge, folder, files, surface=CUBE):
    rows = [line.split() for line in say(judge, "measure", SCENE, surface, 0.1, *files, folder=folder).splitlines()]
    return {row[0]: float(row[1]) for row in rows}


def expect(holds, text):
    if not holds:
        sys.exit(f"check_compare_engines: {text}")


def check_judge(judge):
    with tempfile.TemporaryDirectory() as folder:
        faces = [f"{i}.tif" for i in range(6)]
        say(judge, "make", SCENE, CUBE, "uint8", *faces, folder=folder)
        say(judge, "make", SCENE, CUBE, "uint16", "strip.tif", folder=folder)
        say(judge, "make", SCENE, "equirect/256", "float", "equirect.tif", folder=folder)
        right = decibels(judge, folder, faces)
        expect(sorted(right) == ["all", "corner", "dateline", "interior", "pole", "seam"], f"regions: {right}")
        expect(all(58.0 < value < 60.0 for value in right.values()), f"8 bits: {right}")
        strip = decibels(judge, folder, ["strip.tif"])["all"]
        expect(106.0 < strip < 108.0, f"16 bits: {strip}")
        whole = decibels(judge, folder, ["equirect.tif"], "equirect/256")["all"]
        expect(whole > 140.0, f"floats: {whole}")
        swapped = decibels(judge, folder, faces[1::-1] + faces[2:])["all"]
        expect(swapped < 30.0, f"two faces in each other's place: {swapped}")
        # another convention of pixels is half a pixel at most
        shifted = decibels(judge, folder, faces, "cube-ends/gnomonic/64")["all"]
        expect(30.0 < shifted < 50.0, f"shifted pixels: {shifted}")
        say(judge, "pass", "0.tif", CUBE, "uint8", "passed.tif", folder=folder)
        expect(pathlib.Path(folder, "passed.tif").stat().st_size > 6 * 64 * 64 * 3, "what pass writes is too short")


def check_failures(judge):
    with tempfile.TemporaryDirectory() as folder:
        for words in ["", "make", "make waves:0 cube/gnomonic/0 uint8 a.tif", "make waves:1 cube/none/8 uint8 a.tif",
                      "make waves:1 cube/gnomonic/8 int8 a.tif", "make waves:1 cube/gnomonic/8 uint8 a.tif b.tif",
                      "measure waves:1 equirect/8 1 none.tif", "plate waves:1 equirect/8 1 2 none.tif",
                      "make rings:1 equirect/8 uint8 a.tif"]:
            ran = subprocess.run([judge] + words.split(), cwd=folder, capture_output=True, text=True, check=False)
            expect(ran.returncode == 1 and ran.stderr.startswith("scene-image: "), f"{words}: {ran}")
            expect(not any(pathlib.Path(folder).iterdir()), f"{words} left a file")


def check_tables(script, build):
    lines = say(sys.executable, script, "--quick", "--only", "cubemap-reproject, bilinear", build).splitlines()
    ours = [line for line in lines if line.startswith("| cubemap-reproject")]
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in ours]
    expect(len(rows) == 5, f"tables: {len(rows)}")
    for row, least in zip(rows[:4], [55.0, 55.0, 60.0, 60.0]):
        expect(float(row[3]) > 0.0 and float(row[5]) > 1.0, f"time and memory: {row}")
        expect(all(least - 3.0 < float(cell) < least + 12.0 for cell in row[6:12]), f"dB: {row}")
        expect(row[12] == "", f"missing: {row}")
    # bilinear interpolation takes next to nothing away
    expect(-8.0 < float(rows[4][1]) < -3.0 and abs(float(rows[4][2])) < 0.5, f"zone plates: {rows[4]}")


def main():
    script, build = sys.argv[1:]
    judge = str(pathlib.Path(build) / "bench" / "image" / "scene-image")
    check_judge(judge)
    check_failures(judge)
    check_tables(script, build)
    print("judge, failures and tables are as they should be")


if __name__ == "__main__":
    main()
