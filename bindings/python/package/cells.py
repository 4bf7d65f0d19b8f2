# SPDX-License-Identifier: MIT
"""Cells: numbers of 64 bits for the squares of a grid, regions, and the cells that cover them.

>>> cells = cubemap.CellGrid("seamless")
>>> berlin = cells.forward_lonlat(np.radians(13.4), np.radians(52.5), 12)
>>> cubemap.cell_token(berlin)
'9d09127'
>>> cubemap.parse_cell(cubemap.cell_token(berlin)) == berlin
True
"""

from __future__ import annotations

import ctypes
import operator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from ._errors import Error, in_words
from ._masked_pictures import unmasked
from ._method import bind
from ._methods import CellGridMethods, RegionMethods
from ._texts import Specified, checked_text, created, handle_of, number_of, struct, words_of
from .earth import Grid, grid_of
from .mapping import RECOMMENDED, checked_threads

CURVES = words_of(library.cm_curve_name)
NO_CELL = 0
LEVEL_MAX = 30


class CellGrid(CellGridMethods, Specified):
    """The cells of a grid: CellGrid("coupled"), CellGrid(Grid("seamless", ellipsoid="Mars"), "morton"), CellGrid.s2().

    grid    a Grid, or the specification of its mapping
    curve   "hilbert" or "morton"

    >>> cells = cubemap.CellGrid.s2()
    >>> cell = cells.forward(1.0, 0.2, 0.3, 4)
    >>> around, count = cells.neighbours(cell)
    >>> count
    8
    >>> cubemap.cell_token(cell)
    '117'
    """

    _standard = {"curve": "hilbert", "s2": False, "threads": 1}

    def __init__(self, grid: str | Grid = RECOMMENDED, curve: str = "hilbert", *, s2: bool = False,
                 threads: int = 1) -> None:
        self.grid = grid_of(grid)
        which = number_of(curve, CURVES, "curve")
        if s2:
            self._handle = created(library.cm_cell_grid_create_s2, "cm_cell_grid_destroy", self.grid._handle,
                                   keep=self.grid._handle)
        else:
            self._handle = created(library.cm_cell_grid_create, "cm_cell_grid_destroy", self.grid._handle, which,
                                   keep=self.grid._handle)
        self._given = (curve, bool(s2))
        self._threads = checked_threads(threads)
        self._levels = {}

    @classmethod
    def s2(cls, **keywords: Any) -> CellGrid:
        """The cells of the S2 library, to the bit."""
        return cls(Grid("s2", "s2", ellipsoid="6371010", latitude="geographic"), s2=True, **keywords)

    def _arguments(self):
        return dict(zip(("grid", "curve", "s2", "threads"), (self.grid, *self._given, self._threads), strict=True))

    @property
    def curve(self) -> str:
        """"hilbert" or "morton"."""
        return CURVES[library.cm_cell_grid_curve(self._handle)]

    @property
    def is_s2(self) -> bool:
        """Are these the cells of the S2 library?"""
        return bool(library.cm_cell_grid_is_s2(self._handle))

    def _at_level(self, name, level):
        level = operator.index(level)
        if (name, level) not in self._levels:
            if not 0 <= level <= LEVEL_MAX:
                raise Error(library.CM_ERROR_CELL, f"level: 0 to {LEVEL_MAX}, not {level}")
            self._levels[name, level] = bind(self, name, (level,))
        return self._levels[name, level]

    def _bound_with(self, name, level):
        """The function behind a method that takes a level beside arrays."""
        return self._at_level(f"cm_cell_{name}_array", level)

    _bound_names = ("forward", "forward_lonlat")

    def forward(self, x: ArrayLike, y: ArrayLike, z: ArrayLike, level: int, **keywords: Any) -> Any:
        """The cells of a level at the points of normals; 0 where there is no point. A ufunc: out= and where= go with it."""
        return self._at_level("cm_cell_forward_array", level)(x, y, z, **keywords)

    def forward_lonlat(self, lon: ArrayLike, lat: ArrayLike, level: int, **keywords: Any) -> Any:
        """The cells of a level at geographic longitudes and latitudes, radians."""
        return self._at_level("cm_cell_forward_lonlat_array", level)(lon, lat, **keywords)

    def neighbours_at(self, cell: int, level: int) -> np.ndarray:
        """All cells of a finer level that touch the cell from outside, anticlockwise from low u, low v."""
        return _as_many(library.cm_cell_neighbours_at, self._handle, operator.index(cell), level)

    def cover(self, region: Region, level_min: int, level_max: int, *, most: int = 0,
              inner: bool = False) -> np.ndarray:
        """The cells that a Region takes, sorted.

        most    as many cells as may be: the largest are divided as long as there are no more; 0 for as many as there are
        inner   only those that are wholly in it
        """
        options = struct(library.cm_cover_options, level_min=level_min, level_max=level_max, cells_most=most, kind=int(bool(inner)))
        return _as_many(library.cm_cover, self._handle, handle_of(region, Region, "region"), ctypes.byref(options))


