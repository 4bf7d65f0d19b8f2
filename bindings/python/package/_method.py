# SPDX-License-Identifier: MIT
"""Functions of the library as methods of objects that have a handle."""

from . import _core

_results = {}  # {function: what makes its result of a tuple}


def name_results(function, result):
    """The result of a function for many points becomes a named tuple of as many, or what a function makes of the tuple."""
    _results[function] = result


def function(name):
    """A function of the library that needs no object."""
    return _core.Function(name, result=_results.get(name), origin=(function, (name,)))


def bind(instance, name, options=(), shown=None):
    """A function of the library for an object, whose `_handle` and `_threads` it takes. As the method `shown` of an object that
    `_is_remade` from a few numbers and texts it is pickled with these: it does not keep the object itself."""
    given = (name, instance._handle, options, instance._threads, _results.get(name))
    if shown is None or not getattr(instance, "_is_remade", False):
        return _core.Function(*given)
    return _core.Function(*given, (_bound_again, (instance.__reduce__()[:2], shown)))


def _bound_again(made, shown):
    make, arguments = made
    return getattr(make(*arguments), shown)


class Method:
    """Binds a function of the library to an object when it is first asked for; then it is in the object's dictionary."""

    def __init__(self, name):
        self.name = name
        self.shown = name

    def __set_name__(self, owner, shown):
        self.shown = shown

    def __get__(self, instance, owner=None):
        if instance is None:
            return self
        bound = bind(instance, self.name, shown=self.shown)
        instance.__dict__[self.shown] = bound
        return bound

    def __repr__(self):
        return f"<method {self.shown} of cubemap: {self.name}>"

    @property
    def __doc__(self):
        return documents.get(self.name)


class _Documents:
    """The documentation of functions, read from one that is bound to nothing."""

    def get(self, name):
        options = next((count for count in range(3) if _fits(name, count)), 0)
        return _core.Function(name, options=(0,) * options).__doc__


def _fits(name, count):
    try:
        _core.Function(name, options=(0,) * count)
    except TypeError:
        return False
    return True


documents = _Documents()
