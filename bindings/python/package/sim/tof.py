# SPDX-License-Identifier: MIT
"""Time-of-flight cameras: sensors, lights, worlds made ready for rays, and their frames; docs/guide/sim.md.

>>> camera = cubemap.Camera(32, 24, 26, 26, 15.5, 11.5)
>>> sensor = cubemap.sim.Sensor(camera, pitch=12e-6, f_number=1.0, wavelength=850e-9, efficiency=0.4, exposure=5e-3,
...                             frequency=20e6, duty=0.5, contrast=0.8)
>>> sensor.noise_of_distance(40_000.0) < sensor.noise_of_distance(10_000.0)
True
>>> sensor._replace(phases=8).images
8
"""

from __future__ import annotations

import ctypes
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _library as library
from .._masked_pictures import unmasked
from .._texts import Specified, created, handle_of, struct
from ..budget import Budget
from ..camera import Camera, whole_number
from ..mapping import Mapping, checked_threads, mapping_of, pool_of
from ..pose import Pose
from ..trajectory import Trajectory
from ..world import Scene
from ._dense import address, dense, set_planes

SPEED_OF_LIGHT = 299792458.0
# bits of flags, as cubemap/sim.h has them
SATURATED, NOTHING, FLYING, MOTION, MULTIPATH = (1 << bit for bit in range(5))
_SHOTS = ("poisson", "freeman-tukey")  # CM_TOF_POISSON and CM_TOF_FREEMAN_TUKEY
_EFFECTS = 9  # that a plan measures


class Light(NamedTuple):
    """What shines, beside the camera and in its axes.

    power       watts, all of the cone, while it shines
    aperture    radians, full angle of the cone; 2 pi shines everywhere
    direction   of the cone's axis, of any length; 0 0 0: along the optical axis
    intensity   relative, evenly apart from the axis to the rim; () for even
    """

    power: float
    aperture: float = 2.0 * math.pi
    position: tuple = (0.0, 0.0, 0.0)
    direction: tuple = (0.0, 0.0, 0.0)
    intensity: tuple = ()


def _lights(lights):
    """The array of lights for the library, and what it points into."""
    made, kept = (library.cm_tof_light * len(lights))(), []
    for to, light in zip(made, lights, strict=True):
        to.size, to.power, to.aperture = ctypes.sizeof(to), light.power, light.aperture
        to.position[:] = dense(light.position, "position", (3,), np.float64).tolist()
        to.direction[:] = dense(light.direction, "direction", (3,), np.float64).tolist()
        kept.append(dense(light.intensity, "intensity", (None,)))
        to.n, to.intensity = kept[-1].size, kept[-1].ctypes.data if kept[-1].size else None
    return made, kept


class Reconstruction(NamedTuple):
    """What a camera's driver makes of charges: metres, electrons, electrons, and flags."""

    distance: np.ndarray
    amplitude: np.ndarray
    intensity: np.ndarray
    flags: np.ndarray


