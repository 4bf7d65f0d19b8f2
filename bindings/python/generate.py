#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes what of the Python binding follows from the headers and from bindings/functions:

    loops         in C: the functions for many points, as src/core.h describes them
    _library.py   all functions, structs and enumerations of the library for ctypes
    _methods.py   the methods of classes, and the functions, that are ufuncs
    _methods.pyi  their types and what they do

usage: generate.py [--without-sim] ROOT OUTPUT_FOLDER [NAME...]      (only those files)

--without-sim   of a build that has no library cubemap-sim
"""

import pathlib
import re
import sys
import textwrap

from loop_model import NUMBERS, Binding

# what an output is where a function for one point has written nothing
NOTHING = {"double": "NAN", "float": "NAN", "uint8_t": "255", "int": "-1", "int32_t": "-1", "uint32_t": "UINT32_MAX",
           "unsigned": "UINT32_MAX",
           "int64_t": "-1", "uint64_t": "0", "size_t": "0"}
NO_INDEX = {"cm_trajectory_nearest": "SIZE_MAX"}  # where 0 is something
# what the comment of a function in C does not say to users of Python
LEADS = {
    "cm_forward_array": "Directions, of any length, to face, u and v. What is no direction has face 255 and NaN.",
    "cm_inverse_array": "Points of faces to unit directions. A face that is none, or u, v outside [-1, 1], gives NaN.",
    "cm_forward_lonlat_array": "Longitudes and latitudes, radians, to face, u and v.",
    "cm_inverse_lonlat_array": "Points of faces to longitudes and latitudes, radians.",
    "cm_forward_jacobian_array": "d(u, v) / d(x, y, z) at directions scaled to unit length.",
    "cm_inverse_jacobian_array": "d(x, y, z) / d(u, v) of the unit direction.",
    "cm_forward_distortion_array": "Tissot's indicatrix and what follows from it, as Distortion, at directions.",
    "cm_inverse_distortion_array": "Tissot's indicatrix and what follows from it, as Distortion, at points of faces.",
    "cm_warp_array": "The plane part alone: p, q on the gnomonic cube, or in the disc, to u, v.",
    "cm_unwarp_array": "The plane part back: u, v to p, q.",
    "cm_healpix_pixel_from_direction_array": "The pixels at directions of any length; -1 where there is none.",
    "cm_healpix_pixel_from_angles_array": "The pixels at colatitudes theta and longitudes phi, radians; -1 where there is none.",
    "cm_healpix_pixel_from_lonlat_array": "The pixels at longitudes and latitudes, radians; -1 where there is none.",
    "cm_healpix_direction_from_pixel_array": "The unit directions of pixels' centres; NaN of what is no pixel.",
    "cm_healpix_angles_from_pixel_array": "Colatitudes and longitudes of pixels' centres, radians; NaN of what is no pixel.",
    "cm_healpix_lonlat_from_pixel_array": "Longitudes and latitudes of pixels' centres, radians; NaN of what is no pixel.",
    "cm_healpix_nested_from_ring_array": "Numbers in the order RING to those in NESTED; -1 of what is no pixel.",
    "cm_healpix_ring_from_nested_array": "Numbers in the order NESTED to those in RING; -1 of what is no pixel.",
    "cm_latitude_convert_array": "Latitudes, radians, to the other kind of latitude.",
    "cm_latitude_convert_direction_array": "Directions whose latitude is the one kind to those of the other, in the same longitude.",
    "cm_cell_forward_array": "The cells of a level at directions; 0 where there is none.",
    "cm_cell_forward_lonlat_array": "The cells of a level at longitudes and latitudes, radians; 0 where there is none.",
    "cm_direction_from_lonlat_array": "Longitudes and latitudes, radians, to unit directions.",
    "cm_lonlat_from_direction_array": "Directions of any length to longitudes and latitudes, radians.",
    "cm_camera_project_array": "Points of the camera's axes to columns and rows. What the camera does not see has NaN.",
    "cm_camera_ray_array": "Columns and rows to rays of the camera's axes. Where no ray comes from there is NaN.",
    "cm_scene_cast_array": "What rays from origins in directions meet first, as Hit.",
}
# What comments say of pointers and of where arrays may lie, which NumPy sees to.
MEMORY = re.compile(r"(?:(?:" + "|".join((
    r"(?:Arrays|Arrays here and below|pointers|voxel) may be NULL(?: if n is 0)?[.;]", r"No pointer may be NULL\.",
    r": either output may be NULL\.", r"viewing may be NULL: those of sRGB, as above\.",
    r"map must not be NULL here and below\.", r"Not to be given NULL\.", r"to may be from\.",
    r"(?:[Aa]n|the) output(?: array)? may be [^.;]*\binputs?\b(?: array)?(?: in its place, but not overlap it otherwise| \(x and u, say\))?[.;]",
    r"other overlaps are not allowed\.", r"the result may overwrite the argument\.?", r"No alignment beyond the element's own is needed\.",
    r"n points in separate arrays of n elements each\.", r"n at once, n numbers in each array;",
    r"Arrays take six outputs of n elements each, in that order;", r"an input array may be the same as one of them\.",
    r"---- Outputs must not overlap inputs, but for the two last ones, whose pixels may be written over themselves\.",
    r"Those return CM_OK, or CM_ERROR_PIXEL, with nothing written, if nside is no power of two\.",
)) + r")\s*)+")
# outputs of these must not overlap inputs (healpix.h, world.h)
APART = ("cm_healpix_", "cm_scene_")
# what the package makes of the results of functions with several outputs, as its modules say by name_results
RESULTS = {**dict.fromkeys(("cm_forward_distortion_array", "cm_inverse_distortion_array", "cm_grid_forward_distortion",
                            "cm_grid_inverse_distortion"), "mapping.Distortion"),
           **dict.fromkeys(("cm_octree_at", "cm_octree_ray", "cm_octree_nearest"), "octree.Voxels"),
           "cm_colormap_color_at": "colors.Color", "cm_depth_pyramid_bounds": "depth.DepthBounds",
           "cm_motion_at": "trajectory.MotionState", "cm_scene_cast_array": "world.Hit"}
CTYPES = {"double": "c_double", "float": "c_float", "int": "c_int", "unsigned": "c_uint", "char": "c_char", "signed char": "c_byte",
          "uint8_t": "c_uint8", "int32_t": "c_int32", "uint32_t": "c_uint32", "int64_t": "c_int64", "uint64_t": "c_uint64", "size_t": "c_size_t",
          "ptrdiff_t": "c_ssize_t", "uint16_t": "c_uint16", "unsigned int": "c_uint"}


# ---- the loops in C ----

def argument_text(loop, argument, row, operands):
    """What a call of the function is given for an argument: of all points, or of point i."""
    if row.direction == "handle":
        return "context->handle"
    if row.direction == "count":
        return "n"
    if argument.name in loop.options:
        return f"({argument.base})context->option[{loop.options.index(argument.name)}]"
    own = operands_of(argument, operands)
    if own[0].member:
        return ("&" if argument.pointers or loop.arrays else "") + argument.name
    if loop.arrays:
        return f"planes_{argument.name}" if own[0].planar else f"p[{operands.index(own[0])}]"
    if row.direction == "out":
        return f"to_{argument.name}" if own[0].shape else f"&to_{argument.name}"
    if own[0].shape:
        inner = "".join(f"[{extent}]" for extent in argument.extents[1:])
        return f"(const {own[0].base}(*){inner})from_{argument.name}" if inner else f"from_{argument.name}"
    cast = f"({argument.base})" if argument.base != own[0].base else ""
    return f"{cast}*from_{argument.name}"


def operands_of(argument, operands):
    """Those that an argument is, or is made of."""
    return [operand for operand in operands if (operand.member.split(".")[0] or operand.name) == argument.name]


def planes_of(operand, index):
    """The arrays of an operand that has one for each number."""
    return ", ".join(f"({operand.base} *)p[{index}] + {k} * plane" if k else f"p[{index}]"
                     for k in range(operand.items))


def adapter_arrays(loop, operands):
    """The body of a call for a function that takes arrays."""
    lines = []
    for index, operand in enumerate(operands):
        if operand.planar and not operand.member:
            planes = planes_of(operand, index)
            constant = "const " * (index < len(loop.inputs))
            lines.append(f"{constant}{operand.base} *const planes_{operand.name}[{operand.items}] = {{{planes}}};")
    for argument in loop.declared.arguments:
        own = [operand for operand in operands_of(argument, operands) if operand.member]
        if own:
            size = f"sizeof({argument.base}), " * (argument.name in loop.sized)
            places = [(one, operands.index(one)) for one in own]
            pointers = ", ".join(f"{{{planes_of(one, index)}}}" if one.planar else f"p[{index}]" for one, index in places)
            lines.append(f"const {argument.base} {argument.name} = {{{size}{pointers}}};")
    call = call_text(loop, operands)
    returns = loop.function.result is not None
    return lines + ([f"return {call};"] if returns else [f"{call};", "return CM_OK;"])


def call_text(loop, operands):
    words = [argument_text(loop, argument, row, operands)
             for argument, row in zip(loop.declared.arguments, loop.function.arguments, strict=True)]
    return f"{loop.function.name}({', '.join(words)})"


def read_lines(operand, argument, place, index):
    """How an input of point i gets where the function takes it."""
    first = f"(const {operand.base} *)p[{index}]"
    if operand.member:
        return ["    " + copy_text("&" * (not operand.shape) + place, f"({first})[{operand.items} * i]", operand)]
    return [f"    const {operand.base} *from_{argument.name} = {first} + {operand.items} * i;"]


def written_lines(loop, operand, argument, place):
    """What is there for an output of a point: nothing yet."""
    lines = []
    if not operand.member:
        declared = argument.base if argument.base in loop_enumerations else operand.base
        extents = argument.extents if operand.shape else ()
        lines.append(f"    {declared} {place}{''.join(f'[{extent}]' for extent in extents)};")
    return lines + nothing_lines(loop, place, operand)


def point_lines(loop, operands):
    """What stands before the call for one point, what copies the outputs after it, and which numbers are too large."""
    lines, copies, wide = [], [], []
    for argument, row in zip(loop.declared.arguments, loop.function.arguments, strict=True):
        own = operands_of(argument, operands) if row.direction != "handle" else []
        if own and own[0].member:
            lines.append(f"    {argument.base} {argument.name};")
            lines += [f"    {argument.name}.size = sizeof {argument.name};"] * (argument.name in loop.sized)
        for operand in own:
            index, place = operands.index(operand), operand.member or f"to_{argument.name}"
            if row.direction in ("out", "inout"):
                lines += written_lines(loop, operand, argument, place)
                copies.append(copy_text(f"({operand.base} *)p[{index}] + {operand.items} * i", place, operand))
            else:
                lines += read_lines(operand, argument, place, index)
                wide += [f"*from_{argument.name} > UINT32_MAX"] * operand.narrow
    return lines, copies, wide


def adapter_points(loop, operands):
    """The body of a call for a function that takes one point."""
    lines, copies, wide = point_lines(loop, operands)
    call, result = call_text(loop, operands), ""
    if operands[-1].name == "result":
        result = f"(({operands[-1].base} *)p[{len(operands) - 1}])[i]"
        call = f"{result} = {call}"
    elif loop.function.result is not None:
        call = f"(void){call}"
    if wide:
        nothing = [f"{result} = {NOTHING[operands[-1].base]};"] if result else copies
        lines += [f"    if ({' || '.join(wide)})", "    {", *(f"        {line}" for line in nothing),
                  "        continue;", "    }"]
    lines += [f"    {line}" for line in (f"{call};", *copies)]
    return ["for (size_t i = 0; i < n; i++)", "{", *lines, "}", "return CM_OK;"]


loop_enumerations = set()


def copy_text(to, source, operand):
    """A member is read whole, so that its address is that of its first number."""
    return f"memcpy({to}, &{source}, {operand.items} * sizeof({operand.base}));"


def nothing_lines(loop, name, operand):
    nothing = NO_INDEX.get(loop.function.name, NOTHING[operand.base])
    if not operand.shape:
        return [f"    {name} = {nothing};"]
    return [f"    for (size_t k = 0; k < {operand.items}; k++)", "    {",
            f"        (({operand.base} *){name})[k] = {nothing};", "    }"]


def shape_text(shape):
    return "(" + ",".join(str(extent) for extent in shape) + ")"


def signature_of(loop):
    if all(not operand.shape for operand in loop.inputs + loop.outputs):
        return "NULL"
    sides = [",".join(shape_text(operand.shape) for operand in side) for side in (loop.inputs, loop.outputs)]
    return f'"{sides[0]}->{sides[1]}"'


def call_line(name, loop):
    inputs = ", ".join(operand.shown for operand in loop.inputs)
    outputs = ", ".join(operand.name for operand in loop.outputs)
    return f"{name.split('.')[-1]}({inputs}, /, out=None, *, where=True, ...) -> {outputs}"


def told_in_python(comment):
    """A comment of C without what it says of memory: clauses that stay are sentences."""
    kept, begin = "", 0
    for found in MEMORY.finditer(comment):
        kept += comment[begin:found.start()]
        begin = found.end()
        if kept.rstrip().endswith(";"):
            kept = kept.rstrip()[:-1] + ". "
        elif kept and not kept.rstrip().endswith((".", ":")):
            kept = kept.rstrip() + ". "
        if found.group().rstrip().endswith(";"):
            comment = comment[:begin] + comment[begin:begin + 1].upper() + comment[begin + 1:]
    return (kept + comment[begin:]).strip()


def doc_of(name, loop):
    comment = told_in_python(" ".join((loop.declared.comment or "").split()))
    shapes = [f"{operand.name} {shape_text(operand.shape)}" for operand in loop.inputs + loop.outputs if operand.shape]
    more = f"\n\nTrailing axes: {', '.join(shapes)}." if shapes else ""
    if any(operand.base == "float" for operand in loop.inputs):
        more += "\n\nThere is single precision alone: what NumPy turns into float64 is rounded to float32."
    lead = LEADS.get(loop.function.name)
    said = [lead, *[""] * bool(comment)] if lead else [] if comment else ["See the header."]
    return "\n".join([call_line(name, loop), "", *said, *textwrap.wrap(comment, 100)]) + more + \
        f"\n\nIn C: {loop.function.name}, cubemap/{loop.declared.header}."


def c_text(text):
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return "\n".join(f'    "{line}\\n"' for line in escaped.splitlines())


def write_loops(binding):
    lines = ["/* Written by bindings/python/generate.py. */", '#include "core.h"', "", "#include <math.h>", "#include <string.h>", "",
             "#include <cubemap/colormap.h>", "#include <cubemap/compare.h>", "#include <cubemap/environment.h>",
             "#include <cubemap/image.h>", "#include <cubemap/mips.h>", "#include <cubemap/panorama.h>",
             "#include <cubemap/octree.h>", "#include <cubemap/scene.h>",
             # without the library for the sizes of structs alone
             "#include <cubemap/compensate.h>", "#include <cubemap/depth_error.h>", "#include <cubemap/lens.h>",
             "#include <cubemap/sim.h>", "#include <cubemap/texel.h>", ""]
    loop_enumerations.update(binding.interface.enumerations)
    rows = []
    for name, loops in binding.loops.items():
        double = loops["double"]
        variants = []
        for precision in ("float", "double"):
            if precision not in loops:
                continue
            loop = loops[precision]
            operands = loop.inputs + loop.outputs
            c_name = loop.function.name
            body = adapter_arrays(loop, operands) if loop.arrays else adapter_points(loop, operands)
            text = "\n".join(body)
            unused = [f"    (void){word};" for word in ("context", "plane") if not re.search(rf"\b{word}\b", text)]
            lines += [f"static cm_status call_{c_name}(const struct core_context *context, size_t n, void *const *p, size_t plane)",
                      "{", *unused, *(f"    {line}" for line in body), "}", ""]
            cells = ", ".join(f"{{{NUMBERS[operand.base][0]}, {int(operand.planar)}, {operand.items}}}" for operand in operands)
            lines += [f"static const struct core_variant variant_{c_name} = {{call_{c_name}, {{{cells}}}}};", ""]
            variants.append(f"&variant_{c_name}")
        c_name = double.function.name
        rows.append(f'    {{"{c_name}", "{name.split(".")[-1]}", {signature_of(double)},\n{c_text(doc_of(name, double))},\n'
                    f"     {len(double.inputs)}, {len(double.outputs)}, {len(double.options)}, {int(not c_name.startswith(APART))}, "
                    f"{len(variants)}, {{{', '.join(variants)}}}}},")
    lines += ["const struct core_function core_functions[] = {", *rows, "    {NULL, NULL, NULL, NULL, 0, 0, 0, 0, 0, {NULL}},", "};", ""]
    destroyers = [function.name for function in binding.table.functions
                  if any(argument.direction == "free" for argument in function.arguments)]
    for name in destroyers:
        base = binding.interface.functions[name].arguments[0].base
        lines += [f"static void end_{name}(void *object)", "{", f"    {name}(({base} *)object);", "}", ""]
    lines += ["const struct core_destroyer core_destroyers[] = {", *(f'    {{"{name}", end_{name}}},' for name in destroyers),
              "    {NULL, NULL},", "};", "", "const struct core_size core_sizes[] = {",
              *(f'    {{"{name}", sizeof({name})}},' for name in binding.interface.structs), "    {NULL, 0},", "};", ""]
    return "\n".join(lines)


# ---- _library.py ----

def c_type(binding, item, known):
    """The type of ctypes of an argument, a result or a member."""
    if item.base in CTYPES:
        base = CTYPES[item.base]
    elif item.base in binding.interface.enumerations:
        base = "c_int"
    elif item.base == "cm_cell":
        base = "c_uint64"
    elif item.base in binding.interface.structs and item.base in known:
        base = item.base
    else:
        base = "c_void_p"  # a function of the caller
    if item.base == "char" and item.pointers == 1 and item.constant:
        base = "c_char_p"
    elif item.pointers:
        base = f"POINTER({base})" if base in binding.interface.structs and item.pointers == 1 else "c_void_p"
    for extent in reversed(item.extents):
        base = f"({base} * {extent})"
    return base


# of whole numbers, from the least to the most; numbers of cells may be signed ones of the same 64 bits, as which databases have them
RANGES = {"c_uint8": "0, 2**8 - 1", "c_uint16": "0, 2**16 - 1", "c_uint32": "0, 2**32 - 1", "c_uint": "0, 2**32 - 1",
          "c_int": "-2**31, 2**31 - 1", "c_int64": "-2**63, 2**63 - 1", "c_uint64": "-2**63, 2**64 - 1", "c_size_t": "0, 2**64 - 1"}


def write_library(binding):
    lines = ["# Written by bindings/python/generate.py.", '"""The library for ctypes: what is called once and not for every point."""', "",
             "# ruff: noqa", "import ctypes", "from ctypes import *  # noqa: F403", "", "from ._errors import check",
             "from ._numbers import Structure, function, library as _library", ""]
    known = set()
    for name, members in binding.interface.structs.items():
        lines += [f"class {name}(Structure):", "    _fields_ = ["]
        lines += [f'        ("{member.name}", {c_type(binding, member, known)}),' for member in members]
        lines += ["    ]", "", ""]
        known.add(name)
    for name, values in binding.interface.enumerations.items():
        lines += [f"{constant} = {value}" for constant, value in values.items()]
    lines += ["", f"HAS_SIM = {binding.has_sim}", ""]
    for function in binding.table.functions:
        declared = binding.interface.functions[function.name]
        # arrays in arguments are pointers
        words = [c_type(binding, argument, known) if not argument.extents else "c_void_p" for argument in declared.arguments]
        result = c_type(binding, declared.result, known) if declared.result else "None"
        whole = [f", ({place}, {argument.name!r}, {RANGES[word]})" for place, (word, argument) in enumerate(zip(words, declared.arguments, strict=True))
                 if word in RANGES]
        names = " ".join(argument.name for argument in declared.arguments)
        lines += [f"{function.name} = function({function.name!r}, {names!r}{''.join(whole)})", f"{function.name}.argtypes = [{', '.join(words)}]",
                  f"{function.name}.restype = {result}"]
        if function.result and function.result.direction == "status":
            lines += [f"{function.name}.errcheck = check"]
    return "\n".join(lines) + "\n"


# ---- _methods.py and its types ----

def groups(binding):
    """{class, module, or "" for functions of the package: {method: loops}}; what has options is the class's own."""
    found = {}
    for name, loops in binding.loops.items():
        owner, _, method = name.rpartition(".")
        owner = owner.rpartition(".")[2]
        if not loops["double"].options and (is_class(owner) or not loops["double"].handle):
            found.setdefault(owner, {})[method] = loops
    return found


