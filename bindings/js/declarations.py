# SPDX-License-Identifier: MIT
"""The types of what wrappers.py writes, with the headers' comments."""

import textwrap

from layouts import SCALARS
from special_cases import BY_HAND, FINDERS, GIVEN, SEEKERS, TELLERS, TEXTS_OR_NULL
from wrappers import BIG, KINDS, PREDICATE, camel, enumerators

ARRAYS = {"F64": "Float64Array", "F32": "Float32Array", "U8": "Uint8Array", "U32": "Uint32Array", "I64": "BigInt64Array",
          "U64": "BigUint64Array"}

INPUTS = {"F64": "Reals", "F32": "Floats", "U8": "Bytes", "U32": "Wholes", "U64": "Cells", "I64": "Pixels"}

HEAD = """// SPDX-License-Identifier: MIT
//
// Made by bindings/js/make_wrappers.py from bindings/functions and the headers: do not edit.

import type { Vector } from "./memory.js";

export type Reals = Float64Array | Float32Array | readonly number[] | Vector<Float64Array>;
export type Floats = Float32Array | readonly number[] | Vector<Float32Array>;
export type Bytes = Uint8Array | readonly number[] | Vector<Uint8Array>;
export type Cells = BigUint64Array | readonly bigint[] | Vector<BigUint64Array>;
export type Wholes = Uint32Array | readonly number[] | Vector<Uint32Array>;
export type Pixels = BigInt64Array | readonly (bigint | number)[] | Vector<BigInt64Array>;

"""

PICTURE = """/** Rows from the top, channels beside each other: width * height * channels numbers. */
export interface Picture {
    data: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array | Vector<Uint8Array> | Vector<Float32Array>;
    width: number;
    height: number;
    channels?: number;
}

"""

SCENE = """/** Bytes, or a text as UTF-8. */
export type Key = string | Uint8Array;

/** What a store keeps under a key. */
export interface StoredBlob {
    kind?: number;
    version?: number;
    data: Uint8Array;
}

/** Planes of x, y and z, a value a pixel. */
export interface DepthMapArrays {
    vertex: Float32Array[];
    normal: Float32Array[] | null;
    radius: Float32Array | null;
}

export interface DepthLevelArrays {
    width: number;
    height: number;
    least: Float32Array;
    most: Float32Array;
}

/** A value a ray; normals and colors are three arrays. */
export interface HitArrays {
    distance: Float64Array;
    id: Uint32Array;
    triangle: Uint32Array;
    normal: Float64Array[];
    color: Float64Array[];
    reflectance: Float64Array;
}

/** Centres and colors are three numbers a voxel. */
export interface VoxelArrays {
    centre: Float64Array;
    edge: Float64Array;
    alpha: Uint8Array;
    hasColor: Uint8Array;
    color: Uint8Array;
}

/** What a budget is made of. What is chosen of it is a new one. */
export interface BudgetGiven extends Partial<Omit<Budget, "entry">> {
    entry?: readonly Partial<BudgetEntry>[];
}

export interface RenderedPictures {
    color?: Picture;
    depth?: Picture;
}

"""


def pascal(name):
    if name == "cm_image":
        return "Picture"
    return "".join(part.capitalize() for part in name.removeprefix("cm_").split("_"))


