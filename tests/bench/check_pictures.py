#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""No picture of docs/images is older than its data; and docs/renew/picture-data says so when one is.

Usage: check_pictures.py PICTURE-DATA ROOT
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile


def check(script, root):
    done = subprocess.run([sys.executable, script, "--check", str(root)], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", check=False)
    return done.returncode, done.stdout


def expect(status, said, wanted_status, *words):
    if status != wanted_status or any(word not in said for word in words):
        sys.exit(f"not so: status {wanted_status} and {words}, but {status}: {said}")


def make_tree(script, root):
    """A picture of a file, and one of a part of a document, as they were drawn."""
    for folder in ("docs/renew", "docs/images"):
        (root / folder).mkdir(parents=True)
    own = shutil.copy(script, root / "docs/renew")
    (root / "docs/renew/pictures.txt").write_text("# head\na.png | a.txt | one\n"
                                                  "b-*.png | table.md#t a.txt | two\n")
    (root / "a.txt").write_text("1\n")
    (root / "table.md").write_text("text\n<!-- t -->\nrow\n<!-- end -->\nmore\n")
    for name in ("a.png", "b-1.png", "b-2.png"):
        (root / "docs/images" / name).write_bytes(b"")
    subprocess.run([sys.executable, own, "--write", "*"], check=True)
    return own


def check_changes(script):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        own = make_tree(script, root)
        expect(*check(own, root), 0)
        (root / "table.md").write_text("other text\n<!-- t -->\nrow\n<!-- end -->\n")
        expect(*check(own, root), 0)
        (root / "table.md").write_text("text\n<!-- t -->\nrows\n<!-- end -->\n")
        expect(*check(own, root), 1, "b-1.png is older", "b-2.png is older", "two draws it")
        subprocess.run([sys.executable, own, "--write", "b-1.png"], check=True)
        status, said = check(own, root)
        expect(status, said, 1, "b-2.png is older")
        if "b-1.png" in said or "a.png" in said:
            sys.exit(f"not so: only b-2.png is older: {said}")
        subprocess.run([sys.executable, own, "--write", "b-*"], check=True)
        (root / "a.txt").write_text("2\n")
        expect(*check(own, root), 1, "a.png is older", "b-1.png is older")
        (root / "docs/images" / "c.png").write_bytes(b"")
        expect(*check(own, root), 1, "c.png is in no row")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    script, root = sys.argv[1:]
    check_changes(script)
    status, said = check(script, root)
    print(said, end="")
    sys.exit(status)


if __name__ == "__main__":
    main()
