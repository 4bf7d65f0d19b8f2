# SPDX-License-Identifier: MIT
"""Octrees: maps of scenes from depth views, what is asked of them, their pictures, and hulls of silhouettes.

>>> camera, room = cubemap.Camera(64, 48, 52, 52, 31.5, 23.5), cubemap.Scene.named("room")
>>> pose = cubemap.Pose.from_quaternion((0, 0, 1.2), (-0.5, 0.5, -0.5, 0.5))  # looks along x
>>> octree = cubemap.Octree(0.05, far=8.0)
>>> octree.update(room.render(camera, pose).distance.astype(np.float32), camera, pose)
>>> [cubemap.STATES[state] for state in octree.at([(1.0, 0, 1.2), (-2, 0, 1.2)], 0).state]
['free', 'unknown']
"""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _library as library
from ._errors import Error
from ._masked_pictures import three_numbers
from ._method import name_results
from ._methods import OctreeMethods
from ._texts import Changing, checked_kind, checked_text, created, handle_of, number_of, struct
from .camera import DEPTH_KINDS, Camera
from .images import PIXEL_TYPES, images_in
from .mapping import checked_threads, pool_of
from .pose import Pose, pose_pointer
from .raster import Raster, numbers_of
from .store import Store

RULES = ("counts", "log-odds")
STATES = ("unknown", "free", "occupied")

_Job = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)


class Voxels(NamedTuple):
    """Voxels, an array for each of their numbers: the centre x, y, z, edge, the distance of rays and of the nearest, level,
    state (an index of STATES), alpha, whether it has a color, and color (..., 3)."""

    x: Any
    y: Any
    z: Any
    edge: Any
    distance: Any
    level: Any
    state: Any
    alpha: Any
    has_color: Any
    color: Any


class OctreeCount(NamedTuple):
    """What a map holds: cubemap/octree.h says what each member is."""

    occupied: int
    free: int
    nodes: int
    bytes: int
    paged: int


class OctreePicture(NamedTuple):
    """What a camera sees of a map: color (rows, columns, channels), and depth, of omnidirectional cameras range, NaN where
    nothing is; None: not asked for."""

    color: np.ndarray | None
    depth: np.ndarray | None


def _voxels_of(numbers: tuple) -> Voxels:
    """What a ufunc writes, without what the function returns: the state or the distance says it."""
    return Voxels(*numbers[:len(Voxels._fields)])


for _name in ("cm_octree_at", "cm_octree_ray", "cm_octree_nearest"):
    name_results(_name, _voxels_of)


def _voxels_in(data):
    """Voxels of the bytes of their structs."""
    found = np.frombuffer(data, np.dtype(library.cm_voxel))
    return Voxels(*(found[name].copy() for name in Voxels._fields))