def is_class(owner):
    return owner[:1].isupper()


def write_methods(binding):
    lines = ["# Written by bindings/python/generate.py.", '"""The methods and functions that are ufuncs."""', "", "from ._method import Method, function", ""]
    lines += [f"__all__ = {sorted(groups(binding).get('', {}))!r}", ""]
    for owner, methods in groups(binding).items():
        if is_class(owner):
            lines += ["", f"class {owner}Methods:"]
            lines += [f'    {method} = Method("{loops["double"].function.name}")' for method, loops in methods.items()]
            lines += [""]
        else:
            lines += ["", *(f'{method} = function("{loops["double"].function.name}")' for method, loops in methods.items()), ""]
    return "\n".join(lines) + "\n"


def array_type(operand, loops):
    """Of an output for arrays: real numbers are of the inputs' precision where there are loops of both."""
    kind = NUMBERS[operand.base][1]
    return f"NDArray[np.{'floating[Any]' if kind == 'float64' and 'float' in loops else kind}]"


def number_type(operand):
    """Of a single number."""
    return "float" if operand.base in ("double", "float") else "int"


def result_type(loop, types):
    """Of all outputs: a class of the package's, one type, or a tuple of them."""
    if loop.function.name in RESULTS:
        return RESULTS[loop.function.name].partition(".")[2]
    return types[0] if len(types) == 1 else f"tuple[{', '.join(types)}]"