def _as_many(function, *arguments):
    """The cells that a function writes, with room for as many as it says that there are."""
    count, room = ctypes.c_size_t(), 1024
    while True:
        cells = np.empty(room, np.uint64)
        try:
            function(*arguments, room, cells.ctypes.data, ctypes.byref(count))
        except Error as error:
            if error.status != library.CM_ERROR_SPACE:
                raise
            room = max(count.value, 2 * room)
        else:
            return cells[:count.value].copy()


class Region(RegionMethods, Specified):
    """A part of the Earth: Region.cap, Region.box and Region.polygon make one. Angles are radians.

    >>> disc = cubemap.Region.cap(np.radians(13.4), np.radians(52.5), cubemap.cap_radius(50e3))
    >>> covering = cubemap.CellGrid("coupled").cover(disc, 4, 10, most=20)
    >>> len(covering) <= 20, disc.contains((1.0, 0.0, 0.0))
    (True, False)
    """

    _threads = 1

    def __init__(self, kind: str, *given: Any) -> None:
        makers = {"cap": self._cap, "box": self._box, "polygon": self._polygon}
        if kind not in makers:
            raise ValueError(f"kind: {kind!r} is none of {', '.join(makers)}")
        self._handle = makers[kind](*given)
        self._given = (kind, *given)

    def __repr__(self):
        return f"cubemap.Region.{self._given[0]}{self._given[1:] if len(self._given) > 2 else f'({self._given[1]!r})'}"

    def _same(self):
        return self._given

    def _arguments(self):
        return self._given

    @classmethod
    def cap(cls, lon: float, lat: float, radius: float) -> Region:
        """What is within an angle of a place; cap_radius makes one of metres."""
        return cls("cap", float(lon), float(lat), float(radius))

    @classmethod
    def box(cls, west: float, south: float, east: float, north: float) -> Region:
        """From the meridian of west eastward to that of east, and from a parallel to another."""
        return cls("box", float(west), float(south), float(east), float(north))

    @classmethod
    def polygon(cls, *rings: ArrayLike) -> Region:
        """Rings of corners (lon, lat), outer ones anticlockwise, holes clockwise; edges are great circles."""
        return cls("polygon", *(tuple(map(tuple, np.asarray(unmasked(ring, "rings"), float).tolist())) for ring in rings))

    @staticmethod
    def _cap(lon, lat, radius):
        return created(library.cm_region_cap_lonlat, "cm_region_destroy", lon, lat, radius)

    @staticmethod
    def _box(west, south, east, north):
        return created(library.cm_region_box, "cm_region_destroy", west, south, east, north)

    @staticmethod
    def _polygon(*rings):
        lengths = np.array([len(ring) for ring in rings], np.uintp)
        corners = np.array([corner for ring in rings for corner in ring], np.float64).reshape(-1, 2)
        return created(library.cm_region_polygon, "cm_region_destroy", len(rings), lengths.ctypes.data, corners.ctypes.data)

    def contains(self, normals: ArrayLike) -> Any:
        """Are points, x, y, z along the last axis, in the region or on its border?"""
        return bind(self, "cm_region_contains")(normals) != 0


def cell_token(cell: int) -> str:
    """The text of a cell, as S2 has it; "X" for no cell."""
    text = ctypes.create_string_buffer(17)
    library.cm_cell_token(operator.index(cell), text, len(text))
    return text.value.decode()


def parse_cell(token: str) -> int:
    """The cell of a token."""
    cell = ctypes.c_uint64()
    in_words(library.cm_cell_parse, checked_text(token, "token"), ctypes.byref(cell))
    return cell.value


def _cells_of(cells):
    """Numbers of cells as an array; real ones are none."""
    given = np.asarray(cells)
    if given.size and given.dtype.kind not in "iu":
        given = np.array([operator.index(cell) for cell in given.ravel().tolist()], np.uint64).reshape(given.shape)
    return given.astype(np.uint64, copy=False)


def normalise_cells(cells: ArrayLike) -> np.ndarray:
    """Cells sorted, without those that are none or in others, four quarters joined: a set of cells."""
    cells = _cells_of(cells).ravel().copy()
    return cells[:library.cm_cell_union_normalise(cells.size, cells.ctypes.data)].copy()


def cells_contain(cells: ArrayLike, cell: int) -> bool:
    """Is the whole cell in one of a set, as normalise_cells leaves it?"""
    cells = np.ascontiguousarray(_cells_of(cells))
    return bool(library.cm_cell_union_contains(cells.size, cells.ctypes.data, operator.index(cell)))


def cells_intersect(cells: ArrayLike, cell: int) -> bool:
    """Has the cell anything in common with one of a set, as normalise_cells leaves it?"""
    cells = np.ascontiguousarray(_cells_of(cells))
    return bool(library.cm_cell_union_intersects(cells.size, cells.ctypes.data, operator.index(cell)))
