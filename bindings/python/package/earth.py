# SPDX-License-Identifier: MIT
"""The Earth: ellipsoids, latitudes, rotations, and grids, which are mappings on an ellipsoid.

>>> [ellipsoid.identifier for ellipsoid in cubemap.ellipsoids()][:3]
['WGS84', 'GRS80', 'WGS72']
>>> to_authalic = cubemap.LatitudeConversion("geographic", "authalic")
>>> round(to_authalic.convert(np.radians(52.5)), 9)
0.914133883
"""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from . import _methods
from ._errors import Error, in_words
from ._methods import GridMethods, LatitudeConversionMethods
from ._texts import Specified, checked_text, created, decoded, number_of, struct, words_of
from .mapping import RECOMMENDED, Frame, Mapping, check_specification, checked_threads, options_of

LATITUDES = words_of(library.cm_latitude_name)


class Ellipsoid(Specified):
    """An ellipsoid of revolution: Ellipsoid("WGS84"), Ellipsoid("6378137,298.257223563"), Ellipsoid("6371000").

    text   an identifier of ellipsoids(), or "A,1/F": the equatorial radius in metres and the inverse of the flattening

    >>> earth = cubemap.Ellipsoid("WGS84")
    >>> earth.a, round(earth.authalic_radius, 3)
    (6378137.0, 6371007.181)
    """

    def __init__(self, text: str = "WGS84") -> None:
        self._struct = struct(library.cm_ellipsoid)
        in_words(library.cm_ellipsoid_parse, checked_text(text, "ellipsoid"), ctypes.byref(self._struct))
        self._text = text

    def _arguments(self):
        return {"text": self._text}

    def _same(self):
        return self.a, self.f

    @property
    def identifier(self) -> str:
        """"WGS84"; "" for one of your own."""
        return decoded(self._struct.identifier)

    @property
    def name(self) -> str:
        """One line for people."""
        return decoded(self._struct.name)

    @property
    def a(self) -> float:
        """The equatorial radius, metres."""
        return self._struct.a

    @property
    def f(self) -> float:
        """The flattening."""
        return self._struct.f

    @property
    def area(self) -> float:
        """The surface, square metres."""
        return library.cm_ellipsoid_area(ctypes.byref(self._struct))

    @property
    def authalic_radius(self) -> float:
        """The radius of the sphere of the same surface, metres."""
        return library.cm_ellipsoid_authalic_radius(ctypes.byref(self._struct))


def ellipsoids() -> tuple[Ellipsoid, ...]:
    """The ellipsoids that have a name."""
    return tuple(Ellipsoid(decoded(library.cm_ellipsoid_at(index).contents.identifier))
                 for index in range(library.cm_ellipsoid_count()))


def ellipsoid_of(ellipsoid: str | Ellipsoid) -> Ellipsoid:
    """An ellipsoid, also from its text."""
    return ellipsoid if isinstance(ellipsoid, Ellipsoid) else Ellipsoid(ellipsoid)


class LatitudeConversion(LatitudeConversionMethods, Specified):
    """From one latitude to another: LatitudeConversion("geographic", "authalic").

    source, target   of LATITUDES
    ellipsoid        an Ellipsoid or its text
    tolerance        radians: the series has the least terms that keep it; 0 for full double
    exact            closed forms and iterations whatever the flattening

    c.convert(latitude) takes radians, c.convert_direction(x, y, z) directions.

    >>> c = cubemap.LatitudeConversion("geographic", "conformal", tolerance=1e-9)
    >>> c.order, c.error < 1e-9
    (3, True)
    """

    _standard = {"ellipsoid": "WGS84", "tolerance": 0.0, "exact": False, "threads": 1}

    def __init__(self, source: str, target: str, ellipsoid: str | Ellipsoid = "WGS84", *, tolerance: float = 0.0,
                 exact: bool = False, threads: int = 1) -> None:
        ellipsoid = ellipsoid_of(ellipsoid)
        options = struct(library.cm_latitude_options, tolerance=tolerance, exact=bool(exact))
        self._handle = created(library.cm_latitude_conversion_create, "cm_latitude_conversion_destroy", ctypes.byref(ellipsoid._struct),
                               number_of(source, LATITUDES, "source"), number_of(target, LATITUDES, "target"),
                               ctypes.byref(options))
        self._given = (source, target, ellipsoid._text, tolerance, bool(exact))
        self._threads = checked_threads(threads)

    def _arguments(self):
        return dict(zip(("source", "target", "ellipsoid", "tolerance", "exact", "threads"), (*self._given, self._threads), strict=True))

    @property
    def order(self) -> int:
        """The terms of the series; 0 for closed forms."""
        return library.cm_latitude_conversion_order(self._handle)

    @property
    def error(self) -> float:
        """What is cut off, radians: a bound at every latitude."""
        return library.cm_latitude_conversion_error(self._handle)

    @property
    def constants(self) -> tuple[np.ndarray, int]:
        """What the kernels of shaders take: 13 numbers, and for which number of terms."""
        constants, terms = np.empty(13), ctypes.c_int()
        library.cm_latitude_conversion_constants(self._handle, constants.ctypes.data, ctypes.byref(terms))
        return constants, terms.value


