# SPDX-License-Identifier: MIT
"""HEALPix pixels.

>>> pixels = cubemap.Healpix(1024)
>>> pixel = pixels.pixel_from_direction(1.0, 0.2, 0.3)
>>> pixel
4511872
>>> np.round(pixels.direction_from_pixel(pixel), 3).tolist()
[0.941, 0.188, 0.283]
"""

from __future__ import annotations

import ctypes
import operator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from . import _library as library
from ._errors import Error, in_words
from ._methods import HealpixMethods
from ._texts import Specified, created, handle_of, number_of, struct
from .mapping import checked_threads, options_of

ORDERS = ("ring", "nested")
UNSEEN = -1.6375e30
NO_PIXEL = -1


class Ring(NamedTuple):
    """A ring of pixels: cubemap/healpix.h says what each member is."""

    ring: int
    first: int
    count: int
    z: float
    rho: float
    is_shifted: bool


class Healpix(HealpixMethods, Specified):
    """A resolution of HEALPix in an order: Healpix(1024), Healpix(1024, "nested").

    What is no point is in the pixel -1, and what is no pixel has the centre NaN. theta is the colatitude; radians.

    >>> h = cubemap.Healpix(64, "nested")
    >>> h.pixel_count, h.boundary(0, 2).shape
    (49152, (8, 3))
    >>> values = np.arange(h.pixel_count, dtype=float)
    >>> h.regrade(values, cubemap.Healpix(1, "nested"))[:2].tolist()
    [2047.5, 6143.5]
    """

    _standard = {"order": "ring", "instructions": None, "threads": 1}

    def __init__(self, nside: int, order: str = "ring", *, instructions: str | None = None, threads: int = 1) -> None:
        nside, which = operator.index(nside), number_of(order, ORDERS, "order")
        if not -2**63 <= nside < 2**63:
            raise Error(library.CM_ERROR_PIXEL, f"nside: 1 to 2^29, not {nside}")
        in_words(library.cm_healpix_check, nside, which)
        options = options_of(instructions, "exact")
        self._handle = created(library.cm_healpix_create, "cm_healpix_destroy", nside, which, ctypes.byref(options))
        self._given = (nside, order, instructions)
        self._threads = checked_threads(threads)

    def _arguments(self):
        return dict(zip(("nside", "order", "instructions", "threads"), (*self._given, self._threads), strict=True))

    def _same(self):
        return self.nside, self.order, self.instructions

    @property
    def nside(self) -> int:
        """The pixels along the edge of a base pixel."""
        return library.cm_healpix_nside(self._handle)

    @property
    def order(self) -> str:
        """"ring" or "nested"."""
        return ORDERS[library.cm_healpix_order_of(self._handle)]

    @property
    def instructions(self) -> str:
        """The instruction set that is used."""
        return library.cm_healpix_instructions(self._handle).decode()

    @property
    def pixel_count(self) -> int:
        """12 nside^2."""
        return library.cm_healpix_pixel_count(self._handle)

    @property
    def ring_count(self) -> int:
        """4 nside - 1."""
        return library.cm_healpix_ring_count(self._handle)

    def boundary(self, pixel: int, steps: int = 1) -> np.ndarray:
        """4 steps unit directions of a pixel's boundary, from the north corner by the west: (4 steps, 3), beside each other."""
        if not 1 <= steps <= 2**20:
            raise Error(library.CM_ERROR_ARGUMENT, f"steps: 1 to 2^20, not {steps}")
        return _core.pixel_boundary(self._handle, operator.index(pixel), steps, True)

    def ring_info(self, ring: int) -> Ring:
        """The ring of a number, 1 at the north pole, as Ring."""
        info = struct(library.cm_healpix_ring)
        library.cm_healpix_ring_info(self._handle, operator.index(ring), ctypes.byref(info))
        return Ring(info.ring, info.first, info.count, info.z, info.rho, bool(info.is_shifted))

    def regrade(self, values: ArrayLike, to: Healpix, *, pessimistic: bool = False, power: float = 0.0,
                bad_is_nan: bool = False) -> np.ndarray:
        """A map of another resolution or order, as healpy's ud_grade: means of what is not UNSEEN or NaN.

        values        12 nside^2 numbers, float32 or float64
        to            the Healpix of the result
        pessimistic   is a pixel with any bad part bad?
        power         the result is divided by (nside / nside of the result)^power: -2 for sums
        """
        values = np.ascontiguousarray(values)
        values = values if values.dtype == np.float32 else values.astype(np.float64, casting="same_kind", copy=False)
        if values.shape != (self.pixel_count,):
            raise ValueError(f"values: {self.pixel_count} numbers, not {values.shape}")
        target = handle_of(to, Healpix, "to")
        result = np.empty(to.pixel_count, values.dtype)
        options = struct(library.cm_healpix_regrade_options, is_pessimistic=bool(pessimistic), power=power, bad_is_nan=bool(bad_is_nan))
        function = library.cm_healpix_regrade_f32 if values.dtype == np.float32 else library.cm_healpix_regrade
        function(self._handle, values.ctypes.data, target, result.ctypes.data, ctypes.byref(options))
        return result
