#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What documents and the comments of public headers keep to.

check_documents.py [ROOT]        check the tree; names file and line of what does not
check_documents.py --self-test   check that every kind of fault is found

- a public header begins with a comment of 20 lines at most
- public headers have no figures of accuracy and time: those stand once, in docs/measured
- the first screen, README.md, has a picture, a C program and less than 600 words
- each document is named by the index, docs/README.md
"""

import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import house

LINES_MOST = 20
WORDS_MOST = 600
FIGURE = re.compile(r"\b\d[\d.]*(?:e-?\d+)? ?(?:ns|us|µs|ms|nm|ulps?|eps|microseconds?|milliseconds?)\b(?! is of)")
INDEX = "docs/README.md"
PUBLIC = re.compile(r"^include/cubemap/\w+\.h$")


def header_complaints(path, text):
    """Of one public header."""
    first = re.match(r"/\*.*?\*/", text, re.S)
    lines = first[0].count("\n") + 1 if first else 0
    if not first:
        yield f"{path}:1: does not begin with a comment"
    if lines > LINES_MOST:
        yield f"{path}:1: its first comment has {lines} lines, more than {LINES_MOST}"
    for number, line in enumerate(text.split("\n"), 1):
        figure = FIGURE.search(line)
        if figure:
            yield f"{path}:{number}: the figure '{figure[0]}' belongs into docs/measured"


def readme_complaints(text):
    """Of the first screen."""
    words = len(text.split())
    if words >= WORDS_MOST:
        yield f"README.md:1: {words} words, not less than {WORDS_MOST}"
    if not re.search(r"!\[[^\]]+\]\([^)]+\.(?:jpg|png|svg)\)", text):
        yield "README.md:1: no picture"
    if "```c\n" not in text:
        yield "README.md:1: no program in C"


def index_complaints(index, documents):
    """Documents that the index does not name."""
    named = {os.path.normpath(os.path.join("docs", link)).replace(os.sep, "/")
             for link in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", index)}
    for document in documents:
        if document != INDEX and document not in named:
            yield f"{INDEX}:1: does not name {document}"


def complaints_of(root):
    paths = house.paths_of(root)
    headers = [path for path in paths if PUBLIC.match(path)]
    documents = [path for path in paths if path.startswith("docs/") and path.endswith(".md")]
    found = []
    for path in headers:
        found += header_complaints(path, house.read(root, path))
    found += readme_complaints(house.read(root, "README.md"))
    found += index_complaints(house.read(root, INDEX), documents)
    return found, f"{len(headers)} headers, {len(documents)} documents"


def self_test():
    good = "/* SPDX\n * Some words.\n */\nint a; /* 1e-9 beyond */\n"
    long = "/* SPDX\n" + " * A line.\n" * LINES_MOST + " */\n"
    seeded = [
        (header_complaints("a.h", long), "more than 20"),
        (header_complaints("a.h", "int a;\n"), "does not begin"),
        (header_complaints("a.h", good + "/* takes 30 ns a point */"), "30 ns"),
        (header_complaints("a.h", good + "/* within 8 eps */"), "8 eps"),
        (header_complaints("a.h", good + "/* 2 nm on Earth */"), "2 nm"),
        (readme_complaints("![a](b.png) ```c\n" + "word " * WORDS_MOST), "words"),
        (readme_complaints("```c\n"), "no picture"),
        (readme_complaints("![a](b.png)"), "no program"),
        (index_complaints("[a](guide/a.md)", ["docs/guide/a.md", "docs/guide/b.md"]), "docs/guide/b.md"),
    ]
    for found, words in seeded:
        found = list(found)
        if len(found) != 1 or words not in found[0]:
            house.fail_self_test(f"'{words}' was not found, but {found}")
    clean = list(header_complaints("a.h", good)) + list(readme_complaints("![a](b.png)\n```c\nint a;\n```\n")) + \
        list(index_complaints("[a](guide/a.md#b)", ["docs/guide/a.md", INDEX]))
    if clean:
        house.fail_self_test(f"what is right was complained of: {clean}")
    print(f"self-test: {len(seeded)} seeded faults found")
    return 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
    found, counted = complaints_of(root)
    return house.end("documents", found, counted)


if __name__ == "__main__":
    sys.exit(main())
