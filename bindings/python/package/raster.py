# SPDX-License-Identifier: MIT
"""Triangles, discs and points drawn into any camera, with a z-buffer and ids.

>>> raster = cubemap.Raster(cubemap.Camera(8, 6, 10, 10, 3.5, 2.5))
>>> raster.points([(0.0, 0.0, 2.0), (0.0, 0.0, 1.0)], first_id=7)
>>> depth, ids = raster.read()
>>> np.nanmin(depth).item(), ids[ids != cubemap.NO_ID].tolist()
(1.0, [8])
"""

from __future__ import annotations

import ctypes
import threading

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from ._errors import Error
from ._masked_pictures import unmasked
from ._texts import Changing, checked_text, created, handle_of, struct
from .camera import Camera, whole_number
from .mapping import checked_threads
from .pose import Pose, pose_pointer

NO_ID = 2**32 - 1


def numbers_of(values: ArrayLike, columns: int, dtype: type, name: str) -> np.ndarray:
    """Dense numbers, so many beside each other."""
    values = np.ascontiguousarray(unmasked(values, name), dtype)
    if values.ndim != 2 or values.shape[1] != columns:
        raise ValueError(f"{name}: (n, {columns}), not {values.shape}")
    return values


def indices_of(index: ArrayLike, vertices: int) -> np.ndarray:
    """Triangles as indices of vertices, in 32 bits."""
    index = np.asarray(unmasked(index, "index"))
    if index.dtype.kind not in "iu" and index.size:
        raise TypeError(f"index: whole numbers, not {index.dtype}")
    if index.size and not (0 <= index.min() and index.max() < vertices):
        raise Error(library.CM_ERROR_ARGUMENT, f"index: 0 to {vertices - 1}, not {index.min()} to {index.max()}")
    return numbers_of(index.astype(np.uint32), 3, np.uint32, "index")


class Raster(Changing):
    """An empty canvas in front of a camera, on which the nearest wins: Raster(camera).

    nearest        what is nearer is not seen; 0 for all that is in front
    instructions   one of instruction_sets(); None for the best
    threads        the most that draw; 0 for all processors. Standard: 1

    Triangles, discs and points are of the world, and pose is the camera's: None where the world's axes are the
    camera's. Ids go from first_id on. Several threads of Python may share a canvas: one at a time draws.

    >>> canvas = cubemap.Raster(cubemap.Camera(8, 6, 10, 10, 3.5, 2.5))
    >>> canvas.triangles([(-9.0, -9.0, 2.0), (9.0, -9.0, 2.0), (0.0, 18.0, 2.0)])
    >>> np.isnan(canvas.read()[0]).any().item()
    False
    """

    def __init__(self, camera: Camera, nearest: float = 0.0, *, instructions: str | None = None,
                 threads: int = 1) -> None:
        text = None if instructions is None else checked_text(instructions, "instructions")
        self._handle = created(library.cm_raster_create, "cm_raster_destroy", handle_of(camera, Camera, "camera"), nearest, text,
                               keep=camera._handle)
        self._camera = camera
        self._threads = checked_threads(threads)
        self._lock = threading.Lock()

    def __repr__(self):
        return f"<cubemap.Raster of {self._camera!r}>"

    @property
    def camera(self) -> Camera:
        """The camera."""
        return self._camera

    def clear(self) -> None:
        """Empty again."""
        with self._lock:
            library.cm_raster_clear(self._handle)

    def triangles(self, position: ArrayLike, index: ArrayLike | None = None, *, pose: Pose | None = None,
                  first_id: int = 0) -> None:
        """Draw triangles: positions (n, 3) of vertices, and indices (m, 3) of them; None takes three vertices after
        another."""
        given = _triangles(position, index, first_id)
        with self._lock:
            library.cm_raster_triangles(self._handle, pose_pointer(pose), ctypes.byref(given), self._threads)

    def discs(self, centre: ArrayLike, normal: ArrayLike, radius: ArrayLike, *, pose: Pose | None = None,
              first_id: int = 0) -> None:
        """Draw oriented surfels: centres (n, 3), normals (n, 3) of any length, radii (n); computed in float."""
        centre, normal = (np.ascontiguousarray(numbers_of(one, 3, np.float32, name).T)
                          for one, name in ((centre, "centre"), (normal, "normal")))
        radius = np.ascontiguousarray(unmasked(radius, "radius"), np.float32)
        if centre.shape != normal.shape or radius.shape != centre.shape[1:]:
            counts = f"{radius.shape}, {centre.shape[1:]} and {normal.shape[1:]}"
            raise ValueError(f"radius: as many as centres and normals, not {counts}")
        given = struct(library.cm_discs, count=radius.size, radius=radius.ctypes.data,
                       first_id=whole_number(first_id, "first_id"))
        for k in (0, 1, 2):
            given.centre[k], given.normal[k] = centre[k].ctypes.data, normal[k].ctypes.data
        with self._lock:
            library.cm_raster_discs(self._handle, pose_pointer(pose), ctypes.byref(given), self._threads)

    def points(self, position: ArrayLike, *, pose: Pose | None = None, first_id: int = 0) -> None:
        """Draw points (n, 3), one pixel each."""
        position = numbers_of(position, 3, np.float64, "position")
        given = struct(library.cm_points, count=len(position), position=position.ctypes.data,
                       first_id=whole_number(first_id, "first_id"))
        with self._lock:
            library.cm_raster_points(self._handle, pose_pointer(pose), ctypes.byref(given), self._threads)

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        """What is seen: depth, or range of omnidirectional cameras, float32 with NaN for nothing; and ids, uint32 with
        NO_ID."""
        image, ids = np.empty(self._camera.shape, np.float32), np.empty(self._camera.shape, np.uint32)
        with self._lock:
            library.cm_raster_read(self._handle, image.ctypes.data, ids.ctypes.data)
        return image, ids

    def weights(self, position: ArrayLike, index: ArrayLike | None = None, *, pose: Pose | None = None,
                first_id: int = 0) -> tuple[np.ndarray, np.ndarray]:
        """Where in its triangle each pixel lies that shows one of these, as they were drawn: weights of the second and
        the third vertex; that of the first is what is left of 1. Other pixels are NaN."""
        given = _triangles(position, index, first_id)
        second, third = np.empty((2, *self._camera.shape), np.float32)
        with self._lock:
            library.cm_raster_weights(self._handle, pose_pointer(pose), ctypes.byref(given), second.ctypes.data,
                                      third.ctypes.data)
        return second, third


def _triangles(position, index, first_id):
    position = numbers_of(position, 3, np.float64, "position")
    if index is None and len(position) % 3:
        raise ValueError(f"position: three vertices a triangle without an index, not {len(position)}")
    given = struct(library.cm_triangles, vertex_count=len(position), position=position.ctypes.data,
                   triangle_count=len(position) // 3,
                   first_id=whole_number(first_id, "first_id"))
    given.kept = position
    if index is not None:
        index = indices_of(index, len(position))
        given.triangle_count, given.index, given.kept = len(index), index.ctypes.data, (position, index)
    return given
