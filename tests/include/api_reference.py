#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The reference of the public functions: Doxygen has nothing to complain of, and each public function has a text.

Usage: api_reference.py DOXYGEN DOXYFILE SOURCE OUTPUT

OUTPUT is where that Doxyfile has the pages written.
"""

import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree


def declared(source):
    """The names of the functions that the public headers declare."""
    names = set()
    for header in sorted((source / "include/cubemap").glob("*.h")):
        text = re.sub(r"/\*.*?\*/", " ", header.read_text(encoding="utf-8"), flags=re.S)
        names |= set(re.findall(r"^CM_API\b[^;(]*?\b(cm_\w+)\s*\(", text, re.M))
    return names


def described(output):
    """The names of the functions that the reference has with a text."""
    names = set()
    for page in (output / "xml").glob("*_8h.xml"):
        for member in xml.etree.ElementTree.parse(page).iter("memberdef"):
            texts = [member.find("briefdescription"), member.find("detaileddescription")]
            if member.get("kind") == "function" and any("".join(text.itertext()).strip() for text in texts):
                names.add(member.findtext("name"))
    return names


def main(arguments):
    doxygen, doxyfile, source, output = arguments
    # the pages for people take longer than all else, and nothing is seen only there
    words = pathlib.Path(doxyfile).read_text(encoding="utf-8") + "\nGENERATE_HTML = NO\n"
    run = subprocess.run([doxygen, "-"], input=words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                         check=False)
    print(run.stdout, end="")
    names = declared(pathlib.Path(source))
    missing = sorted(names - described(pathlib.Path(output)))
    for name in missing:
        print(f"{name}: the reference has no text of it")
    print(f"{len(names)} public functions, {len(missing)} without a text; Doxygen ended with {run.returncode}")
    return 1 if run.returncode != 0 or missing or len(names) < 100 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