def stub(method, loops, is_method):
    """Types of a ufunc: of numbers, which give numbers, and of all else."""
    loop, indent = loops["double"], "    " * is_method
    arrays = [array_type(operand, loops) for operand in loop.outputs]
    alone = [array if operand.shape else number_type(operand) for operand, array in zip(loop.outputs, arrays, strict=True)]
    result, result_alone = result_type(loop, arrays), result_type(loop, alone)
    # names before / are never said: those of the rest are not among them
    outputs = "outputs" + "_" * any(operand.shown == "outputs" for operand in loop.inputs)

    def declared(types, more, result):
        inputs = ["self"] * is_method + [f"{operand.shown}: {one}" for operand, one in zip(loop.inputs, types, strict=True)]
        return f"{indent}def {method}({', '.join([*inputs, '/', *more])}) -> {result}:"

    lines = []
    if result_alone != result and not any(operand.shape for operand in loop.inputs):
        numbers = declared(map(number_type, loop.inputs), (), result_alone)
        lines += [f"{indent}@overload", f"{numbers} ...  # type: ignore", f"{indent}@overload"]
    doc = textwrap.indent(doc_of(method, loop).replace("\\", "\\\\"), indent + "    ").strip()
    general = declared(["ArrayLike"] * len(loop.inputs), (f"*{outputs}: Any", "**keywords: Any"), result)
    return [*lines, general, f'{indent}    """{doc}', f'{indent}    """', f"{indent}    ..."]


