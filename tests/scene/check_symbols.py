#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The libraries of modules know no library for files: they name no symbol of OpenImageIO, SQLite, zstd, a reader of meshes or
of JSON, and do not ask for these libraries when they are loaded.

check_symbols.py NM LIBRARY...   NM: what shows the symbols of a library, static or shared
check_symbols.py --self-test     check that each fault is found that is made for it
"""

import re
import subprocess
import sys

FORBIDDEN = re.compile(r"(?i)\b_*(sqlite3_|zstd_|cjson_|\w*openimageio|\w*oiio|\w*tinygltf|\w*tinyobj|gdal\w*|ff\w*fits|"
                       r"cm_image_io_get)")


def forbidden_in(text):
    """The lines of nm that name what is forbidden."""
    return [line.strip() for line in text.splitlines() if FORBIDDEN.search(line)]


def symbols_of(tool, library):
    options = ["-D"] if ".so" in library else []
    return subprocess.run([tool, *options, library], capture_output=True, text=True, check=True).stdout


def self_test():
    bad = ["                 U sqlite3_open_v2", "0000000000001000 T ZSTD_compress2", "                 U cJSON_Parse",
           "                 U _ZN11OpenImageIO4v2_410ImageInput4openE", "0000 W _ZN8tinygltf10TinyGLTFD1Ev",
           "                 U _ZN7tinyobj7LoadObjEv", "                 U cm_image_io_get"]
    good = ["                 U malloc", "0000000000001000 T cm_store_create", "0000000000001000 t insert"]
    missed = [line for line in bad if not forbidden_in(line)] + [line for line in good if forbidden_in(line)]
    for line in missed:
        print(f"symbols: not told right: {line.strip()}")
    return 1 if missed else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    wrong = 0
    for library in sys.argv[2:]:
        text = symbols_of(sys.argv[1], library)
        if "cm_" not in text:
            print(f"{library}: nm shows nothing of it")
            wrong += 1
        for line in forbidden_in(text):
            print(f"{library}: {line}")
            wrong += 1
    print(f"symbols: {len(sys.argv) - 2} libraries, {wrong} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
