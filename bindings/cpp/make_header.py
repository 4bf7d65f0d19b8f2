#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes bindings/cpp/cubemap.hpp: classes and functions of C++ for all of bindings/functions, inline.

Usage: make_header.py [--check] ROOT

A handle becomes two classes: NAME_view, which does not own it and has its methods, and NAME, which does. Arguments that
say how much there is are taken from spans, and spans that are shorter than the table says are refused; a status becomes an
exception, or stays one in functions that begin with try_.
What is before and behind the generated text stands in head.hpp.in. With --check nothing is written; the exit status is 1
if the header says something else. Without pycparser it is 77.
"""

import pathlib
import re
import sys
import textwrap

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import function_table
import public_headers

KEYWORDS = {"union", "class", "this", "new", "delete"}

# What the words of shapes are that no argument has: (function or None for all, word) -> C++.
KNOWN = {
    ("cm_sample", "channels"): "detail::channels(pictures)",
    ("cm_ssim", "channels"): "detail::channels(&reference)",
    ("cm_environment_project", "channels"): "cm_environment_channels(get())",
    ("cm_depth_clean", "pixels"): "detail::pixels(picture)",
    ("cm_tof_reconstruct", "images"): "detail::phase_images(sensor)",
    **{(name, word): value for name in ("cm_compensate", "cm_compensate_pixelwise")
       for word, value in (("channels", "detail::whole(input.channels)"), ("pixels", "detail::whole(input.width), detail::whole(input.height)"))},
}

# What may be NULL, as the headers say, beside options.
OPTIONAL = {("cm_ssim", "channel_means"), ("cm_flow_warp", "coverage"), ("cm_raster_read", "image"), ("cm_raster_read", "id"),
            ("cm_distortion_percentiles", "doubt"), ("cm_store_next", "after"),
            ("cm_depth_error_sparsify", "error"), ("cm_depth_error_sparsify", "oracle"),
            ("cm_depth_error_temporal", "deviation"),
            *((f"cm_raster_{drawn}", "pose") for drawn in ("triangles", "discs", "points", "weights"))}


# What says in words why nothing was made.
EXPLAINED = {**dict.fromkeys(("cm_mapping_create", "cm_mapping_create_with"), "cm_specification_check(specification, words, size)"),
             "cm_colormap_create": "cm_colormap_check(specification, words, size)",
             "cm_surface_create": "cm_surface_check(specification, options, words, size)"}


class Argument:
    """An argument in C++: how it is declared, "" for what is taken from others, and what C is given for it."""

    def __init__(self, declared, passed, standard=""):
        self.declared, self.passed, self.standard = declared, passed, standard


def wrapped(text, indent):
    """In lines that are not too long."""
    return "\n".join(textwrap.wrap(" ".join(text.split()), 110, initial_indent=indent, break_long_words=False,
                                   subsequent_indent=indent + "    ", break_on_hyphens=False)) + "\n"


class Definition:
    """A function of C++ in its parts."""

    def __init__(self, before, kind, name, listed, body):
        self.before, self.kind, self.name, self.listed, self.body = before, kind, name, listed, body

    def declaration(self):
        return wrapped(f"{self.before}{self.kind}{self.name}{self.listed};", "    ")

    def whole(self, scope):
        """As it stands outside of classes; scope is "" for a function of its own."""
        listed = self.listed.replace(" = nullptr", "") if scope else self.listed
        return wrapped(f"inline {self.kind}{scope}{self.name}{listed} {self.body}", "")


def is_span(given):
    """Is it an array whose length another argument says?"""
    return len(given.shape) >= 1 and given.direction in ("in", "out", "inout") and given.shape[0] not in (
        "text", "call", "pointer") and not re.fullmatch(r"\d+", given.shape[0])


class Writer:
    def __init__(self, table, interface):
        self.table, self.interface = table, interface
        self.methods, self.free, self.made = {}, [], {}
        self.changed = {argument.base for function in interface.functions.values() for argument in function.arguments
                        if argument.base in interface.handles and argument.pointers == 1 and not argument.constant
                        and not function.name.endswith("_destroy")}

    def pointer(self, handle):
        return f"{handle} *" if handle in self.changed else f"const {handle} *"

    def count_of(self, function, name):
        """What says how many: the size of the first span whose shape is this count alone, or None."""
        if not any(given.name == name and given.direction == "count" for given in function.arguments):
            return None
        for given in function.arguments:
            if is_span(given) and given.shape == (name,):
                return f"{given.name}.size()"
        return None

    def is_given_as_span(self, given, declared):
        """Pictures are no spans: how many there are the object knows. Nor are structs of arrays."""
        is_struct = declared.base in self.interface.structs
        return is_span(given) and declared.pointers == 1 and not declared.extents and declared.base != "void" and not (
            is_struct and (given.shape[0] in ("pictures", "planes") or "arrays" in declared.base))

    def factors(self, function, given):
        """What a span's length must not be less than, as factors in C++."""
        found = []
        for extent in given.shape:
            if extent == "sum(ring_length)":
                found.append("detail::sum(ring_length)")
                continue
            if extent == "pixels/4":
                found.append("cm_rays_halved_pixel_count(get())")
                continue
            if extent == "pinhole_pixels":
                found.append("cm_lens_map_pinhole_pixel_count(get())")
                continue
            number, word = re.match(r"(\d*)[*(]*([a-z_]*)", extent).groups()
            value = self.value_of(function, given, word) + (" + 1" if "+1" in extent else "") if word else ""
            found += ([number] if number else []) + ([value] if word else []) * (2 if extent.endswith("^2") else 1)
        return found

    def value_of(self, function, given, word):
        """A word of a shape, in C++."""
        size = self.count_of(function, word)
        if size is not None:
            return size
        if word != "pixels" and any(argument.name == word for argument in function.arguments):
            return f"detail::whole({word})"
        if (function.name, word) in KNOWN:
            return KNOWN[function.name, word]
        handles = [argument for argument in function.arguments[:function.arguments.index(given)] if argument.direction == "handle"]
        of = self.passed(function, handles[-1])
        if word == "nside":
            return f"detail::whole(cm_healpix_nside({of}))"
        declared = self.interface.functions[function.name].arguments[function.arguments.index(handles[-1])]
        return f"{declared.base}_pixel_count({of})"

    def passed(self, function, handle):
        """A handle as C is given it."""
        own = handle is function.arguments[0] and "::" in function.names["cpp"]
        return "get()" if own else f"{handle.name}.get()"

    def lengths(self, function):
        """Are the spans long enough? In C++, "" where there is nothing to ask."""
        conditions, declared = [], self.interface.functions[function.name]
        for given, one in zip(function.arguments, declared.arguments):
            if not self.is_given_as_span(given, one) or self.count_of(function, given.shape[0]) == f"{given.name}.size()" \
                    and len(given.shape) == 1:
                continue
            if any(argument.name == "stride" for argument in function.arguments) and given.name == "xyz":
                condition = f"detail::strides({given.name}.size(), {self.value_of(function, given, 'n')}, stride)"
            else:
                condition = f"detail::holds({given.name}.size(), {', '.join(self.factors(function, given))})"
            if (function.name, given.name) in OPTIONAL:
                condition = f"({given.name}.data() == nullptr || {condition})"
            conditions.append(condition)
        return " && ".join(conditions)

    def argument(self, function, given, declared):
        name, const = given.name, "const " if declared.constant else ""
        if given.direction == "handle":
            return Argument(f"{declared.base[3:]}_view {name}", f"{name}.get()")
        if given.direction == "new":
            return Argument("", "&made_object")
        if given.direction == "count" and declared.pointers == 0:
            size = self.count_of(function, name)
            return Argument(f"{declared.base} {name}", name) if size is None \
                else Argument("", f"static_cast<{declared.base}>({size})" if declared.base != "size_t" else size)
        if declared.base in self.interface.structs and declared.pointers == 1 and given.shape == ():
            if given.direction == "in" and declared.base != "cm_frame" and not declared.base.endswith("viewing") \
                    and (function.name, name) not in OPTIONAL:
                return Argument(f"const {declared.base} &{name}", f"&{name}")
            if given.direction in ("option", "in"):
                return Argument(f"const {declared.base} *{name}", name, " = nullptr")
            return Argument(f"{const}{declared.base} *{name}", name)
        if self.is_given_as_span(given, declared):
            return Argument(f"span<{const}{declared.base}> {name}", f"{name}.data()")
        if declared.extents and not declared.pointers:
            extents = "".join(f"[{extent}]" for extent in declared.extents)
            return Argument(f"{const}{declared.base} (&{name}){extents}", name)
        if declared.extents:
            return Argument(f"{declared.base} *const (&{name})[{declared.extents[0]}]", name)
        return Argument(declared.text, name)

    def parts(self, function):
        declared = self.interface.functions[function.name]
        arguments = [self.argument(function, one, other) for one, other in zip(function.arguments, declared.arguments)]
        own = function.arguments and function.arguments[0].direction == "handle" and "::" in function.names["cpp"]
        if own and declared.arguments[0].base[3:] == function.names["cpp"].split("::")[0]:
            arguments[0] = Argument("", "get()")
        # what has a standard value must not stand before what has none
        listed = [one for one in arguments if one.declared]
        if function.name.endswith("_with"):  # its shorter form is a function of its own
            listed[-1].standard = ""
        for index, one in enumerate(listed):
            if one.standard and any(not other.standard for other in listed[index + 1:]):
                one.standard = ""
        return declared, arguments, ", ".join(one.declared + one.standard for one in listed)

    def result_type(self, declared):
        result = declared.result
        if result is None or result.base == "cm_status":
            return "void"
        if result.base in self.interface.handles:
            return f"{result.base[3:]}_view"
        return f"{'const ' if result.constant else ''}{result.base}{' *' * result.pointers}"

    def write(self, function):
        """A function, and where it belongs."""
        if "cpp" not in function.names:
            return
        name = function.names["cpp"].split("::")
        declared, arguments, listed = self.parts(function)
        call = f"{function.name}({', '.join(one.passed for one in arguments)})"
        lengths = self.lengths(function)
        asked = f"{lengths} ? {call} : CM_ERROR_ARGUMENT" if lengths else call
        made = next((one for one, given in zip(declared.arguments, function.arguments) if given.direction == "new"), None)
        owner = name[0] if len(name) == 2 or made else None
        method = name[-1] + ("_" if name[-1] in KEYWORDS else "")
        is_method = bool(arguments) and arguments[0].passed == "get()"
        after = " const" if is_method else ""
        before = "static " if owner and not is_method else ""
        lines = [f"// {function.name}"]
        if made:
            names = ", ".join(re.search(r"(\w+)\)?(?:\[[^]]*\])*$", one.declared)[1] for one in arguments if one.declared)
            factory = "make" if len(name) == 1 else method
            lines.append(Definition(before, f"result<{owner}> ", f"try_{factory}", f"({listed}){after}", f"""
{{ {made.base} *made_object = nullptr; const cm_status status = {asked};
return status == CM_OK ? result<{owner}>({owner}(made_object)) : result<{owner}>(status); }}"""))
            if len(name) == 1:
                needed = sum(bool(one.declared and not one.standard) for one in arguments)
                words = EXPLAINED.get(function.name)
                explained = f"[&](char *words, std::size_t size) {{ {words}; }}" if words else ""
                lines.append(Definition("explicit " if needed <= 1 else "", "", owner, f"({listed})",
                                        f" : {owner}(try_make({names}).value({explained})) {{}}"))
            else:
                lines.append(Definition(before, f"{owner} ", method, f"({listed}){after}",
                                        f" {{ return try_{method}({names}).value(); }}"))
            self.made.setdefault(owner, []).extend(lines)
            return
        if declared.result is not None and declared.result.base == "cm_status":
            lines.append(Definition(before, "cm_status ", f"try_{method}", f"({listed}){after}", f"{{ return {asked}; }}"))
            lines.append(Definition(before, "void ", method, f"({listed}){after}", f"{{ detail::check({asked}); }}"))
        else:
            kind = self.result_type(declared)
            returned = f"return {kind}({call});" if kind.endswith("_view") else f"{call};" if kind == "void" else f"return {call};"
            needed = f"detail::check({lengths} ? CM_OK : CM_ERROR_ARGUMENT); " if lengths else ""
            lines.append(Definition(before, kind + " ", method, f"({listed}){after}", f"{{ {needed}{returned} }}"))
        if owner:
            self.methods.setdefault(owner, []).extend(lines)
        else:
            self.free.extend(lines)


