# SPDX-License-Identifier: MIT
"""Trajectories: poses in time, how far one is from another, and what an inertial sensor on one measures.

>>> stamps = np.arange(100) / 10
>>> truth = cubemap.Trajectory(stamps, cubemap.Pose.exp(np.multiply.outer(stamps, (0.5, 0, 0, 0, 0, 0.1))))
>>> estimate = cubemap.Trajectory(stamps, truth.poses @ cubemap.Pose(position=(0.01, 0, 0)))
>>> found = truth.evaluate(estimate)
>>> found.pairs, found.ate_rmse < 0.01
(100, True)
"""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from . import _library as library
from ._errors import Error
from ._masked_pictures import unmasked
from ._method import bind, name_results
from ._methods import MotionMethods, TrajectoryMethods
from ._texts import Specified, checked_kind, created, handle_of, struct
from .pose import Pose

NO_INDEX = -1


class Evaluation(NamedTuple):
    """How far an estimate is from the truth: cubemap/trajectory.h says what each member is."""

    pairs: int
    motions: int
    ate_rmse: float
    rpe_translation_rmse: float
    rpe_rotation_rmse_degrees: float
    alignment: Pose
    rank: int
    is_determined: bool


class MotionState(NamedTuple):
    """Where something is and how it moves: velocity and acceleration in the world's axes, rate, radians per second, in
    the camera's."""

    pose: Pose
    velocity: np.ndarray
    acceleration: np.ndarray
    rate: np.ndarray


class InertialNoise(NamedTuple):
    """Noise of a sensor: the density of white noise, unit per root of Hz, the bias's walk, and the bias at the
    beginning."""

    density: float = 0.0
    walk: float = 0.0
    bias: tuple = (0.0, 0.0, 0.0)


class Inertial(NamedTuple):
    """What an accelerometer and a gyroscope measure: stamps (n), acceleration (n, 3) and rate (n, 3)."""

    stamps: np.ndarray
    acceleration: np.ndarray
    rate: np.ndarray


def _state_of(parts: tuple) -> MotionState:
    return MotionState(Pose._make(parts[:2]), *parts[2:])


name_results("cm_motion_at", _state_of)


class Trajectory(TrajectoryMethods, Specified):
    """Poses in time: Trajectory(stamps, poses).

    stamps   seconds (n), each greater than the one before
    poses    a Pose of shape (n,)

    t.at(index) gives stamp, rotation and position.

    >>> t = cubemap.Trajectory([0.0, 1.0], cubemap.Pose(position=[(0, 0, 0), (2, 0, 0)]))
    >>> t
    <cubemap.Trajectory of 2 poses from 0.0 to 1.0 s>
    >>> t.interpolate(0.25).position.tolist()
    [0.5, 0.0, 0.0]
    >>> t.nearest([0.01, 0.5]).tolist()
    [0, -1]
    """

    _is_remade = False

    def __init__(self, stamps: ArrayLike, poses: Pose) -> None:
        stamps = np.ascontiguousarray(unmasked(stamps, "stamps"), np.float64)
        checked_kind(poses, Pose, "poses")
        if stamps.ndim != 1 or poses.shape != stamps.shape:
            raise ValueError(f"stamps, poses: (n,) both, not {stamps.shape} and {poses.shape}")
        packed = np.concatenate((poses.rotation.reshape(-1, 9), poses.position), axis=1)
        packed, wrong = np.ascontiguousarray(packed), ctypes.c_size_t()
        pointer = packed.ctypes.data_as(ctypes.POINTER(library.cm_pose))
        address = ctypes.c_void_p()
        try:
            library.cm_trajectory_create(len(stamps), stamps.ctypes.data, pointer, ctypes.byref(address),
                                         ctypes.byref(wrong))
        except Error as error:
            if error.status in (library.CM_ERROR_DATA, library.CM_ERROR_CAMERA):
                is_stamp = error.status == library.CM_ERROR_DATA
                what = "stamps: not greater than the one before" if is_stamp else f"poses: {error}"
                raise Error(error.status, f"{what}, at index {wrong.value}") from None
            raise
        self._handle = _core.Handle(address.value, "cm_trajectory_destroy")
        self._threads = 1

    def _arguments(self):
        return {"stamps": self.stamps, "poses": self.poses}

    def _same(self):
        return self.stamps.tobytes(), self.poses

    def __repr__(self):
        stamps = self.stamps
        return f"<cubemap.Trajectory of {len(self)} poses from {stamps[0]} to {stamps[-1]} s>"

    def __len__(self) -> int:
        return library.cm_trajectory_count(self._handle)

    @property
    def stamps(self) -> np.ndarray:
        """Seconds (n)."""
        return self.at(np.arange(len(self)))[0]

    @property
    def poses(self) -> Pose:
        """The poses, (n,)."""
        return Pose._make(self.at(np.arange(len(self)))[1:])

    def interpolate(self, time: ArrayLike) -> Pose:
        """Poses at times, along the screw between neighbours; NaN before the first stamp and after the last."""
        return Pose._make(bind(self, "cm_trajectory_interpolate")(time))

    def nearest(self, time: ArrayLike, apart: float = 0.02) -> np.ndarray:
        """Indices of the stamps nearest to times, of two the earlier one; NO_INDEX, -1, where none is so near."""
        return np.asarray(bind(self, "cm_trajectory_nearest")(time, apart), np.uint64).view(np.int64)[()]

    def associate(self, other: Trajectory, apart: float = 0.02) -> tuple[np.ndarray, np.ndarray]:
        """Pairs of stamps, the closest first taken, at most so many seconds apart: indices of both, in this one's
        order."""
        handle = handle_of(other, Trajectory, "other")
        room = min(len(self), len(other))
        mine, others = np.empty((2, room), np.uintp)
        count = ctypes.c_size_t()
        library.cm_trajectory_associate(self._handle, handle, apart, room, mine.ctypes.data, others.ctypes.data,
                                        ctypes.byref(count))
        return mine[:count.value].astype(np.int64), others[:count.value].astype(np.int64)

    def evaluate(self, estimate: Trajectory, apart: float = 0.02, interval: float = 1.0) -> Evaluation:
        """ATE and RPE of an estimate, where this is the truth; apart and interval are seconds, 0 for these."""
        options = struct(library.cm_evaluation_options, apart=apart, interval=interval)
        found = struct(library.cm_evaluation)
        library.cm_trajectory_evaluate(self._handle, handle_of(estimate, Trajectory, "estimate"), ctypes.byref(options), ctypes.byref(found))
        values = {name: getattr(found, name) for name in Evaluation._fields}
        return Evaluation(**{**values, "alignment": Pose._read(found.alignment),
                             "is_determined": bool(found.is_determined)})


