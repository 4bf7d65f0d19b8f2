# SPDX-License-Identifier: MIT
"""The kernels as flat texts of shading languages: what generate prints and the tests run."""

import collections
import functools
import os
import re
import shlex
import struct
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INCLUDE = os.path.join(ROOT, "include")

# A dialect: its number in dialect.h, what a text begins with, its type of three numbers and what makes one.
Dialect = collections.namedtuple("Dialect", "backend head vector make_vector suffix meaning")
DIALECTS = {
    "glsl": Dialect(3, "", "vec3", "vec3", ".glsl", "GLSL 3.30 to 4.60, GLSL for Vulkan"),
    "glsl-es": Dialect(3, "precision highp float;\n", "vec3", "vec3", ".glsl", "GLSL ES 3.00 to 3.20, WebGL 2"),
    "hlsl": Dialect(6, "", "float3", "float3", ".hlsl", "HLSL, shader model 5 and later"),
    "opencl": Dialect(7, "", None, None, ".cl", "OpenCL C 1.2 and later"),
    "cuda": Dialect(8, "", "float3", "make_float3", ".cuh", "CUDA C++"),
    "metal": Dialect(9, "#include <metal_stdlib>\nusing namespace metal;\n", "float3", "float3", ".metal",
                     "Metal 2 and later"),
}

Parameter = collections.namedtuple("Parameter", "name standard low high")
# kind is what its descriptor is: warp, sphere, azimuthal, square or layout. word is that of its functions.
Mapping = collections.namedtuple("Mapping", "identifier aliases presets name word kind has_variants parameters has_lookup")


class Wrong(Exception):
    """What a user gave is not there."""


def preprocess(text, backend=3):
    """A text after the C preprocessor, without lines of its own."""
    command = shlex.split(os.environ.get("CC", "cc")) + [
        "-E", "-P", "-x", "c", "-U__OPTIMIZE__", f"-DCM_BACKEND={backend}", "-I", INCLUDE, "-"]
    return subprocess.run(command, input=text, stdout=subprocess.PIPE, check=True, text=True).stdout


def field(text, name):
    """The texts of a descriptor's field, joined as C joins them."""
    found = re.search(r"\." + name + r' = ((?:"[^"]*"\s*)+)', text)
    return "".join(re.findall(r'"([^"]*)"', found[1])) if found else ""


def number(text, name, without):
    found = re.search(r"\." + name + r" = \(?(-?[0-9.e+-]+)", text)
    return float(found[1]) if found else without


@functools.lru_cache(maxsize=None)
def read_catalogue():
    """All mappings in the catalogue's order, by the descriptors in the kernels' headers."""
    kinds = {"WARP": "warp", "WARP_VARIANTS": "variants", "SPHERE": "sphere", "AZIMUTHAL": "azimuthal",
             "SQUARE": "square", "LAYOUT": "layout"}
    source = "#define CM_DESCRIPTORS\n"
    source += "".join(f"#define CM_{kind}(word, ...) @{name} word @ __VA_ARGS__ @end\n" for kind, name in kinds.items())
    source += '#include "cubemap/kernel/kernel_catalogue.h"\n'
    mappings = []
    for kind, word, text in re.findall(r"@(\w+) (\w+) @(.*?)@end", preprocess(source), re.S):
        parameters = [
            Parameter(field(part, "name"), number(part, "standard", 0.0), number(part, "low", 0.0),
                      number(part, "high", 0.0))
            for part in re.findall(r"\{(\s*\.name = [^{}]*)\}", text)]
        # a map on one square is none of a cube map's
        has_lookup = ".kind" not in text
        mappings.append(Mapping(field(text, "identifier"), field(text, "aliases"), field(text, "presets"),
                                field(text, "name"), word, "warp" if kind == "variants" else kind, kind == "variants",
                                parameters, has_lookup))
    return mappings


def assignments(words):
    return dict(word.split("=", 1) for word in words.split(",") if "=" in word)


