# SPDX-License-Identifier: MIT
"""JavaScript around the functions of a module: one function for all that have its name in the list.

Of functions for points and for arrays those for arrays are called, which have the same bits; numbers are arrays of one.
What a function writes is its result: one value, or an object of all by their names. Structs are objects with the members'
names in camel case, enumerators texts."""

import re

from layouts import SCALARS
from special_cases import (BY_HAND, CHECKS, COUNTED, EXTENTS, FEWER, FINDERS, FINDERS_ERRORS, METHODS, NEEDS, NULLABLE, REQUIRED, RESULTS, SEEKERS,
                           TELLERS)

KINDS = {"double": "F64", "float": "F32", "uint8_t": "U8", "uint32_t": "U32", "size_t": "U32", "int64_t": "I64",
         "uint64_t": "U64", "cm_cell": "U64"}
BIG = {"int64_t", "uint64_t", "cm_cell"}
OF_PIXELS = {("pixels",): "this.pixelCount", ("pixels/4",): "this.halvedPixelCount"}  # images of what an object is made for
ROOMS = ("capacity", "room")  # how much there is room for: as much as the function says
PREDICATE = re.compile(r"^(is|has|contains|intersects)|(Is|Has|Contains|Intersects)[A-Z]|(Contains|Intersects)$")


def camel(name):
    first, *rest = name.split("_")
    return first + "".join(part.capitalize() for part in rest)


def enumerators(values):
    """{"exact": 0}: without what all names begin with."""
    names = list(values)
    parts = [name.split("_") for name in names]
    same = 0
    while all(len(part) > same + 1 and part[same] == parts[0][same] for part in parts):
        same += 1
    return {"-".join(part[same:]).lower(): values[name] for part, name in zip(parts, names)}


def number_text(base, value, name):
    """JavaScript for a number as the library has it."""
    if base in BIG:
        return f"big({value}, \"{name}\", {'true' if base == 'int64_t' else 'false'})"
    size, viewed = SCALARS[base]
    if viewed.startswith("Float"):
        return f"number({value}, \"{name}\")"
    bits = 8 * size
    least, most = (0, 2**bits - 1) if viewed.startswith("Uint") else (-2**(bits - 1), 2**(bits - 1) - 1)
    return f"whole({value}, \"{name}\", {least}, {most})"


class Argument:
    """What the list and the header say of one argument."""

    def __init__(self, listed, declared):
        self.name, self.direction, self.shape, self.is_text = camel(listed.name), listed.direction, listed.shape, listed.is_text
        self.base, self.constant, self.pointers, self.extents = declared.base, declared.constant, declared.pointers, declared.extents
        self.kind = KINDS.get(declared.base)
        self.is_nullable = self.is_required = False
        if declared.base in RESULTS:
            self.direction = "out"

    @property
    def is_input(self):
        return self.direction in ("in", "inout", "handle", "option")

    @property
    def is_output(self):
        return self.direction in ("out", "inout", "new")

    @property
    def is_hidden(self):
        """One thread is all there is."""
        return self.name == "threads" or self.base == "cm_pool"

    @property
    def is_of_pixels(self):
        return self.shape in OF_PIXELS

    def length(self):
        """Of its arrays, as JavaScript."""
        if not self.shape:
            return "1"
        if self.is_of_pixels:
            return OF_PIXELS[self.shape]
        return " * ".join(f"({re.sub(r'[a-z_]+', lambda m: camel(m.group()), part)})" for part in self.shape)


class Call:
    """One C function."""

    def __init__(self, listed, interface):
        declared = interface.functions[listed.name]
        self.name, self.comment = listed.name, declared.comment
        self.arguments = [Argument(one, other) for one, other in zip(listed.arguments, declared.arguments)]
        self.result = Argument(listed.result, declared.result) if listed.result else None
        for one in self.arguments:
            one.is_nullable = (self.name, one.name) in NULLABLE
            one.is_required = (self.name, one.name) in REQUIRED
        self.js = listed.names["js"]
        self.has_arrays = any(one.shape == ("n",) or (len(one.shape) == 2 and one.shape[1] == "n") for one in self.arguments)
        self.is_float = self.name.endswith("_f32")

    @property
    def throws(self):
        return self.result is not None and self.result.direction == "status"

    @property
    def message(self):
        return next((one for one in self.arguments if one.name == "message"), None)

    def handle(self):
        """The object whose method this is."""
        first = self.arguments[0] if self.arguments else None
        is_method = "." in self.js and first is not None and first.direction == "handle"
        return first if is_method and not any(one.direction == "new" for one in self.arguments) else None

    @property
    def is_method(self):
        return self.handle() is not None or self.name in METHODS

    @property
    def room(self):
        return next((one for one in self.arguments if one.direction == "count" and one.name in ROOMS), None)

    @property
    def tells(self):
        """Does it return or write anything but its status, and is no making of an object?"""
        is_told = (self.result is not None and not self.throws) or any(one.is_output for one in self.arguments)
        return is_told and self.name not in METHODS

    def needs(self):
        """Statements in a method after the call."""
        return [f"needs(this, {', '.join(NEEDS[self.name])});"] if self.name in NEEDS else []


