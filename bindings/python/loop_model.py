# SPDX-License-Identifier: MIT
"""Which functions of the library work on many points, and what their inputs and outputs are: from bindings/functions and the
headers."""

import dataclasses
import keyword
import sys

NUMBERS = {"double": ("CORE_DOUBLE", "float64"), "float": ("CORE_FLOAT", "float32"), "uint8_t": ("CORE_UINT8", "uint8"),
           "int": ("CORE_INT", "intc"), "uint32_t": ("CORE_UINT32", "uint32"), "unsigned": ("CORE_UINT32", "uint32"),
           "int64_t": ("CORE_INT64", "int64"), "uint64_t": ("CORE_UINT64", "uint64"), "size_t": ("CORE_UINT64", "uint64")}
# how NumPy has several arrays of one output
CORE_SHAPES = {"cm_forward_jacobian_array": (2, 3), "cm_inverse_jacobian_array": (3, 2), "cm_warp_jacobian_array": (2, 2)}


@dataclasses.dataclass(frozen=True)
class Operand:
    """A number, or several, of every point."""

    name: str
    base: str  # "double"
    shape: tuple  # of one point
    planar: bool = False
    member: str = ""  # of a struct: "distortion.major"

    @property
    def shown(self):
        """Its name in Python."""
        return self.name + "_" * keyword.iskeyword(self.name)

    @property
    def items(self):
        count = 1
        for extent in self.shape:
            count *= extent
        return count


@dataclasses.dataclass(frozen=True)
class Loop:
    """A function of the library that works on many points, or is made to."""

    function: object
    declared: object
    inputs: tuple
    outputs: tuple
    options: tuple
    handle: str
    arrays: bool


class Unfit(Exception):
    """The function is none for many points."""


class Binding:
    def __init__(self, root):
        sys.path.insert(0, str(root / "bindings"))
        import function_table
        import public_headers

        table = function_table.read(root / "bindings" / "functions")
        # the extension module has no library of modules that are not bound
        self.table = dataclasses.replace(table, functions=tuple(function for function in table.functions
                                                                if function.reasons.get("python") != "unbound"))
        self.interface = public_headers.read(root)
        self.loops = self.find_loops()

    def base(self, name):
        """The type of a number, "int" for an enumerator; None for others."""
        if name == "cm_cell":
            return "uint64_t"
        if name in self.interface.enumerations:
            return "int"
        return name if name in NUMBERS else None

    def members(self, name):
        """The members of a struct that is made of numbers alone; None for others."""
        members = self.interface.structs.get(name)
        if members is None or any(member.pointers or self.base(member.base) is None or member.name == "size" for member in members):
            return None
        return members

    def operand(self, argument, shape):
        """The operands that an argument is: one, or those of a struct's members."""
        base = self.base(argument.base)
        if base is not None:
            return [Operand(argument.name, base, shape)]
        members = self.members(argument.base)
        if members is None or shape:
            raise Unfit
        return [Operand(member.name, self.base(member.base), member.extents, member=f"{argument.name}.{member.name}")
                for member in members]

    def array_operand(self, function, argument, row):
        """The operands of an argument with n of everything."""
        name = function.name.removesuffix("_f32")
        if row.shape == ("n",) and argument.base in self.interface.structs:  # an array for each member
            return [Operand(member.name, member.base, (), member=f"{argument.name}.{member.name}")
                    for member in self.interface.structs[argument.base]]
        base = self.base(argument.base)
        if base is None or argument.pointers + len(argument.extents) < 1:
            raise Unfit
        if row.shape == ("n",):
            return [Operand(argument.name, base, ())]
        if len(row.shape) == 2 and row.shape[1] == "n" and row.shape[0].isdigit():
            return [Operand(argument.name, base, CORE_SHAPES.get(name, (int(row.shape[0]),)), planar=True)]
        raise Unfit

    def loop(self, function):
        """The loop of a function of the table; Unfit if it is none."""
        declared = self.interface.functions[function.name]
        arrays = any(row.direction == "count" and row.name == "n" for row in function.arguments)
        inputs, outputs, options, handle = [], [], [], ""
        for argument, row in zip(declared.arguments, function.arguments, strict=True):
            if row.direction == "handle" and not handle:
                handle = argument.base
            elif row.direction == "count" and row.name == "n":
                pass
            elif row.direction == "option" and arrays and self.base(argument.base) and not argument.pointers:
                options.append(argument.name)
            elif row.direction in ("in", "out", "option") and not row.is_text:
                if arrays:
                    found = self.array_operand(function, argument, row)
                elif all(extent.isdigit() for extent in row.shape) and argument.base in (*NUMBERS, "cm_cell") \
                        or not row.shape:
                    found = self.operand(argument, tuple(int(extent) for extent in row.shape))
                else:
                    raise Unfit
                (outputs if row.direction == "out" else inputs).extend(found)
            else:
                raise Unfit
        if function.result and function.result.direction == "out":
            if arrays or function.result.is_text or declared.result.pointers or self.base(declared.result.base) is None:
                raise Unfit
            outputs.append(Operand("result", self.base(declared.result.base), ()))
        elif function.result and function.result.direction != "status":
            raise Unfit
        if not inputs or not outputs or len(inputs) + len(outputs) > 16 or len(options) > 2:
            raise Unfit
        return Loop(function, declared, tuple(inputs), tuple(outputs), tuple(options), handle, arrays)

    def find_loops(self):
        """{name in Python: {"double": loop, "float": loop}}: of functions with one name those for arrays."""
        found = {}
        for name, functions in self.table.by_name("python").items():
            loops = []
            for function in functions:
                try:
                    loops.append(self.loop(function))
                except Unfit:
                    pass
            loops = [loop for loop in loops if "_threads" not in loop.function.name]
            chosen = [loop for loop in loops if loop.arrays] or loops
            if chosen:
                found[name] = {"float" if loop.function.name.endswith("_f32") else "double": loop for loop in chosen}
        return {name: loops for name, loops in found.items() if "double" in loops}