class Rotation(Specified):
    """How the cube stands on the Earth: Rotation("10,20,30"), Rotation("land-coupled"), Rotation(matrix of 3 x 3).

    text   "LON,LAT[,ROLL]" in degrees, or a name of orientations()

    The rows of r.matrix are the cube's axes in those of the Earth.

    >>> r = cubemap.Rotation("10,20,30")
    >>> r.apply(r.apply_back((1.0, 0.0, 0.0))).round(12).tolist()
    [1.0, 0.0, 0.0]
    """

    def __init__(self, rotation: str | ArrayLike | Rotation = "0,0,0") -> None:
        if isinstance(rotation, str):
            made = struct(library.cm_rotation)
            in_words(library.cm_rotation_parse, checked_text(rotation, "rotation"), ctypes.byref(made))
            self._matrix = np.array(made.row)
        else:
            self._matrix = np.array(rotation.matrix if isinstance(rotation, Rotation) else rotation, dtype=np.float64)
            if self._matrix.shape != (3, 3):
                raise ValueError(f"rotation: a matrix of 3 x 3, not of {self._matrix.shape}")
            try:
                library.cm_rotation_check(self._pointer())
            except Error as error:
                raise Error(error.status, "rotation: the rows are not of length 1, at right angles and right-handed") from None
        self._matrix.flags.writeable = False

    @classmethod
    def from_angles(cls, lon: float, lat: float, roll: float = 0.0) -> Rotation:
        """The front goes to a longitude and a latitude, and the cube is turned about it; degrees."""
        made = struct(library.cm_rotation)
        library.cm_rotation_from_angles(lon, lat, roll, ctypes.byref(made))
        return cls(np.array(made.row))

    def _pointer(self):
        return self._matrix.ctypes.data_as(ctypes.POINTER(library.cm_rotation))

    def _arguments(self):
        return {"rotation": self._matrix.tolist()}

    def _same(self):
        return tuple(self._matrix.ravel().tolist())

    @property
    def matrix(self) -> np.ndarray:
        """3 x 3, not to be written to."""
        return self._matrix

    @property
    def angles(self) -> tuple[float, float, float]:
        """lon, lat and roll, degrees."""
        lon, lat, roll = ctypes.c_double(), ctypes.c_double(), ctypes.c_double()
        library.cm_rotation_angles(self._pointer(), ctypes.byref(lon), ctypes.byref(lat), ctypes.byref(roll))
        return lon.value, lat.value, roll.value

    def apply(self, directions: ArrayLike, **keywords: Any) -> np.ndarray:
        """Directions of the Earth, x, y, z along the last axis, to those of the cube."""
        return _methods.rotate(self._matrix, directions, **keywords)

    def apply_back(self, directions: ArrayLike, **keywords: Any) -> np.ndarray:
        """Directions of the cube to those of the Earth."""
        return _methods.rotate_back(self._matrix, directions, **keywords)


class Orientation(NamedTuple):
    """An orientation that has a name: the best of a measure over a mask. Angles are degrees."""

    identifier: str
    name: str
    mapping: str
    measure: str
    lon: float
    lat: float
    roll: float
    before: float
    after: float


def orientations() -> tuple[Orientation, ...]:
    """The orientations that have a name."""
    found = [library.cm_orientation_at(index).contents for index in range(library.cm_orientation_count())]
    return tuple(Orientation(*(decoded(getattr(one, name)) if isinstance(getattr(one, name), bytes) else getattr(one, name)
                               for name in Orientation._fields)) for one in found)


