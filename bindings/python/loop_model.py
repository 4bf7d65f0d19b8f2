# SPDX-License-Identifier: MIT
"""Which functions of the library work on many points, and what their inputs and outputs are: from bindings/functions and the
headers."""

import dataclasses
import keyword
import math
import sys

NUMBERS = {"double": ("CORE_DOUBLE", "float64"), "float": ("CORE_FLOAT", "float32"), "uint8_t": ("CORE_UINT8", "uint8"),
           "int": ("CORE_INT", "intc"), "int32_t": ("CORE_INT", "intc"), "uint32_t": ("CORE_UINT32", "uint32"), "unsigned": ("CORE_UINT32", "uint32"),
           "int64_t": ("CORE_INT64", "int64"), "uint64_t": ("CORE_UINT64", "uint64"), "size_t": ("CORE_UINT64", "uint64")}
# how NumPy has what is so many numbers in a row in C, or so many arrays: matrices
CORE_SHAPES = {"cm_forward_jacobian_array": (2, 3), "cm_inverse_jacobian_array": (3, 2),
               "cm_warp_jacobian_array": (2, 2), "cm_camera_jacobian": (2, 3), "cm_pose_adjoint": (6, 6), "cm_pose_transport": (6, 6),
               "cm_texel_matrix": (4, 4)}
# functions that take every number of 32 bits: what has more must not become one that they take
WIDE = "cm_random_"
# what the library cubemap-sim declares, which a build may be without
SIM_HEADERS = ("brdf.h", "compensate.h", "depth_error.h", "lens.h", "sim.h", "texel.h")


@dataclasses.dataclass(frozen=True)
class Operand:
    """A number, or several, of every point."""

    name: str
    base: str  # "double"
    shape: tuple  # of one point
    planar: bool = False
    member: str = ""  # of a struct: "distortion.major", "pose.rotation.row"
    narrow: bool = False  # has C 32 bits where NumPy has 64?

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
    sized: tuple  # arguments that are structs with their size


class Unfit(Exception):
    """The function is none for many points."""


def told_apart(*sides):
    """The operands of both sides: those whose names are not the only ones have their struct's name before it."""
    names = [operand.name for side in sides for operand in side]

    def own_name(operand):
        if not operand.member or names.count(operand.name) == 1:
            return operand
        return dataclasses.replace(operand, name=f"{operand.member.split('.')[0]}_{operand.name}")

    return tuple(tuple(map(own_name, side)) for side in sides)