def generated(root):
    table = function_table.read(root / "bindings" / "functions")
    writer = Writer(table, public_headers.read(root))
    for function in table.functions:
        writer.write(function)
    names = sorted(handle[3:] for handle in writer.interface.handles)
    parts = ["".join(f"class {name}_view;\nclass {name};\n" for name in names)]
    bodies = []
    for name in names:
        pointer = writer.pointer("cm_" + name)
        inside, outside = split(writer.methods.get(name, []), f"{name}_view")
        parts.append(f"""
/* An object cm_{name} that somebody else owns. */
class {name}_view
{{
public:
    explicit {name}_view({pointer}handle) noexcept : handle_(handle) {{}}
    {pointer}get() const noexcept {{ return handle_; }}
{inside}
private:
    {pointer}handle_;
}};
""")
        bodies.append(outside)
        inside, outside = split(writer.made.get(name, []), name)
        parts.append(f"""
/* One of one's own: it can be moved, not copied. */
class {name} : public detail::owner<{name}_view, cm_{name}, cm_{name}_destroy>
{{
public:
    explicit {name}(cm_{name} *handle) noexcept : owner(handle) {{}}
{inside}}};
""")
        bodies.append(outside)
    free = "".join(line + "\n" if isinstance(line, str) else line.whole("") for line in writer.free)
    return "".join(parts) + "\n" + "".join(bodies) + "\n" + free


def split(lines, owner):
    """Declarations for inside a class, and definitions for behind all classes, where all are complete."""
    inside = "".join(f"    {line}\n" if isinstance(line, str) else line.declaration() for line in lines)
    return inside, "".join(line.whole(f"{owner}::") for line in lines if not isinstance(line, str))


def main(arguments):
    check = arguments[:1] == ["--check"]
    arguments = arguments[1:] if check else arguments
    if len(arguments) != 1:
        sys.exit(__doc__.strip())
    root = pathlib.Path(arguments[0]).resolve()
    try:
        text = generated(root)
    except ModuleNotFoundError as error:
        print(f"{error}: Debian has it as python3-pycparser")
        return 77
    whole = (root / "bindings" / "cpp" / "head.hpp.in").read_text(encoding="utf-8").replace("@generated@", text)
    file = root / "bindings" / "cpp" / "cubemap.hpp"
    if not check:
        file.write_text(whole, encoding="utf-8")
        return 0
    is_same = file.exists() and file.read_text(encoding="utf-8") == whole
    print("cubemap.hpp is as bindings/functions has it" if is_same else "bindings/cpp/make_header.py makes cubemap.hpp anew")
    return 0 if is_same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
