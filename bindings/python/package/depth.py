# SPDX-License-Identifier: MIT
"""Depth images: cleaned, as points and normals, smoothed, halved, and bounded for boxes of pixels.

An image is an array (rows, columns) of float32, NaN where nothing was measured; strides of any kind will do. Depth is
along the optical axis, range along the ray; images of omnidirectional cameras hold range.

>>> stored = np.full((480, 640), 10_000, np.uint16)  # as TUM's files have it
>>> depth, count = cubemap.clean_depth(stored, 1 / 5000, farthest=8.0)
>>> depth[0, 0].item(), count.valid
(2.0, 307200)
"""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from ._masked_pictures import filled, is_masked
from ._method import name_results
from ._methods import DepthPyramidMethods
from ._texts import Changing, Specified, checked_kind, checked_text, created, handle_of, number_of, struct
from .camera import DEPTH_KINDS, Camera
from .images import images_in
from .mapping import checked_threads


class DepthCount(NamedTuple):
    """How many pixels were what: cubemap/depth.h says what each member is."""

    valid: int
    zero: int
    nan: int
    infinite: int
    negative: int
    near: int
    far: int


class DepthMaps(NamedTuple):
    """Maps of a depth image: points and unit normals (rows, columns, 3) in the camera's axes, and radii of surfels;
    None: not asked for."""

    vertex: np.ndarray
    normal: np.ndarray | None
    radius: np.ndarray | None


class DepthBounds(NamedTuple):
    """What is known of boxes of pixels: the least and the greatest measurement, and whether a pixel has none."""

    least: Any
    most: Any
    has_unmeasured: Any


name_results("cm_depth_pyramid_bounds", DepthBounds)


def _dense(image, shape=None):
    """An image as the library reads it: float32, row by row. Whole numbers are no depths; clean_depth makes some of
    them."""
    image = np.asarray(filled(image) if is_masked(image) else image)
    if image.dtype.kind != "f":
        raise TypeError(f"image: real numbers, not {image.dtype}; clean_depth makes depths of stored units")
    if image.ndim != 2 or (shape is not None and image.shape != shape):
        raise ValueError(f"image: {shape or '(rows, columns)'}, not {image.shape}")
    return np.require(image, np.float32, ("C", "A"))


def _written(out, image, write, shape=None, in_place=False):
    """What write(address) leaves in a dense array of a shape, or of the image's: out itself if it is dense and shares
    nothing with the image, or is just where that is and may be."""
    shape = image.shape if shape is None else shape
    if out is not None and (checked_kind(out, np.ndarray, "out").shape != shape or out.dtype != np.float32 or not out.flags.writeable):
        raise ValueError(f"out: {shape} of float32, to be written to, not {out.shape} of {out.dtype}")
    fits = out is not None and out.flags.carray and (
        not np.may_share_memory(out, image) or (in_place and out.ctypes.data == image.ctypes.data))
    dense = out if fits else np.empty(shape, np.float32)
    write(dense.ctypes.data)
    if out is None or dense is out:
        return dense
    out[...] = dense
    return out


def clean_depth(picture: ArrayLike, unit: float, *, nearest: float = 0.0, farthest: float = 0.0,
                out: np.ndarray | None = None, threads: int = 1) -> tuple[np.ndarray, DepthCount]:
    """Stored depths, (rows, columns) of uint16 or float32, as metres in float32 with NaN for what is none, and how
    many were what.

    unit                metres per stored unit: 1/5000 of TUM's files, 1 of metres
    nearest, farthest   metres; 0 is no limit
    """
    if np.ndim(picture) != 2:
        raise ValueError(f"picture: (rows, columns), not {np.shape(picture)}")
    if is_masked(picture):
        picture = filled(picture, "zero")  # which is no depth either
    image, _, kept = images_in(np.shape(picture), picture)
    limits = struct(library.cm_depth_limits, unit=unit, nearest=nearest, farthest=farthest)
    count = struct(library.cm_depth_count)
    given = (image, ctypes.byref(limits), checked_threads(threads))
    depth = _written(out, kept[0, ..., 0], lambda to: library.cm_depth_clean(*given, to, ctypes.byref(count)))
    return depth, DepthCount(*(getattr(count, name) for name in DepthCount._fields))


