#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The names of files: each once, none that differs from another by a plural, and at the top those that belong there.

check_names.py [ROOT]        check the tree
check_names.py --self-test   check that each is found
"""

import collections
import fnmatch
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import house

# What stands at the top, where a slip of a shell would leave its files.
AT_THE_TOP = {".clang-format", ".editorconfig", ".gitignore", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "README.md",
              "meson.build", "meson_options.txt", "pyproject.toml"}

# Each folder has one of its own.
EVERYWHERE = ["meson.build", "README.md", "test", "__init__.py"]

# Data, which is called as what it is of, and what documents are made from.
NOT_NAMED_HERE = ["tests/vectors/*", "tests/fuzz/corpus/*", "docs/*", "data/*", "*.png", "*.txt"]

# What is read side by side: a source and a script of one name are in different languages.
LANGUAGES = {".c": "C", ".h": "C", ".cpp": "C", ".hpp": "C", ".inc": "C", "": "script", ".sh": "script",
             ".py": "script"}


def singulars(stem):
    """A stem, and what it is the plural of; test-cells and test_cells are one."""
    stem = re.sub(r"[-.]", "_", stem.lower())
    if stem.endswith("ies"):
        yield stem[:-3] + "y"
    if stem.endswith(("ses", "xes", "ches", "shes")):
        yield stem[:-2]
    if stem.endswith("s") and not stem.endswith("ss"):
        yield stem[:-1]


def check_top(paths, complaints):
    for path in paths:
        if "/" not in path and path not in AT_THE_TOP:
            complaints.append(f"{path}: does not belong at the top of the tree")


def check_once(paths, complaints):
    places = collections.defaultdict(list)
    for path in paths:
        places[os.path.basename(path)].append(path)
    for name, where in sorted(places.items()):
        if len(where) > 1 and name not in EVERYWHERE:
            complaints.append(f"{where[1]}: there is {where[0]} too")


def check_plurals(paths, complaints):
    stems = collections.defaultdict(list)
    for path in paths:
        stem, ending = os.path.splitext(os.path.basename(path))
        if ending in LANGUAGES:
            stems[LANGUAGES[ending], re.sub(r"[-.]", "_", stem.lower())].append(path)
    for (language, stem), where in sorted(stems.items()):
        for singular in singulars(stem):
            for other in stems.get((language, singular), []):
                complaints.append(f"{where[0]}: differs from {other} by a plural")


def check(paths):
    complaints = []
    named = [path for path in paths if not any(fnmatch.fnmatchcase(path, pattern) for pattern in NOT_NAMED_HERE)]
    check_top(paths, complaints)
    check_once(named, complaints)
    check_plurals(named, complaints)
    return complaints, len(named)


GOOD = ["meson.build", "tests/meson.build", "include/cubemap/healpix.h",
        "libcubemap/cells/cell.c", "tests/cells/test_cells.c", "libcubemap/cells/region.h", "libcubemap/cells/region.c",
        "research/vectors/vectors", "libcubemap/batch/lanes/vector.inc", "tests/vectors/a/cell.c",
        "libcubemap/batch/alias.h"]
FAULTS = [("140", "does not belong at the top"),
          ("tools/cli/region.c", "there is libcubemap/cells/region.c too"),
          ("include/cubemap/kernel/region.h", "there is include/cubemap/kernel/region.h too"),
          ("tools/cli/cells.h", "differs from libcubemap/cells/cell.c by a plural"),
          ("tools/cli/aliases.c", "differs from libcubemap/batch/alias.h by a plural"),
          ("tools/cli/test-cell.c", "differs from tools/cli/test-cell.c by a plural"),
          ("scripts/vector", "differs from scripts/vector by a plural")]


def self_test():
    if check(GOOD)[0]:
        house.fail_self_test(f"good names are not good: {check(GOOD)[0]}")
    for path, expected in FAULTS:
        complaints, _ = check(sorted(GOOD + [path]))
        if not any(expected in complaint for complaint in complaints):
            house.fail_self_test(f"{path}: not found: {expected}, but {complaints}")
    print(f"self-test: {len(FAULTS)} faults, each found")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    complaints, count = check(house.paths_of(arguments[0] if arguments else "."))
    return house.end("names", complaints, f"{count} files") if count > 100 else "no tree is here"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