class Writer:
    def __init__(self, listed, interface, layouts):
        self.interface, self.layouts = interface, layouts
        self.called = {"malloc", "free", "cm_status_text"}
        self.written, self.read, self.laid = set(), set(), set()  # structs
        self.frees = {one.arguments[0].name: one.name for one in listed if one.arguments and one.arguments[0].direction == "free"}
        self.destructors = {interface.functions[one.name].arguments[0].base: one.name
                            for one in listed if one.arguments and one.arguments[0].direction == "free"}
        self.groups = {}
        for one in listed:
            if "js" in one.names:
                call = Call(one, interface)
                self.groups.setdefault(call.js, []).append(call)
        self.classes = {}  # {"Mapping": {"forward": [Call, ...]}}; "" for functions
        self.handle_classes = {}  # {"cm_mapping": "Mapping"}
        for name, calls in self.groups.items():
            owner, _, method = name.rpartition(".")
            made = next((arg.base for call in calls for arg in call.arguments if arg.direction == "new"), None)
            if not owner and made is not None:
                owner, method = name, "constructor"
            if made is not None:
                self.handle_classes.setdefault(made, owner)
            self.classes.setdefault(owner, {})[method] = self.best(calls)
        self.body = self.classes_text()

    def best(self, calls):
        """Those to call: for arrays if there are any, else for doubles; of two that make an object the one with options."""
        arrays = [call for call in calls if call.has_arrays]
        if arrays:
            return arrays
        exact = [call for call in calls if not call.is_float]
        return [max(exact, key=lambda call: len(call.arguments))]

    def call(self, name):
        self.called.add(name)
        return f"X.{name}"

    # ---- Structs

    def structs_used(self):
        return self.written | self.read | self.laid

    def write_struct(self, name):
        self.written.add(name)
        return f"write_{name}"

    def read_struct(self, name):
        self.read.add(name)
        return f"read_{name}"

    def enum_table(self, base):
        return "E_" + base

    def put(self, member, value, offset):
        """Statements that put one element of a member from a JavaScript value; None of what JavaScript does not give."""
        if member.base == "cm_memory":
            return None
        if member.base == "cm_image":
            return f"picture({value}, p + {offset}, \"{camel(member.name)}\");"
        if member.pointers:
            if member.extents is not None:
                if member.base in self.interface.structs:
                    size = self.layouts.of(member.base).size
                    return (f"const q = M.zeros({size} * {value}.length); M.data.setUint32(p + {offset}, q, true); "
                            f"Array.from({value}, (one, i) => {{ {self.write_struct(member.base)}(present(one, \"{camel(member.name)}\"), q + {size} * i); }});")
                kind = KINDS[member.base]
                return (f"const q = M.input({kind}, {value}, {self.extent(member)}, \"{camel(member.name)}\"); "
                        f"M.data.setUint32(p + {offset}, q, true);")
            if member.base in self.handle_classes:
                return (f"M.data.setUint32(p + {offset}, pointerOf({value}, {self.handle_classes[member.base]}, "
                        f"\"{camel(member.name)}\"), true);")
            if member.base == "char":
                return f"const q = M.text({value}, \"{camel(member.name)}\"); M.data.setUint32(p + {offset}, q, true);"
            if member.base in self.interface.structs:
                return f"const q = {self.write_struct(member.base)}({value}); M.data.setUint32(p + {offset}, q, true);"
            if member.base in self.interface.enumerations:
                return (f"const q = M.zeros(4); M.data.setInt32(q, code({self.enum_table(member.base)}, "
                        f"{value}, \"{camel(member.name)}\"), true); M.data.setUint32(p + {offset}, q, true);")
            return None
        if member.words or member.base in self.interface.enumerations:
            table = self.enum_table(member.words or member.base)
            return f"M.data.setInt32(p + {offset}, code({table}, {value}, \"{camel(member.name)}\"), true);"
        if member.base in SCALARS:
            return f"M.data.set{SCALARS[member.base][1]}(p + {offset}, {number_text(member.base, value, camel(member.name))}, true);"
        return f"{self.write_struct(member.base)}({value}, p + {offset});"

    @staticmethod
    def extent(member):
        """How many elements an array has that a struct points to, as JavaScript."""
        return member.extents if isinstance(member.extents, str) else f"{camel(member.extents[0])} * {member.extents[1]}"

    def counts_text(self, layout):
        """Counts that follow from the arrays, which are all to say the same (M.input); the first that is there says it."""
        lines = []
        for counter in dict.fromkeys(one.extents[0] for one in layout.members if isinstance(one.extents, tuple)):
            arrays = [one for one in layout.members if isinstance(one.extents, tuple) and one.extents[0] == counter]
            name, other = camel(counter), COUNTED.get((layout.name, counter), "0")
            pairs = ", ".join(f"[o.{camel(one.name)}{'?.[0]' if one.is_array else ''}, {one.extents[1]}]" for one in arrays)
            offset = next(one.offset for one in layout.members if one.name == counter)
            lines += [f"const {name} = rows([{pairs}], o.{name}, \"{name}\") ?? {other};",
                      f"M.data.setUint32(p + {offset}, {name}, true);"]
        return lines

    def is_counter(self, layout, member):
        return any(isinstance(one.extents, tuple) and one.extents[0] == member.name for one in layout.members)

    def given(self, layout):
        """The members that JavaScript gives."""
        return [one for one in layout.members if one.name != "size" and self.put(one, "value", "0") is not None]

    def writer_text(self, name):
        layout = self.layouts.of(name)
        lines = [f"function write_{name}(o, to) {{"]
        if name in FINDERS:
            lines += [f"if (typeof o === \"string\") {{ const p = {self.call(FINDERS[name])}(M.text(o)); "
                      f"if (p === 0) {{ throw errorOf({FINDERS_ERRORS[name]}, `there is no {name[3:]} '${{o}}'`); }} return p; }}"]
        lines += ["if (o === undefined || o === null) { return 0; }",
                  f"object(o, {sorted(camel(one.name) for one in self.given(layout))!r}, \"{camel(name[3:])}\");",
                  f"const p = to ?? M.zeros({layout.size});", *self.counts_text(layout)]
        for member in layout.members:
            if member.name == "size" and member.base == "size_t":
                lines.append(f"M.data.setUint32(p + {member.offset}, {layout.size}, true);")
                continue
            if self.is_counter(layout, member):
                continue
            value = f"o.{camel(member.name)}"
            if member.is_array:
                put = self.put(member, "value", f"{member.offset} + {member.size} * i")
                if put is not None:
                    parts = "arrays" if member.pointers else "elements"
                    fewer = ", true" if (name, member.name) in FEWER else ""
                    lines.append(f"if ({value} !== undefined) {{ {parts}({value}, {member.count}, \"{camel(member.name)}\"{fewer}).forEach((value, i) => {{ {put} }}); }}")
            else:
                put = self.put(member, value, member.offset)
                if put is not None:
                    there = "!= null" if member.pointers or member.base == "cm_image" else "!== undefined"
                    lines.append(f"if ({value} {there}) {{ {put} }}")
        return "\n".join([*lines, "return p;", "}"])

    def get(self, member, offset):
        if member.words:
            return f"word({self.enum_table(member.words)}, M.data.get{SCALARS[member.base][1]}(p + {offset}, true))"
        if member.pointers and isinstance(member.extents, tuple) and member.base in self.interface.structs:
            length, place = f"M.data.getUint32(p + {member.counter}, true)", f"M.data.getUint32(p + {offset}, true)"
            return (f"Array.from({{ length: {length} }}, "
                    f"(_, i) => {self.read_struct(member.base)}({place} + {self.layouts.of(member.base).size} * i))")
        if member.pointers and isinstance(member.extents, tuple):
            count = f"M.data.getUint32(p + {member.counter}, true) * {member.extents[1]}"
            return f"M.copy({KINDS[member.base]}, M.data.getUint32(p + {offset}, true), {count})"
        if member.pointers:
            return f"M.string(M.data.getUint32(p + {offset}, true))" if member.base == "char" else None
        if member.base in self.interface.enumerations:
            return f"word({self.enum_table(member.base)}, M.data.getInt32(p + {offset}, true))"
        if member.base in SCALARS:
            return f"M.data.get{SCALARS[member.base][1]}(p + {offset}, true)"
        return f"{self.read_struct(member.base)}(p + {offset})"

    def reader_text(self, name):
        parts = []
        for member in self.layouts.of(name).members:
            if member.name == "size" and member.base == "size_t":
                continue
            if member.is_array:
                count = next((f"M.data.getUint32(p + {one.offset}, true)" for one in self.layouts.of(name).members
                              if one.name == f"{member.name}_count"), str(member.count))
                value = self.get(member, f"{member.offset} + {member.size} * i")
                value = value and f"Array.from({{ length: {count} }}, (_, i) => {value})"
            else:
                value = self.get(member, member.offset)
            if value is not None:
                parts.append(f"    {camel(member.name)}: {value},")
        return "\n".join([f"function read_{name}(p) {{", "if (p === 0) { return null; }", "return {", *parts, "};", "}"])

    # ---- Calls

    def own_pointer(self, call):
        """Of the object whose method this is."""
        handle = call.handle()
        return f'{"pointerOf" if handle.constant else "pointerToChange"}(this, {self.handle_classes[handle.base]}, "this")'

    def is_optional(self, argument):
        """May it be left out? Zero stands for it then."""
        is_struct = argument.base in self.interface.structs
        return not argument.is_required and (argument.is_nullable or argument.name in ("frame", "instructions") or
                                             argument.direction == "option" and not argument.shape and is_struct)

    def input(self, argument, n):
        """JavaScript for what is passed."""
        name, base = argument.name, argument.base
        if argument.is_hidden:
            return "1" if argument.name == "threads" else "0"
        if argument.direction == "handle":
            return f"pointerOf({name}, {self.handle_classes[base]}, \"{name}\")"
        value = name if self.is_optional(argument) else f"present({name}, \"{name}\")"
        if argument.is_text:
            return f"M.text({value}, \"{name}\")"
        if base in self.interface.structs and not argument.kind:
            return f"{self.write_struct(base)}({value})"
        if base in self.interface.enumerations and argument.pointers == 0:
            return f"code({self.enum_table(base)}, {value}, \"{name}\")"
        if argument.pointers or argument.extents:
            length = n if argument.shape == ("n",) else argument.length()
            return f"M.input({argument.kind}, {name}, {length}, \"{name}\")"
        return number_text(base, value, name)

    def plain(self, argument, pointer):
        """What one value at a pointer is."""
        if argument.base in self.interface.structs:
            return f"{self.read_struct(argument.base)}({pointer})"
        if argument.base in self.interface.enumerations:
            return f"word({self.enum_table(argument.base)}, M.data.getInt32({pointer}, true))"
        return f"M.data.get{SCALARS[argument.base][1]}({pointer}, true)"

    def returned(self, argument, method):
        """What the function's own result is, r."""
        base = argument.base
        if argument.is_text or (base == "char" and argument.pointers):
            return "M.string(r)"
        if argument.direction == "borrowed" or argument.pointers:
            if base in self.interface.structs:
                return f"{self.read_struct(base)}(r)"
            return f"borrowed({self.handle_classes[base]}, r, this)"
        if base in self.interface.enumerations:
            return f"word({self.enum_table(base)}, r)"
        if base == "int" and PREDICATE.search(method):
            return "r !== 0"
        if base in ("uint64_t", "cm_cell"):
            return "BigInt.asUintN(64, r)"
        return "r >>> 0" if base in ("size_t", "uint32_t", "unsigned", "uint64_t") else "r"

    def parameters(self, call):
        """Of the JavaScript function, in order, without the object itself."""
        inputs = [one for one in call.arguments if one.is_input and one is not call.handle() and not one.is_hidden]
        shapes = " ".join(" ".join(one.shape) for one in inputs)
        room = [one for one in call.arguments if one.direction == "count" and not re.search(rf"\b{one.name}\b", shapes)
                and one.name not in ("n", *ROOMS, "messageSize", "size", "length")]
        if call.message is None and any(one.name == "size" for one in call.arguments if one.direction == "count"):
            texts = [one for one in call.arguments if one.is_text and one.is_output]
            room += [one for one in call.arguments if one.name == "size" and not texts]
        return inputs, room

    def function(self, method, calls):
        call = calls[0]
        if call.name in BY_HAND:
            for one in calls:
                self.called.add(one.name)
            return self.by_hand(call)
        return self.over_arrays(method, calls) if call.has_arrays else self.once(method, call)

    def by_hand(self, call):
        names, _, needed = BY_HAND[call.name]
        for one in needed:
            if one.startswith("<"):
                self.read_struct(one[1:])
            elif one.startswith("@"):
                self.laid.add(one[1:])
            elif one in self.interface.structs:
                self.write_struct(one)
            else:
                self.called.add(one)
        rest = f", {names}" if names else ""
        owner, _, _ = call.js.rpartition(".")
        own = f'own, ownToChange: () => pointerToChange(this, {owner}, "this"), whileRead: (read) => whileRead(this, {owner}, read), '
        lines = [f'const own = () => pointerOf(this, {owner}, "this");', "own();"] if call.is_method else []
        return names, "\n".join([*lines, f"return byHand.{call.name}({{ X, M, check, number, pointerOf, owned, code, {own if lines else ''}"
                                         f"enumerations, structs, layouts, classes: kept, picture }}, this{rest});"])

    def arguments_text(self, call, values):
        return ", ".join(values[one.name] for one in call.arguments)

    def over_arrays(self, method, calls):
        call = calls[0]
        single = next((one for one in calls if one.is_float), None)
        inputs, _ = self.parameters(call)
        outputs = [one for one in call.arguments if one.is_output]
        first = next((one for one in inputs if one.shape == ("n",)), None)
        values = {}
        lines = [f"const one = typeof {first.name} !== \"object\";", f"const n = one ? 1 : M.count({first.name}, \"{first.name}\");"] if first else \
            ["const one = false;", "counted(n, \"n\");"]  # nothing says how many, but who calls
        # where arrays are in this memory, which may grow before all that are not have room there
        moved = [one.name for one in inputs if one.kind and one.shape and one.direction != "inout"]
        own = [f"{self.own_pointer(call)};"] if call.handle() is not None else []
        lines = own + [f"{name} = M.settle({name});" for name in moved] + lines
        if any(one.direction != "inout" for one in outputs):
            lines.append("const to = M.settleAll(out);")
        real = next((one for one in inputs if one.base == "double" and one.shape == ("n",)), first)
        R = "F64"
        if single is not None:
            lines += [f"const isFloat = M.isFloat({real.name});", "const R = isFloat ? F32 : F64;"]
            R = "R"
        if call.handle() is not None:
            values[call.handle().name] = self.own_pointer(call)
        for one in call.arguments:
            kind = R if one.kind == "F64" else one.kind
            if one.name == "n":
                values["n"] = "n"
            elif one.direction == "inout":
                lines.append(f"const p_{one.name} = M.copied({kind}, {one.name}, n, \"{one.name}\");")
                values[one.name] = f"p_{one.name}"
            elif one.is_input and one.name not in values:
                lines.append(f"const p_{one.name} = {self.input(one, 'n').replace('F64', kind or 'F64')};")
                values[one.name] = f"p_{one.name}"
        parts = []
        for one in outputs:
            if one.direction == "inout":
                continue
            kind = R if one.kind == "F64" else one.kind
            if one.base in self.interface.structs:  # a struct of arrays
                layout = self.layouts.of(one.base)
                lines += [f"const p_{one.name} = M.zeros({layout.size});", f"const columns = {[camel(m.name) for m in layout.members]};",
                          f"const places = columns.map((name) => M.output(F64, to?.[name], n, name));",
                          f"places.forEach((place, i) => M.data.setUint32(p_{one.name} + 4 * i, place, true));"]
                parts.append("...Object.fromEntries(columns.map((name, i) => [name, one ? M.first(F64, places[i]) : M.result(F64, out?.[name], places[i], n)]))")
            elif len(one.shape) == 2:
                count = int(one.shape[0])
                lines += [f"const places_{one.name} = Array.from({{ length: {count} }}, (_, i) => M.output({kind}, to?.{one.name}?.[i], n, \"{one.name}\"));",
                          f"const p_{one.name} = M.zeros(4 * {count});",
                          f"places_{one.name}.forEach((place, i) => M.data.setUint32(p_{one.name} + 4 * i, place, true));"]
                parts.append(f"{one.name}: places_{one.name}.map((place, i) => one ? M.first({kind}, place) : M.result({kind}, out?.{one.name}?.[i], place, n))")
            else:
                lines.append(f"const p_{one.name} = M.output({kind}, to?.{one.name}, n, \"{one.name}\");")
                parts.append(f"{one.name}: one ? M.first({kind}, p_{one.name}) : M.result({kind}, out?.{one.name}, p_{one.name}, n)")
            values[one.name] = f"p_{one.name}"
        names = [one.name for one in inputs] + ([] if first else ["n"])
        target = self.call(call.name)
        if single is not None:
            target = f"(isFloat ? {self.call(single.name)} : {target})"
        lines.append(f"const r = {target}({self.arguments_text(call, values)});")
        if call.throws:
            lines.append("check(r);")
        if parts:
            names.append("out")
        inout = next((one for one in outputs if one.direction == "inout"), None)
        if inout is not None:
            lines.append(f"return new {inout.kind}.Type(M.buffer, p_{inout.name}, r >>> 0).slice();")
        elif not parts:
            lines.append(f"return {self.returned(call.result, method)};")
        elif len(parts) == 1 and not parts[0].startswith("...") :
            lines.append(f"return {parts[0].split(': ', 1)[1]};")
        else:
            lines.append(f"return {{ {', '.join(parts)} }};")
        return ", ".join(names), "\n".join(lines)

    def text_out(self, method, call, text, values, lines, before):
        """A text that the function writes: into 256 bytes, or into as many as it asks for."""
        asks = next((one for one in call.arguments if one.name == "length" and one.is_output), None)
        size = next((one.name for one in call.arguments if one.direction == "count" and one.name in ("size", "messageSize")), None)
        lines += before
        if asks is not None:
            values.update({text.name: "0", size: "0", asks.name: "q_length"})
            lines += ["const q_length = M.zeros(4);", f"X.{call.name}({self.arguments_text(call, values)});",
                      "const size = M.data.getUint32(q_length, true) + 1;", "const q_text = M.zeros(size);"]
            values.update({text.name: "q_text", size: "size"})
        else:
            lines.append("const q_text = M.zeros(512);")
            values.update({text.name: "q_text", **({size: "512"} if size else {})})
        lines.append(f"const r = {self.call(call.name)}({self.arguments_text(call, values)});")

    def once(self, method, call):
        inputs, room = self.parameters(call)
        values, lines, outputs = {}, [], []
        if call.handle() is not None:
            lines.append(f"{self.own_pointer(call)};")  # before anything else is asked
            values[call.handle().name] = self.own_pointer(call)
        for one in room:
            lines.append(f"{one.name} = " + number_text(one.base, f"present({one.name}, \"{one.name}\")", one.name) + ";")
            values[one.name] = one.name
        for one in call.arguments:
            if one.is_input and one.name not in values:
                put = self.input(one, '')
                if one.is_nullable and one.kind:
                    put = f"{one.name} == null ? 0 : {put}"
                if len(one.shape) == 2 and one.shape[0] == "n" and "n" not in values:
                    lines.append(f"const n = rows([[{one.name}, {one.shape[1]}]], undefined, \"{one.name}\");")
                    values["n"] = "n"
                lines.append(f"const p_{one.name} = {put};")
                values[one.name] = f"p_{one.name}"
                for count in call.arguments:
                    if count.direction == "count" and one.shape == (count.name,) and one.kind:
                        values[count.name] = count.name
                        lines[-1] = f"const {count.name} = M.count({one.name}, \"{one.name}\");\nconst p_{one.name} = M.input({one.kind}, {one.name}, {count.name}, \"{one.name}\");"
                    if count.direction == "count" and one.shape == (count.name,) and one.base == "char":
                        lines[-1] = f"const p_{one.name} = M.text(present({one.name}, \"{one.name}\"), \"{one.name}\");"
                        values[count.name] = f"new TextEncoder().encode({one.name}).length"
            elif one.direction == "new":
                lines.append("const q_new = M.zeros(4);")
                values[one.name] = "q_new"
            elif one.is_text and one.is_output:
                pass
            elif one.is_output:
                outputs.append(one)
        names = ", ".join([one.name for one in inputs] + [one.name for one in room])
        made = next((one for one in call.arguments if one.direction == "new"), None)
        if made is not None:
            return names, "\n".join([*lines, *self.make(call, values, method)])
        if call.room is not None:
            return names, "\n".join([*lines, *self.as_many_as_there_are(call, values, outputs)])
        text = next((one for one in call.arguments if one.is_text and one.is_output), None)
        shown = [one for one in outputs if one.name != "length"]
        images = [one for one in shown if one.is_of_pixels]
        names += (", out" if names else "out") if images else ""
        for one in shown:
            size, _ = self.layouts.element(one.base, 0)
            length = one.length() if one.shape else "1"
            lines.append(f"const p_{one.name} = M.zeros({size} * {length});" if one not in images else
                         f"const p_{one.name} = M.output({one.kind}, out?.{one.name}, {length}, \"{one.name}\");")
            values[one.name] = f"p_{one.name}"
            if one.base in self.interface.structs and self.layouts.of(one.base).members[0].name == "size":
                lines.append(f"M.data.setUint32(p_{one.name}, {size}, true);")
        if text is not None:
            self.text_out(method, call, text, values, lines, [])
        else:
            lines.append(f"const r = {self.call(call.name)}({self.arguments_text(call, values)});")
        if text is not None and text.name == "message":
            if not shown:  # whether something is right: what is wrong, or null
                return names, "\n".join([*lines, "return r === 0 ? null : M.string(q_text);"])
            lines.append("check(r, q_text);")
        elif call.throws:
            lines += ["check(r);", *call.needs()]
        if text is not None and text.name != "message":
            return names, "\n".join([*lines, "return M.string(q_text);"])
        parts = []
        if call.name in SEEKERS:
            lines.append("if (r === 0) { return null; }")
        if call.result is not None and call.result.direction != "status" and call.name not in SEEKERS | TELLERS:
            counts = call.result.base in ("int", "size_t") and len(shown) == 1 and len(shown[0].shape) == 1
            if counts:
                one = shown[0]
                return names, "\n".join([*lines, f"return M.result({one.kind}, undefined, p_{one.name}, r);"])
            name = "face" if call.result.base == "uint8_t" else "value"
            parts.append((name, self.returned(call.result, method)))
        for one in shown:
            value = self.plain(one, f"p_{one.name}") if not one.shape else \
                f"M.result({one.kind}, {f'out?.{one.name}' if one in images else 'undefined'}, p_{one.name}, {one.length()})"
            parts.append((one.name, value))
        if len(parts) == 1:
            lines.append(f"return {parts[0][1]};")
        elif parts:
            lines.append(f"return {{ {', '.join(f'{name}: {value}' for name, value in parts)} }};")
        return names, "\n".join(lines)

    def as_many_as_there_are(self, call, values, outputs):
        """A function that says how many there are if there is no room: it is called twice."""
        arrays = [one for one in outputs if one.name != "count"]
        values.update({"count": "q_count", call.room.name: "0", **{one.name: "0" for one in arrays}})
        lines = ["const q_count = M.zeros(4);", f"let r = {self.call(call.name)}({self.arguments_text(call, values)});",
                 "const count = M.data.getUint32(q_count, true);"]
        for one in arrays:
            width = " * ".join(("count", *one.shape[1:]))
            lines.append(f"const p_{one.name} = M.room({width} * {one.kind}.bytes);")
        values.update({call.room.name: "count", **{one.name: f"p_{one.name}" for one in arrays}})
        lines += [f"if (r === SPACE) {{ r = {self.call(call.name)}({self.arguments_text(call, values)}); }}", "check(r);"]
        found = [(one.name, f"M.result({one.kind}, undefined, p_{one.name}, "
                  f"{' * '.join(('M.data.getUint32(q_count, true)', *one.shape[1:]))})") for one in arrays]
        if len(found) == 1:
            return [*lines, f"return {found[0][1]};"]
        return [*lines, f"return {{ {', '.join(f'{name}: {value}' for name, value in found)} }};"]

    def make(self, call, values, method):
        lines = [f"const r = {self.call(call.name)}({self.arguments_text(call, values)});"]
        words = "0"
        if call.name in CHECKS:
            checker, given = CHECKS[call.name]
            lines += ["let words = 0;", "if (r !== 0) {", "words = M.zeros(512);",
                      f"{self.call(checker)}({', '.join('p_' + name for name in given)}, words, 512);", "}"]
            words = "words"
        lines.append(f"check(r, {words});")
        made = "M.data.getUint32(q_new, true)"
        if method == "constructor":
            return [*lines, f"return {made};"]
        owner = self.handle_classes[next(one.base for one in call.arguments if one.direction == "new")]
        needed = NEEDS.get(call.name, [])
        return [*lines, f"return {'needs(' if needed else ''}owned({owner}, {made}){', ' + ', '.join(needed) + ')' if needed else ''};"]

    # ---- Classes

    def wrapped(self, names, body):
        return f"({names}) {{\nconst mark = M.mark();\ntry {{\n{body}\n}} finally {{\nM.release(mark);\n}}\n}}"

    def classes_text(self):
        texts = []
        for owner, methods in self.classes.items():
            if not owner:
                texts += [f"function {name}{self.wrapped(*self.function(name, calls))}" for name, calls in methods.items()]
            elif owner in self.handle_classes.values():
                texts.append(self.class_text(owner, methods))
            else:
                parts = []
                for name, calls in methods.items():
                    text = self.wrapped(*self.function(name, calls))
                    parts.append(f"{name}{text},")
                texts.append(f"const {owner} = Object.freeze({{\n" + "\n".join(parts) + "\n});")
        return "\n\n".join(texts)

    def class_text(self, owner, methods):
        base = next(key for key, value in self.handle_classes.items() if value == owner)
        destroy = self.destructors[base]
        self.called.add(destroy)
        lines = [f"class {owner} extends Owned {{"]
        if "constructor" in methods:
            names, body = self.function("constructor", methods["constructor"])
            needs = NEEDS.get(methods["constructor"][0].name)
            keeps = f" if (given[0] !== OWNED) {{ const [{names}] = given; needs(this, {', '.join(needs)}); }}" if needs else ""
            lines += [f"static #make{self.wrapped(names, body)}",
                      f"constructor(...given) {{ super({owner}, given[0] === OWNED ? given[1] : {owner}.#make(...given), \"{destroy}\", "
                      f"given[0] === OWNED ? given[2] : undefined);{keeps} }}"]
        else:
            lines += [f"constructor(...given) {{ if (given[0] !== OWNED) {{ throw new TypeError(\"{owner} has no constructor\"); }} super({owner}, given[1], \"{destroy}\", given[2]); }}"]
        for name, calls in methods.items():
            if name == "constructor":
                continue
            names, body = self.function(name, calls)
            static = "" if calls[0].is_method else "static "
            getter = "get " if not static and not names and calls[0].tells else ""
            lines.append(f"{static}{getter}{name}{self.wrapped(names, body)}")
        return "\n".join([*lines, "}"])

    def layouts_text(self):
        """Where members are, for what is written by hand."""
        return ",\n".join(f"{name}: {{ BYTES: {self.layouts.of(name).size}, " +
                          ", ".join(f"{camel(one.name)}: {one.offset}" for one in self.layouts.of(name).members) + " }"
                          for name in sorted(self.laid))

    def text(self):
        structs, done = [], set()
        while True:
            todo = [("w", name) for name in sorted(self.written)] + [("r", name) for name in sorted(self.read)]
            todo = [one for one in todo if one not in done]
            if not todo:
                break
            for one in todo:
                done.add(one)
                structs.append(self.writer_text(one[1]) if one[0] == "w" else self.reader_text(one[1]))
        tables = "\n".join(f"const E_{base} = {enumerators(values)!r};".replace("'", '"')
                           for base, values in self.interface.enumerations.items())
        exported = [name for name in self.classes if name] + list(self.classes.get("", {}))
        by_hand = "scene_by_hand" if "Octree" in self.classes else "by_hand"
        head = (self.template()).replace("/*BY_HAND*/", by_hand).replace("/*TABLES*/", tables).replace("/*STRUCTS*/", "\n\n".join(structs)) \
            .replace("/*CLASSES*/", self.body).replace("/*NAMES*/", ", ".join(exported)) \
            .replace("/*WRITERS*/", ", ".join([*(f"write_{name}" for name in sorted(self.written)),
                                                 *(f"read_{name}" for name in sorted(self.read))])) \
            .replace("/*ENUMERATIONS*/", ", ".join(f"E_{base}" for base in self.interface.enumerations)) \
            .replace("/*LAYOUTS*/", self.layouts_text()).replace("/*KEPT*/", ", ".join(sorted(set(self.handle_classes.values()))))
        return head

    @staticmethod
    def template():
        import pathlib
        return (pathlib.Path(__file__).parent / "src" / "module.js.in").read_text(encoding="utf-8")
