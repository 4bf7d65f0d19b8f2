# SPDX-License-Identifier: MIT
"""Texel images: a fine colour picture over a coarse cloud of depths; docs/guide/sim-lens.md.

>>> options = cubemap.sim.TexelOptions(field=np.radians(40), width=64, height=64, columns=8, rows=8)
>>> image = cubemap.sim.texel_render(cubemap.Scene.named("room"), cubemap.Pose(position=(0, 0, 1.2)), options)
>>> image.color.shape, image.depth.shape
((64, 64, 3), (8, 8))
"""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _library as library
from .. import _methods
from .._texts import checked_kind, handle_of, number_of, struct
from ..mapping import pool_of
from ..pose import Pose, pose_pointer
from ..world import Scene
from ._dense import dense, measured, set_planes

SPACINGS = ("even spaces", "even angles")


class TexelOptions(NamedTuple):
    """What a texel image is to be: cubemap/texel.h says what each member is, and what stands for 0."""

    field: float
    width: int = 0
    height: int = 0
    columns: int = 0
    rows: int = 0
    window: int = 0
    oversampling: int = 0
    spacing: str = "even spaces"
    unit: float = 0.0

    def _struct(self):
        return struct(library.cm_texel_options,
                      **{**self._asdict(), "spacing": number_of(self.spacing, SPACINGS, "spacing")})


class TexelPlaces(NamedTuple):
    """Where samples are: a column of the canvas for each of the columns, a row for each of the rows; and x and y of their
    rays at z = 1."""

    column: np.ndarray
    row: np.ndarray
    x: np.ndarray
    y: np.ndarray


class TexelImage(NamedTuple):
    """A texel image: color (height, width, 3), None where only depths were given; of samples (rows, columns) depth and
    range in metres, points (..., 3) in metres, and uv (..., 2) on the canvas."""

    color: np.ndarray | None
    depth: np.ndarray
    range: np.ndarray
    point: np.ndarray
    uv: np.ndarray


def texel_linearise(near: float, far: float, z_buffer: ArrayLike) -> np.ndarray:
    """Values of a z-buffer, 0 at the near plane and 1 at the far one, to depth along the axis; far may be infinite."""
    z_buffer = np.ascontiguousarray(z_buffer, np.float32)
    depth = np.empty_like(z_buffer)
    library.cm_texel_linearise(near, far, z_buffer.size, z_buffer.ctypes.data, depth.ctypes.data)
    return depth


def texel_complete(options: TexelOptions) -> TexelOptions:
    """The options with numbers in the place of zeros."""
    made = checked_kind(options, TexelOptions, "options")._struct()
    library.cm_texel_complete(ctypes.byref(made))
    found = TexelOptions(*(getattr(made, name) for name in TexelOptions._fields))
    return found._replace(spacing=SPACINGS[found.spacing])


def texel_places(options: TexelOptions) -> TexelPlaces:
    """Where samples are on the canvas."""
    whole = texel_complete(options)
    made = TexelPlaces(*(np.empty(count) for count in (whole.columns, whole.rows) * 2))
    library.cm_texel_places(ctypes.byref(options._struct()), *(one.ctypes.data for one in made))
    return made


def texel_sample(options: TexelOptions, canvas: ArrayLike) -> np.ndarray:
    """Depths of the canvas, (height, width), to those of samples, (rows, columns): means of windows."""
    whole = texel_complete(options)
    canvas = dense(canvas, "canvas", (whole.height, whole.width))
    depth = np.empty((whole.rows, whole.columns), np.float32)
    library.cm_texel_sample(ctypes.byref(options._struct()), canvas.ctypes.data, depth.ctypes.data)
    return depth


def _image(whole, color, depth):
    """An image to be filled: its struct, and the named tuple of its arrays."""
    shape = (whole.rows, whole.columns)
    point, uv = np.empty((3, *shape), np.float32), np.empty((2, *shape), np.float32)
    image = TexelImage(color, depth, np.empty(shape, np.float32), np.moveaxis(point, 0, -1), np.moveaxis(uv, 0, -1))
    made = struct(library.cm_texel_image, range=image.range.ctypes.data, depth=depth.ctypes.data,
                  color=None if color is None else color.ctypes.data)
    set_planes(made.point, point)
    set_planes(made.uv, uv)
    return made, image


def texel_points(options: TexelOptions, depth: ArrayLike) -> TexelImage:
    """Points, ranges and places of samples from their depths, (rows, columns) in metres."""
    whole = texel_complete(options)
    depth = dense(measured(depth), "depth", (whole.rows, whole.columns))
    made, image = _image(whole, None, np.empty_like(depth))
    library.cm_texel_points(ctypes.byref(options._struct()), depth.ctypes.data, ctypes.byref(made))
    return image._replace(depth=depth)


def texel_matrix(base: Pose, scan: Pose, unit: float = 1.0) -> np.ndarray:
    """The matrices (..., 4, 4) that take points of a scan's camera to the axes of the base scan's; metres per unit of
    the world."""
    base, scan = checked_kind(base, Pose, "base"), checked_kind(scan, Pose, "scan")
    return _methods.texel_matrix(base.rotation, base.position, scan.rotation, scan.position, unit)


def texel_render(scene: Scene, pose: Pose, options: TexelOptions, *, threads: int = 1) -> TexelImage:
    """The texel image of a world seen from a pose."""
    whole = texel_complete(options)
    color = np.empty((whole.height, whole.width, 3), np.float32)
    made, image = _image(whole, color, np.empty((whole.rows, whole.columns), np.float32))
    library.cm_texel_render(handle_of(scene, Scene, "scene"), pose_pointer(pose), ctypes.byref(options._struct()),
                            pool_of(threads), ctypes.byref(made))
    return image
