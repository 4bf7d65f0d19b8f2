#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The reference of the public functions: Doxygen has nothing to complain of, and each public function has a text.

Usage: api_reference.py DOXYGEN DOXYFILE SOURCE OUTPUT

OUTPUT is where that Doxyfile has the pages written.
"""

import importlib.machinery
import importlib.util
import pathlib
import re
import shutil
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


def filtered(source, output):
    """The public headers as Doxygen's filter writes them, in a folder: a process for each would take longer than Doxygen."""
    loader = importlib.machinery.SourceFileLoader("header_comments", str(source / "docs/renew/header-comments"))
    header_comments = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(header_comments)
    folder = output / "headers"
    shutil.rmtree(folder, ignore_errors=True)
    for header in sorted((source / "include/cubemap").rglob("*.h")):
        to = folder / header.relative_to(source / "include")
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_text(header_comments.filtered(header.read_text(encoding="utf-8"), header.name), encoding="utf-8")
    return folder


def main(arguments):
    doxygen, doxyfile, source, output = arguments
    headers = filtered(pathlib.Path(source), pathlib.Path(output))
    # the pages for people take longer than all else, and nothing is seen only there
    words = (pathlib.Path(doxyfile).read_text(encoding="utf-8") + "\nGENERATE_HTML = NO\nINPUT_FILTER =\n"
             f"INPUT = {headers}/cubemap\nSTRIP_FROM_PATH = {headers}\nSTRIP_FROM_INC_PATH = {headers}\n")
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
