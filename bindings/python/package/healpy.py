# SPDX-License-Identifier: MIT
"""Functions of healpy by the same names and arguments: `from cubemap import healpy as hp`.

What differs:
  speed         bindings/python/benchmark.py measures it beside healpy's
  numbers       single points give numbers of Python instead of NumPy's
  no pixel      a number of no pixel gives NaN, or -1, and ValueError in boundaries; healpy gives any number
  no point      NaN and infinite angles and vectors, the vector 0 and radii below 0 are refused with ValueError; healpy may
                give any pixel, or none
  resolutions   what is none is refused with ValueError, by vec2pix, max_pixrad and nside2pixarea, too, where healpy computes
                with it or ends the program; but nside2npix multiplies, as healpy's. 0 is no number of pixels. max_pixrad knows all, healpy powers of
                two. A real number that is whole is one
  types         what is computed is float64, also of float32; healpy's ang2vec and vec2ang give float32
  nothing       arrays without pixels have no boundaries, of shape (0, 3, 4 step); healpy refuses them. step is 1 or more
  accuracy      angles of vectors are accurate at the poles, where healpy's arc cosine loses half of the digits. So a point
                within rounding of a border may be in the pixel beside. Vectors of angles do not depend on NumPy's sines
  shapes        ang2vec has the vectors of angles of several dimensions along the last axis; healpy turns all axes around
  ud_grade      sums are made in double; UNSEEN stays UNSEEN when `power` is given. NaN and infinities are as UNSEEN: healpy
                keeps them in finer maps, and makes NaN of pixels that have one. What a masked array masks is UNSEEN, too;
                healpy computes with what is under the mask. An order that is none is refused
  query_disc    inclusive=True gives all pixels that the disc overlaps, and a few more: not the same few
  reorder       of bunches of memory nothing is said: a map is done at once. Masked arrays keep their mask
  many turns    longitudes of millions of turns are taken to all their digits; healpy's turn is rounded
  left out      query_polygon, query_strip, get_interp_val, get_interp_weights; pix2xyf, xyf2pix, pix2ring, ringinfo, dir2vec,
                vec2dir, check_max_nside; masks: ma, mask_bad, mask_good, maptype, dist2holes, hotspots; fit_dipole, fit_monopole,
                remove_dipole, remove_monopole; Rotator; what reads and writes files, draws, smooths or transforms into harmonics

>>> from cubemap import healpy as hp
>>> pixel = hp.ang2pix(1024, 0.3, 0.4)
>>> pixel
280595
>>> theta, phi = hp.pix2ang(1024, pixel)
>>> round(theta, 4), round(phi, 4)
(0.3001, 0.4)
>>> len(hp.query_disc(64, (1, 0, 0), 0.2))
488
"""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from . import _core, _methods
from .pixels import UNSEEN, Healpix

__all__ = ["UNSEEN", "ang2pix", "ang2vec", "boundaries", "get_all_neighbours", "get_map_size", "get_nside", "isnpixok", "isnsideok",
           "max_pixrad", "nest2ring", "npix2nside", "npix2order", "nside2npix", "nside2order", "nside2pixarea", "nside2resol",
           "order2npix", "order2nside", "pix2ang", "pix2vec", "query_disc", "reorder", "ring2nest", "ud_grade", "vec2ang", "vec2pix"]

NSIDE_MAX = 2**29
_PI, _MOST = math.pi, np.finfo(np.float64).max.item()  # names of the module are found sooner than attributes


def _healpix(nside, nest):
    if isinstance(nside, (np.ndarray, list, tuple)):
        if np.size(nside) != 1:
            raise ValueError(f"nside is one number here, not {np.size(nside)}")
        nside = np.asarray(nside).item()
    return _made(nside, nest)


@functools.lru_cache(maxsize=128)
def _made(nside, nest):
    if not isnsideok(nside, nest):
        raise ValueError(f"{nside} is not a valid nside parameter (must be a power of 2, less than 2**30)")
    return Healpix(int(nside), "nested" if nest else "ring")


# Methods of Healpix by nside and order, bound: for single points, of which looking up took most of the time.
_from_angles, _to_angles, _from_lonlat, _to_lonlat, _from_direction, _to_direction, _to_nested, _handles = ({} for _ in range(8))


def _bind(table, method, nside, nest):
    bound = getattr(_healpix(nside, nest), method)
    if isinstance(nside, (np.ndarray, list, tuple)):  # of no dimension: the same number may be found as one
        return bound
    if len(table) >= 128:
        table.clear()
    table[nside, nest] = bound
    return bound


