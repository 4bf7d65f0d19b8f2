# SPDX-License-Identifier: MIT
"""Errors of the library as exceptions, with its words."""

import ctypes

from . import _core


class Error(ValueError):
    """What the library refuses: `status` is its number, as in cubemap/status.h.

    >>> try:
    ...     cubemap.Mapping("copled")
    ... except cubemap.Error as error:
    ...     print(error.status, error)
    3 no mapping is called 'copled'; coupled is the recommended one, and the catalogue lists all
    """

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status

    def __reduce__(self):
        return type(self), (self.status, self.args[0])


_text = ctypes.CDLL(_core.__file__).cm_status_text
_text.restype = ctypes.c_char_p


def check(status, function=None, arguments=None):
    """Nothing if the status is CM_OK; else the exception for it."""
    if status == 8:
        raise MemoryError
    if status != 0:
        raise Error(status, _text(status).decode())
    return status


def in_words(checker, *arguments):
    """Call a function that checks something and says in a message what is wrong."""
    message = ctypes.create_string_buffer(512)
    try:
        checker(*arguments, message, len(message))
    except Error as error:
        raise Error(error.status, message.value.decode() or str(error)) from None