def find(specification, catalogue):
    """The mapping that a specification names, and the values of its parameters."""
    wanted = specification.lower()
    for mapping in catalogue:
        fixed = {}
        names = [mapping.identifier]
        for alias in mapping.aliases.split():
            head, _, rest = alias.partition(":") if "=" in alias else (alias, "", "")
            names.append(head)
            if wanted == head:
                fixed = assignments(rest)
        best = max((name for name in names if wanted == name or wanted.startswith(name + ":")), key=len, default=None)
        if best is None or any(other is not mapping and best != wanted and wanted.startswith(other.identifier + ":") and
                               len(other.identifier) > len(best) or other.identifier == wanted and other is not mapping
                               for other in catalogue):
            continue
        rest = wanted[len(best) + 1:]
        presets = dict(preset.split(":", 1) for preset in mapping.presets.split())
        given = {**fixed, **assignments(presets.get(rest, rest))}
        if rest and rest not in presets and "=" not in rest:
            raise Wrong(f"{specification}: {mapping.identifier} has no preset {rest}")
        known = [parameter.name for parameter in mapping.parameters]
        for name in given:
            if name not in known:
                raise Wrong(f"{specification}: {mapping.identifier} has no parameter {name}; it has "
                            f"{', '.join(known) or 'none'}")
        values = []
        for parameter in mapping.parameters:
            try:
                value = float(given.get(parameter.name, parameter.standard))
            except ValueError:
                raise Wrong(f"{specification}: {given[parameter.name]} is no number") from None
            if not parameter.low <= value <= parameter.high:
                raise Wrong(f"{specification}: {parameter.name} is from {parameter.low:g} to {parameter.high:g}")
            values.append(value)
        return mapping, values
    raise Wrong(f"no mapping {specification}; --list lists them")


def literal(value):
    """A number as all the languages write a float that is its nearest."""
    nearest = struct.unpack("f", struct.pack("f", value))[0]
    text = f"{nearest:.9g}"
    return text + ("" if "." in text or "e" in text else ".0") + "f"


def stem(mapping):
    """What the names of a mapping's kernels begin with."""
    return "cm_" + {"azimuthal": "azimuthal_", "square": "square_"}.get(mapping.kind, "") + mapping.word


def macros(mapping):
    """The lines of the dialect that make the functions on the sphere."""
    name = stem(mapping)
    lines = []
    if mapping.kind == "warp":
        lines.append(f"CM_WARP_ON_SPHERE({name}_project, {name}_unproject, {name}_gradients, {name}_forward, "
                     f"{name}_inverse, {name}_jacobian)")
    if mapping.kind == "azimuthal":
        lines.append(f"CM_AZIMUTHAL_SCALE({name}_areal_scale, {name}_radius)")
    if mapping.kind in ("warp", "sphere"):
        lines.append(f"CM_SCALE_ON_SPHERE({name}_areal_scale, {name}_gradients)")
    if mapping.kind == "warp":
        lines.append(f"CM_WARP_LOOKUP({name}_lookup, {name}_lookup_step, {name}_forward, {name}_jacobian)")
    if mapping.kind == "sphere":
        lines.append(f"CM_SPHERE_LOOKUP({name}_lookup, {name}_lookup_step, {name}_project, {name}_gradients)")
    return "\n".join(lines) + "\n"


def constants(mapping, values, function=""):
    """A function without arguments that gives the prepared constants of these parameters."""
    name = stem(mapping)
    if mapping.kind in ("square", "layout"):
        return ""
    lines = [f"    cm_constants k = cm_make_parameters(0.0f, 0.0f);"]
    lines += [f"    k.k{index} = {literal(value)};" for index, value in enumerate(values[:7])]
    return f"{function}cm_constants {name}_constants()\n{{\n" + "\n".join(lines) + f"\n    return {name}_prepare(k);\n}}\n"


def split_items(text):
    """The structs and functions of a flat text: (name, text)."""
    items, depth, begin = [], 0, 0
    for match in re.finditer(r"[{};]", text):
        depth += {"{": 1, "}": -1}.get(match[0], 0)
        piece = text[begin:match.end()].strip()
        is_struct = piece.startswith(("struct", "typedef"))
        if depth == 0 and match[0] == (";" if is_struct else "}"):
            name = re.search(r"struct (\w+)" if is_struct else r"(\w+)\s*\(", piece)[1]
            items.append((name, piece))
            begin = match.end()
    return items


