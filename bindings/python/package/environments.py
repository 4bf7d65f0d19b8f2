# SPDX-License-Identifier: MIT
"""Environments for renderers: spherical harmonics, irradiance, levels prefiltered by GGX.

Coefficients are arrays ((degree + 1)^2, channels): that of degree l and order m stands at l (l + 1) + m.

>>> coefficients = np.zeros((4, 1))
>>> coefficients[0] = np.sqrt(4 * np.pi)  # 1 everywhere
>>> cubemap.harmonics_evaluate(coefficients, 0.0, 0.0, 1.0).round(12).tolist()
[[1.0]]
>>> cubemap.harmonics_cosine_lobe(2).round(6).tolist()
[3.141593, 2.094395, 0.785398]
"""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from . import _library as library
from ._masked_pictures import unmasked
from ._texts import Changing, created, number_of, string_of, struct
from .earth import Rotation
from .images import PIXEL_TYPES
from .mapping import Mapping, checked_threads, mapping_of

WINDOWS = ("none", "hanning", "lanczos")


def _coefficients(values):
    """Dense coefficients, their degree and their channels."""
    values = np.ascontiguousarray(values, np.float64)
    values = values[:, np.newaxis] if values.ndim == 1 else values
    degree = int(np.sqrt(len(values))) - 1
    if values.ndim != 2 or (degree + 1) ** 2 != len(values) or degree < 0:
        raise ValueError(f"coefficients: ((degree + 1)^2, channels), not {values.shape}")
    return values, degree, values.shape[1]


def _directions(x, y, z):
    return [np.ascontiguousarray(one, np.float64) for one in np.broadcast_arrays(x, y, z)]


