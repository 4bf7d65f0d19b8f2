# SPDX-License-Identifier: MIT
"""Masked arrays for functions of which a point has several numbers, to whose results NumPy gives masks of other shapes.

>>> jacobians = cubemap.Mapping("coupled").forward_jacobian(np.ma.array([2.0, 3.0], mask=[False, True]), 1.0, 0.5)
>>> jacobians.shape, jacobians.mask.all(axis=(1, 2)).tolist()
((2, 2, 3), [False, True])
"""

import re

import numpy as np


def _core_axes(ufunc, axes, axis):
    """Of each operand the axes that are a point's numbers; the last ones, or those that a caller has named."""
    operands = re.findall(r"\(([^)]*)\)", ufunc.signature)
    counts = [len([extent for extent in operand.split(",") if extent]) for operand in operands]
    if axis is not None:
        axes = [(axis,) if count else () for count in counts]
    named = [one if isinstance(one, tuple) else (one,) for one in axes or ()]
    return named + [tuple(range(-count, 0)) for count in counts[len(named):]]


def _mask_of_points(inputs, axes):
    """Masked is a point of which a number is."""
    mask = np.False_
    for one, core in zip(inputs, axes, strict=True):
        if isinstance(one, np.ma.MaskedArray):
            mask = mask | np.ma.getmaskarray(one).any(axis=core)
    return mask


def _with_mask(result, mask, core):
    """A result of which all numbers of a masked point are masked."""
    masks = np.zeros(np.shape(result), bool)
    np.moveaxis(masks, core, range(-len(core), 0))[...] = np.expand_dims(mask, tuple(range(-len(core), 0)))
    return np.ma.array(result, mask=masks)[()]  # of one number NumPy's constant, as its own functions give it


def call(ufunc, arguments, keywords):
    """What a gufunc gives for arguments of which some may be masked. Where an output is given, it is the result: its mask is
    set if it has one."""
    inputs, places = arguments[:ufunc.nin], arguments[ufunc.nin:]
    given = keywords.get("out", ())
    places += given if isinstance(given, tuple) else (given,)
    are_masked = any(isinstance(one, np.ma.MaskedArray) for one in (*inputs, *places))
    if not are_masked or len(arguments) > ufunc.nin and "out" in keywords:  # which NumPy refuses
        return ufunc(*arguments, **keywords)
    axes = _core_axes(ufunc, keywords.get("axes"), keywords.get("axis"))
    places += (None,) * (ufunc.nout - len(places))
    bare = tuple(None if one is None else np.ma.getdata(one) for one in places)
    results = ufunc(*map(np.ma.getdata, inputs), **{**keywords, "out": bare})
    mask = _mask_of_points(inputs, axes[:ufunc.nin])
    made = []
    for result, place, core in zip(results if ufunc.nout > 1 else (results,), places, axes[ufunc.nin:], strict=True):
        if place is None:
            place = _with_mask(result, mask, core)
        elif isinstance(place, np.ma.MaskedArray):
            place.mask = np.ma.getmaskarray(_with_mask(result, mask, core))
        made.append(place)
    return tuple(made) if ufunc.nout > 1 else made[0]
