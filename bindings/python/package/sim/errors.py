# SPDX-License-Identifier: MIT
"""How far depth is from ground truth. Depth and truth are float32 of one shape, and other numbers are rounded to that; what is
finite and above 0 is measured.

>>> truth = np.full((4, 4), 2.0, np.float32)
>>> depth = truth + np.float32(0.5)
>>> depth[0, 0] = np.nan
>>> found = cubemap.sim.depth_error(depth, truth)
>>> found.count, found.missing, found.bias
(15, 1, 0.5)
>>> cubemap.sim.depth_error_quantiles(depth, truth, [0.0, 1.0]).tolist()
[0.5, 0.5]
"""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _library as library
from .. import _methods
from .._texts import number_of, struct
from ._dense import address, dense, measured, pair, planes

SPARSIFICATION_MEASURES = ("mae", "rmse")
_Three = ctypes.c_void_p * 3


class DepthError(NamedTuple):
    """Of all pixels at once: cubemap/depth_error.h says what each member is."""

    count: int
    missing: int
    extra: int
    bias: float
    mae: float
    deviation: float
    mse: float
    rmse: float
    median: float
    median_absolute: float
    maximum: float


class DepthPlane(NamedTuple):
    """A plane through points, and how they leave it: cubemap/depth_error.h says what each member is."""

    count: int
    normal: np.ndarray
    distance: float
    centre: np.ndarray
    rms: float
    maximum: float
    curvature: np.ndarray


class DepthEdges(NamedTuple):
    """How edges of depth were found: cubemap/depth_error.h says what each member is."""

    measured: int
    true_ones: int
    right: int
    found: int
    precision: float
    recall: float


class Sparsification(NamedTuple):
    """The error of what is left, the oracle's, and the area between both over all fractions."""

    error: np.ndarray
    oracle: np.ndarray
    area: float


def _read(kind, made):
    """A struct's members as a named tuple; arrays are copied."""
    values = (getattr(made, name) for name in kind._fields)
    return kind(*(np.array(value) if isinstance(value, ctypes.Array) else value for value in values))


def depth_error_local(depth: ArrayLike, truth: ArrayLike) -> np.ndarray:
    """The error of each pixel, depth - truth; NaN where it does not count."""
    return _methods.depth_error_local(*pair(depth, truth))


def depth_error(depth: ArrayLike, truth: ArrayLike) -> DepthError:
    """The errors of all pixels at once."""
    depth, truth = pair(depth, truth)
    found = struct(library.cm_depth_error)
    library.cm_depth_error_measure(depth.size, depth.ctypes.data, truth.ctypes.data, ctypes.byref(found))
    return _read(DepthError, found)


def _at(measure, depth, truth, places):
    """What a function says of depth and truth at several numbers."""
    depth, truth = pair(depth, truth)
    places = np.asarray(places, np.float64)
    given = np.ascontiguousarray(places.reshape(-1))
    found = np.empty_like(given)
    measure(depth.size, depth.ctypes.data, truth.ctypes.data, given.size, given.ctypes.data, found.ctypes.data)
    return found.reshape(places.shape)[()]


def depth_error_quantiles(depth: ArrayLike, truth: ArrayLike, fraction: ArrayLike) -> np.ndarray:
    """Quantiles of the endpoint error for fractions from 0, the least, to 1, the greatest."""
    return _at(library.cm_depth_error_quantiles, depth, truth, fraction)


def depth_error_bad(depth: ArrayLike, truth: ArrayLike, limit: ArrayLike) -> np.ndarray:
    """The part of pixels whose endpoint error is above each limit, of those that truth has."""
    return _at(library.cm_depth_error_bad, depth, truth, limit)


def depth_error_temporal(depth: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Mean and standard deviation over frames, (frames, ...), of what each pixel has measured."""
    depth = np.ascontiguousarray(measured(depth), np.float32)
    mean, deviation = (np.empty(depth.shape[1:], np.float32) for _ in range(2))
    library.cm_depth_error_temporal(len(depth), mean.size, depth.ctypes.data, mean.ctypes.data, deviation.ctypes.data)
    return mean, deviation


def depth_error_slope(normal: ArrayLike, truth: ArrayLike) -> np.ndarray:
    """The angle between normals (..., 3) and the true ones; NaN where one is none."""
    return _methods.depth_error_slope(normal, truth)


def depth_error_plane(points: ArrayLike) -> DepthPlane:
    """The best plane through points (..., 3), by least squares of distances."""
    three = planes(points, "points")
    found = struct(library.cm_depth_plane)
    library.cm_depth_error_plane(three[0].size, _Three(*(one.ctypes.data for one in three)), ctypes.byref(found))
    return _read(DepthPlane, found)


def depth_error_edges(depth: ArrayLike, truth: ArrayLike, gap: float = 0.05, reach: int = 1) -> DepthEdges:
    """Edges, where neighbours differ by more than gap of the nearer one, that have one of the other picture within
    reach pixels."""
    depth = dense(measured(depth), "depth", (None, None))
    truth = dense(measured(truth), "truth", depth.shape)
    found = struct(library.cm_depth_edges)
    library.cm_depth_error_edges(depth.shape[1], depth.shape[0], depth.ctypes.data, truth.ctypes.data, gap, reach,
                                 ctypes.byref(found))
    return _read(DepthEdges, found)


def depth_error_sparsify(depth: ArrayLike, truth: ArrayLike, confidence: ArrayLike, fraction: ArrayLike, *,
                         measure: str = "mae") -> Sparsification:
    """The error that is left when these fractions of the pixels with the least confidence are removed, and the
    oracle's; measure is of SPARSIFICATION_MEASURES."""
    depth, truth = pair(depth, truth)
    confidence = dense(confidence, "confidence", depth.shape)
    fraction = dense(fraction, "fraction", (None,), np.float64)
    error, oracle, area = np.empty_like(fraction), np.empty_like(fraction), ctypes.c_double()
    library.cm_depth_error_sparsify(depth.size, *map(address, (depth, truth, confidence)),
                                    number_of(measure, SPARSIFICATION_MEASURES, "measure"), fraction.size,
                                    *map(address, (fraction, error, oracle)), ctypes.byref(area))
    return Sparsification(error, oracle, area.value)