def harmonics_basis(degree: int, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> np.ndarray:
    """The values of the basis in directions: (..., (degree + 1)^2)."""
    x, y, z = _directions(x, y, z)
    value = np.empty((*x.shape, (degree + 1) ** 2))
    library.cm_harmonics_basis(degree, x.size, x.ctypes.data, y.ctypes.data, z.ctypes.data, value.ctypes.data)
    return value


def harmonics_evaluate(coefficients: ArrayLike, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> np.ndarray:
    """The sum of coefficients times basis in directions: (..., channels)."""
    values, degree, channels = _coefficients(coefficients)
    x, y, z = _directions(x, y, z)
    value = np.empty((*x.shape, channels))
    library.cm_harmonics_evaluate(degree, channels, values.ctypes.data, x.size, x.ctypes.data, y.ctypes.data, z.ctypes.data,
                                  value.ctypes.data)
    return value


def _factors(function, degree, *before):
    factor = np.empty(degree + 1)
    function(*before, factor.ctypes.data)
    return factor


def harmonics_cosine_lobe(degree: int) -> np.ndarray:
    """Factors of degrees that make irradiance of radiance."""
    return _factors(library.cm_harmonics_cosine_lobe, degree, degree)


def harmonics_ggx_lobe(degree: int, roughness: float) -> np.ndarray:
    """Factors of degrees of the lobe of a roughness."""
    return _factors(library.cm_harmonics_ggx_lobe, degree, degree, roughness)


def harmonics_window_factors(window: str, width: float, degree: int) -> np.ndarray:
    """Factors of degrees of a window, of "none", "hanning" and "lanczos"."""
    return _factors(library.cm_harmonics_window_factors, degree, number_of(window, WINDOWS, "window"), width, degree)


def harmonics_scale(coefficients: ArrayLike, factor: ArrayLike) -> np.ndarray:
    """Coefficients whose degrees are multiplied by factors."""
    values, degree, channels = _coefficients(coefficients)
    values, factor = values.copy(), np.ascontiguousarray(factor, np.float64)
    if factor.shape != (degree + 1,):
        raise ValueError(f"factor: {degree + 1} numbers, not {factor.shape}")
    library.cm_harmonics_scale(degree, channels, factor.ctypes.data, values.ctypes.data)
    return values


def harmonics_rotate(coefficients: ArrayLike, rotation: str | Rotation) -> np.ndarray:
    """Coefficients of the function turned: its value in the direction rotation.apply(d) is that of the given one in d."""
    values, degree, channels = _coefficients(coefficients)
    rotation = rotation if isinstance(rotation, Rotation) else Rotation(rotation)
    to = np.empty_like(values)
    library.cm_harmonics_rotate(degree, channels, rotation._pointer(), values.ctypes.data, to.ctypes.data)
    return to


def harmonics_json(coefficients: ArrayLike) -> str:
    """Coefficients as JSON text."""
    values, degree, channels = _coefficients(coefficients)
    return string_of(lambda text, size, length: library.cm_harmonics_json(degree, channels, values.ctypes.data, text, size, length))


def _faces(pictures):
    """Structs of six pictures, (6, edge, edge[, channels]), and the dense array that they point into."""
    pictures = np.ascontiguousarray(unmasked(pictures, "pictures"))
    stacked = pictures if pictures.ndim == 4 else pictures[..., np.newaxis]
    if stacked.ndim != 4 or stacked.shape[0] != 6:
        raise ValueError(f"pictures: (6, edge, edge[, channels]), not {pictures.shape}")
    if stacked.dtype.name not in PIXEL_TYPES:
        raise TypeError(f"pictures: {', '.join(PIXEL_TYPES)}, not {stacked.dtype}")
    images = (library.cm_image * 6)()
    for image, picture in zip(images, stacked, strict=True):
        image.size, image.data, image.type = ctypes.sizeof(library.cm_image), picture.ctypes.data, PIXEL_TYPES.index(picture.dtype.name)
        image.height, image.width, image.channels = picture.shape
    return images, stacked


def harmonics_faces(coefficients: ArrayLike, mapping: str | Mapping, edge: int, *, dtype: DTypeLike = np.float32,
                    threads: int = 1) -> np.ndarray:
    """The sum in every pixel's centre of six faces: (6, edge, edge, channels)."""
    values, degree, channels = _coefficients(coefficients)
    images, faces = _faces(np.zeros((6, edge, edge, channels), dtype))
    library.cm_harmonics_faces(degree, channels, values.ctypes.data, mapping_of(mapping)._handle, threads, images)
    return faces


def texel_solid_angles(mapping: str | Mapping, edge: int) -> np.ndarray:
    """The solid angle of each pixel of six faces: (6, edge, edge)."""
    angles = np.empty((6, edge, edge))
    for face in range(6):
        library.cm_texel_solid_angles(mapping_of(mapping)._handle, face, edge, angles[face].ctypes.data)
    return angles


class Environment(Changing):
    """Six faces of linear light, (6, edge, edge[, channels]), as renderers need them.

    e.project(8) are coefficients, e.prefilter(0.3, "coupled", 64) a level for a roughness.

    >>> sky = cubemap.Environment("coupled", np.full((6, 16, 16, 3), 0.5, np.float32))
    >>> sky.size, sky.channels, sky.level_count
    (16, 3, 5)
    >>> round(sky.irradiance("coupled", 2)[0, 0, 0, 0].item(), 4)
    1.5708
    """

    def __init__(self, mapping: str | Mapping, faces: ArrayLike, *, threads: int = 1) -> None:
        images, kept = _faces(faces)
        mapping = mapping_of(mapping)._handle
        self._threads = checked_threads(threads)
        self._handle = created(library.cm_environment_create, "cm_environment_destroy", mapping, images, self._threads,
                               keep=(mapping, images, kept))

    def __repr__(self):
        return f"<cubemap.Environment of {self.size} x {self.size} pixels a face, {self.channels} channels>"

    @property
    def size(self) -> int:
        """The edge of a face in pixels."""
        return library.cm_environment_size(self._handle)

    @property
    def channels(self) -> int:
        """The channels of a pixel."""
        return library.cm_environment_channels(self._handle)

    @property
    def level_count(self) -> int:
        """The levels of its pyramid."""
        return library.cm_environment_level_count(self._handle)

    def project(self, degree: int) -> np.ndarray:
        """The coefficients up to a degree."""
        coefficients = np.empty(((degree + 1) ** 2, self.channels))
        library.cm_environment_project(self._handle, degree, self._threads, coefficients.ctypes.data)
        return coefficients

    def irradiance(self, mapping: str | Mapping, edge: int, *, dtype: DTypeLike = np.float32) -> np.ndarray:
        """Irradiance in every pixel of faces, from every pixel of the environment; the fast way is by coefficients."""
        images, faces = _faces(np.zeros((6, edge, edge, self.channels), dtype))
        library.cm_environment_irradiance(self._handle, mapping_of(mapping)._handle, self._threads, images)
        return faces

    def prefilter(self, roughness: float, mapping: str | Mapping, edge: int, *,
                  dtype: DTypeLike = np.float32) -> np.ndarray:
        """The mean over the lobe of GGX at a roughness, in every pixel of faces."""
        images, faces = _faces(np.zeros((6, edge, edge, self.channels), dtype))
        options = struct(library.cm_prefilter_options, threads=self._threads)
        library.cm_environment_prefilter(self._handle, roughness, ctypes.byref(options), mapping_of(mapping)._handle, images)
        return faces


def brdf_table(width: int, height: int, *, shadowing: str = "correlated", channels: int = 2,
               dtype: DTypeLike = np.float32, threads: int = 1) -> np.ndarray:
    """The table of the split sum, (height, width, channels): rows are roughness, columns the cosine of view and normal.

    shadowing   "correlated" or "schlick"
    channels    2: scale and bias; 3: and what single reflections lose
    """
    table = np.zeros((height, width, channels), dtype)
    if table.dtype.name not in PIXEL_TYPES:
        raise TypeError(f"dtype: {', '.join(PIXEL_TYPES)}, not {table.dtype}")
    image = struct(library.cm_image, data=table.ctypes.data, type=PIXEL_TYPES.index(table.dtype.name), width=width, height=height,
                   channels=channels)
    library.cm_brdf_table(number_of(shadowing, ("correlated", "schlick"), "shadowing"), checked_threads(threads), ctypes.byref(image))
    return table