class Sensor(NamedTuple):
    """What measures: cubemap/sim.h says what each member is. What is 0 is not there.

    mask        (rows, columns), the active part of each sub-pixel, 0 to 1; () for the whole pixel
    harmonics   of the correlation: amplitudes of cos(j x) for j from 1; () for a cosine
    shot_variance   for Options(shot="freeman-tukey"): a measured polynomial of y = sqrt(N) + sqrt(N + 1), factors of 1, y,
                    y^2 ...; () for Poisson's own
    shot_range      the least and the greatest y that were measured

    sensor._replace(phases=8) is another one.
    """

    camera: Camera
    pitch: float
    f_number: float
    wavelength: float
    efficiency: float
    exposure: float
    frequency: float
    duty: float
    contrast: float
    phases: int = 4
    readout: float = 0.0
    pause: float = 0.0
    full_well: float = 0.0
    dark: float = 0.0
    read_noise: float = 0.0
    single_readout: bool = False
    mask: tuple = ()
    harmonics: tuple = ()
    second_frequency: float = 0.0
    fixed_pattern: float = 0.0
    shot_variance: tuple = ()
    shot_range: tuple = (0.0, 0.0)

    def _struct(self):
        """For the library, and what it points into."""
        tables = ("camera", "mask", "harmonics", "shot_variance", "shot_range")
        numbers = {name: value for name, value in self._asdict().items() if name not in tables}
        mask = dense(self.mask, "mask", (None, None)) if np.size(self.mask) else None
        harmonic = dense(self.harmonics, "harmonics", (None,), np.float64)
        shot = dense(self.shot_variance, "shot_variance", (None,), np.float64)
        made = struct(library.cm_tof_sensor, camera=handle_of(self.camera, Camera, "camera").address, mask=address(mask),
                      harmonics=harmonic.size, harmonic=address(harmonic) if harmonic.size else None,
                      shot_terms=shot.size, shot_variance=address(shot) if shot.size else None, **numbers)
        made.shot_least, made.shot_most = dense(self.shot_range, "shot_range", (2,), np.float64).tolist()
        if mask is not None:
            made.mask_rows, made.mask_columns = mask.shape
        return made, (self.camera, mask, harmonic, shot)

    @property
    def images(self) -> int:
        """Phase images of a frame: two series of them with a second frequency."""
        return self.phases * (2 if self.second_frequency else 1)

    @property
    def frame_time(self) -> float:
        """Seconds from one frame's beginning to the next."""
        made, _kept = self._struct()
        return library.cm_tof_frame_time(ctypes.byref(made))

    def noise_of_distance(self, signal: float, ambient: float = 0.0) -> float:
        """The standard deviation of the distance by shot noise, metres, of electrons a phase image."""
        made, _kept = self._struct()
        return library.cm_tof_noise_of_distance(ctypes.byref(made), signal, ambient)

    def reconstruct(self, charge_a: ArrayLike, charge_b: ArrayLike, flags: ArrayLike | None = None) -> Reconstruction:
        """Distance, amplitude and intensity of charges (images, ...); flags that are given are added to."""
        made, _kept = self._struct()
        charge_a = np.ascontiguousarray(unmasked(charge_a, "charge_a"), np.float32)
        if charge_a.shape[:1] != (self.images,):
            raise ValueError(f"charge_a: ({self.images}, ...), not {charge_a.shape}")
        charge_b = dense(charge_b, "charge_b", charge_a.shape)
        shape = charge_a.shape[1:]
        flags = np.zeros(shape, np.uint8) if flags is None else dense(flags, "flags", shape, np.uint8).copy()
        found = Reconstruction(*(np.empty(shape, np.float32) for _ in range(3)), flags)
        library.cm_tof_reconstruct(ctypes.byref(made), flags.size, charge_a.ctypes.data, charge_b.ctypes.data,
                                   *map(address, found))
        return found


class Surroundings(NamedTuple):
    """Light from all around, not modulated, in W / (m^2 sr) of what the camera's filter lets pass.

    constant   everywhere
    mapping    a Mapping or its specification, in the world's axes, of radiance (faces, edge, edge), which is added
    """

    constant: float = 0.0
    mapping: str | Mapping = "coupled"
    radiance: ArrayLike | None = None

    def _struct(self):
        """For the library, and what it points into."""
        mapping = mapping_of(self.mapping)
        made = struct(library.cm_tof_environment, mapping=mapping._handle.address, constant=self.constant)
        radiance = None
        if self.radiance is not None:
            edge = np.shape(self.radiance)[-1:]
            radiance = dense(self.radiance, "radiance", (mapping.face_count, *edge, *edge))
            made.edge, made.radiance = radiance.shape[-1], radiance.ctypes.data
        return made, (mapping, radiance)


