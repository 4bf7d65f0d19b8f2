# SPDX-License-Identifier: MIT
"""Arrays as the library reads and writes them: dense, of float32."""

import numpy as np

from .._masked_pictures import filled, is_masked, unmasked


def dense(values, name, shape, dtype=np.float32):
    """Dense numbers of a shape, in which None is any extent."""
    made = np.ascontiguousarray(unmasked(values, name), dtype)
    if made.ndim != len(shape) or any(want not in (None, has) for want, has in zip(shape, made.shape)):
        shown = ", ".join("any" if extent is None else str(extent) for extent in shape)
        raise ValueError(f"{name}: an array of ({shown}), not {made.shape}")
    return made


def measured(depth):
    """Depths, of which what is masked was not measured: NaN."""
    return filled(depth.astype(np.float32)) if is_masked(depth) else depth


def pair(depth, truth):
    """Depth and truth, of any and the same shape."""
    depth, truth = (np.ascontiguousarray(measured(one), np.float32) for one in (depth, truth))
    if depth.shape != truth.shape:
        raise ValueError(f"truth: of the depth's shape, {depth.shape}, not {truth.shape}")
    return depth, truth


def planes(points, name):
    """Points (..., 3) as three dense arrays."""
    points = np.asarray(unmasked(points, name), np.float32)
    if points.shape[-1:] != (3,):
        raise ValueError(f"{name}: (..., 3), not {points.shape}")
    return np.require(np.moveaxis(points, -1, 0).reshape(3, *(points.shape[:-1] or (1,))), requirements="C")


def set_planes(members, planes):
    """The members of a struct that are three pointers, or two, to these planes."""
    for k, plane in enumerate(planes):
        members[k] = plane.ctypes.data


def address(array):
    """Where an array is; None stays None."""
    return None if array is None else array.ctypes.data
