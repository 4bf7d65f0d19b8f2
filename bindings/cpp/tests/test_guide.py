#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The program of docs/guide/cpp.md prints what stands there: test_guide.py ROOT LIBRARY FOLDER COMPILER..."""

import pathlib
import re
import subprocess
import sys


def main(root, library, folder, *compiler):
    page = (pathlib.Path(root) / "docs/guide/cpp.md").read_text(encoding="utf-8")
    program, expected = (re.search(rf"```{kind}\n(.*?)```", page, re.S)[1] for kind in ("cpp", "output"))
    headers = pathlib.Path(folder) / "installed"
    (headers / "cubemap").mkdir(parents=True, exist_ok=True)
    # as it is installed: beside the headers of C
    (headers / "cubemap/cubemap.hpp").write_bytes((pathlib.Path(root) / "bindings/cpp/cubemap.hpp").read_bytes())
    source, binary = pathlib.Path(folder) / "guide_example.cpp", pathlib.Path(folder) / "guide-example"
    source.write_text(program, encoding="utf-8")
    place = pathlib.Path(library).parent
    subprocess.run([*compiler, "-std=c++17", f"-I{headers}", f"-I{root}/include", str(source), f"-L{place}",
                    f"-Wl,-rpath,{place}", "-lcubemap", "-o", str(binary)], check=True)
    printed = subprocess.run([str(binary)], check=True, text=True, stdout=subprocess.PIPE).stdout
    print(printed)
    return 0 if printed == expected else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