class Options(NamedTuple):
    """How a frame is simulated: cubemap/sim.h says what each member is, and what stands for 0.

    samples        of a pixel, columns and rows; times: of an exposure
    shot           where shot noise comes from: "poisson" or "freeman-tukey"
    mapping        of the map in which virtual lights are found; None for the equal-area cube "healpix"
    surroundings   Surroundings, or None
    """

    bounces: int = 0
    lights: int = 0
    visibility: bool = False
    paths: int = 0
    traces: bool = False
    samples: tuple = (1, 1)
    times: int = 0
    full: bool = False
    noise: bool = False
    seed: int = 0
    view: int = 0
    mapping: str | Mapping | None = None
    map_edge: int = 0
    surroundings: Surroundings | None = None
    shot: str = "poisson"

    def _struct(self):
        """For the library, and what it points into."""
        columns, rows = self.samples
        counts = {"lights": self.lights, "paths": self.paths, "view": self.view, "map_edge": self.map_edge,
                  "sample_columns": columns, "sample_rows": rows, "sample_times": self.times}
        if self.shot not in _SHOTS:
            raise ValueError(f"shot: one of {', '.join(_SHOTS)}, not {self.shot!r}")
        made = struct(library.cm_tof_options, bounces=self.bounces, seed=self.seed, shot=_SHOTS.index(self.shot),
                      **{name: bool(getattr(self, name)) for name in ("visibility", "traces", "full", "noise")},
                      **{name: whole_number(value, name) for name, value in counts.items()})
        kept = []
        if self.mapping is not None:
            kept.append(mapping_of(self.mapping))
            made.mapping = kept[0]._handle.address
        if self.surroundings is not None:
            kept.append(self.surroundings._struct())
            made.environment = ctypes.pointer(kept[-1][0])
        return made, kept

    def _changed(self, made):
        """These, but with the numbers of a struct."""
        numbers = {name: getattr(made, name) for name in ("bounces", "lights", "paths")}
        switches = {name: bool(getattr(made, name)) for name in ("visibility", "traces", "full", "noise")}
        return self._replace(**numbers, **switches, samples=(made.sample_columns, made.sample_rows),
                             times=made.sample_times)


class Report(NamedTuple):
    """What was done for a frame: cubemap/sim.h says what each member is."""

    rays: int
    oversampled: int
    times: int
    lights: int
    saturated: int


class TofFrame(NamedTuple):
    """What a camera measures, (rows, columns): phase, charge_a and charge_b (images, rows, columns) in electrons, distance in
    metres, NaN where nothing came, amplitude and intensity in electrons, flags, and the Report."""

    phase: np.ndarray
    charge_a: np.ndarray
    charge_b: np.ndarray
    distance: np.ndarray
    amplitude: np.ndarray
    intensity: np.ndarray
    flags: np.ndarray
    report: Report


class Truth(NamedTuple):
    """What is truly there, (rows, columns): position and normal (..., 3) in the world, object, an id of the scene or NO_ID,
    shape, an index of its kind, triangle, depth and range; and where that is at other times, (..., 3) in pixels, pixels and
    metres of range; None: not asked for."""

    position: np.ndarray
    normal: np.ndarray
    object: np.ndarray
    shape: np.ndarray
    triangle: np.ndarray
    depth: np.ndarray
    range: np.ndarray
    flow_next: np.ndarray | None
    flow_before: np.ndarray | None


def _path(trajectory):
    """A camera that stands still has a trajectory of one pose."""
    return Trajectory([0.0], trajectory[None]) if isinstance(trajectory, Pose) else trajectory


def _handle(trajectory):
    return None if trajectory is None else handle_of(trajectory, Trajectory, "trajectory")


