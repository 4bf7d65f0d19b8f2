# SPDX-License-Identifier: MIT
"""Poses: where cameras are and how they stand, one or arrays of them.

>>> points = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
>>> moved = cubemap.Pose.exp((1.0, 2.0, 3.0, 0.0, 0.0, 0.5)).apply_back(points)
>>> found = cubemap.align(points, moved)
>>> found.is_determined, round(found.motion.angle, 12)
(True, 0.5)
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from . import _methods
from ._errors import check
from ._masked_pictures import unmasked
from ._texts import Specified, checked_kind
from .earth import Rotation


class Pose(Specified):
    """Where a camera is and how it stands, or an array of such: Pose(), Pose(rotation, position), Pose.exp(twist).

    rotation   (..., 3, 3): its rows are the camera's axes in the world; a Rotation is one, too
    position   (..., 3): the camera's centre in the world

    x_camera = rotation (x_world - position). It stands for the motion from camera to world, as a line of TUM does: a @
    b is b, a pose in the axes of camera a, in a's world. A twist is six numbers, translation first. Arrays of poses
    broadcast as NumPy's.

    >>> turn = cubemap.Pose.from_quaternion((0, 0, 1), (0, 0, np.sqrt(0.5), np.sqrt(0.5)))
    >>> turn.apply_back((1.0, 0.0, 0.0)).round(12).tolist()
    [0.0, 1.0, 1.0]
    >>> (turn @ turn.inverse()).position.round(12).tolist()
    [0.0, 0.0, 0.0]
    >>> turn.interpolate(cubemap.Pose(), [0.0, 0.5, 1.0]).angle.round(6).tolist()
    [1.570796, 0.785398, 0.0]
    """

    __array_ufunc__ = None  # an array @ pose is none of NumPy's products

    def __init__(self, rotation: ArrayLike | Rotation | None = None, position: ArrayLike = (0.0, 0.0, 0.0)) -> None:
        rotation = np.eye(3) if rotation is None else rotation.matrix if isinstance(rotation, Rotation) else rotation
        rotation = np.asarray(unmasked(rotation, "rotation"), np.float64)
        position = np.asarray(unmasked(position, "position"), np.float64)
        if rotation.shape[-2:] != (3, 3) or position.shape[-1:] != (3,):
            raise ValueError(f"rotation, position: (..., 3, 3) and (..., 3), not {rotation.shape} and {position.shape}")
        self._set(rotation, position)
        check(int(np.max(_methods.pose_check(self._rotation, self._position), initial=0)))

    def _set(self, rotation, position):
        shape = np.broadcast_shapes(rotation.shape[:-2], position.shape[:-1])
        self._rotation = np.array(np.broadcast_to(rotation, (*shape, 3, 3)))
        self._position = np.array(np.broadcast_to(position, (*shape, 3)))
        self._rotation.flags.writeable = self._position.flags.writeable = False

    @classmethod
    def _make(cls, parts):
        """Of what the library has made: nothing is checked, so that NaN stays NaN."""
        made = object.__new__(cls)
        made._set(*parts)
        return made

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> Pose:
        """Of matrices (..., 4, 4) from camera to world, as `matrix` gives them."""
        matrix = np.asarray(unmasked(matrix, "matrix"), np.float64)
        if matrix.shape[-2:] != (4, 4) or not (matrix[..., 3, :] == (0, 0, 0, 1)).all():
            raise ValueError("matrix: (..., 4, 4) with a last row of 0 0 0 1")
        return cls(np.swapaxes(matrix[..., :3, :3], -1, -2), matrix[..., :3, 3])

    @classmethod
    def from_quaternion(cls, position: ArrayLike, quaternion: ArrayLike) -> Pose:
        """Of positions (..., 3) and quaternions (..., 4), x y z w, from camera to world, as lines of TUM have them."""
        made = cls._make(_methods.pose_from_quaternion(position, quaternion))
        if np.isnan(made._position).any() or np.isnan(made._rotation).any():
            check(library.CM_ERROR_CAMERA)
        return made

    @classmethod
    def exp(cls, twist: ArrayLike) -> Pose:
        """The motions of twists, (..., 6)."""
        return cls._make(_methods.pose_exp(twist))

    def log(self) -> np.ndarray:
        """The twists of the motions, (..., 6); angles are in [0, pi]."""
        return _methods.pose_log(*self._parts)

    @property
    def _parts(self):
        return self._rotation, self._position

    def _struct(self):
        """Of one pose, for the library."""
        if self.shape != ():
            raise ValueError(f"one pose, not an array of {self.shape}")
        made = library.cm_pose()
        ctypes.memmove(made.rotation.row, self._rotation.ctypes.data, 72)
        ctypes.memmove(made.position, self._position.ctypes.data, 24)
        return made

    @classmethod
    def _read(cls, made):
        return cls._make((np.array(made.rotation.row), np.array(made.position)))

    def _arguments(self):
        return {"rotation": self._rotation.tolist(), "position": self._position.tolist()}

    def _same(self):
        return self.shape, (self._rotation + 0.0).tobytes(), (self._position + 0.0).tobytes()

    def __reduce__(self):
        added = {name: value for name, value in vars(self).items() if name not in ("_rotation", "_position")}
        return _pose_of, (*self._parts, type(self)), added or None

    def __getitem__(self, index: Any) -> Pose:
        places = np.arange(np.prod(self.shape, dtype=int)).reshape(self.shape)[index]
        return Pose._make((self._rotation.reshape(-1, 3, 3)[places], self._position.reshape(-1, 3)[places]))

    def __iter__(self) -> Iterator[Pose]:
        return (self[index] for index in range(len(self)))

    def __len__(self) -> int:
        if self.shape == ():
            raise TypeError("one pose has no length")
        return self.shape[0]

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the array of poses: () of one."""
        return self._position.shape[:-1]

    @property
    def rotation(self) -> np.ndarray:
        """(..., 3, 3), not to be written to."""
        return self._rotation

    @property
    def position(self) -> np.ndarray:
        """(..., 3), not to be written to."""
        return self._position

    @property
    def matrix(self) -> np.ndarray:
        """(..., 4, 4), from camera to world; inverse().matrix is from world to camera."""
        matrix = np.zeros((*self.shape, 4, 4))
        matrix[..., :3, :3] = np.swapaxes(self._rotation, -1, -2)
        matrix[..., :3, 3], matrix[..., 3, 3] = self._position, 1.0
        return matrix

    @property
    def quaternion(self) -> np.ndarray:
        """(..., 4): x y z w, from camera to world; w is not less than 0."""
        return _methods.pose_quaternion(*self._parts)

    @property
    def angle(self) -> Any:
        """Of the rotation, in [0, pi]."""
        return _methods.pose_angle(*self._parts)

    def apply(self, world: ArrayLike, **keywords: Any) -> np.ndarray:
        """Points of the world, x, y, z along the last axis, in the camera's axes."""
        return _methods.pose_apply(*self._parts, world, **keywords)

    def apply_back(self, camera: ArrayLike, **keywords: Any) -> np.ndarray:
        """Points of the camera's axes in the world."""
        return _methods.pose_apply_back(*self._parts, camera, **keywords)

    def __matmul__(self, inner: Pose) -> Pose:
        if not isinstance(inner, Pose):
            return NotImplemented
        return Pose._make(_methods.pose_compose(*self._parts, *inner._parts))

    def inverse(self) -> Pose:
        """The world's pose in the camera's axes."""
        return Pose._make(_methods.pose_invert(*self._parts))

    def between(self, to: Pose) -> Pose:
        """The other pose in the axes of this one: the motion from one view to the next."""
        return Pose._make(_methods.pose_between(*self._parts, *checked_kind(to, Pose, "to")._parts))

    def interpolate(self, to: Pose, t: ArrayLike) -> Pose:
        """Along the screw from this pose, t = 0, to another, t = 1; t may be an array."""
        return Pose._make(_methods.pose_interpolate(*self._parts, *checked_kind(to, Pose, "to")._parts, t))

    def adjoint(self) -> np.ndarray:
        """(..., 6, 6): small twists in the camera's axes as twists in the world's."""
        return _methods.pose_adjoint(*self._parts)

    def transport(self, covariance: ArrayLike) -> np.ndarray:
        """Covariances (..., 6, 6) of small twists in the camera's axes as those of twists in the world's."""
        return _methods.pose_transport(*self._parts, covariance)


def _pose_of(rotation, position, kind=Pose):
    return kind._make((rotation, position))


def pose_pointer(pose: Pose | None) -> Any:
    """One pose for the library; None stays None."""
    return None if pose is None else ctypes.byref(checked_kind(pose, Pose, "pose")._struct())


class Alignment(NamedTuple):
    """The best rigid motion from points to others: cubemap/trajectory.h says what each member is."""

    motion: Pose
    rank: int
    is_determined: bool


def align(points: ArrayLike, to: ArrayLike) -> Alignment:
    """The rigid motion that takes points, (n, 3), to others with the least sum of squares: motion.apply_back(points)
    is near them."""
    points, to = (np.ascontiguousarray(unmasked(one, "points, to"), np.float64) for one in (points, to))
    if points.shape != to.shape or points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"points, to: (n, 3) both, not {points.shape} and {to.shape}")
    motion, rank, is_determined = library.cm_pose(), ctypes.c_int(), ctypes.c_int()
    library.cm_pose_align(len(points), points.ctypes.data, to.ctypes.data, ctypes.byref(motion), ctypes.byref(rank),
                          ctypes.byref(is_determined))
    return Alignment(Pose._read(motion), rank.value, bool(is_determined.value))