class Rays(Specified):
    """What depth images need of a camera, made once for all its images: the rays of its pixels.

    camera         a Camera
    instructions   one of instruction_sets(); None for the best
    threads        the most that work on one image; 0 for all processors. Standard: 1

    Every method takes images of camera.shape, and `out`, an array of float32 to write into.

    >>> camera = cubemap.Camera(8, 6, 10, 10, 3.5, 2.5)
    >>> rays = cubemap.Rays(camera)
    >>> maps = rays.maps(np.full(camera.shape, 2.0, np.float32), "depth")
    >>> maps.vertex.shape, maps.normal[2, 3].tolist()
    ((6, 8, 3), [0.0, 0.0, -1.0])
    """

    _standard = {"instructions": None, "threads": 1}

    def __init__(self, camera: Camera, *, instructions: str | None = None, threads: int = 1) -> None:
        text = None if instructions is None else checked_text(instructions, "instructions")
        self._handle = created(library.cm_rays_create, "cm_rays_destroy", handle_of(camera, Camera, "camera"), text)
        self._given = (camera, instructions)
        self._threads = checked_threads(threads)

    def _arguments(self):
        return dict(zip(("camera", "instructions", "threads"), (*self._given, self._threads), strict=True))

    @property
    def camera(self) -> Camera:
        """The camera."""
        return self._given[0]

    def _given_to(self, image, *options):
        return self._handle, image.ctypes.data, *options, self._threads

    def to_range(self, depth: ArrayLike, out: np.ndarray | None = None) -> np.ndarray:
        """Depth to range; omnidirectional cameras have no depth."""
        image = _dense(depth, self.camera.shape)
        return _written(out, image, lambda to: library.cm_depth_to_range(*self._given_to(image), to), in_place=True)

    def from_range(self, range: ArrayLike, out: np.ndarray | None = None) -> np.ndarray:
        """Range to depth."""
        image = _dense(range, self.camera.shape)
        return _written(out, image, lambda to: library.cm_depth_from_range(*self._given_to(image), to), in_place=True)

    def maps(self, image: ArrayLike, kind: str, *, gap: float = 0.0, normals: bool = True,
             radii: bool = False) -> DepthMaps:
        """Points, normals and radii of an image, as DepthMaps.

        kind      "depth" or "range": what the image holds
        gap       neighbours that differ by more than this part of a pixel's depth are of another surface; 0 for 0.05
        normals   are there to be normals, towards the camera?
        radii     and radii, which cover the pixels? They need normals
        """
        is_range = number_of(kind, DEPTH_KINDS, "kind")
        if DEPTH_KINDS[is_range] != "range" and self.camera.kind == "range":
            raise ValueError("kind: images of omnidirectional cameras hold range")
        image = _dense(image, self.camera.shape)
        shape = (3, *image.shape)
        vertex, normal = np.empty(shape, np.float32), np.empty(shape, np.float32) if normals else None
        radius = np.empty(image.shape, np.float32) if radii else None
        maps = struct(library.cm_depth_maps, is_range=is_range, gap=gap)
        for k in (0, 1, 2):
            maps.vertex[k] = vertex[k].ctypes.data
            maps.normal[k] = normal[k].ctypes.data if normals else None
        maps.radius = radius.ctypes.data if radii else None
        library.cm_depth_make_maps(self._handle, image.ctypes.data, self._threads, ctypes.byref(maps))
        return DepthMaps(np.moveaxis(vertex, 0, -1), np.moveaxis(normal, 0, -1) if normals else None, radius)

    def smooth(self, image: ArrayLike, pixels: float, metres: float, out: np.ndarray | None = None) -> np.ndarray:
        """The bilateral filter of 7 x 7 pixels: the sigmas of distances in the image and of differences of values."""
        image = _dense(image, self.camera.shape)
        return _written(out, image, lambda to: library.cm_depth_smooth(*self._given_to(image, pixels, metres), to))

    def halve(self, image: ArrayLike, gap: float, out: np.ndarray | None = None) -> np.ndarray:
        """An image of half the size, for camera.halved(): the mean of those of four that are no more than `gap` of the
        nearest behind it."""
        image = _dense(image, self.camera.shape)
        shape = (image.shape[0] // 2, image.shape[1] // 2)
        return _written(out, image, lambda to: library.cm_depth_halve(*self._given_to(image, gap), to), shape)


class DepthPyramid(DepthPyramidMethods, Changing):
    """The least and greatest measurements of squares of 2, 4, 8 ... pixels of an image: DepthPyramid(depth).

    p.bounds(column, row, last_column, last_row) gives DepthBounds of boxes of pixels, ends included; what is no box
    has NaN, NaN, -1.

    >>> pyramid = cubemap.DepthPyramid(np.arange(1, 65, dtype=np.float32).reshape(8, 8))
    >>> bounds = pyramid.bounds(2, 2, 5, 3)
    >>> bounds.least, bounds.most, bounds.has_unmeasured
    (19.0, 30.0, 0)
    """

    def __init__(self, image: ArrayLike, *, instructions: str | None = None, threads: int = 1) -> None:
        image = _dense(image)
        text = None if instructions is None else checked_text(instructions, "instructions")
        self._handle = created(library.cm_depth_pyramid_create, "cm_depth_pyramid_destroy", image.shape[1],
                               image.shape[0], text)
        self._threads = checked_threads(threads)
        self._shape = image.shape
        self.fill(image)

    def fill(self, image: ArrayLike) -> None:
        """Another image of the same size in the place of this one; no other thread may use the pyramid meanwhile."""
        image = _dense(image, self._shape)
        library.cm_depth_pyramid_fill(self._handle, image.ctypes.data, self._threads)

    def __repr__(self):
        return f"<cubemap.DepthPyramid of {self._shape[0]} rows, {self._shape[1]} columns>"

    @property
    def shape(self) -> tuple[int, int]:
        """Of the image: (rows, columns)."""
        return self._shape

    @property
    def levels(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Copies of (least, most) of all levels, that of 2 x 2 pixels a cell first.

        least has a minus sign where a pixel of the cell has no measurement, and is -infinity where none has; most is 0
        there.
        """
        return [self._level(level) for level in range(1, library.cm_depth_pyramid_last(self._handle) + 1)]

    def _level(self, level):
        cells = struct(library.cm_depth_level)
        library.cm_depth_pyramid_level(self._handle, level, ctypes.byref(cells))
        shape = (cells.height, cells.width)
        return tuple(np.frombuffer(ctypes.string_at(address, 4 * cells.height * cells.width), np.float32).reshape(shape)
                     for address in (cells.least, cells.most))
