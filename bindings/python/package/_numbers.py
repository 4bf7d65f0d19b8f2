# SPDX-License-Identifier: MIT
"""Whole numbers on their way to the library: ctypes cuts off the bits for which there is no room, and here they are refused.

>>> cubemap.face_weights("coupled", 8, 2**32 + 1)
Traceback (most recent call last):
    ...
cubemap._errors.Error: face: from 0 to 4294967295, not 4294967297
"""

import ctypes
import operator

from . import _core
from ._errors import Error

_OUT_OF_RANGE = 5  # CM_ERROR_RANGE


def _checked(name, value, low, high):
    if not low <= value <= high:
        raise Error(_OUT_OF_RANGE, f"{name}: from {low} to {high}, not {value}")


class Structure(ctypes.Structure):
    """A struct whose members take no whole number that they cannot keep."""

    def __setattr__(self, name, value):
        super().__setattr__(name, value)
        if hasattr(value, "__index__"):
            kept = getattr(self, name)
            if isinstance(kept, int) and kept != operator.index(value):
                kind = dict(self._fields_)[name]
                bits = 8 * ctypes.sizeof(kind)
                _checked(name, operator.index(value), *((0, 2**bits - 1) if kind(-1).value > 0 else (-2**(bits - 1), 2**(bits - 1) - 1)))


library = ctypes.CDLL(_core.__file__)


class _Function(library._FuncPtr):
    """A function of the library, which knows of its whole numbers (place, name, least, most)."""

    _flags_ = library._FuncPtr._flags_
    _restype_ = library._FuncPtr._restype_

    def __call__(self, *arguments):
        for place, name, low, high in self.whole:
            if place < len(arguments) and hasattr(arguments[place], "__index__"):
                _checked(name, operator.index(arguments[place]), low, high)
        try:
            return super().__call__(*arguments)
        except ctypes.ArgumentError as error:
            place = int(str(error).split(":")[0].removeprefix("argument ")) - 1
            raise TypeError(f"{self.names[place]}: cannot be a {type(arguments[place]).__name__}") from None


def function(name, names, *whole):
    """A function of the library by its name, and those of its arguments; and of which of them are whole numbers."""
    found = _Function((name, library))
    found.names, found.whole = names.split(), whole
    return found