class Declarations:
    def __init__(self, writer):
        self.writer = writer
        self.interface = writer.interface

    def plain(self, base):
        """The type of one value."""
        if base in self.interface.structs:
            return pascal(base)
        if base in self.interface.enumerations:
            return pascal(base)
        return "bigint" if base in BIG else "number"

    def input(self, one):
        if one.direction == "handle":
            return self.writer.handle_classes[one.base]
        if one.is_text:
            return "string"
        if one.base in self.interface.structs:
            name = pascal(one.base)
            return f"string | Partial<{name}>" if one.base in FINDERS else GIVEN.get(one.base, f"Partial<{name}>")
        if one.base in self.interface.enumerations and not one.pointers:
            return pascal(one.base)
        if one.pointers or one.extents:
            return INPUTS.get(one.kind, "string")
        if one.base in BIG:
            return "bigint" if one.base != "int64_t" else "bigint | number"
        return "number"

    def parameters(self, inputs):
        """The last ones may be left out if they are options."""
        texts, may = [], True
        for one in reversed(inputs):
            may = may and self.writer.is_optional(one)
            kind = self.input(one) + (" | null" if self.writer.is_optional(one) else "")
            texts.append(f"{one.name}{'?' if may else ''}: {kind}")
        return texts[::-1]

    def over_arrays(self, calls):
        call = calls[0]
        inputs, _ = self.writer.parameters(call)
        outputs = [one for one in call.arguments if one.direction == "out"]
        inout = next((one for one in call.arguments if one.direction == "inout"), None)
        if inout is not None:
            return [f"({', '.join(self.parameters(inputs))}): {ARRAYS[inout.kind]}"]
        if not outputs:
            kind = "boolean" if PREDICATE.search(call.js) else self.plain(call.result.base)
            return [f"({', '.join(self.parameters(inputs))}): {kind}"]
        signatures = []
        is_counted = not any(one.shape == ("n",) for one in inputs)
        for how in ["one", "float", "array"]:
            if how == "one" and is_counted:
                continue
            if how == "float" and not any(other.is_float for other in calls):
                continue
            given = []
            for one in inputs:
                if one.shape != ("n",):
                    given.append(f"{one.name}: {self.input(one)}")
                elif how == "one":
                    given.append(f"{one.name}: {self.plain(one.base)}")
                elif how == "float" and one.kind == "F64":
                    given.append(f"{one.name}: Float32Array | Vector<Float32Array>")
                else:
                    given.append(f"{one.name}: {self.input(one)}")
            members, places = [], []
            for one in outputs:
                array = ARRAYS["F32" if how == "float" and one.kind == "F64" else one.kind] if one.kind else "Float64Array"
                value = self.plain(one.base) if how == "one" else array
                if one.base in self.interface.structs:
                    names = [camel(member.name) for member in self.writer.layouts.of(one.base).members]
                    value = "number" if how == "one" else "Float64Array"
                    members += [f"{name}: {value}" for name in names]
                    places += [f"{name}?: {array} | Vector<{array}>" for name in names]
                elif len(one.shape) == 2:
                    members.append(f"{one.name}: {value}[]")
                    places.append(f"{one.name}?: ({array} | Vector<{array}>)[]")
                else:
                    members.append(f"{one.name}: {value}")
                    places.append(f"{one.name}?: {array} | Vector<{array}>")
            if is_counted:
                given.append("n: number")
            if how != "one":
                given.append(f"out?: {{ {'; '.join(places)} }}")
            result = members[0].split(": ", 1)[1] if len(members) == 1 else f"{{ {'; '.join(members)} }}"
            signatures.append(f"({', '.join(given)}): {result}")
        return signatures

    def returned(self, one, method):
        if one.is_text or (one.base == "char" and one.pointers):
            return "string | null" if method.endswith("At") else "string"  # a list has an end
        if one.direction == "borrowed" or one.pointers:
            if one.base in self.interface.structs:
                return f"{pascal(one.base)} | null"
            return self.writer.handle_classes[one.base]
        if one.base == "int" and PREDICATE.search(method):
            return "boolean"
        return self.plain(one.base)

    def once(self, call, method):
        inputs, room = self.writer.parameters(call)
        given = ", ".join(self.parameters(inputs) + [f"{one.name}: number" for one in room])
        made = next((one for one in call.arguments if one.direction == "new"), None)
        if made is not None:
            return f"({given})" + ("" if method == "constructor" else f": {self.writer.handle_classes[made.base]}")
        outs = [one for one in call.arguments if one.is_output and not one.is_text
                and not (one.name == "length" or (call.room is not None and one.name == "count"))]
        images = [one for one in outs if one.is_of_pixels]
        if images:
            places = "; ".join(f"{one.name}?: {ARRAYS[one.kind]} | Vector<{ARRAYS[one.kind]}>" for one in images)
            given += (", " if given else "") + f"out?: {{ {places} }}"
        text = next((one for one in call.arguments if one.is_text and one.is_output), None)
        if text is not None and text.name == "message" and not outs:
            return f"({given}): string | null"
        if text is not None and text.name != "message":
            return f"({given}): string"
        parts = []
        if call.result is not None and call.result.direction != "status" and call.name not in SEEKERS | TELLERS:
            if call.result.base in ("int", "size_t") and len(outs) == 1 and len(outs[0].shape) == 1:
                return f"({given}): {ARRAYS[outs[0].kind]}"
            parts.append(("face" if call.result.base == "uint8_t" else "value", self.returned(call.result, method)))
        parts += [(one.name, ARRAYS[one.kind] if one.shape else self.plain(one.base)) for one in outs]
        if not parts:
            return f"({given}): void"
        if len(parts) == 1:
            return f"({given}): {parts[0][1]}" + (" | null" if call.name in SEEKERS else "")
        return f"({given}): {{ {'; '.join(f'{name}: {kind}' for name, kind in parts)} }}"

    def signatures(self, method, calls):
        if calls[0].name in BY_HAND:
            return [BY_HAND[calls[0].name][1]]
        return self.over_arrays(calls) if calls[0].has_arrays else [self.once(calls[0], method)]

    @staticmethod
    def comment(text, indent):
        if not text:
            return ""
        lines = textwrap.wrap(text.replace("*/", "* /"), 110 - len(indent))
        return f"{indent}/** " + f"\n{indent} *  ".join(lines) + " */\n"

    def class_text(self, owner, methods):
        lines = [f"export class {owner} {{"]
        is_made = "constructor" in methods
        if not is_made:
            lines.append("    private constructor();")
        for method, calls in methods.items():
            lines.append(self.comment(calls[0].comment, "    ").rstrip("\n"))
            static = "" if calls[0].is_method or method == "constructor" else "static "
            for signature in self.signatures(method, calls):
                if not static and signature.startswith("()") and method != "constructor" and calls[0].tells:
                    lines.append(f"    readonly {method}{signature[2:]};")
                else:
                    lines.append(f"    {static}{method}{signature};")
        return "\n".join([*filter(None, lines), "    /** Gives the memory back now; else that happens when nobody has the object. */",
                          "    free(): void;", "}", ""])

    def member_type(self, layout, member):
        """The type of a struct's member; None of what JavaScript has not."""
        if member.base == "cm_image":
            return "Picture"
        if member.words:
            return pascal(member.words)
        if member.extents is not None and member.base in self.interface.structs:
            return f"{pascal(member.base)}[]"
        if member.extents is not None:
            kind = f"{INPUTS[KINDS[member.base]]} | null"
            return f"readonly ({kind})[]" if member.is_array else kind
        if member.pointers and member.base in self.writer.handle_classes:
            return f"{self.writer.handle_classes[member.base]} | null"
        is_struct = member.base in self.interface.structs
        if member.pointers and not (member.base == "char" or is_struct or member.base in self.interface.enumerations):
            return None
        kind = "string" if member.base == "char" and member.pointers else self.plain(member.base)
        if kind == "string" and layout.name in TEXTS_OR_NULL:
            kind += " | null"
        if member.pointers and is_struct:
            kind = f"string | Partial<{kind}>" if member.base in FINDERS else f"Partial<{kind}>"
        return kind + ("[]" if member.is_array else "")

    def struct_text(self, name):
        lines = [f"export interface {pascal(name)} {{"]
        layout = self.writer.layouts.of(name)
        for member in layout.members:
            if member.name == "size" and member.base == "size_t" or member.base in ("void", "function", "cm_memory"):
                continue
            kind = self.member_type(layout, member)
            if kind is not None:
                is_handle = member.pointers and member.base in self.writer.handle_classes
                may_lack = name not in self.writer.read or is_handle or self.writer.is_counter(layout, member)
                lines.append(f"    {camel(member.name)}{'?' if may_lack else ''}: {kind};")
        return "\n".join([*lines, "}", ""])

    def text(self):
        structs = self.writer.written | self.writer.read
        todo = list(structs)
        while todo:
            for member in self.writer.layouts.of(todo.pop()).members:
                if member.base in self.interface.structs and member.base not in structs:
                    structs.add(member.base)
                    todo.append(member.base)
        classes = self.writer.classes
        texts = [HEAD]
        if "cm_image" in structs:
            texts.append(PICTURE)
        if "Octree" in classes:
            texts.append(SCENE)
        for base, values in self.interface.enumerations.items():
            texts.append(f"export type {pascal(base)} = " + " | ".join(f'"{name}"' for name in enumerators(values)) + ";\n")
        texts += ["\n"] + [self.struct_text(name) + "\n" for name in sorted(structs - {"cm_image", "cm_memory", "cm_rows"})]
        members = []
        for owner, methods in classes.items():
            if not owner:
                for method, calls in methods.items():
                    members.append(self.comment(calls[0].comment, "    ") + "\n".join(
                        f"    {method}{signature};" for signature in self.signatures(method, calls)))
            elif owner in self.writer.handle_classes.values():
                texts.append(self.class_text(owner, methods) + "\n")
                members.append(f"    readonly {owner}: typeof {owner};")
            else:
                inner = [self.comment(calls[0].comment, "        ") + "\n".join(
                    f"        {method}{signature};" for signature in self.signatures(method, calls)) for method, calls in methods.items()]
                members.append(f"    readonly {owner}: {{\n" + "\n".join(inner) + "\n    };")
        arrays = {"float64": "F64", "float32": "F32", "uint8": "U8", "uint32": "U32", "int64": "I64", "uint64": "U64"}
        members += [f"    /** An array in the module's memory, which functions use where it is. */\n    {name}(length: number): Vector<{ARRAYS[kind]}>;"
                    for name, kind in arrays.items()]
        texts.append("/** What load() gives. */\nexport interface Library {\n    readonly memory: WebAssembly.Memory;\n" + "\n".join(members) + "\n}\n")
        return "".join(texts)
