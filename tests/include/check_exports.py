#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A library exports what its headers declare, and nothing else; what they declare has CM_API before it.

check_exports.py --library NAME TOOL LIBRARY INCLUDE   LIBRARY: the file of the library NAME, which TOOL shows, nm if it is a
                                                       shared object, objdump if it is a DLL; INCLUDE: where headers are
check_exports.py --msvc CLANG INCLUDE                  the same of MSVC's DLLs, which export what is declared so: CLANG reads
                                                       the headers as MSVC does
check_exports.py --self-test                           check that each fault is found that is made for it
"""

import glob
import os
import re
import subprocess
import sys

# What is not of libcubemap: colour maps and pictures have libraries of their own, kernels need none.
OTHERS = {"colormap.h": "cubemap-colormap", "compare.h": "cubemap-image", "environment.h": "cubemap-image",
          "image.h": "cubemap-image", "mips.h": "cubemap-image", "panorama.h": "cubemap-image", "kernels.h": None,
          "srgb.h": None,
          "octree.h": "cubemap-octree",
          **dict.fromkeys(("brdf.h", "compensate.h", "depth_error.h", "lens.h", "sim.h", "texel.h"), "cubemap-sim"),
          # the module scene
          **dict.fromkeys(("budget.h", "camera.h", "depth.h", "mesh.h", "pool.h", "pose.h", "random.h", "raster.h", "scene.h",
                           "store.h", "trajectory.h", "view.h", "world.h"), "cubemap-scene")}

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.M)
BODY = re.compile(r"\{[^{}]*\}")
FUNCTION = re.compile(r"\b(cm_\w+)\s*\(")


def declared_in(text, header="the header"):
    """The functions that a header declares, and a complaint for each that lacks CM_API."""
    text = DIRECTIVE.sub("", COMMENT.sub(" ", text)).replace('extern "C" {', "")
    while BODY.search(text):
        text = BODY.sub(";", text)
    names, complaints = set(), []
    for statement in text.split(";"):
        words = statement.split()
        function = FUNCTION.search(statement)
        if not words or function is None or words[0] in ("typedef", "static"):
            continue
        names.add(function[1])
        if words[0] != "CM_API":
            complaints.append(f"{header}: {function[1]} has no CM_API")
    return names, complaints


def exported_by_nm(text):
    """Of nm -D: functions and data that the library defines, but for what linkers and sanitizers add."""
    lines = [line.split() for line in text.splitlines()]
    names = {line[2].split("@")[0] for line in lines if len(line) == 3 and line[1] in "TDBRVW"}
    return {name for name in names if not re.match(r"_|\.|\w*(asan|ubsan|sancov|llvm|gcov)", name)}


def exported_by_objdump(text):
    """Of objdump -p: the table of names of a DLL."""
    table = text.split("[Ordinal/Name Pointer] Table", 1)[-1].split("\n\n", 1)[0]
    return set(re.findall(r"^\s*\[\s*\d+\](?:\s+\+base\[\s*\d+\])?\s+(?:[0-9a-f]+\s+)?(\S+)$", table, re.M))


def compare(declared, exported, library):
    return ([f"{library} does not export {name}, which is declared" for name in sorted(declared - exported)] +
            [f"{library} exports {name}, which no header declares" for name in sorted(exported - declared)])


# With each macro, what clang says of a function for MSVC.
STORAGE = {"": "DLLImportAttr", "-DCM_BUILD": "DLLExportAttr", "-DCM_STATIC": None}


def storage_in(tree):
    """Of clang's -ast-dump: {function: how it is shared}, or None where it is not, of those that are not static."""
    found, name = {}, None
    for line in tree.splitlines():
        if re.match(r"[|`]-\w", line):
            function = re.match(r"[|`]-FunctionDecl .*? (cm_\w+) '", line)
            name = function[1] if function and not re.search(r"' (static|inline)\b", line) else None
            if name:
                found.setdefault(name, None)
        elif name and (attribute := re.search(r"-(DLL(?:Ex|Im)portAttr)\b", line)):
            found[name] = attribute[1]
    return found


def clang_for_msvc(clang, include, macro, *options, text=None):
    command = [clang, "--target=x86_64-pc-windows-msvc", "-nostdlibinc", "-std=c11", "-Wall", "-Wextra", "-Wpedantic",
               "-Werror", "-fno-color-diagnostics", "-I", include, *([macro] if macro else []), *options]
    return subprocess.run(command, input=text, stdout=subprocess.PIPE, check=True, encoding="utf-8").stdout