class TofScene(Specified):
    """A world made ready for rays: TofScene(Scene.named("room")). Its primitives may have a motion, a Trajectory of their own,
    and a Brdf: primitive._replace(motion=..., brdf=...).

    threads   the most that work on one frame; 0 for all processors. Standard: 1; the bits are the same

    The camera's trajectory is a Trajectory, a Pose where it stands, or None for the origin along the world's axes.

    >>> scene = cubemap.sim.TofScene(cubemap.Scene([cubemap.Primitive.plane((0, 0, 2), (0, 0, -1))]))
    >>> truth = scene.find_truth(cubemap.Camera(8, 6, 10, 10, 3.5, 2.5))
    >>> len(scene), truth.depth.min().item(), truth.depth.max().item()
    (1, 2.0, 2.0)
    """

    _standard = {"threads": 1}

    def __init__(self, scene: Scene, *, threads: int = 1) -> None:
        world = handle_of(scene, Scene, "scene")
        self._handle = created(library.cm_tof_scene_create, "cm_tof_scene_destroy", world, keep=world)
        self._scene, self._threads = scene, checked_threads(threads)
        self._pool = pool_of(threads)

    def _arguments(self):
        return {"scene": self._scene, "threads": self._threads}

    def __len__(self) -> int:
        return library.cm_tof_scene_count(self._handle)

    @property
    def scene(self) -> Scene:
        """What it was made of."""
        return self._scene

    def simulate(self, sensor: Sensor, lights: list | tuple, trajectory: Trajectory | Pose | None = None,
                 time: float = 0.0, options: Options = Options()) -> TofFrame:
        """The frame that begins at a time, seconds of the trajectory."""
        (of, kept), (shining, tables), (how, more) = sensor._struct(), _lights(lights), options._struct()
        path, report = _path(trajectory), struct(library.cm_tof_report)
        shape, images = sensor.camera.shape, (sensor.images, *sensor.camera.shape)
        made = {name: np.empty(images, np.float32) for name in ("phase", "charge_a", "charge_b")}
        made.update({name: np.empty(shape, np.float32) for name in ("distance", "amplitude", "intensity")})
        made["flags"] = np.empty(shape, np.uint8)
        result = struct(library.cm_tof_result, report=ctypes.pointer(report),
                        **{name: array.ctypes.data for name, array in made.items()})
        library.cm_tof_simulate(self._handle, ctypes.byref(of), shining, len(lights), _handle(path), time,
                                ctypes.byref(how), self._pool, ctypes.byref(result))
        return TofFrame(**made, report=Report(*(getattr(report, name) for name in Report._fields)))

    def plan(self, sensor: Sensor, lights: list | tuple, limit: float, trajectory: Trajectory | Pose | None = None,
             time: float = 0.0, most: Options = Options(samples=(3, 3))) -> tuple[Options, Budget]:
        """What a frame needs for an error of distance of at most limit metres, and the Budget that says why; most says
        how many bounces, samples, lights and paths to take at the most where they are needed, 0: as many as are. Bounces
        below 0: direct light alone."""
        (of, kept), (shining, tables), (how, more) = sensor._struct(), _lights(lights), most._struct()
        path, chosen = _path(trajectory), struct(library.cm_tof_options)
        entries = (library.cm_budget_entry * _EFFECTS)()
        budget = struct(library.cm_budget, entry=ctypes.cast(entries, ctypes.POINTER(library.cm_budget_entry)))
        library.cm_tof_plan(self._handle, ctypes.byref(of), shining, len(lights), _handle(path), time, limit,
                            ctypes.byref(how), self._pool, ctypes.byref(chosen), ctypes.byref(budget))
        return most._changed(chosen), Budget._read(budget)

    def find_truth(self, camera: Camera, trajectory: Trajectory | Pose | None = None, time: float = 0.0, *,
                   next: float | None = None, before: float | None = None) -> Truth:
        """What is truly there at a time, and its flow to the times next and before."""
        handle = handle_of(camera, Camera, "camera")
        shape, path = camera.shape, _path(trajectory)
        truth, made = struct(library.cm_tof_truth), {}
        flows = (("flow_next", next), ("flow_before", before))
        for name, dtype in (("position", np.float64), ("normal", np.float32),
                            *((name, np.float32) for name, when in flows if when is not None)):
            made[name] = np.empty((3, *shape), dtype)
            set_planes(getattr(truth, name), made[name])
        for name in ("object", "shape", "triangle", "depth", "range"):
            made[name] = np.empty(shape, np.float32 if name in ("depth", "range") else np.uint32)
            setattr(truth, name, made[name].ctypes.data)
        library.cm_tof_find_truth(self._handle, handle, _handle(path), time, time if next is None else next,
                                  time if before is None else before, self._pool, ctypes.byref(truth))
        return Truth(*(None if name not in made else np.moveaxis(made[name], 0, -1) if made[name].ndim == 3
                       else made[name] for name in Truth._fields))
