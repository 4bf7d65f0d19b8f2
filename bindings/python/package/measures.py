# SPDX-License-Identifier: MIT
"""What a mapping costs in distortion, and how to turn the cube so that what counts suffers least.

>>> found = cubemap.statistics("seamless", "area")
>>> round(found.mean, 6), round(found.maximum / found.minimum, 6)
(1.0, 1.0)
>>> cubemap.advise_size("coupled", np.radians(0.1)).pixels
1093
>>> land = np.zeros((90, 180), np.float32)
>>> land[20:40, 60:120] = 1
>>> one, other = (cubemap.orient_value("coupled", land, rotation) for rotation in ("0,0,0", "0,30,0"))
>>> one == other
False
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from ._errors import Error
from ._masked_pictures import unmasked
from ._texts import number_of, struct, words_of
from .earth import LATITUDES, Ellipsoid, Rotation, ellipsoid_of
from .mapping import Mapping, mapping_of

QUANTITIES = words_of(library.cm_quantity_name)
ORIENT_MEASURES = words_of(library.cm_orient_measure_name)
OVER = ("face", "sphere")
PRECISIONS = words_of(library.cm_precision_name)


class Statistics(NamedTuple):
    """Of a quantity: cubemap/statistics.h says what each member is."""

    ideal: float
    mean: float
    mean_error: float
    rmse: float
    rmse_error: float
    minimum: float
    maximum: float
    maximum_error: float
    ratio: float
    minimum_face: int
    maximum_face: int
    minimum_uv: tuple
    maximum_uv: tuple
    evaluations: int


def _options(over, faces, pixels=0, tolerance=0.0):
    bits = 0
    for face in range(6) if faces is None else faces:
        if not 0 <= face <= 5:
            raise Error(library.CM_ERROR_ARGUMENT, f"faces: 0 to 5, not {face}")
        bits |= 1 << face
    if bits == 0:  # which is all of them for the library
        raise Error(library.CM_ERROR_ARGUMENT, "faces: there are none")
    return struct(library.cm_statistics_options, measure=number_of(over, OVER, "over"), faces=bits, pixels=pixels, tolerance=tolerance)


def statistics(mapping: str | Mapping, quantity: str = "area", *, over: str = "face",
               faces: Iterable[int] | None = None, pixels: int = 0, tolerance: float = 0.0) -> Statistics:
    """Mean, root mean square error and extremes of a quantity over a mapping to six faces.

    quantity    of QUANTITIES
    over        "face": equal areas of the map count alike; "sphere": equal areas of the sphere
    pixels      the sums over so many pixels along an edge; 0 for quadrature to a tolerance
    """
    found = struct(library.cm_statistics)
    options = _options(over, faces, pixels, tolerance)
    library.cm_distortion_statistics(mapping_of(mapping)._handle, number_of(quantity, QUANTITIES, "quantity"),
                                     ctypes.byref(options), ctypes.byref(found))
    values = (getattr(found, name) for name in Statistics._fields)
    return Statistics(*(tuple(value) if isinstance(value, ctypes.Array) else value for value in values))


def percentiles(mapping: str | Mapping, quantity: str, percent: ArrayLike, *, over: str = "face",
                faces: Iterable[int] | None = None) -> tuple[np.ndarray, np.ndarray]:
    """The values below which so many percent of the face or sphere have the quantity, and how far each is in doubt."""
    percent = np.asarray(percent, np.float64, order="C")
    value, doubt = np.empty_like(percent), np.empty_like(percent)
    options = _options(over, faces)
    library.cm_distortion_percentiles(mapping_of(mapping)._handle, number_of(quantity, QUANTITIES, "quantity"),
                                      ctypes.byref(options), percent.size, percent.ctypes.data, value.ctypes.data, doubt.ctypes.data)
    return value[()], doubt[()]


class Orient(NamedTuple):
    """The best orientation: cubemap/orient.h says what each member is. rivals are (Rotation, value)."""

    rotation: Rotation
    angles: tuple
    before: float
    after: float
    gap: float
    radius: float
    symmetries: int
    rivals: tuple


def _mask_options(mask, measure, over, resolution, threads, boxes_max):
    mask = np.ascontiguousarray(unmasked(mask, "mask"), np.float32)
    if mask.ndim != 2:
        raise ValueError(f"mask: rows and columns, not {mask.shape}")
    raster = struct(library.cm_mask, width=mask.shape[1], height=mask.shape[0], value=mask.ctypes.data)
    options = struct(library.cm_orient_options, measure=number_of(measure, ORIENT_MEASURES, "measure"), over=number_of(over, OVER, "over"),
                     resolution=resolution, threads=threads, boxes_max=boxes_max)
    return mask, raster, options


def orient(mapping: str | Mapping, mask: ArrayLike, measure: str = "deformation", *, over: str = "face",
           resolution: float = 0.0, threads: int = 1, boxes_max: int = 0) -> Orient:
    """The rotation of the cube for which a mask suffers least.

    mask         rows from the north pole, columns from longitude -180: how much each pixel of the sphere counts
    measure      of ORIENT_MEASURES
    resolution   degrees to which the best rotation is followed; 0: 0.1
    """
    mask, raster, options = _mask_options(mask, measure, over, resolution, threads, boxes_max)
    found = struct(library.cm_orient_result)
    library.cm_orient(mapping_of(mapping)._handle, ctypes.byref(raster), ctypes.byref(options), ctypes.byref(found))
    rivals = tuple((Rotation(np.array(one.rotation.row)), one.value) for one in found.rival[:found.rival_count])
    return Orient(Rotation(np.array(found.rotation.row)), (found.lon, found.lat, found.roll), found.before, found.after, found.gap,
                  found.radius, found.symmetries, rivals)


def orient_value(mapping: str | Mapping, mask: ArrayLike, rotation: str | Rotation, measure: str = "deformation", *,
                 over: str = "face", threads: int = 1) -> float:
    """The measure of a mask in a given orientation."""
    mask, raster, options = _mask_options(mask, measure, over, 0.0, threads, 0)
    rotation = rotation if isinstance(rotation, Rotation) else Rotation(rotation)
    value = ctypes.c_double()
    library.cm_orient_value(mapping_of(mapping)._handle, ctypes.byref(raster), ctypes.byref(options), rotation._pointer(),
                            ctypes.byref(value))
    return value.value


class FaceSize(NamedTuple):
    """How large a face is to be: cubemap/advise.h says what each member is."""

    pixels: int
    coarsest: float
    power: int
    cheaper: int
    cheaper_coarsest: float
    cheaper_share: float
    mean_pixels: int


def advise_size(mapping: str | Mapping, angle: float) -> FaceSize:
    """How many pixels a face must have so that none is coarser than an angle, radians."""
    found = struct(library.cm_advice_size)
    library.cm_advise_size(mapping_of(mapping)._handle, angle, ctypes.byref(found))
    return FaceSize(*(getattr(found, name) for name in FaceSize._fields))


class Precision(NamedTuple):
    """Which precision is enough, and its bound of a round trip on Earth, metres."""

    precision: str
    error: float
    cheaper_error: float


def advise_precision(mapping: str | Mapping, metres: float) -> Precision:
    """Whether float is enough for an error on Earth."""
    found = struct(library.cm_advice_precision)
    library.cm_advise_precision(mapping_of(mapping)._handle, metres, ctypes.byref(found))
    return Precision(PRECISIONS[found.precision], found.error, found.cheaper_error)


class Terms(NamedTuple):
    """How many terms a latitude's series takes: cubemap/advise.h says what each member is."""

    tolerance: float
    terms: int
    error: float
    cheaper_terms: int
    cheaper_error: float


def advise_terms(source: str, target: str, metres: float, ellipsoid: str | Ellipsoid = "WGS84") -> Terms:
    """How many terms a latitude takes for an error along the meridian."""
    found = struct(library.cm_advice_terms)
    library.cm_advise_terms(ctypes.byref(ellipsoid_of(ellipsoid)._struct), number_of(source, LATITUDES, "source"),
                            number_of(target, LATITUDES, "target"), metres, ctypes.byref(found))
    return Terms(*(getattr(found, name) for name in Terms._fields))
