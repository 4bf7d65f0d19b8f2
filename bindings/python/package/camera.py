# SPDX-License-Identifier: MIT
"""Cameras: from points to pixels, and from pixels to rays.

>>> camera = cubemap.Camera(640, 480, 525, 525, 319.5, 239.5)
>>> np.round(camera.project(0.3, -0.2, 2.0), 9).tolist()
[398.25, 187.0]
>>> np.round(camera.ray(398.25, 187.0), 9).tolist()
[0.15, -0.1, 1.0]
"""

from __future__ import annotations

import ctypes
import operator

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from ._errors import Error
from ._methods import CameraMethods
from ._texts import Specified, created, struct
from .mapping import Frame, Mapping, checked_threads

DEPTH_KINDS = ("depth", "range")
_NUMBERS = ("fx", "fy", "cx", "cy")


def whole_number(value: int, name: str) -> int:
    """A number of 32 bits, as the library has sizes and ids."""
    value = operator.index(value)
    if not 0 <= value < 2**32:
        raise Error(library.CM_ERROR_RANGE, f"{name}: 0 to 2^32 - 1, not {value}")
    return value


class Camera(CameraMethods, Specified):
    """A camera: Camera(640, 480, 525, 525, 319.5, 239.5), or an omnidirectional one, Camera(mapping="coupled",
    size=256).

    width, height   pixels; of a cube's mapping N and 6 N, of others N and N: size=N says both
    fx, fy, cx, cy  focal lengths and the principal point, pixels
    pixel_centre    where centres of pixels are: 0 at integers, as OpenCV and TUM have it, 0.5 as pictures of this
                    library
    distortion      up to 14 numbers in OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y
    mapping         instead of these: a Mapping, or its specification with a frame
    threads         the most that work on one array; 0 for all processors. Standard: 1

    c.project(x, y, z) gives column and row, c.ray(column, row) gives x, y and z. Perspective cameras have x right, y
    down, z forward, and rays with z = 1; omnidirectional ones have their mapping's axes, and rays of length 1. What
    the camera does not see is NaN, what is beyond a fold of the lens too. The names are those of CAMERA.json, so that
    what json.load makes of it, but for "depth_scale", are arguments here.

    >>> around = cubemap.Camera(mapping="coupled", size=256)
    >>> around.shape, around.kind
    ((1536, 256), 'range')
    >>> halved = cubemap.Camera(640, 480, 525, 525, 319.5, 239.5, distortion=(-0.28, 0.07)).halved()
    >>> halved.width, halved.fx
    (320, 262.5)
    """

    _standard = {"width": 0, "height": 0, **dict.fromkeys(_NUMBERS, 0.0), "pixel_centre": 0.0, "distortion": (),
                 "mapping": None, "threads": 1}

    def __init__(self, width: int = 0, height: int = 0, fx: float = 0.0, fy: float = 0.0, cx: float = 0.0,
                 cy: float = 0.0, pixel_centre: float = 0.0, distortion: ArrayLike = (),
                 mapping: str | Mapping | None = None, *,
                 frame: str | Frame | None = None, size: int = 0, threads: int = 1) -> None:
        distortion = np.asarray(distortion, np.float64)
        if distortion.ndim != 1 or distortion.size > 14:
            raise ValueError(f"distortion: up to 14 numbers, not {distortion.shape}")
        if mapping is None and (frame is not None or size):
            raise ValueError("frame, size: of cameras with a mapping")
        if mapping is not None and (any((fx, fy, cx, cy)) or distortion.any()):
            raise ValueError("mapping: stands instead of fx, fy, cx, cy and distortion")
        if mapping is not None:
            if isinstance(mapping, Mapping) and frame is not None:
                raise ValueError("frame: a Mapping has its own")
            mapping = mapping if isinstance(mapping, Mapping) else Mapping(mapping, "geo" if frame is None else frame)
            if size:
                width, height = size, size * mapping.face_count
        options = struct(library.cm_camera_options, width=whole_number(width, "width"),
                         height=whole_number(height, "height"), fx=fx, fy=fy, cx=cx, cy=cy, pixel_centre=pixel_centre)
        options.distortion[:distortion.size] = distortion.tolist()
        if mapping is not None:
            options.mapping = mapping._handle.address
        self._handle = created(library.cm_camera_create, "cm_camera_destroy", ctypes.byref(options),
                               keep=None if mapping is None else mapping._handle)
        self._mapping = mapping
        self._threads = checked_threads(threads)

    @property
    def _options(self):
        return library.cm_camera_describe(self._handle).contents

    def _arguments(self):
        options = self._options
        distortion = tuple(np.trim_zeros(list(options.distortion), "b"))
        return {"width": options.width, "height": options.height, **{name: getattr(options, name) for name in _NUMBERS},
                "pixel_centre": options.pixel_centre, "distortion": distortion, "mapping": self._mapping,
                "threads": self._threads}

    @property
    def width(self) -> int:
        """Pixels from left to right."""
        return self._options.width

    @property
    def height(self) -> int:
        """Pixels from top to bottom: of a cube all six faces, one under another."""
        return self._options.height

    @property
    def shape(self) -> tuple[int, int]:
        """Of its images as arrays: (rows, columns)."""
        return self.height, self.width

    @property
    def fx(self) -> float:
        """The focal length along rows, pixels."""
        return self._options.fx

    @property
    def fy(self) -> float:
        """The focal length along columns, pixels."""
        return self._options.fy

    @property
    def cx(self) -> float:
        """The principal point's column."""
        return self._options.cx

    @property
    def cy(self) -> float:
        """The principal point's row."""
        return self._options.cy

    @property
    def pixel_centre(self) -> float:
        """Column and row of a pixel's centre are i + pixel_centre."""
        return self._options.pixel_centre

    @property
    def distortion(self) -> tuple[float, ...]:
        """14 numbers in OpenCV's order."""
        return tuple(self._options.distortion)

    @property
    def mapping(self) -> Mapping | None:
        """Of omnidirectional cameras; None of perspective ones."""
        return self._mapping

    @property
    def kind(self) -> str:
        """What a ray of it is multiplied by: "depth", along the axis, or "range", along the ray, of omnidirectional
        ones."""
        return DEPTH_KINDS[self._mapping is not None]

    def pixels(self) -> tuple[np.ndarray, np.ndarray]:
        """Columns and rows of the centres of all pixels, (columns,) and (rows, 1): together they are of the camera's
        shape."""
        return np.arange(self.width) + self.pixel_centre, np.arange(self.height)[:, np.newaxis] + self.pixel_centre

    def halved(self) -> Camera:
        """The camera of an image that Rays.halve has made."""
        options = struct(library.cm_camera_options)
        library.cm_depth_halve_camera(ctypes.byref(self._options), ctypes.byref(options))
        changed = ("width", "height", "pixel_centre", *(_NUMBERS if self._mapping is None else ()))
        return Camera(**{**self._arguments(), **{name: getattr(options, name) for name in changed}})
