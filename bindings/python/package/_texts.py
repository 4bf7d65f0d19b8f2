# SPDX-License-Identifier: MIT
"""Words and structs: what Python has for enumerators, texts and members of the library."""

import ctypes

from . import _core
from . import _library as library
from ._errors import Error


def decoded(text):
    """A text of the library; None stays None."""
    return None if text is None else text.decode()


def words_of(name):
    """The words that a function of the library has for the numbers from 0 on."""
    words = []
    while (text := name(len(words))) is not None:
        words.append(text.decode())
    return tuple(words)


def number_of(word, words, what):
    """The number of a word."""
    try:
        return words.index(str(word).lower())
    except ValueError:
        raise ValueError(f"{what}: {word!r} is none of {', '.join(words)}") from None


def struct(kind, /, **members):
    """A struct of the library with its size, and what is given; all else is 0."""
    made = kind()
    if any(name == "size" and type_ is ctypes.c_size_t for name, type_ in kind._fields_) and "size" not in members:
        made.size = ctypes.sizeof(kind)
    for name, value in members.items():
        setattr(made, name, value)
    return made


def created(creator, destroyer, *arguments, keep=None):
    """A handle of what a function of the library makes; its last argument is where."""
    address = ctypes.c_void_p()
    creator(*arguments, ctypes.byref(address))
    return _core.Handle(address.value, destroyer, keep)


class Specified:
    """What is made again from its arguments: it is equal, hashed, printed and pickled by them.

    `_arguments()` gives them as a dictionary in the order of the constructor, or as a tuple; those that are as they are without
    a word are not printed.
    """

    _standard = {}
    _is_remade = True  # are they few, and at hand? Then methods that are ufuncs are pickled with them

    def _arguments(self):
        raise NotImplementedError

    def __repr__(self):
        shown = [f"{name}={value!r}" if place else f"{value!r}"
                 for place, (name, value) in enumerate(self._arguments().items())
                 if place == 0 or name not in self._standard or self._standard[name] != value]
        where = "cubemap.sim" if _own_kind(type(self)).__module__.startswith("cubemap.sim") else "cubemap"
        return f"{where}.{type(self).__name__}({', '.join(shown)})"

    def _same(self):
        """What makes two of them equal: the threads that work do not."""
        return tuple((name, value) for name, value in self._arguments().items() if name != "threads")

    def __eq__(self, other):
        return self._same() == other._same() if type(other) is type(self) else NotImplemented

    def __hash__(self):
        return hash((type(self).__name__, self._same()))

    def __reduce__(self):
        again = type(self), self._arguments()
        if _own_kind(type(self)) is type(self):
            return _made_again, again
        held = vars(_made_again(*again)).keys()
        return _made_again, again, {name: value for name, value in vars(self).items()
                                    if name not in held and not isinstance(value, _core.Function)}


def _own_kind(kind):
    """The class of this package that a user's class is made of."""
    return next(one for one in kind.__mro__ if one.__module__.split(".")[0] == __package__)


def _made_again(kind, arguments):
    """Its own constructor may have other arguments; what it has added comes as state."""
    made = kind.__new__(kind)
    begin = _own_kind(kind).__init__
    begin(made, **arguments) if isinstance(arguments, dict) else begin(made, *arguments)
    return made


class Changing:
    """What holds what was put into it, and is no value: a copy would be the same object under another name."""

    def __reduce__(self):
        raise TypeError(f"a cubemap.{type(self).__name__} cannot be copied or pickled: it holds what was put into it; make another one")


def string_of(write):
    """A text that write(buffer, size, length) gives when there is room for it."""
    length = ctypes.c_size_t()
    try:
        write(None, 0, ctypes.byref(length))
    except Error as error:
        if error.status != library.CM_ERROR_SPACE:
            raise
    text = ctypes.create_string_buffer(length.value + 1)
    write(text, len(text), ctypes.byref(length))
    return text.value.decode()


def checked_kind(given, kind, what):
    """What is given; TypeError if it is none of the kind."""
    if not isinstance(given, kind):
        raise TypeError(f"{what}: a {kind.__name__}, not {type(given).__name__}")
    return given


def handle_of(given, kind, what):
    """Its handle; TypeError for what is none of the kind, whose handle the library would take for one."""
    return checked_kind(given, kind, what)._handle


def checked_text(text, what):
    """The bytes of a text without zero bytes, which would end it."""
    if not isinstance(text, str):
        raise TypeError(f"{what}: a text, not {type(text).__name__}")
    if "\0" in text:
        raise ValueError(f"{what}: a zero byte in {text!r}")
    return text.encode()