def write_stubs(binding):
    lines = ["# Written by bindings/python/generate.py.", "from typing import Any, overload", "", "import numpy as np",
             "from numpy.typing import ArrayLike, NDArray", "", f"__all__ = {sorted(groups(binding).get('', {}))!r}", ""]
    bound = {loops["double"].function.name for methods in groups(binding).values() for loops in methods.values()}
    lines += [f"from .{module} import {name}" for module, _, name in
              sorted({RESULTS[function].partition(".") for function in bound & set(RESULTS)})]
    lines += [""]
    for owner, methods in groups(binding).items():
        lines += [f"class {owner}Methods:"] * is_class(owner)
        for method, loops in methods.items():
            lines += stub(method, loops, is_class(owner))
        lines += [""]
    return "\n".join(lines) + "\n"


FILES = {"loops.c": write_loops, "_library.py": write_library, "_methods.py": write_methods, "_methods.pyi": write_stubs}


def main():
    words = [word for word in sys.argv[1:] if word != "--without-sim"]
    if len(words) < 2:
        sys.exit(__doc__)
    binding = Binding(pathlib.Path(words[0]), has_sim="--without-sim" not in sys.argv)
    folder = pathlib.Path(words[1])
    for name in words[2:] or FILES:
        (folder / name).write_text(FILES[name](binding), encoding="utf-8")


if __name__ == "__main__":
    main()
