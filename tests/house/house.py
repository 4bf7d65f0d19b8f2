# SPDX-License-Identifier: MIT
"""What the checks of the house share: the files of the tree, and how a check ends."""

import os
import sys

NOT_OURS = ("build", "shared", "subprojects", "demo-output")


def is_skipped(folder, name, at_top):
    """Is this folder a build, hidden, or made by running something?"""
    return (name.startswith(".") and name != ".ci") or name == "__pycache__" or \
        (at_top and name.startswith(NOT_OURS)) or \
        os.path.isdir(os.path.join(folder, name, "meson-private"))


def paths_of(root):
    """Every file below the root, as paths with / from there, sorted."""
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if not is_skipped(folder, name, folder == root)]
        for name in names:
            # of a work tree, and what pip leaves
            if name in (".git", ".mesonpy-native-file.ini"):
                continue
            found.append(os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/"))
    return sorted(found)


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        return file.read()


def end(name, complaints, counted):
    """Says what is wrong, or what has been looked at; the exit status."""
    for complaint in complaints:
        print(complaint)
    print(f"{name}: {counted}, {len(complaints)} not as they should be")
    return 1 if complaints else 0


def fail_self_test(text):
    print(f"self-test: {text}")
    sys.exit(1)
