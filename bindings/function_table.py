# SPDX-License-Identifier: MIT
"""The table of all public functions, bindings/functions, read. Its head says what stands in it.

    table = function_table.read("bindings/functions")
    for function in table.functions: function.name, function.arguments, function.names["python"], ...
"""

import dataclasses
import pathlib
import re

LANGUAGES = ("python", "js", "cpp")
KEYS = (*LANGUAGES, "fuzz", "docs")
DIRECTIONS = ("in", "out", "inout", "handle", "new", "free", "borrowed", "status", "count", "option")
RETURNED_ALONE = ("borrowed", "status")


class TableError(ValueError):
    """What is wrong, with the number of the line."""


@dataclasses.dataclass(frozen=True)
class Argument:
    name: str
    direction: str
    shape: tuple  # words and numbers as texts: (), ("n",), ("n", "3"); ("text",) and the like for what has no extents
    is_text: bool


@dataclasses.dataclass(frozen=True)
class Function:
    name: str
    header: str  # "mapping.h"
    arguments: tuple
    result: Argument  # None for void
    names: dict  # {"python": "Mapping.forward"}; no key where it is left out
    reasons: dict  # {"python": "strides"} where it is left out
    fuzz: tuple  # names of harnesses
    docs: str  # a page of the guide
    line: int


@dataclasses.dataclass(frozen=True)
class Table:
    functions: tuple
    reasons: dict  # {"strides": what it means}

    def by_name(self, language):
        """{name in that language: its functions}, in the order of the table."""
        found = {}
        for function in self.functions:
            if language in function.names:
                found.setdefault(function.names[language], []).append(function)
        return found


def split_shape(text):
    """The extents between the outer parentheses; commas inside inner ones are theirs."""
    if not (text.startswith("(") and text.endswith(")")):
        return (text,)
    parts, depth = [""], 0
    for letter in text[1:-1]:
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return tuple(parts) if parts != [""] else ()


def parse_argument(word, line):
    parts = word.split(":")
    if len(parts) != 3:
        raise TableError(f"line {line}: {word}: not ARGUMENT:DIRECTION:SHAPE")
    name, direction, shape = parts
    if direction not in DIRECTIONS or (direction in RETURNED_ALONE and name != "return"):
        raise TableError(f"line {line}: {word}: {direction} is no direction here")
    if not re.fullmatch(r"\(.*\)|text|call|pointer", shape) or shape.count("(") != shape.count(")"):
        raise TableError(f"line {line}: {word}: {shape} is no shape")
    return Argument(name, direction, split_shape(shape), shape == "text")


def parse_line(text, line, header, reasons):
    left, _, right = text.partition(" ; ")
    name, *words = left.split()
    arguments = [parse_argument(word, line) for word in words]
    result = arguments.pop() if arguments and arguments[-1].name == "return" else None
    values = {}
    for word in right.split():
        key, _, value = word.partition("=")
        if key not in KEYS or not value or key in values:
            raise TableError(f"line {line}: {word}: no KEY=VALUE, or there twice")
        values[key] = value
    lacking = [key for key in KEYS if key not in values]
    if lacking:
        raise TableError(f"line {line}: {name} has no {', '.join(lacking)}")
    left_out = {key: values[key][1:] for key in LANGUAGES if values[key].startswith("-")}
    for key, reason in left_out.items():
        if reason not in reasons:
            raise TableError(f"line {line}: {key}=-{reason}: no reason of the head of the table")
    names = {key: values[key] for key in LANGUAGES if key not in left_out}
    return Function(name, header, tuple(arguments), result, names, left_out, tuple(values["fuzz"].split(",")),
                    values["docs"], line)


def parse(text):
    """The table of a text; TableError says what is wrong with it."""
    reasons = dict(re.findall(r"^# -(\w+) +(.+)$", text, re.M))
    functions, seen, header = [], {}, ""
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("# ---- "):
            header = line.split()[2]
        if not line.strip() or line.startswith("#"):
            continue
        function = parse_line(line, number, header, reasons)
        if function.name in seen:
            raise TableError(f"line {number}: {function.name} stands in line {seen[function.name]} too")
        seen[function.name] = number
        functions.append(function)
    return Table(tuple(functions), reasons)


def read(path):
    return parse(pathlib.Path(path).read_text(encoding="utf-8"))