class Octree(OctreeMethods, Changing):
    """A map of a scene from depth views: Octree(0.01, far=8.0).

    edge          of the finest voxel
    levels        1 to 20: the root has 2^levels voxels each way
    centre        of the root
    rule          of RULES: "counts", 2 for a hit and 2 for a miss, or "log-odds" with hit, miss, low and high
    nearest, far  what is nearer says nothing; what is farther is free up to there. 0: no limit
    no_return_is_free   pixels that measured nothing are free up to far
    endpoints_only      nothing is missed: no space becomes free, and what moves away stays
    noise         of the sensor: sigma / range
    footprint     voxels are no finer than so many pixels; 0: one size
    color         do voxels have colors?
    memory, pages   bytes in memory before parts go to a Store, which is used by one map at a time
    instructions  one of instruction_sets(); None for the best
    threads       the most that work on one call; 0 for all processors. Standard: 1

    Of points (..., 3), broadcast: m.at(point, level), m.ray(origin, direction, far) and m.nearest(point, radius) give
    Voxels; where there is none, the edge of the first is 0, and the distances of the others are NaN. While a map is changed
    no other thread may use it, and with pages one thread at a time.

    >>> m = cubemap.Octree(0.1)
    >>> m.update_points((0.0, 0.0, 0.0), [(1.05, 0.05, 0.05)])
    >>> m
    <cubemap.Octree of 16 levels, edge 0.1, step 1>
    >>> round(m.ray((0.05, 0.05, 0.05), (1.0, 0.0, 0.0), 5.0).distance, 6)
    0.95
    >>> m.count.occupied
    1
    """

    def __init__(self, edge: float, levels: int = 16, *, centre: ArrayLike = (0.0, 0.0, 0.0), rule: str = "counts",
                 hit: float = 0.85, miss: float = -0.4, low: float = -2.0, high: float = 3.5, nearest: float = 0.0,
                 far: float = 0.0, no_return_is_free: bool = False, noise: float = 0.0, footprint: float = 0.0,
                 color: bool = True, memory: int = 0, pages: Store | None = None, instructions: str | None = None,
                 threads: int = 1,
                 endpoints_only: bool = False) -> None:
        options = struct(library.cm_octree_options, edge=edge, levels=levels, rule=number_of(rule, RULES, "rule"),
                         near=nearest, far=far, no_return_is_free=bool(no_return_is_free), noise=noise,
                         footprint=footprint, color=bool(color), endpoints_only=bool(endpoints_only),
                         **_paging(memory, pages, instructions))
        if options.rule:
            options.hit, options.miss, options.low, options.high = hit, miss, low, high
        options.centre[:] = three_numbers(centre, "centre")
        self._begin(library.cm_octree_create, (ctypes.byref(options),), pages, threads)

    def _begin(self, creator, arguments, pages, threads):
        """The map that is made, with the threads that work on it."""
        threads = checked_threads(threads)
        self._handle = created(creator, "cm_octree_destroy", *arguments, keep=None if pages is None else pages._handle)
        self._pages = pages
        self._threads = threads if pages is None else 1
        self._pool = pool_of(threads)

    def __repr__(self):
        options = self._options
        return f"<cubemap.Octree of {options.levels} levels, edge {options.edge:g}, step {self.step}>"

    @property
    def _options(self):
        return library.cm_octree_describe(self._handle).contents

    @property
    def options(self) -> dict:
        """The arguments that it was made with, but for memory, pages, instructions and threads."""
        options = self._options
        numbers = {name: getattr(options, name) for name in
                   ("edge", "levels", "hit", "miss", "low", "high", "far", "noise", "footprint")}
        return {**numbers, "centre": tuple(options.centre), "rule": RULES[options.rule], "nearest": options.near,
                "no_return_is_free": bool(options.no_return_is_free),
                "endpoints_only": bool(options.endpoints_only), "color": bool(options.color)}

    # ---- making it ----

    def update(self, depth: ArrayLike, camera: Camera, pose: Pose = Pose(), *, color: ArrayLike | None = None,
               unit: float = 1.0, kind: str | None = None) -> None:
        """Integrate a view.

        depth   (rows, columns) of the camera, uint16 or float32; 0 and NaN: nothing was measured
        color   (rows, columns, 3), or None
        unit    metres per stored unit
        kind    "depth" or "range"; None: what images of the camera hold

        ValueError for depths beyond 2^20 edges, as of a background of 1e10, in maps of more than 13 levels without `far`.
        """
        view, _kept = _view(camera, pose, depth=depth, color=color)
        view.depth_unit = unit
        view.depth_is_range = number_of(camera.kind if kind is None else kind, DEPTH_KINDS, "kind")
        library.cm_octree_update(self._handle, ctypes.byref(view), self._pool)

    def update_points(self, origin: ArrayLike, points: ArrayLike, colors: ArrayLike | None = None) -> None:
        """Integrate points (n, 3) of the world that were seen from an origin; colors (n, 3) of uint8, or None."""
        points = numbers_of(points, 3, np.float32, "points")
        if colors is not None:
            colors = numbers_of(colors, 3, np.uint8, "colors")
            if len(colors) != len(points):
                raise ValueError(f"colors: one a point, {len(points)}, not {len(colors)}")
        library.cm_octree_update_points(self._handle, _pointer(origin, "origin"), len(points), points.ctypes.data,
                                        None if colors is None else colors.ctypes.data)

    def merge(self, other: Octree, pose: Pose | None = None) -> None:
        """Add another map of the same rule; the pose takes its points to this one's."""
        library.cm_octree_merge(self._handle, handle_of(other, Octree, "other"), pose_pointer(pose))

    def compact(self) -> None:
        """Give memory back; nothing that is asked changes."""
        library.cm_octree_compact(self._handle)

    def carve_hull(self, masks: list | tuple, *, outside_survives: bool = False) -> None:
        """Carve the visual hull into an empty map: masks are (camera, pose, image), and inside is what is not 0.

        outside_survives   what a view does not see lives; else it is outside
        """
        made = [_view(camera, pose, color=image) for camera, pose, image in masks]
        views = (library.cm_view * len(made))(*(view for view, _ in made))
        library.cm_hull_carve(self._handle, len(made), views, bool(outside_survives), self._pool)

    # ---- asking it ----

    @property
    def step(self) -> int:
        """How many updates and merges there were."""
        return library.cm_octree_step(self._handle)

    @property
    def count(self) -> OctreeCount:
        """What it holds."""
        found = struct(library.cm_octree_count)
        library.cm_octree_count_voxels(self._handle, ctypes.byref(found))
        return OctreeCount(*(getattr(found, name) for name in OctreeCount._fields))

    def extract(self, level: int = 0) -> Voxels:
        """The occupied voxels of a level, in the order of keys."""
        count = ctypes.c_size_t()
        try:
            library.cm_octree_extract(self._handle, level, 0, None, ctypes.byref(count))
        except Error as error:
            if error.status != library.CM_ERROR_SPACE:
                raise
        voxels = (library.cm_voxel * count.value)()
        library.cm_octree_extract(self._handle, level, count.value, voxels, ctypes.byref(count))
        return _voxels_in(voxels)

    def _walk(self, walk, *arguments):
        size, found = ctypes.sizeof(library.cm_voxel), bytearray()

        def take(_user, voxel):
            found.extend(ctypes.string_at(voxel, size))
            return 0

        walk(self._handle, *arguments, ctypes.cast(_Job(take), ctypes.c_void_p), None)
        return _voxels_in(found)

    def walk_ray(self, origin: ArrayLike, direction: ArrayLike, far: float = 0.0) -> Voxels:
        """All known voxels along one ray, in its order."""
        return self._walk(library.cm_octree_walk_ray, _pointer(origin, "origin"), _pointer(direction, "direction"), far)

    def walk_box(self, least: ArrayLike, greatest: ArrayLike) -> Voxels:
        """All known voxels whose centre is in a box; equal ones may come as one larger voxel."""
        return self._walk(library.cm_octree_walk_box, _pointer(least, "least"), _pointer(greatest, "greatest"))

    def walk_changes(self, since: int) -> Voxels:
        """All known voxels of blocks in which a view changed something after a step."""
        return self._walk(library.cm_octree_walk_changes, since)

    # ---- keeping it ----

    def save(self, store: Store, user_data: bytes = b"") -> None:
        """Put what changed into a store and commit; user_data are kept with it, 65536 bytes at most."""
        checked_kind(store, Store, "store")._call(lambda handle: library.cm_octree_save(self._handle, handle, user_data or None, len(user_data)))

    @classmethod
    def load(cls, store: Store, *, memory: int = 0, pages: bool = False, instructions: str | None = None,
             threads: int = 1) -> Octree:
        """The map that a store keeps; pages: the store is its pages, and only what is needed is loaded."""
        options = struct(library.cm_octree_options, **_paging(memory, store if pages else None, instructions))
        made = object.__new__(cls)
        checked_kind(store, Store, "store")._call(
            lambda handle: made._begin(library.cm_octree_load, (handle, ctypes.byref(options)), store if pages else None, threads))
        return made

    @property
    def user_data(self) -> bytes:
        """What save was given."""
        count = ctypes.c_size_t()
        data = library.cm_octree_user_data(self._handle, ctypes.byref(count))
        return ctypes.string_at(data, count.value) if data else b""

    # ---- seeing it ----

    def render(self, camera: Camera, pose: Pose = Pose(), *, color: bool = True, depth: bool = True,
               channels: int = 3, dtype: str = "float32", coarsest: int = 0, far: float = 0.0,
               light: ArrayLike | None = None, light_angle: float = 0.0, ambient: float = 0.0,
               background: ArrayLike = (0.0, 0.0, 0.0), mesh: Raster | None = None,
               mesh_color: ArrayLike | None = None) -> OctreePicture:
        """Trace a cone for each pixel.

        color, depth   which pictures are wanted; channels 3, or 4 with opacity; dtype uint8, uint16 or float32
        coarsest       the finest level that is read
        far            the length of cones; 0: 10
        light          the place of a virtual light with a shadow of light_angle; ambient: of the light everywhere
        mesh           a Raster before the same camera, whose pixels hide what is behind; mesh_color (rows, columns, 3)
        """
        before = handle_of(camera, Camera, "camera")
        shading = struct(library.cm_octree_shading, coarsest=coarsest, far=far, light=light is not None,
                         light_angle=light_angle, ambient=ambient, pool=None if self._pool is None else self._pool.address)
        shading.background[:] = three_numbers(background, "background")
        if light is not None:
            shading.light_position[:] = three_numbers(light, "light")
        if mesh is not None:
            shading.mesh = handle_of(mesh, Raster, "mesh").address
        if mesh_color is not None:
            mesh_color = np.ascontiguousarray(mesh_color, np.float32)
            if mesh_color.shape != (*camera.shape, 3):
                raise ValueError(f"mesh_color: {(*camera.shape, 3)}, not {mesh_color.shape}")
            shading.mesh_color = mesh_color.ctypes.data
        if np.dtype(dtype).name not in PIXEL_TYPES:
            raise ValueError(f"dtype: {', '.join(PIXEL_TYPES)}, not {dtype}")
        pictures = [np.empty((*camera.shape, channels), dtype) if color else None,
                    np.empty(camera.shape, np.float32) if depth else None]
        given = [None if one is None else images_in(camera.shape, one, writes=True)[0] for one in pictures]
        library.cm_octree_render(self._handle, before, pose_pointer(pose), ctypes.byref(shading), *given)
        return OctreePicture(*pictures)


def _paging(memory, pages, instructions):
    """The options of a map that the file does not keep."""
    text = None if instructions is None else checked_text(instructions, "instructions")
    return {"memory": memory, "pages": None if pages is None else handle_of(pages, Store, "pages").address, "instructions": text}


def _pointer(values, name):
    """Three numbers for the library."""
    return (ctypes.c_double * 3)(*three_numbers(values, name))


def _view(camera, pose, **pictures):
    """A view of the library with these pictures, and what must live as long."""
    view = struct(library.cm_view, camera=handle_of(camera, Camera, "camera").address, pose=checked_kind(pose, Pose, "pose")._struct())
    kept = [camera]
    for name, picture in pictures.items():
        if picture is not None:
            images, _, pixels = images_in(camera.shape, picture)
            setattr(view, name, images[0])
            kept.append(pixels)
    return view, kept