class Binding:
    """What there is to bind, with or without the library cubemap-sim."""

    def __init__(self, root, has_sim=True):
        sys.path.insert(0, str(root / "bindings"))
        import function_table
        import public_headers

        self.has_sim = has_sim
        table = function_table.read(root / "bindings" / "functions")
        bound = (function for function in table.functions if has_sim or function.header not in SIM_HEADERS)
        self.table = dataclasses.replace(table, functions=tuple(bound))
        self.interface = public_headers.read(root)
        self.loops = self.find_loops()

    def base(self, name):
        """The type of a number, "int" for an enumerator; None for others."""
        if name == "cm_cell":
            return "uint64_t"
        if name in self.interface.enumerations:
            return "int"
        return name if name in NUMBERS else None

    def is_sized(self, name):
        """Is it a struct that begins with its size?"""
        members = self.interface.structs.get(name)
        return bool(members) and members[0].name == "size"

    def members(self, name):
        """The numbers of a struct that is made of them alone, and of such structs: (path, name, type, extents)."""
        found = []
        for member in self.interface.structs.get(name, ())[self.is_sized(name):]:
            base = self.base(member.base)
            if member.pointers or (base is None and member.extents):
                raise Unfit
            if base is not None:
                found.append((member.name, member.name, base, member.extents))
                continue
            inner = self.members(member.base)
            found += [(f"{member.name}.{path}", member.name if len(inner) == 1 else shown, inside, extents)
                      for path, shown, inside, extents in inner]
        if not found:
            raise Unfit
        return found

    def operand(self, function, argument, row):
        """The operands that an argument of one point is: one, or those of a struct's members."""
        shape = tuple(int(extent) for extent in row.shape)
        base = self.base(argument.base)
        if base is None:
            if shape:
                raise Unfit
            return [Operand(shown, inside, extents, member=f"{argument.name}.{path}")
                    for path, shown, inside, extents in self.members(argument.base)]
        if base == "uint32_t" and row.direction != "out" and function.name.startswith(WIDE):
            return [Operand(argument.name, "uint64_t", shape, narrow=True)]
        return [Operand(argument.name, base, self.core_shape(function, shape))]

    def core_shape(self, function, shape):
        """What NumPy has for numbers in a row."""
        matrix = CORE_SHAPES.get(function.name.removesuffix("_f32"), ())
        return matrix if shape and shape[0] == math.prod(matrix) else shape

    def array_operand(self, function, argument, row):
        """The operands of an argument with n of everything."""
        if row.shape == ("n",) and argument.base in self.interface.structs:  # an array for each member
            members = self.interface.structs[argument.base][self.is_sized(argument.base):]
            return [Operand(member.name, member.base, member.extents, planar=bool(member.extents),
                            member=f"{argument.name}.{member.name}") for member in members]
        base = self.base(argument.base)
        if base is None or argument.pointers + len(argument.extents) < 1:
            raise Unfit
        if row.shape == ("n",):
            return [Operand(argument.name, base, ())]
        if len(row.shape) == 2 and row.shape[1] == "n" and row.shape[0].isdigit():
            return [Operand(argument.name, base, self.core_shape(function, (int(row.shape[0]),)), planar=True)]
        raise Unfit

    def loop(self, function):
        """The loop of a function of the table; Unfit if it is none."""
        declared = self.interface.functions[function.name]
        arrays = any(row.direction == "count" and row.name == "n" for row in function.arguments)
        inputs, outputs, options, sized, handle = [], [], [], [], ""
        for argument, row in zip(declared.arguments, function.arguments, strict=True):
            if row.direction == "handle" and not handle:
                handle = argument.base
            elif row.direction == "count" and row.name == "n":
                pass
            elif row.direction == "option" and arrays and self.base(argument.base) and not argument.pointers:
                if argument.base in ("double", "float"):  # what a loop is bound to are whole numbers
                    raise Unfit
                options.append(argument.name)
            elif self.is_operand(argument, row, arrays):
                found = self.array_operand(function, argument, row) if arrays else self.operand(function, argument, row)
                (outputs if row.direction in ("out", "inout") else inputs).extend(found)
                sized += [argument.name] * self.is_sized(argument.base)
            else:
                raise Unfit
        if function.result and function.result.direction == "out":
            if arrays or function.result.is_text or declared.result.pointers or self.base(declared.result.base) is None:
                raise Unfit
            outputs.append(Operand("result", self.base(declared.result.base), ()))
        elif function.result and function.result.direction != "status":
            raise Unfit
        elif function.result and not outputs and not arrays and not handle:  # what checks something: the status says it
            outputs.append(Operand("result", "int", ()))
        if not inputs or not outputs or len(inputs) + len(outputs) > 16 or len(options) > 2:
            raise Unfit
        inputs, outputs = told_apart(inputs, outputs)
        return Loop(function, declared, inputs, outputs, tuple(options), handle, arrays, tuple(sized))

    def is_operand(self, argument, row, arrays):
        """Can NumPy give it? Structs with their size are outputs; as inputs they are options."""
        if row.is_text or row.direction not in ("in", "out", "option", "inout"):
            return False
        sized = self.is_sized(argument.base)
        if arrays:
            return row.direction != "inout" and (not sized or row.direction == "out")
        return all(extent.isdigit() for extent in row.shape) and sized == (row.direction == "inout")

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