def _each(nside, nest, method, *arrays):
    """A method of Healpix, also for an array of nsides."""
    if isinstance(nside, int) or np.ndim(nside) == 0:
        return getattr(_healpix(nside, nest), method)(*arrays)
    masks = [np.ma.getmaskarray(array) for array in (nside, *arrays) if isinstance(array, np.ma.MaskedArray)]
    nside, *arrays = np.broadcast_arrays(_checked_nside(nside, nest), *arrays)
    found = None
    for one in np.unique(nside).tolist() or [1]:  # of none, to know what kinds of arrays there would be
        here = nside == one
        part = getattr(_healpix(one, nest), method)(*(array[here] for array in arrays))
        parts = part if isinstance(part, tuple) else (part,)
        if found is None:
            found = tuple(np.empty((*nside.shape, *one_part.shape[1:]), one_part.dtype) for one_part in parts)
        for to, one_part in zip(found, parts, strict=True):
            to[here] = one_part
    if masks:
        masked = np.broadcast_to(functools.reduce(np.logical_or, masks), nside.shape)
        found = tuple(np.ma.array(one, mask=masked) for one in found)
    return found if len(found) > 1 else found[0]


def _checked(pixel, what):
    """A pixel, or pixels; ValueError if there is none at some point."""
    if (pixel < 0) if isinstance(pixel, int) else np.any(pixel < 0):
        raise ValueError(what)
    return pixel


def ang2pix(nside: ArrayLike, theta: ArrayLike, phi: ArrayLike, nest: bool = False, lonlat: bool = False) -> Any:
    """The pixels at angles: colatitude and longitude in radians, or longitude and latitude in degrees."""
    if lonlat:
        if type(nside) is int and type(theta) is float and type(phi) is float:
            bound = _from_lonlat.get((nside, nest)) or _bind(_from_lonlat, "pixel_from_lonlat", nside, nest)
            return _checked(bound(math.radians(theta), math.radians(phi)), "THETA is out of range [0,pi]")
        return _checked(_each(nside, nest, "pixel_from_lonlat", np.radians(theta), np.radians(phi)), "THETA is out of range [0,pi]")
    if type(nside) is int:
        try:
            bound = _from_angles[nside, nest]
        except KeyError:
            bound = _bind(_from_angles, "pixel_from_angles", nside, nest)
        pixel = bound(theta, phi)
        if type(pixel) is int and pixel >= 0:
            return pixel
    else:
        pixel = _each(nside, nest, "pixel_from_angles", theta, phi)
    if (pixel < 0) if isinstance(pixel, int) else np.any(pixel < 0):  # healpy lets 1e-5 beyond the south pole pass
        theta = np.asarray(theta, dtype=np.float64)
        beyond = (theta > np.pi) & (theta <= np.pi + 1e-5)
        theta, phi = np.where(beyond, 2 * np.pi - theta, theta), np.where(beyond, np.add(phi, np.pi), phi)
        pixel = _checked(_each(nside, nest, "pixel_from_angles", theta, phi), "THETA is out of range [0,pi]")
    return pixel


def pix2ang(nside: ArrayLike, ipix: ArrayLike, nest: bool = False, lonlat: bool = False) -> tuple[Any, Any]:
    """The angles of centres: colatitude and longitude in radians, or longitude and latitude in degrees."""
    if lonlat:
        if type(nside) is int and type(ipix) is int:
            lon, lat = (_to_lonlat.get((nside, nest)) or _bind(_to_lonlat, "lonlat_from_pixel", nside, nest))(ipix)
            lon = math.degrees(lon)
            return lon + 360.0 if lon < 0 else lon, math.degrees(lat)
        lon, lat = _each(nside, nest, "lonlat_from_pixel", ipix)
        lon, lat = np.degrees(lon), np.degrees(lat)
        return lon + np.where(lon < 0, 360.0, 0.0), lat  # a sum keeps the mask of a masked array
    if type(nside) is int:
        return (_to_angles.get((nside, nest)) or _bind(_to_angles, "angles_from_pixel", nside, nest))(ipix)
    return _each(nside, nest, "angles_from_pixel", ipix)


