#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bindings/functions, the one list of public functions, against the headers and what the library exports.

check_functions.py [ROOT [LIBRARY...]]   check the table; with libraries, shared ones, what they export too
check_functions.py --self-test           check that each fault is found

A function must be in the table as its header declares it, have a comment, a name in every language or a reason why not,
and a page of the guide. That harnesses call it tests/fuzz/check_table.py says, that bindings have it their own tests.
Without pycparser the exit status is 77.
"""

import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "bindings")]
sys.dont_write_bytecode = True
import function_table
import house
import public_headers

LEAST_FUNCTIONS = 300  # fewer would mean that the headers are not read as they are written

# What arrays of unknown length, and pointers to one, may be called in the table.
OUTPUTS = ("out", "inout")


def expected_directions(declared, name, interface):
    """The directions that an argument of that type may have."""
    if declared.base in interface.handles:
        if declared.pointers == 2:
            return ("new",)
        if declared.name == "return":
            return ("borrowed",)
        return ("free",) if name.endswith("_destroy") else ("handle",)
    if declared.name == "return":
        if declared.base == "cm_status":
            return ("status",)
        return ("borrowed",) if declared.pointers and not declared.is_text else ("out",)
    if declared.base in ("void", "function") or (declared.pointers + len(declared.extents) == 0
                                                 and not declared.base.startswith("cm_distortion_arrays")):
        return ("in", "count", "option", *OUTPUTS) if declared.base == "void" else ("in", "count", "option")
    if declared.constant:
        # pictures are described by structs that are not written themselves
        return ("in", "option", *OUTPUTS) if declared.base == "cm_image" or "arrays" in declared.base else ("in", "option")
    return OUTPUTS


def expected_extents(declared):
    """What the shape must begin with, or None for anything."""
    return tuple(map(str, declared.extents)) if declared.extents else None


def check_argument(function, given, declared, interface):
    where = f"{function.name}: {given.name}"
    if given.name != declared.name:
        yield f"{function.name}: the header calls an argument {declared.name}, the table {given.name}"
        return
    directions = expected_directions(declared, function.name, interface)
    if given.direction not in directions:
        yield f"{where} is {given.direction}, but {declared.text} can be {' or '.join(directions)}"
    extents = expected_extents(declared)
    if extents and not given.is_text and given.shape[:len(extents)] != extents:
        yield f"{where} has the shape {given.shape}, but the header says {declared.text}"
    if given.is_text and not declared.base == "char":
        yield f"{where} is text, but {declared.text}"
    known = {argument.name for argument in function.arguments} | {"nside", "pictures", "planes", "channels", "pixels", "pinhole_pixels"}
    for word in re.findall(r"[a-z_]\w*", " ".join(given.shape)):
        if word not in known and given.shape not in (("text",), ("call",), ("pointer",)) and word != "sum":
            yield f"{where}: what is {word} in its shape?"


def check_function(function, declared, interface):
    if function.header != declared.header:
        yield f"{function.name} stands under {function.header}, but is of {declared.header}"
    given, wanted = list(function.arguments), list(declared.arguments)
    if function.result or declared.result:
        if not (function.result and declared.result):
            yield f"{function.name}: what it returns is not as in the header"
            return
        given.append(function.result)
        wanted.append(declared.result)
    if len(given) != len(wanted):
        yield f"{function.name} has {len(given)} arguments and results in the table, {len(wanted)} in the header"
        return
    for one, other in zip(given, wanted):
        yield from check_argument(function, one, other, interface)
    if not declared.comment:
        yield f"{function.name}: {declared.header}:{declared.line} has no comment"


def check_twins(table):
    """What is there for float is as it is for double."""
    by_name = {function.name: function for function in table.functions}
    for function in table.functions:
        twin = by_name.get(re.sub(r"_f32$", "", function.name))
        if twin is None:
            yield f"{function.name} has no twin for double"
        elif (function.arguments, function.result) != (twin.arguments, twin.result):
            yield f"{function.name} and {twin.name} have other arguments in the table"


def check(text, interface, pages, exported=None):
    """What is wrong with the table of this text, and how many functions it has."""
    try:
        table = function_table.parse(text)
    except function_table.TableError as error:
        return [f"bindings/functions: {error}"], 0
    complaints, names = [], {function.name for function in table.functions}
    complaints += [f"{name}: {interface.functions[name].header} declares it, the table lacks it"
                   for name in interface.functions if name not in names]
    for function in table.functions:
        declared = interface.functions.get(function.name)
        if declared is None:
            complaints.append(f"{function.name} is in the table, but in no header")
            continue
        complaints += check_function(function, declared, interface)
        if function.docs not in pages:
            complaints.append(f"{function.name}: there is no docs/guide/{function.docs}.md")
    complaints += check_twins(table)
    used = {reason for function in table.functions for reason in function.reasons.values()}
    complaints += [f"the reason -{reason} of the table is nobody's" for reason in table.reasons if reason not in used]
    if exported is not None:
        complaints += [f"{name} is exported, but not in the table" for name in sorted(exported - names)]
        complaints += [f"{name} is in the table, but not exported" for name in sorted(names - exported)]
    return complaints, len(table.functions)


def exports_of(libraries):
    """The functions that shared libraries export."""
    names = set()
    for library in libraries:
        symbols = subprocess.run(["nm", "-D", "--defined-only", library], text=True, check=True,
                                 stdout=subprocess.PIPE).stdout
        names |= set(re.findall(r"\b[TtWi] (cm_\w+)$", symbols, re.M))
    return names


HEAD = "#\n# -strides   such\n# ---- mapping.h\n"
TAIL = " ; python=a js=b cpp=-strides fuzz=c docs=library\n"
GOOD = {"cm_put": "mapping:handle:() n:count:() x:in:(n) uv:out:(2) return:status:()",
        "cm_put_f32": "mapping:handle:() n:count:() x:in:(n) uv:out:(2) return:status:()"}

# what is changed in the good table, and what must be said of it
FAULTS = [
    ("cm_put_f32 ", "cm_pat_f32 ", "cm_pat_f32 is in the table, but in no header"),
    ("cm_put_f32 ", "cm_pat_f32 ", "cm_put_f32: mapping.h declares it, the table lacks it"),
    ("cm_put ", "cm_put mapping:handle:() ; python=a js=b cpp=-strides fuzz=c docs=library\ncm_put ", "stands in line"),
    ("x:in", "y:in", "the header calls an argument x, the table y"),
    ("x:in", "x:out", "cm_put: x is out, but"),
    ("uv:out", "uv:in", "cm_put: uv is in, but"),
    ("mapping:handle", "mapping:in", "cm_put: mapping is in, but"),
    ("uv:out:(2)", "uv:out:(3)", "cm_put: uv has the shape ('3',), but the header says"),
    ("x:in:(n)", "x:in:(m)", "cm_put: x: what is m in its shape?"),
    ("x:in:(n)", "x:in:(n", "is no shape"),
    ("x:in:(n)", "x:on:(n)", "on is no direction here"),
    (" return:status:()", "", "what it returns is not as in the header"),
    (" uv:out:(2)", "", "arguments and results in the table"),
    ("python=a ", "", "has no python"),
    ("-strides ", "-strode ", "no reason of the head"),
    ("docs=library", "docs=nowhere", "there is no docs/guide/nowhere.md"),
    ("---- mapping.h", "---- grid.h", "stands under grid.h, but is of mapping.h"),
    ("# -strides   such\n", "# -strides   such\n# -idle   such\n", "the reason -idle of the table is nobody's"),
    ("n:count:() x", "n:option:() x", "cm_put_f32 and cm_put have other arguments in the table"),
]


def self_test():
    def argument(name, base, constant, pointers, extents=()):
        return public_headers.Argument(name, base, constant, pointers, extents, f"{base} {name}")

    def declared(name, real, comment="What it does."):
        return public_headers.Function(name, "mapping.h", 7, (
            argument("mapping", "cm_mapping", True, 1), argument("n", "size_t", False, 0), argument("x", real, True, 1),
            argument("uv", real, False, 0, (2,))), argument("return", "cm_status", False, 0), comment)

    def interface(**more):
        return public_headers.Interface({"cm_put": declared("cm_put", "double", **more), "cm_put_f32": declared("cm_put_f32", "float")},
                                        frozenset({"cm_mapping"}), {}, {})

    text = HEAD + "".join(f"{name} {words}{TAIL}" for name, words in GOOD.items())
    exported = {"cm_put", "cm_put_f32"}
    complaints, count = check(text, interface(), {"library"}, exported)
    if complaints or count != 2:
        house.fail_self_test(f"the good table is not good: {complaints}")
    cases = [(text.replace(old, new, 1), interface(), exported, expected) for old, new, expected in FAULTS]
    cases += [(text, interface(comment=""), exported, "cm_put: mapping.h:7 has no comment"),
              (text, interface(), exported | {"cm_more"}, "cm_more is exported, but not in the table"),
              (text, interface(), {"cm_put"}, "cm_put_f32 is in the table, but not exported")]
    for changed, read, library, expected in cases:
        complaints, _ = check(changed, read, {"library"}, library)
        if not any(expected in complaint for complaint in complaints):
            house.fail_self_test(f"not found: {expected}\n  but: {complaints}\n{changed}")
    print(f"self-test: {len(cases)} faults, each found")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    root, *libraries = arguments or ["."]
    try:
        interface = public_headers.read(root)
    except ModuleNotFoundError as error:
        print(f"{error}: Debian has it as python3-pycparser")
        return 77
    pages = {os.path.splitext(name)[0] for name in os.listdir(os.path.join(root, "docs", "guide"))}
    complaints, count = check(house.read(root, "bindings/functions"), interface, pages,
                              exports_of(libraries) if libraries else None)
    if count < LEAST_FUNCTIONS and not complaints:
        complaints = [f"only {count} functions"]
    return house.end("functions", complaints, f"{count} functions")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