def check_msvc(clang, include):
    headers = [os.path.basename(path) for path in sorted(glob.glob(os.path.join(include, "cubemap", "*.h")))]
    headers = [name for name in headers if OTHERS.get(name, "") is not None]  # kernels have no functions of a library
    declared = set()
    for name in headers:
        with open(os.path.join(include, "cubemap", name), encoding="utf-8") as file:
            declared |= declared_in(file.read(), name)[0]
    text = "".join(f"#include <cubemap/{name}>\n" for name in headers)
    complaints = []
    for macro, wanted in STORAGE.items():
        tree = clang_for_msvc(clang, include, macro, "-fsyntax-only", "-Xclang", "-ast-dump", "-x", "c", "-", text=text)
        found = storage_in(tree)
        complaints += [f"with {macro or 'no macro'} {name} has {found.get(name, 'no declaration')}, not {wanted}"
                       for name in sorted(declared) if found.get(name, "no declaration") != wanted]
    # what is defined becomes an order to the linker
    definition = "#include <cubemap/version.h>\nconst char *cm_version(void) { return CM_VERSION_STRING; }\n"
    made = clang_for_msvc(clang, include, "-DCM_BUILD", "-S", "-o", "-", "-x", "c", "-", text=definition)
    if "/EXPORT:cm_version" not in made:
        complaints.append("an object does not export what it defines")
    return complaints, len(declared)


def self_test():
    header = ('typedef enum cm_e { CM_A /* cm_no(x) */ } cm_e;\ntypedef void (*cm_job)(int);\n#define cm_m(x) \\\n cm_k(x)\n'
              'static inline int cm_i(int a) { return cm_j(a); }\nCM_API const char *cm_text(cm_e e);\n'
              "CM_API int\ncm_two(int (*cm_call)(int));\nint cm_bare(void);\n")
    names, complaints = declared_in(header)
    assert names == {"cm_text", "cm_two", "cm_bare"}, names
    assert complaints == ["the header: cm_bare has no CM_API"], complaints
    shown = exported_by_nm("0 T cm_text\n0 T cm_extra@@V\n U malloc\n0 T _init\n0 D cm_data\n")
    assert shown == {"cm_text", "cm_extra", "cm_data"}, shown
    dll = exported_by_objdump("x\n[Ordinal/Name Pointer] Table -- Ordinal Base 1\n\t[   0] +base[   1]  0000 cm_text\n"
                              "\t[   1] cm_two\n\nThe Function Table\n\t[ 3] cm_three\n")
    assert dll == {"cm_text", "cm_two"}, dll
    tree = ("|-FunctionDecl 0x1 <a:1, b:2> col:3 cm_out 'int (void)'\n| `-DLLExportAttr 0x2 <a>\n"
            "|-FunctionDecl 0x1 <a:1, b:2> col:3 cm_bare 'int (int)'\n| |-ParmVarDecl 0x2 <a> col:1 b 'int'\n"
            "|-FunctionDecl 0x1 <a:1, b:2> col:3 cm_own 'int (int)' static inline\n| `-DLLExportAttr 0x2 <a>\n"
            "`-FunctionDecl 0x1 <a:1, b:2> line:3:4 used cm_in 'int (void)' extern\n  `-DLLImportAttr 0x2 <a>\n")
    assert storage_in(tree) == {"cm_out": "DLLExportAttr", "cm_bare": None, "cm_in": "DLLImportAttr"}, storage_in(tree)
    assert len(compare({"a", "b"}, {"b", "c"}, "it")) == 2
    print("every fault was found")


def main(arguments):
    if arguments == ["--self-test"]:
        self_test()
        return 0
    if len(arguments) == 3 and arguments[0] == "--msvc":
        complaints, count = check_msvc(*arguments[1:])
        print("\n".join(complaints) or f"{count} functions, declared as MSVC's DLLs need it")
        return 1 if complaints or count == 0 else 0
    if len(arguments) != 5 or arguments[0] != "--library":
        print(__doc__, file=sys.stderr)
        return 2
    name, tool, library, include = arguments[1:]
    declared, complaints = set(), []
    for header in sorted(glob.glob(os.path.join(include, "cubemap", "*.h"))):
        if OTHERS.get(os.path.basename(header), "cubemap") == name:
            with open(header, encoding="utf-8") as file:
                names, more = declared_in(file.read(), header)
            declared |= names
            complaints += more
    is_dll = library.endswith(".dll")
    shown = subprocess.run([tool, "-p" if is_dll else "-D", library] + ([] if is_dll else ["--defined-only"]),
                           check=True, capture_output=True, text=True).stdout
    exported = exported_by_objdump(shown) if is_dll else exported_by_nm(shown)
    complaints += compare(declared, exported, library)
    print("\n".join(complaints) or f"{library}: {len(exported)} functions, as declared")
    return 1 if complaints or not declared else 0


sys.exit(main(sys.argv[1:]))