def vec2pix(nside: ArrayLike, x: ArrayLike, y: ArrayLike, z: ArrayLike, nest: bool = False) -> Any:
    """The pixels at vectors of any length."""
    if type(nside) is int:
        try:
            bound = _from_direction[nside, nest]
        except KeyError:
            bound = _bind(_from_direction, "pixel_from_direction", nside, nest)
        pixel = bound(x, y, z)
        if type(pixel) is int and pixel >= 0:
            return pixel
    else:
        pixel = _each(nside, nest, "pixel_from_direction", x, y, z)
    return _checked(pixel, "a vector that is zero or not finite")


def pix2vec(nside: ArrayLike, ipix: ArrayLike, nest: bool = False) -> tuple[Any, Any, Any]:
    """The centres, as unit vectors x, y, z."""
    if type(nside) is int:
        return (_to_direction.get((nside, nest)) or _bind(_to_direction, "direction_from_pixel", nside, nest))(ipix)
    return _each(nside, nest, "direction_from_pixel", ipix)


def ang2vec(theta: ArrayLike, phi: ArrayLike, lonlat: bool = False) -> np.ndarray:
    """Unit vectors, along the last axis, of angles as in ang2pix."""
    if lonlat:
        if type(theta) is float and type(phi) is float and -90.0 <= phi <= 90.0 and -_MOST <= theta <= _MOST:
            return _core.lonlat_to_vector(theta, phi)
        vectors = np.stack(_methods.direction_from_lonlat(np.radians(theta), np.radians(phi)), axis=-1)
        if np.isnan(vectors).any():
            raise ValueError("THETA is out of range [0,pi]")
        return vectors
    if type(theta) is float and type(phi) is float and 0.0 <= theta <= _PI and -_MOST <= phi <= _MOST:  # a single point
        return _core.angles_to_vector(theta, phi)
    theta, phi = (np.asarray(one) for one in (theta, phi))
    if theta.dtype.kind in "SUc" or phi.dtype.kind in "SUc":  # NumPy would read texts
        raise TypeError("angles are real numbers")
    theta, phi = np.broadcast_arrays(theta.astype(np.float64, copy=False), phi.astype(np.float64, copy=False))
    if not ((theta >= 0) & (theta <= np.pi + 1e-5)).all():
        raise ValueError("THETA is out of range [0,pi]")
    if not np.isfinite(phi).all():
        raise ValueError("PHI is not finite")
    return _core.angles_to_vectors(theta, phi).reshape(*theta.shape, 3)