class Motion(MotionMethods, Specified):
    """A trajectory as a curve with continuous acceleration: Motion(trajectory).

    m.at(time) gives MotionState, NaN before the first stamp and after the last.

    >>> stamps = np.arange(10) / 10
    >>> poses = cubemap.Pose(position=np.multiply.outer(stamps, (2.0, 0.0, 0.0)))
    >>> motion = cubemap.Motion(cubemap.Trajectory(stamps, poses))
    >>> motion.at(0.45).velocity.round(9).tolist()
    [2.0, 0.0, 0.0]
    >>> motion.inertial(200, gravity=(0, 0, -9.81)).acceleration[50].round(6).tolist()
    [0.0, 0.0, 9.81]
    """

    def __init__(self, trajectory: Trajectory) -> None:
        self._handle = created(library.cm_motion_create, "cm_motion_destroy", handle_of(trajectory, Trajectory, "trajectory"))
        self._trajectory = trajectory
        self._threads = 1

    def _arguments(self):
        return {"trajectory": self._trajectory}

    @property
    def trajectory(self) -> Trajectory:
        """What it was made of."""
        return self._trajectory

    def inertial(self, rate: float, gravity: ArrayLike, *, latency: float = 0.0,
                 accelerometer: InertialNoise = InertialNoise(),
                 gyroscope: InertialNoise = InertialNoise(), seed: int = 0) -> Inertial:
        """What an inertial sensor at the camera's centre and in its axes measures, as Inertial.

        rate       samples a second
        gravity    in the world's axes: (0, 0, -9.81) where z is up
        latency    seconds by which stamps are later than what they are of
        """
        options = struct(library.cm_inertial_options, rate=rate, latency=latency, seed=seed)
        options.gravity[:] = np.asarray(gravity, float).tolist()
        for to, noise in ((options.accelerometer, accelerometer), (options.gyroscope, gyroscope)):
            to.density, to.walk = noise.density, noise.walk
            to.bias[:] = noise.bias
        count = ctypes.c_size_t()
        try:
            library.cm_motion_inertial(self._handle, ctypes.byref(options), 0, None, None, None, ctypes.byref(count))
        except Error as error:
            if error.status != library.CM_ERROR_SPACE:
                raise
        made = Inertial(np.empty(count.value), np.empty((count.value, 3)), np.empty((count.value, 3)))
        library.cm_motion_inertial(self._handle, ctypes.byref(options), count.value, *(one.ctypes.data for one in made),
                                   ctypes.byref(count))
        return made
