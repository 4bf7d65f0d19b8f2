# SPDX-License-Identifier: MIT
"""What the public headers declare, read by a parser of C: every function that is exported, with its arguments and its
comment. Needs pycparser (Debian: python3-pycparser) and a C preprocessor."""

import dataclasses
import os
import pathlib
import re
import subprocess
import tempfile

# What stands in for the system's headers, whose extensions are none of the language's.
STUBS = {
    "stddef.h": "typedef unsigned long size_t; typedef long ptrdiff_t;\n#define NULL ((void *)0)\n",
    "stdint.h": "".join(f"typedef {kind} {name}_t;\n" for kind, name in
                        [("signed char", "int8"), ("unsigned char", "uint8"), ("short", "int16"),
                         ("unsigned short", "uint16"), ("int", "int32"), ("unsigned", "uint32"),
                         ("long", "int64"), ("unsigned long", "uint64")])
                + "#define UINT32_MAX 4294967295u\n",
    "math.h": "double fabs(double); double copysign(double, double); double pow(double, double);\n"
              "float fabsf(float); float copysignf(float, float); float powf(float, float);\n",
}


@dataclasses.dataclass(frozen=True)
class Argument:
    """An argument, or what a function returns, which has the name "return"."""

    name: str
    base: str  # "double", "cm_mapping", "char", "void": without const
    constant: bool  # is what it points to, or the array's elements, const?
    pointers: int  # how many, arrays left out
    extents: tuple  # of an array, as numbers: (3,), (4, 3)
    text: str  # as it is declared

    @property
    def is_text(self):
        return self.base == "char" and self.pointers + len(self.extents) == 1


@dataclasses.dataclass(frozen=True)
class Function:
    name: str
    header: str  # "mapping.h"
    line: int
    arguments: tuple
    result: Argument  # None for void
    comment: str  # of the function, or of the group that it stands in; "" for none


@dataclasses.dataclass(frozen=True)
class Interface:
    functions: dict  # by name
    handles: frozenset  # types that are only declared: "cm_mapping"
    structs: dict  # {"cm_options": [member, ...]}
    enumerations: dict  # {"cm_tier": {"CM_TIER_EXACT": 0, ...}}


def preprocessed(headers, compiler):
    """All the headers as one text, with line markers and without what pycparser does not know."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in STUBS.items():
            (pathlib.Path(folder) / name).write_text(text, encoding="utf-8")
        names = sorted(path.name for path in (headers / "cubemap").glob("*.h") if path.name != "kernels.h")
        command = [*compiler, "-E", "-nostdinc", "-std=c11", "-D__attribute__(x)=", "-I", folder, "-I", str(headers), "-x", "c", "-"]
        source = "".join(f"#include <cubemap/{name}>\n" for name in names)
        return subprocess.run(command, input=source, text=True, check=True, stdout=subprocess.PIPE).stdout


def argument_of(name, kind, c_ast, generator):
    """What a declared type is."""
    text = generator.visit(c_ast.Decl(name, [], [], [], [], kind, None, None) if name != "return" else
                           c_ast.Typename(None, [], None, kind))
    pointers, extents = 0, []
    while not isinstance(kind, c_ast.TypeDecl):
        if isinstance(kind, c_ast.ArrayDecl):
            extents.append(int(kind.dim.value) if kind.dim is not None else 0)
        elif isinstance(kind, c_ast.FuncDecl):
            return Argument(name, "function", False, 1, (), text)
        else:
            pointers += 1
        kind = kind.type
    return Argument(name, " ".join(kind.type.names), "const" in kind.quals, pointers, tuple(extents), text)


def is_section(line):
    return line.startswith("/* ---- ")


def comment_before(lines, line):
    """The comment that ends above a line, or above the declarations that stand before it without a blank line; without
    one the title of the section, as docs/renew/header-comments has it for the reference."""
    at = line - 2
    while at >= 0 and lines[at].strip() and not (lines[at].startswith(("/*", " *")) and lines[at].rstrip().endswith("*/")):
        at -= 1
    end = at
    while at >= 0 and lines[at].strip() and not lines[at].startswith("/*"):
        at -= 1
    if at < 0 or not lines[at].strip():
        titles = [number for number in range(line - 1) if is_section(lines[number])]
        if not titles:
            return ""
        at = end = titles[-1]
        while "*/" not in lines[end]:
            end += 1
    text = " ".join(re.sub(r"^(/\*|\s\*/?)\s?", "", part) for part in lines[at:end + 1])
    return re.sub(r"\s+", " ", text.replace("*/", "")).strip(" -")


def read(root, compiler=None):
    """The interface that the headers in root/include declare."""
    from pycparser import c_ast, c_generator, c_parser

    headers = pathlib.Path(root) / "include"
    tree = c_parser.CParser().parse(preprocessed(headers, compiler or os.environ.get("CC", "cc").split()))
    generator = c_generator.CGenerator()
    functions, handles, structs, enumerations, lines = {}, set(), {}, {}, {}
    for node in tree.ext:
        if not isinstance(node, (c_ast.Decl, c_ast.Typedef)):
            continue
        header = pathlib.Path(node.coord.file)
        if header.parent.name != "cubemap":
            continue
        if isinstance(node, c_ast.Typedef):
            kind = node.type.type
            if isinstance(kind, c_ast.Struct) and kind.decls is None:
                handles.add(node.name)
            elif isinstance(kind, c_ast.Struct):
                structs[node.name] = [argument_of(member.name, member.type, c_ast, generator) for member in kind.decls]
                handles.discard(node.name)
            elif isinstance(kind, c_ast.Enum):
                enumerations[node.name] = {item.name: int(item.value.value) for item in kind.values.enumerators}
            continue
        if not isinstance(node.type, c_ast.FuncDecl):
            continue
        text = lines.setdefault(header, header.read_text(encoding="utf-8").splitlines())
        parameters = node.type.args.params if node.type.args else []
        arguments = tuple(argument_of(one.name, one.type, c_ast, generator) for one in parameters if one.name)
        result = argument_of("return", node.type.type, c_ast, generator)
        # the declaration's first line, where CM_API is: its name may be on the next
        line = node.coord.line
        while line > 1 and "CM_API" not in text[line - 1]:
            line -= 1
        functions[node.name] = Function(node.name, header.name, line, arguments,
                                        None if (result.base, result.pointers) == ("void", 0) else result,
                                        comment_before(text, line))
    return Interface(functions, frozenset(handles), structs, enumerations)
