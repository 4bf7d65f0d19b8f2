# SPDX-License-Identifier: MIT
"""How far one picture is from another: errors, SSIM, FLIP, weights by solid angle, points spread over the sphere.

Pictures are arrays (rows, columns[, channels]) of uint8, uint16, float16 or float32; whole numbers are 0 to 1.

>>> one = np.full((4, 8), 100, np.uint8)
>>> other = one + np.uint8(51)
>>> figures = cubemap.compare_errors(one, other, weights=cubemap.equirect_weights(8, 4))
>>> round(figures.rmse, 6), round(figures.psnr, 2)
(0.2, 13.98)
"""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from ._masked_pictures import unmasked
from ._texts import Changing, created, number_of, struct
from .images import PIXEL_TYPES
from .mapping import Mapping, mapping_of

NOT_FINITE_COMPARED = ("refuse", "skip", "alike")


class ErrorFigures(NamedTuple):
    """Of errors: cubemap/compare.h says what each member is."""

    pixels: int
    not_finite: int
    weight: float
    mse: float
    rmse: float
    mean_absolute: float
    mean_signed: float
    largest: float
    largest_row: int
    largest_column: int
    largest_channel: int
    peak: float
    psnr: float


class MapFigures(NamedTuple):
    """Of a measure with windows: cubemap/compare.h says what each member is."""

    pixels: int
    not_finite: int
    weight: float
    mean: float
    lowest: float
    highest: float
    lowest_column: int
    lowest_row: int
    highest_column: int
    highest_row: int
    exposure_start: float
    exposure_stop: float
    exposure_count: int


def _image(picture):
    """A struct for one picture, and the dense array that it points into."""
    picture = np.ascontiguousarray(unmasked(picture, "picture"))
    if picture.dtype.name not in PIXEL_TYPES:
        raise TypeError(f"picture: {', '.join(PIXEL_TYPES)}, not {picture.dtype}")
    if picture.ndim not in (2, 3) or 0 in picture.shape:
        raise ValueError(f"picture: (rows, columns[, channels]), not {picture.shape}")
    channels = picture.shape[2] if picture.ndim == 3 else 1
    made = struct(library.cm_image, data=picture.ctypes.data, type=PIXEL_TYPES.index(picture.dtype.name), width=picture.shape[1],
                  height=picture.shape[0], channels=channels)
    return made, picture


def _options(weights, border, not_finite, peak, threads, **more):
    """Options and what they point to."""
    made = struct(library.cm_compare_options, border=border, not_finite=number_of(not_finite, NOT_FINITE_COMPARED, "not_finite"), peak=peak,
                  threads=threads, **more)
    kept = None
    if weights is not None:
        weights = np.asarray(weights, np.float32)
        kept = _image(weights[:, np.newaxis] if weights.ndim == 1 else weights)
        made.weights = ctypes.pointer(kept[0])
    return made, kept


def _figures(kind, figures):
    return kind(*(getattr(figures, name) for name in kind._fields))


def compare_errors(reference: ArrayLike, picture: ArrayLike, *, weights: ArrayLike | None = None, border: int = 0,
                   not_finite: str = "refuse", peak: float = 0.0, threads: int = 1) -> ErrorFigures:
    """Errors of a picture, over all channels, as ErrorFigures.

    weights      of pixels, or a number for each row: those of equirect_weights make psnr WS-PSNR
    border       pixels at all edges that do not count
    not_finite   "refuse", "skip" or "alike"
    peak         the greatest value that there can be; 0: 1 for whole numbers, else the reference's greatest
    """
    (one, _kept), (other, _also) = _image(reference), _image(picture)
    options, _weights = _options(weights, border, not_finite, peak, threads)
    figures = struct(library.cm_error_figures)
    library.cm_compare_errors(ctypes.byref(one), ctypes.byref(other), ctypes.byref(options), ctypes.byref(figures))
    return _figures(ErrorFigures, figures)


def compare_values(reference: ArrayLike, picture: ArrayLike, *, weights: ArrayLike | None = None,
                   not_finite: str = "refuse", peak: float = 0.0, threads: int = 1) -> ErrorFigures:
    """Errors of values at points, (n[, channels]) of float32, as ErrorFigures: at sphere_points, psnr is S-PSNR."""
    one, other = (np.ascontiguousarray(unmasked(values, "values"), np.float32) for values in (reference, picture))
    if one.shape != other.shape or one.ndim not in (1, 2):
        raise ValueError(f"values: two of (n[, channels]), not {one.shape} and {other.shape}")
    weights = None if weights is None else np.asarray(weights, np.float32)[np.newaxis, :]
    options, _weights = _options(weights, 0, not_finite, peak, threads)
    figures = struct(library.cm_error_figures)
    library.cm_compare_values(len(one), one.shape[1] if one.ndim == 2 else 1, one.ctypes.data, other.ctypes.data,
                              ctypes.byref(options), ctypes.byref(figures))
    return _figures(ErrorFigures, figures)