def needed(items, wanted):
    """Those items that the wanted ones use, in their order."""
    uses = {name: set(re.findall(r"\bcm_\w+", text)) for name, text in items}
    seen, waiting = set(), list(wanted)
    while waiting:
        name = waiting.pop()
        if name not in seen:
            seen.add(name)
            waiting += uses[name] & uses.keys()
    return [(name, text) for name, text in items if name in seen]


def layout(text):
    """A function that a macro made, one statement a line."""
    if text.count("\n") > 2 or "{" not in text:
        return text
    lines, depth = [], 0
    for part in re.findall(r"[^{};]*[{};]", text):
        part = " ".join(part.split())
        if part.endswith("{"):
            lines += ["    " * depth + part[:-1].strip(), "    " * depth + "{"]
            depth += 1
        else:
            depth -= part == "}"
            lines.append("    " * depth + part)
    return "\n".join(lines)


def functions_of(mapping):
    """The names that a text offers."""
    name = stem(mapping)
    if mapping.kind == "layout":
        return ["cm_quincuncial_place", "cm_quincuncial_unplace", "cm_quincuncial_jacobian"] \
            if mapping.word == "quincuncial" else []
    if mapping.kind == "square":
        return ["cm_make_disc_point", "cm_jacobian_determinant"] + [f"{name}_{end}" for end in
                                                                     ("forward", "inverse", "jacobian")]
    ends = ["project", "unproject", "gradients", "tangents", "areal_scale"]
    if mapping.kind == "warp":
        ends = ["forward", "inverse", "jacobian", "project", "unproject", "gradients", "areal_scale"]
    names = [f"{name}_{end}" for end in ends]
    if mapping.has_lookup and mapping.kind in ("warp", "sphere"):
        names += [f"{name}_lookup", f"{name}_lookup_step"]
    if mapping.kind == "azimuthal":
        names.append("cm_make_disc_point")
    return names


def vectors(mapping, dialect):
    """The lookups with a language's own vectors."""
    d = DIALECTS[dialect]
    name = stem(mapping)
    if d.vector is None or f"{name}_lookup" not in functions_of(mapping):
        return ""
    function = "static __host__ __device__ __forceinline__ " if dialect == "cuda" else "static inline " if dialect == "metal" else ""
    return f"""{function}{d.vector} {name}_lookup({d.vector} d, cm_constants k)
{{
    cm_xyz m = {name}_lookup(d.x, d.y, d.z, k);
    return {d.make_vector}(m.x, m.y, m.z);
}}
{function}{d.vector} {name}_lookup_step({d.vector} d, {d.vector} by, cm_constants k)
{{
    cm_xyz m = {name}_lookup_step(d.x, d.y, d.z, by.x, by.y, by.z, k);
    return {d.make_vector}(m.x, m.y, m.z);
}}
"""


@functools.lru_cache(maxsize=None)
def kernels_of(dialect):
    """All structs and functions in a dialect."""
    source = '#include "cubemap/kernel/backend.h"\n' + "".join(map(macros, read_catalogue()))
    return split_items(preprocess(source, DIALECTS[dialect].backend))


def flat(dialect, chosen, also=()):
    """The text of mappings and their values, [(mapping, values)], and of kernels besides; the dialect's head goes before
    it."""
    items = kernels_of(dialect)
    wanted = list(also) + [name for mapping, _ in chosen for name in functions_of(mapping)]
    wanted += ["cm_make_parameters"] + [stem(mapping) + "_prepare" for mapping, _ in chosen
                                        if mapping.kind not in ("square", "layout")]
    text = "\n".join(layout(piece) for _, piece in needed(items, wanted)) + "\n"
    function = {"cuda": "static __host__ __device__ __forceinline__ ", "metal": "static inline ",
                "opencl": "static inline "}.get(dialect, "")
    for mapping, values in chosen:
        text += constants(mapping, values, function) + vectors(mapping, dialect)
    return text