def vec2ang(vectors: ArrayLike, lonlat: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """The angles of vectors, (n, 3) or (3,): arrays of n."""
    return _core.vectors_to_angles(vectors, lonlat)


def nest2ring(nside: ArrayLike, ipix: ArrayLike) -> Any:
    """From the order NESTED to RING."""
    return _each(nside, True, "ring_from_nested", ipix)


def ring2nest(nside: ArrayLike, ipix: ArrayLike) -> Any:
    """From the order RING to NESTED."""
    if type(nside) is int:
        bound = _to_nested.get((nside, False)) or _bind(_to_nested, "nested_from_ring", _checked_nside(nside, True), False)
        return bound(ipix)
    return _each(_checked_nside(nside, True), False, "nested_from_ring", ipix)


def get_all_neighbours(nside: ArrayLike, theta: ArrayLike, phi: ArrayLike | None = None, nest: bool = False,
                       lonlat: bool = False) -> np.ndarray:
    """The neighbours SW, W, NW, N, NE, E, SE and S, along the first axis; -1 where there is none."""
    # what has no mask for eight of each
    nside, theta, phi = (np.ma.getdata(one) if isinstance(one, np.ma.MaskedArray) else one for one in (nside, theta, phi))
    pixel = theta if phi is None else ang2pix(nside, theta, phi, nest, lonlat)
    if type(nside) is int and type(pixel) is int:
        return _core.pixel_neighbours(_handles.get((nside, nest)) or _bind(_handles, "_handle", nside, nest), pixel)
    found = _each(nside, nest, "neighbours", pixel)
    return found if found.ndim == 1 else np.moveaxis(found, -1, 0)


def boundaries(nside: int, pix: ArrayLike, step: int = 1, nest: bool = False) -> np.ndarray:
    """The boundary of pixels: x, y, z of 4 step points, (3, 4 step), or (n, 3, 4 step) of n pixels."""
    if type(nside) is int and type(pix) is int:
        return _core.pixel_boundary(_handles.get((nside, nest)) or _bind(_handles, "_handle", nside, nest), pix, step, False)
    pixels = np.asarray(pix)
    if pixels.ndim > 1:
        raise ValueError("pixels are to be one number, or an array of one dimension")
    if pixels.size and pixels.dtype.kind not in "iub":
        raise ValueError("pixels are whole numbers")
    if pixels.dtype.kind == "u" or not pixels.size:
        pixels = pixels.astype(np.int64)  # what is too large is negative then, and refused
    found = _core.pixel_boundaries(_bind(_handles, "_handle", nside, nest), pixels, step)
    return found if pixels.ndim else found[0]


# ---- resolutions ----

def isnsideok(nside: ArrayLike, nest: bool = False) -> Any:
    """Is there such a resolution: 1 to 2^29, in NESTED a power of two?"""
    if type(nside) is int:
        return 0 < nside <= NSIDE_MAX and not (nest and nside & (nside - 1))
    nside = np.asarray(nside)
    if nside.dtype.kind in "SU":
        raise TypeError("nside is a number, not a text")
    whole = nside.astype(np.int64)
    good = (nside == whole) & (whole > 0) & (whole <= NSIDE_MAX)
    good = good & ((whole & (whole - 1)) == 0) if nest else good
    return good if good.ndim else bool(good)


def _checked_nside(nside, nest=False):
    if not (isnsideok(nside, nest) if type(nside) is int else np.all(isnsideok(nside, nest))):
        raise ValueError(f"{nside} is not a valid nside parameter (must be a power of 2, less than 2**30)")
    return nside


def nside2npix(nside: Any) -> Any:
    """12 nside^2."""
    return 12 * nside * nside


def npix2nside(npix: int) -> int:
    """The nside of a number of pixels."""
    if not isnpixok(npix):
        raise ValueError("Wrong pixel number (it is not 12*nside**2)")
    return int(math.sqrt(npix / 12))


def isnpixok(npix: ArrayLike) -> Any:
    """Is it 12 nside^2?"""
    if type(npix) is int:
        return npix > 0 and math.sqrt(npix / 12.0).is_integer()
    nside = np.sqrt(np.asarray(npix) / 12.0)
    good = (nside == np.floor(nside)) & (nside > 0)
    return good if good.ndim else bool(good)


def nside2order(nside: int) -> int:
    """The base-2 logarithm."""
    return int(_checked_nside(nside, True)).bit_length() - 1


def order2nside(order: int) -> int:
    """2^order."""
    return _checked_nside(1 << order, True)


def order2npix(order: int) -> int:
    """The pixels of an order."""
    return nside2npix(order2nside(order))


def npix2order(npix: int) -> int:
    """The order of a number of pixels."""
    return nside2order(npix2nside(npix))


def nside2pixarea(nside: Any, degrees: bool = False) -> Any:
    """The area of a pixel, steradians or square degrees."""
    area = 4 * np.pi / nside2npix(_checked_nside(nside))
    return np.degrees(np.degrees(area)) if degrees else area


def nside2resol(nside: Any, arcmin: bool = False) -> Any:
    """The root of a pixel's area, radians or minutes of arc."""
    area = nside2pixarea(nside)
    side = math.sqrt(area) if type(area) is float else np.sqrt(area)
    return np.degrees(side) * 60 if arcmin else side


def max_pixrad(nside: ArrayLike, degrees: bool = False) -> Any:
    """The greatest angle between a pixel's centre and its corners."""
    if np.ndim(nside) == 0:
        return _pixel_radius(nside.item() if isinstance(nside, np.ndarray) else nside, degrees)
    sides = np.asarray(nside)
    return np.array([_pixel_radius(one, degrees) for one in sides.ravel().tolist()], np.float64).reshape(sides.shape)


@functools.lru_cache(maxsize=128)
def _pixel_radius(nside, degrees):
    _checked_nside(nside)
    rise, tip = 2 / 3, 1 - (1 - 1 / nside) ** 2 / 3
    one = np.array([np.sqrt(1 - rise**2) * np.cos(np.pi / (4 * nside)), np.sqrt(1 - rise**2) * np.sin(np.pi / (4 * nside)), rise])
    other = np.array([np.sqrt(1 - tip**2), 0.0, tip])
    angle = np.arctan2(np.linalg.norm(np.cross(one, other)), one @ other)
    return np.degrees(angle) if degrees else angle


def get_map_size(m: ArrayLike) -> int:
    """The pixels of a map."""
    npix = _map_shape(m)[-1]
    npix2nside(npix)
    return npix


def get_nside(m: ArrayLike) -> int:
    """The nside of a map, or of several of one size."""
    npix = _map_shape(m)[-1]
    if not isnpixok(npix):
        raise TypeError(f"bad number of pixels: {npix}")
    return npix2nside(npix)


def _map_shape(m):
    if np.ndim(m) == 0:
        raise TypeError("a map is an array, not a single thing")
    return np.shape(m)


# ---- maps ----

def _is_nested(order):
    name = str(order).upper()[:4]
    if name not in ("RING", "NEST"):
        raise ValueError(f"an order is RING or NEST, not {order}")
    return name == "NEST"


def reorder(map_in: ArrayLike, inp: str | None = None, out: str | None = None, r2n: bool | None = None,
            n2r: bool | None = None) -> np.ndarray:
    """A map, or maps along the first axis, in the other order."""
    inp, out = ("NEST", "RING") if n2r else ("RING", "NEST") if r2n else (inp, out)
    nested, wanted = _is_nested(inp), _is_nested(out)
    values = map_in if isinstance(map_in, np.ma.MaskedArray) else np.asarray(map_in)
    values = values.astype(values.dtype.newbyteorder("="), copy=False)
    nside = get_nside(values)
    if nested == wanted:
        return values
    pixels = np.arange(values.shape[-1])
    return values[..., ring2nest(nside, pixels) if nested else nest2ring(nside, pixels)]


def _unmasked(map_in):
    """A map as an array of numbers, with UNSEEN for what a masked one masks."""
    values = map_in if isinstance(map_in, np.ma.MaskedArray) else np.asarray(map_in)
    if values.dtype.kind == "O":
        values = values.astype(np.float64)
    if isinstance(values, np.ma.MaskedArray):
        values = values.astype(np.result_type(values.dtype, np.float32), copy=False).filled(UNSEEN)
    return values


def _regraded_complex(values, *options):
    """Both parts of a map as ud_grade has them: what is bad in one is so in the other."""
    bad = ~np.isfinite(values) | (np.abs(values - UNSEEN) < 1e-5 * abs(UNSEEN))
    real, imaginary = (ud_grade(np.where(bad, UNSEEN, part), *options) for part in (values.real, values.imag))
    return real + 1j * np.where(real == UNSEEN, 0, imaginary)


def ud_grade(map_in: ArrayLike, nside_out: int, pess: bool = False, order_in: str = "RING",
             order_out: str | None = None, power: float | None = None, dtype: DTypeLike | None = None) -> np.ndarray:
    """A map, or maps along the first axis, of another resolution: means of the good parts of a pixel."""
    _checked_nside(nside_out, nest=order_in != "RING")
    values = _unmasked(map_in)
    kind = np.dtype(dtype) if dtype is not None else values.dtype.newbyteorder("=")
    nside, nested = get_nside(values), _is_nested(order_in)
    wanted = nested if order_out is None else _is_nested(order_out)
    if values.ndim > 1:
        return np.array([ud_grade(one, nside_out, pess, order_in, order_out, power, dtype) for one in values])
    if values.dtype.kind == "c":
        return _regraded_complex(values, nside_out, pess, order_in, order_out, power).astype(kind, copy=False)
    if np.issubdtype(kind, np.floating) and values.dtype != np.float32:
        values = values.astype(np.float64, copy=False)
    graded = _healpix(nside, nested).regrade(values, _healpix(nside_out, wanted), pessimistic=bool(pess), power=float(power or 0))
    if np.issubdtype(kind, np.integer):  # healpy: what UNSEEN is for whole numbers nobody knows
        graded = np.where(graded == UNSEEN, 0, graded)
    return graded.astype(kind, copy=False)


# ---- regions ----

def query_disc(nside: int, vec: ArrayLike, radius: float, inclusive: bool = False, fact: int = 4, nest: bool = False,
               buff: np.ndarray | None = None) -> np.ndarray:
    """The pixels, sorted, whose centre is within an angle of a vector; inclusive: those that overlap the disc, and a few more."""
    if inclusive and not 1 <= fact <= 1 << 20:
        raise ValueError(f"fact: 1 to 2^20, not {fact}")
    if nest:
        _healpix(nside, True)  # is there such a one?
    ring = (_handles.get((nside, False)) if type(nside) is int else None) or _bind(_handles, "_handle", nside, False)
    pixels = _core.pixel_disc(ring, vec, radius, fact if inclusive else 0, nest)
    if buff is not None:
        if not isinstance(buff, np.ndarray) or buff.dtype != np.int64:  # others would cut numbers of pixels
            raise ValueError("buff is an array of int64")
        buff[:pixels.size] = pixels
        return buff[:pixels.size]
    return pixels
