# SPDX-License-Identifier: MIT
"""How structs lie in WebAssembly's memory: pointers and size_t have 4 bytes, all else its own alignment. The build has clang
hold against it what this says (assertions)."""

import dataclasses

from special_cases import EXTENTS, WORDS

SCALARS = {  # type: (bytes, what DataView calls it)
    "char": (1, "Int8"), "signed char": (1, "Int8"), "uint8_t": (1, "Uint8"), "uint16_t": (2, "Uint16"),
    "int": (4, "Int32"), "unsigned": (4, "Uint32"), "unsigned int": (4, "Uint32"), "uint32_t": (4, "Uint32"),
    "int32_t": (4, "Int32"), "size_t": (4, "Uint32"), "ptrdiff_t": (4, "Int32"), "float": (4, "Float32"),
    "double": (8, "Float64"), "int64_t": (8, "BigInt64"), "uint64_t": (8, "BigUint64"), "cm_cell": (8, "BigUint64"),
}


@dataclasses.dataclass(frozen=True)
class Member:
    name: str
    base: str
    pointers: int
    count: int  # of an array's elements; 1 for what is none
    is_array: bool
    offset: int
    size: int  # of one element
    words: str = ""  # the enumeration that a whole number is of
    extents: object = None  # of the array that a pointer points to (special_cases.py)
    counter: int = 0  # where the number of its elements is


@dataclasses.dataclass(frozen=True)
class Layout:
    name: str
    members: tuple
    size: int
    alignment: int


class Layouts:
    def __init__(self, interface):
        self.interface = interface
        self.known = {}

    def element(self, base, pointers):
        """Size and alignment."""
        if pointers:
            return 4, 4
        if base in SCALARS:
            return (SCALARS[base][0],) * 2
        if base in self.interface.enumerations:
            return 4, 4
        layout = self.of(base)
        return layout.size, layout.alignment

    def of(self, name):
        if name not in self.known:
            members, at, widest = [], 0, 1
            for member in self.interface.structs[name]:
                size, alignment = self.element(member.base, member.pointers)
                count = 1
                for extent in member.extents:
                    count *= extent
                at = -(-at // alignment) * alignment
                extents = EXTENTS.get(name, {}).get(member.name)
                members.append(Member(member.name, member.base, member.pointers, count, bool(member.extents), at, size,
                                      WORDS.get((name, member.name), ""), extents))
                at += size * count
                widest = max(widest, alignment)
            places = {one.name: one.offset for one in members}
            members = [dataclasses.replace(one, counter=places[one.extents[0]]) if isinstance(one.extents, tuple) else one
                       for one in members]
            self.known[name] = Layout(name, tuple(members), -(-at // widest) * widest, widest)
        return self.known[name]

    def assertions(self, names, headers):
        """C that does not compile where a compiler sees another layout."""
        lines = [f"#include <cubemap/{header}>" for header in sorted(headers)]
        for name in sorted(names):
            layout = self.of(name)
            lines.append(f'_Static_assert(sizeof({name}) == {layout.size}, "{name}");')
            lines += [f'_Static_assert(offsetof({name}, {one.name}) == {one.offset}, "{name}.{one.name}");'
                      for one in layout.members]
        return "\n".join(lines) + "\n"