class Errors(Changing):
    """Errors of pictures that come in rows: add blocks from the top, then ask for figures.

    >>> errors = cubemap.Errors(1)
    >>> errors.add(np.zeros((2, 4), np.float32), np.full((2, 4), 0.5, np.float32))
    >>> errors.get().mean_absolute
    0.5
    """

    def __init__(self, channels: int, *, not_finite: str = "refuse", peak: float = 0.0) -> None:
        options, _ = _options(None, 0, not_finite, peak, 1)
        self._handle = created(library.cm_errors_create, "cm_errors_destroy", channels, ctypes.byref(options))

    def __repr__(self):
        return f"<cubemap.Errors of {self.get().pixels} pixels>"

    def add(self, reference: ArrayLike, picture: ArrayLike, weights: ArrayLike | None = None) -> None:
        """The next rows, and their weights."""
        (one, _kept), (other, _also) = _image(reference), _image(picture)
        made = None
        if weights is not None:
            weights = np.asarray(weights, np.float32)
            made = _image(weights[:, np.newaxis] if weights.ndim == 1 else weights)
        library.cm_errors_add(self._handle, ctypes.byref(one), ctypes.byref(other), ctypes.byref(made[0]) if made else None)

    def get(self, channel: int | None = None) -> ErrorFigures:
        """What was found so far, of one channel or of all, as ErrorFigures."""
        figures = struct(library.cm_error_figures)
        library.cm_errors_get(self._handle, 2**32 - 1 if channel is None else channel, ctypes.byref(figures))
        return _figures(ErrorFigures, figures)


def _mapped(function, reference, picture, options, *more):
    (one, kept), (other, _also) = _image(reference), _image(picture)
    values = np.empty(kept.shape[:2], np.float32)
    to, _map = _image(values)
    figures = struct(library.cm_map_figures)
    function(ctypes.byref(one), ctypes.byref(other), ctypes.byref(options), ctypes.byref(figures), ctypes.byref(to), *more)
    return _figures(MapFigures, figures), values


def ssim(reference: ArrayLike, picture: ArrayLike, *, weights: ArrayLike | None = None, border: int = 0,
         not_finite: str = "refuse", peak: float = 0.0, threads: int = 1) -> tuple[MapFigures, np.ndarray]:
    """Structural similarity: MapFigures, and the map of it."""
    options, _weights = _options(weights, border, not_finite, peak, threads)
    return _mapped(library.cm_ssim, reference, picture, options, None)


def flip(reference: ArrayLike, picture: ArrayLike, *, weights: ArrayLike | None = None, border: int = 0,
         not_finite: str = "refuse", pixels_per_degree: float = 0.0, linear: bool = False,
         threads: int = 1) -> tuple[MapFigures, np.ndarray]:
    """FLIP, what is seen when two pictures take turns: MapFigures, and the map of it."""
    options, _weights = _options(weights, border, not_finite, 0.0, threads, pixels_per_degree=pixels_per_degree, linear=bool(linear))
    return _mapped(library.cm_flip, reference, picture, options)


def flip_hdr(reference: ArrayLike, picture: ArrayLike, *, weights: ArrayLike | None = None, border: int = 0,
             not_finite: str = "refuse", pixels_per_degree: float = 0.0,
             exposures: tuple[float, float, int] | None = None, threads: int = 1) -> tuple[MapFigures, np.ndarray]:
    """HDR-FLIP of linear light: MapFigures, and the map of it. exposures: start, stop and how many; without it the reference tells."""
    start, stop, count = exposures or (0.0, 0.0, 0)
    options, _weights = _options(weights, border, not_finite, 0.0, threads, pixels_per_degree=pixels_per_degree, exposure_start=start,
                                 exposure_stop=stop, exposure_count=count)
    return _mapped(library.cm_flip_hdr, reference, picture, options)


def difference_map(reference: ArrayLike, picture: ArrayLike, *, threads: int = 1) -> np.ndarray:
    """The greatest error over the channels of each pixel."""
    (one, kept), (other, _also) = _image(reference), _image(picture)
    values = np.empty(kept.shape[:2], np.float32)
    to, _map = _image(values)
    library.cm_difference_map(ctypes.byref(one), ctypes.byref(other), threads, ctypes.byref(to))
    return values


def equirect_weights(width: int, height: int) -> np.ndarray:
    """The solid angle of each pixel of the rows of an equirectangular picture."""
    weights = np.empty(height, np.float32)
    library.cm_equirect_weights(width, height, weights.ctypes.data)
    return weights


def face_weights(mapping: str | Mapping, edge: int, face: int = 0, *, threads: int = 1) -> np.ndarray:
    """The solid angle of each pixel of a face, rows from v = -1."""
    weights = np.empty((edge, edge), np.float32)
    library.cm_face_weights(mapping_of(mapping)._handle, face, edge, threads, weights.ctypes.data)
    return weights


def sphere_points(n: int, first: int = 0, count: int | None = None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points of n that are evenly spread over the sphere: x, y, z."""
    count = n - first if count is None else count
    x, y, z = np.empty((3, max(count, 0)))
    library.cm_sphere_points(n, first, count, x.ctypes.data, y.ctypes.data, z.ctypes.data)
    return x, y, z
