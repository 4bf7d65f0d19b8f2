#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Who is fed by which harness, in bindings/functions for the library and in tests/fuzz/README.md for the tools: every
harness there calls its function, and every harness is built, has first inputs and is there; and every option of the
programs for images is in the dictionary of its harness.

Usage: check_table.py REPOSITORY
"""

import functools
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bindings"))
sys.dont_write_bytecode = True
import function_table

LEAST_FUNCTIONS = 30  # fewer would mean that the headers are not read as they are written


def rows_of_library(table, fuzz):
    """(function, harness) for each harness of each public function."""
    return [(function.name, next((file.name for file in fuzz.glob(f"fuzz_{name}.c*")), f"fuzz_{name}.c"))
            for function in table.functions for name in function.fuzz]


def rows_of(readme):
    """(function, harness) for each harness of each row."""
    rows = []
    for line in readme.read_text(encoding="utf-8").splitlines():
        found = re.fullmatch(r"\| `([a-z0-9_]*)`[^|]* \| (`.*`) \|", line)
        if found:
            rows += [(found[1], harness) for harness in re.findall(r"[^`, ]+", found[2])]
    return rows


@functools.lru_cache(maxsize=None)
def words_of(harness):
    """Those of its text without comments."""
    text = harness.read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.DOTALL)
    return set(re.findall(r"\w+", text))


def programs_of(tools):
    """The programs as functions, cm_NAME_main."""
    return {name for header in tools.glob("*/*.h")
            for name in re.findall(r"\bint (cm_\w+_main)\(", header.read_text(encoding="utf-8"))}


def functions_of_files(modules):
    """What the modules have for files, which is the programs' own."""
    return {name for header in modules.glob("*/io/*.h")
            for name in re.findall(r"^[a-z][\w *]*\b(cm_\w+)\(", header.read_text(encoding="utf-8"), re.M)}


def wrong_of(row, fuzz, functions, built):
    """What is wrong with a row, or None; functions are those that may begin with cm_."""
    function, harness = row
    name = re.sub(r"^fuzz_", "", pathlib.PurePath(harness).stem)
    corpus = fuzz / "corpus" / name
    if function.startswith("cm_") and function not in functions:
        return f"{function} is in a table, but neither in the library, nor in the tools, nor for files"
    if not (fuzz / harness).is_file():
        return f"{harness} is in a table, but there is no such file"
    if function not in words_of(fuzz / harness):
        return f"{harness} does not call {function}"
    if not (corpus.is_dir() and any(each.is_file() for each in corpus.rglob("*"))):
        return f"{harness} has no first inputs in corpus/{name}"
    if not re.search(rf"'(fuzz-|fuzz_)?{re.escape(name)}(\.c)?'", built):
        return f"{harness} is not built by meson.build"
    return None


def missing_words(root):
    """The options of programs that the dictionaries of their harnesses do not have."""
    for program in ("reproject", "compare"):
        table = root / "tools" / program / f"{program}_table.c"
        words = root / "tests" / "fuzz" / "corpus" / f"{program}_options.dict"
        known = words.read_text(encoding="utf-8").splitlines()
        for name in re.findall(r'\.name = "([a-z0-9-]+)"', table.read_text(encoding="utf-8")):
            if f'"--{name}"' not in known and not name.startswith("cubemap-"):  # the program's own
                yield f'{words.name} does not have "--{name}"'


def main():
    root = pathlib.Path(sys.argv[1])
    fuzz = root / "tests" / "fuzz"
    table = function_table.read(root / "bindings" / "functions")
    functions = {function.name for function in table.functions}
    rows = rows_of_library(table, fuzz) + rows_of(fuzz / "README.md")
    built = (fuzz / "meson.build").read_text(encoding="utf-8")
    named = {harness for _, harness in rows}
    known = functions | programs_of(root / "tools") | functions_of_files(root / "modules")
    complaints = list(filter(None, (wrong_of(row, fuzz, known, built) for row in rows)))
    complaints += [f"{file.name} is in no table"
                   for file in sorted([*fuzz.glob("fuzz_*.c"), *fuzz.glob("fuzz_*.cpp")]) if file.name not in named]
    complaints += missing_words(root)
    for complaint in complaints:
        print("not ok:", complaint)
    print(f"{len(functions)} functions of the library\n{len(named)} harnesses")
    return 1 if complaints or len(functions) < LEAST_FUNCTIONS else 0


if __name__ == "__main__":
    sys.exit(main())