def cap_radius(metres: float, ellipsoid: str | Ellipsoid = "WGS84") -> float:
    """The angle of a cap that has all in it that is so many metres from its middle, wherever that is."""
    return library.cm_cap_radius(ctypes.byref(ellipsoid_of(ellipsoid)._struct), metres)


class Grid(GridMethods, Specified):
    """A mapping on an ellipsoid: Grid(), Grid("seamless", ellipsoid="Mars"), Grid(rotation="land-coupled").

    mapping     a specification; frame as of Mapping
    ellipsoid   an Ellipsoid or its text
    latitude    of LATITUDES; None: conformal for conformal mappings, authalic for all others
    tolerance   of the latitude, radians; 0: full double
    rotation    of the cube, a Rotation or its text

    g.forward_lonlat(lon, lat) takes geographic radians, g.forward(x, y, z) normals of the ellipsoid.

    >>> g = cubemap.Grid("seamless", rotation="land-coupled")
    >>> face, u, v = g.forward_lonlat(np.radians(13.4), np.radians(52.5))
    >>> lon, lat = g.inverse_lonlat(face, u, v)
    >>> round(np.degrees(lon), 9), round(np.degrees(lat), 9)
    (13.4, 52.5)
    """

    _standard = {"frame": "geo", "ellipsoid": "WGS84", "latitude": None, "tolerance": 0.0, "rotation": None, "instructions": None,
                 "tier": "exact", "threads": 1}

    def __init__(self, mapping: str = RECOMMENDED, frame: str | Frame = "geo", *, ellipsoid: str | Ellipsoid = "WGS84",
                 latitude: str | None = None, tolerance: float = 0.0, rotation: str | Rotation | None = None,
                 instructions: str | None = None, tier: str = "exact", threads: int = 1) -> None:
        if isinstance(mapping, Mapping):
            raise TypeError("mapping: a specification; the grid makes its own mapping")
        check_specification(mapping)
        table = (frame if isinstance(frame, Frame) else Frame.named(frame))._struct()
        ellipsoid = ellipsoid_of(ellipsoid)
        rotation = rotation if rotation is None or isinstance(rotation, Rotation) else Rotation(rotation)
        options = options_of(instructions, tier)
        given = struct(library.cm_grid_options, mapping=mapping.encode(), frame=ctypes.pointer(table),
                       ellipsoid=ctypes.pointer(ellipsoid._struct), tolerance=tolerance, options=ctypes.pointer(options))
        if latitude is not None:
            number = ctypes.c_int(number_of(latitude, LATITUDES, "latitude"))
            given.latitude = ctypes.addressof(number)
        if rotation is not None:
            given.rotation = rotation._pointer()
        self._handle = created(library.cm_grid_create, "cm_grid_destroy", ctypes.byref(given), keep=(table, ellipsoid))
        self._given = (mapping, frame, ellipsoid._text, latitude, tolerance, rotation, instructions, tier)
        self._threads = checked_threads(threads)

    def _arguments(self):
        return dict(zip(("mapping", *self._standard), (*self._given, self._threads), strict=True))

    def _same(self):
        mapping, frame, _, _, tolerance, _, instructions, tier = self._given
        return (Mapping(mapping, frame, instructions=instructions, tier=tier), self.ellipsoid, self.latitude, tolerance, self.rotation)

    @property
    def mapping(self) -> Mapping:
        """Its mapping, as one of its own."""
        mapping, frame, *_, instructions, tier = self._given
        return Mapping(mapping, frame, instructions=instructions, tier=tier, threads=self._threads)

    @property
    def ellipsoid(self) -> Ellipsoid:
        """Its ellipsoid."""
        return Ellipsoid(self._given[2])

    @property
    def latitude(self) -> str:
        """Its latitude, of LATITUDES."""
        return LATITUDES[library.cm_grid_latitude(self._handle)]

    @property
    def rotation(self) -> Rotation:
        """Its rotation."""
        return Rotation(np.array(library.cm_grid_rotation(self._handle).contents.row))


def grid_of(grid: str | Grid) -> Grid:
    """A grid, also from the specification of its mapping."""
    if isinstance(grid, Grid):
        return grid
    if not isinstance(grid, str):
        raise Error(library.CM_ERROR_ARGUMENT, f"grid: a Grid or a specification, not {grid!r}")
    return Grid(grid)
