#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""C++ costs nothing: test_cost.py ROOT COMPILER... compiles calls.cpp with -O2 and compares each function's instructions
in C++ with those of the calls of C."""

import re
import subprocess
import sys


def functions(assembly):
    """{name: its instructions}, labels and directives left out."""
    found, name = {}, None
    for line in assembly.splitlines():
        label = re.match(r"_?(\w+_in_c(?:pp)?):", line)
        if label:
            name = label[1]
            found[name] = []
        elif name and re.match(r"\s+\.cfi_endproc|\.Lfunc_end", line):
            name = None
        elif name and re.match(r"\s+[a-z]", line):
            found[name].append(re.sub(r"\.L\w+|#.*", "", " ".join(line.split())))
    return found


def main(root, *compiler):
    command = [*compiler, "-std=c++17", "-O2", f"-I{root}/include", f"-I{root}", "-S", "-o", "-", f"{root}/bindings/cpp/tests/calls.cpp"]
    found = functions(subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout)
    bad = 0
    for what in ("point", "array", "status"):
        c, cpp = found[what + "_in_c"], found[what + "_in_cpp"]
        print(f"{what}: {len(c)} instructions in C, {len(cpp)} in C++, {'the same' if c == cpp else 'others'}")
        bad += c != cpp or not any("cm_" in line for line in c)
    calls = {name: sorted(re.findall(r"cm_\w+", " ".join(found[name]))) for name in ("object_in_c", "object_in_cpp")}
    print(f"object: calls {', '.join(calls['object_in_cpp'])}")
    bad += calls["object_in_c"] != calls["object_in_cpp"]
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
