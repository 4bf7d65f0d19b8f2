# SPDX-License-Identifier: MIT
"""Lenses for rasterisers that know only pinholes: vertices moved, or pictures resampled; docs/guide/sim-lens.md.

>>> camera = cubemap.Camera(64, 48, 52, 52, 31.5, 23.5, distortion=(-0.28, 0.07))
>>> pinhole = cubemap.sim.lens_pinhole(camera)
>>> pinhole.width > camera.width, pinhole.distortion == (0.0,) * 14
(True, True)
>>> cubemap.sim.lens_guard(camera) > 1.1
True
"""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import ArrayLike

from .. import _library as library
from .._texts import Specified, created, handle_of, struct
from ..camera import Camera
from ..mapping import pool_of
from ._dense import dense


def lens_frustum(camera: Camera) -> np.ndarray:
    """The planes of the picture's left, right, upper and lower edge at z = 1, of the camera without its distortion."""
    frustum = np.empty(4)
    library.cm_lens_frustum(handle_of(camera, Camera, "camera"), frustum.ctypes.data)
    return frustum


def lens_guard(camera: Camera, delta: float = 0.1) -> float:
    """How far vertices must be kept around the frustum, in normalised device coordinates: 1 + delta + what the lens
    brings in from beyond it."""
    guard = ctypes.c_double()
    library.cm_lens_guard(handle_of(camera, Camera, "camera"), delta, ctypes.byref(guard))
    return guard.value


def lens_move_vertices(camera: Camera, points: ArrayLike, guard: float = 0.0) -> np.ndarray:
    """Points (..., 3) of the camera's axes, moved so that a pinhole draws them where the lens has them; NaN for those
    that are left out. guard 0: none is left out for being far outside."""
    points = np.asarray(points, np.float64)
    if points.shape[-1:] != (3,):
        raise ValueError(f"points: (..., 3), not {points.shape}")
    given = np.ascontiguousarray(np.moveaxis(points, -1, 0))
    moved = np.empty_like(given)
    addresses = [one.ctypes.data for side in (given.reshape(3, -1), moved.reshape(3, -1)) for one in side]
    library.cm_lens_move_vertices(handle_of(camera, Camera, "camera"), guard, points.size // 3, *addresses)
    return np.moveaxis(moved, 0, -1)


def lens_pinhole(camera: Camera, scale: float = 0.0) -> Camera:
    """The pinhole whose picture covers the whole distorted one. Its focal lengths are the camera's times scale; 0: so
    many times that neighbours are nowhere less than a pixel apart."""
    options = struct(library.cm_camera_options)
    library.cm_lens_pinhole(handle_of(camera, Camera, "camera"), scale, ctypes.byref(options))
    return Camera(*(getattr(options, name) for name in ("width", "height", "fx", "fy", "cx", "cy", "pixel_centre")))


class LensMap(Specified):
    """Where each pixel of a camera's distorted picture is in an undistorted one: LensMap(camera).

    pinhole   the camera of that; None for lens_pinhole(camera)
    threads   the most that work on one picture; 0 for all processors. Standard: 1

    Pictures are of pinhole.shape, what comes out of camera.shape.

    >>> lens = cubemap.sim.LensMap(cubemap.Camera(64, 48, 52, 52, 31.5, 23.5, distortion=(-0.28, 0.07)))
    >>> lens.unfilled
    0
    >>> round(lens.depth(np.full(lens.pinhole.shape, 2.0, np.float32)).max().item(), 6)
    2.0
    """

    def __init__(self, camera: Camera, pinhole: Camera | None = None, *, threads: int = 1) -> None:
        self._cameras = (camera, lens_pinhole(camera) if pinhole is None else pinhole)
        self._pool, self._threads = pool_of(threads), threads
        handles = tuple(handle_of(one, Camera, "cameras") for one in self._cameras)
        self._handle = created(library.cm_lens_map_create, "cm_lens_map_destroy", *handles, self._pool, keep=handles)

    def _arguments(self):
        return {"camera": self.camera, "pinhole": self.pinhole, "threads": self._threads}

    def __repr__(self):
        return f"<cubemap.sim.LensMap from {self.pinhole.shape} to {self.camera.shape}>"

    @property
    def camera(self) -> Camera:
        """The camera with the lens."""
        return self._cameras[0]

    @property
    def pinhole(self) -> Camera:
        """The camera without one."""
        return self._cameras[1]

    @property
    def unfilled(self) -> int:
        """How many pixels have a ray that the pinhole does not show."""
        return library.cm_lens_map_unfilled(self._handle)

    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """Columns and rows of the undistorted picture; NaN where there is none."""
        column, row = np.empty((2, *self.camera.shape))
        library.cm_lens_map_places(self._handle, column.ctypes.data, row.ctypes.data)
        return column, row

    def _picture(self, picture, *more):
        return dense(picture, "picture", (*self.pinhole.shape, *more))

    def color(self, picture: ArrayLike) -> np.ndarray:
        """Colours, (rows, columns[, channels]), bilinear; NaN where nothing is."""
        picture = self._picture(picture, *[None] * (np.ndim(picture) == 3))
        made = np.empty((*self.camera.shape, *picture.shape[2:]), np.float32)
        channels = picture.shape[2] if picture.ndim == 3 else 1
        library.cm_lens_map_color(self._handle, channels, picture.ctypes.data, made.ctypes.data, self._pool)
        return made

    def depth(self, picture: ArrayLike, gap: float = 0.0) -> np.ndarray:
        """Depth along the axis: 1 / depth is interpolated, never between surfaces that are more than this part of the
        nearest depth apart; gap 0 for 0.05."""
        picture, made = self._picture(picture), np.empty(self.camera.shape, np.float32)
        library.cm_lens_map_depth(self._handle, gap, picture.ctypes.data, made.ctypes.data, self._pool)
        return made

    def labels(self, picture: ArrayLike, nothing: object = 0) -> np.ndarray:
        """Ids and all else that is never mixed, (rows, columns) of any type: those of the nearest pixel."""
        picture = np.ascontiguousarray(picture)
        if picture.dtype.hasobject or picture.shape != self.pinhole.shape:
            raise ValueError(f"picture: {self.pinhole.shape} of numbers, not {picture.shape} of {picture.dtype}")
        empty, made = np.array(nothing, picture.dtype), np.empty(self.camera.shape, picture.dtype)
        library.cm_lens_map_labels(self._handle, picture.itemsize, picture.ctypes.data, empty.ctypes.data,
                                   made.ctypes.data, self._pool)
        return made

    def flow(self, picture: ArrayLike) -> np.ndarray:
        """Flow, (rows, columns, 2) in pixels: that of the nearest pixel, whose end goes through the lens, too."""
        picture, made = self._picture(picture, 2), np.empty((*self.camera.shape, 2), np.float32)
        library.cm_lens_map_flow(self._handle, picture.ctypes.data, made.ctypes.data, self._pool)
        return made
