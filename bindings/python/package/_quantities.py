# SPDX-License-Identifier: MIT
"""Numbers with units, as astropy has them, for functions that take numbers: angles in any unit of angle, and what has no unit.

Their own way to ufuncs knows NumPy's and SciPy's only, and refuses all others.

>>> from types import SimpleNamespace as of
>>> is_quantity(of(unit="deg", to_value=None)), is_quantity(1.0)
(True, False)
"""

# of radians: names of arguments, and one that has them by its function
ANGLES = frozenset(("lon", "lat", "theta", "phi", "angle", "theta_in", "convert.from_"))
IN_DEGREES = frozenset(("rotation_from_angles",))


def is_quantity(value):
    """Is it a number with a unit?"""
    return hasattr(value, "unit") and hasattr(value, "to_value")


def _number(value, name, function):
    """Its number as an angle or without unit; else an error that says so."""
    if not is_quantity(value):
        return value
    wanted, words = "", "a number without unit"
    if function in IN_DEGREES:
        wanted, words = "deg", "an angle"
    elif name in ANGLES or f"{function}.{name}" in ANGLES:
        wanted, words = "rad", "an angle"
    try:
        return value.to_value(wanted)
    except ValueError:  # of astropy's kind
        raise TypeError(f"{name}: {words}, not a quantity of {value.unit}; .to_value({str(value.unit)!r}) has its number") from None


def call(ufunc, arguments, keywords):
    """What a ufunc gives for the numbers of quantities; None if there are none. Results are numbers: angles in radians."""
    given = keywords.get("out", ())
    places = (*arguments[ufunc.nin:], *(given if isinstance(given, tuple) else (given,)))
    if any(map(is_quantity, places)):
        raise TypeError("out: an array of numbers, not a quantity")
    if not any(map(is_quantity, arguments[:ufunc.nin])):
        return None
    line = ufunc.__doc__.split("\n\n")[1]  # the first is of the names that NumPy has for arguments
    names = line[line.index("(") + 1:].split(", ")[:ufunc.nin]
    numbers = (_number(value, name, ufunc.__name__) for value, name in zip(arguments[:ufunc.nin], names, strict=True))
    return ufunc(*numbers, *arguments[ufunc.nin:], **keywords)
