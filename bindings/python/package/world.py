# SPDX-License-Identifier: MIT
"""Worlds of planes, boxes, spheres, cylinders and meshes, and what rays meet among them.

>>> ball = cubemap.Primitive.sphere((3, 0, 1), 0.5, cubemap.Material(reflectance=0.4))
>>> hit = cubemap.Scene([ball]).cast(0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
>>> hit.distance, hit.id, hit.reflectance
(2.5, 0, 0.4)
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
from ._methods import SceneMethods
from ._texts import Specified, checked_kind, checked_text, created, handle_of, number_of, struct, words_of
from .camera import Camera
from .mapping import checked_threads
from .pose import Pose
from .raster import indices_of, numbers_of
from .trajectory import Trajectory

SCENES = words_of(library.cm_scene_name_at)
PRIMITIVES = ("plane", "box", "sphere", "cylinder", "mesh")


class Hit(NamedTuple):
    """What rays met: distance in lengths of the direction, infinite for nothing; id of the primitive, or NO_ID;
    triangle of its mesh; normal (..., 3) towards the ray's origin, color (..., 3) and reflectance, 0 to 1."""

    distance: Any
    id: Any
    triangle: Any
    normal: Any
    color: Any
    reflectance: Any


name_results("cm_scene_cast_array", Hit)


class Material(NamedTuple):
    """How a surface looks: color and reflectance, 0 to 1."""

    color: tuple = (1.0, 1.0, 1.0)
    reflectance: float = 1.0


class Mesh(Specified):
    """Indexed triangles: Mesh(position, index).

    position   (n, 3) of vertices; index (m, 3) of them
    normal     (n, 3) of vertices, or None; uv (n, 2), places in a texture, and color (n, 3), which the material's
               multiplies, too
    material   of all triangles

    The arrays are copied.

    >>> mesh = cubemap.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    >>> mesh
    <cubemap.Mesh of 3 vertices and 1 triangles>
    >>> mesh.bounds[1].tolist()
    [1.0, 1.0, 0.0]
    """

    _standard = {"normal": None, "uv": None, "color": None, "material": Material()}

    def __init__(self, position: ArrayLike, index: ArrayLike, *, normal: ArrayLike | None = None,
                 uv: ArrayLike | None = None,
                 color: ArrayLike | None = None, material: Material = Material()) -> None:
        position = numbers_of(position, 3, np.float64, "position")
        index = indices_of(index, len(position))
        more = {name: None if values is None else numbers_of(values, columns, np.float32, name)
                for name, values, columns in (("normal", normal, 3), ("uv", uv, 2), ("color", color, 3))}
        for name, values in more.items():
            if values is not None and len(values) != len(position):
                raise ValueError(f"{name}: one a vertex, {len(position)}, not {len(values)}")
        options = struct(library.cm_mesh_options, vertex_count=len(position), position=position.ctypes.data,
                         triangle_count=len(index), index=index.ctypes.data,
                         **{name: None if values is None else values.ctypes.data for name, values in more.items()})
        _set_material(options.material, material)
        self._handle = created(library.cm_mesh_create, "cm_mesh_destroy", ctypes.byref(options))
        self._material = Material(*material)

    def _arguments(self):
        options = library.cm_mesh_describe(self._handle).contents
        count = options.vertex_count
        given = {"position": _copied(options.position, (count, 3), np.float64),
                 "index": _copied(options.index, (options.triangle_count, 3), np.uint32),
                 "normal": _copied(options.normal, (count, 3), np.float32),
                 "uv": _copied(options.uv, (count, 2), np.float32),
                 "color": _copied(options.color, (count, 3), np.float32)}
        return {**given, "material": self._material}

    def _same(self):
        return tuple(value.tobytes() if isinstance(value, np.ndarray) else value
                     for value in self._arguments().values())

    def __repr__(self):
        options = library.cm_mesh_describe(self._handle).contents
        return f"<cubemap.Mesh of {options.vertex_count} vertices and {options.triangle_count} triangles>"

    @property
    def position(self) -> np.ndarray:
        """A copy of the vertices' places, (n, 3)."""
        return self._arguments()["position"]

    @property
    def index(self) -> np.ndarray:
        """A copy of the triangles, (m, 3)."""
        return self._arguments()["index"]

    @property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """The least and the greatest coordinates of the triangles' vertices; NaN where there is none."""
        least, greatest = np.empty((2, 3))
        library.cm_mesh_bounds(self._handle, least.ctypes.data, greatest.ctypes.data)
        return least, greatest


def _copied(address, shape, dtype):
    if not address:
        return None
    data = ctypes.string_at(address, np.dtype(dtype).itemsize * shape[0] * shape[1])
    return np.frombuffer(data, dtype).reshape(shape).copy()


def _set_material(to, material):
    color, to.reflectance = material
    to.color[:] = three_numbers(color, "color")


class Primitive(NamedTuple):
    """A surface of a world, as Primitive.sphere and its like make it; cubemap/world.h says what first and second are
    of each kind. motion, poses that take it to its place at their times, and brdf, a cubemap.sim.Brdf, are for
    cubemap.sim alone."""

    kind: str
    first: tuple = (0.0, 0.0, 0.0)
    second: tuple = (0.0, 0.0, 0.0)
    radius: float = 0.0
    of: Mesh | None = None
    pose: Pose = Pose()
    material: Material = Material()
    motion: Trajectory | None = None
    brdf: object = None

    @classmethod
    def plane(cls, point: ArrayLike, normal: ArrayLike, material: Material = Material()) -> Primitive:
        """An endless plane through a point, with a normal of any length."""
        return cls("plane", tuple(three_numbers(point, "point")), tuple(three_numbers(normal, "normal")), material=material)

    @classmethod
    def box(cls, least: ArrayLike, greatest: ArrayLike, material: Material = Material()) -> Primitive:
        """A box along the axes; a room for who is inside."""
        return cls("box", tuple(three_numbers(least, "least")), tuple(three_numbers(greatest, "greatest")), material=material)

    @classmethod
    def sphere(cls, centre: ArrayLike, radius: float, material: Material = Material()) -> Primitive:
        """A sphere."""
        return cls("sphere", tuple(three_numbers(centre, "centre")), radius=float(radius), material=material)

    @classmethod
    def cylinder(cls, start: ArrayLike, end: ArrayLike, radius: float, material: Material = Material()) -> Primitive:
        """A cylinder along its axis from start to end, closed by caps."""
        return cls("cylinder", tuple(three_numbers(start, "start")), tuple(three_numbers(end, "end")), float(radius), material=material)

    @classmethod
    def mesh(cls, mesh: Mesh, pose: Pose = Pose(), material: Material = Material()) -> Primitive:
        """A mesh that stands in the world as a camera of that pose; its colours are multiplied by the material's."""
        return cls("mesh", of=mesh, pose=pose, material=material)

    def _struct(self):
        made = struct(library.cm_primitive, kind=number_of(self.kind, PRIMITIVES, "kind"), radius=self.radius,
                      pose=self.pose._struct(),
                      **{name: None if part is None else handle_of(part, kind, name).address
                         for name, part, kind in zip(("mesh", "motion", "brdf"), self._parts, self._kinds(), strict=True)})
        made.first[:], made.second[:] = three_numbers(self.first, "first"), three_numbers(self.second, "second")
        _set_material(made.material, self.material)
        return made

    @property
    def _parts(self):
        """What must live as long as a world with it."""
        return self.of, self.motion, self.brdf

    def _kinds(self):
        """The classes of these parts; that of BRDFs is in a module that need not be there."""
        if self.brdf is None:
            return Mesh, Trajectory, None
        from .sim import Brdf
        return Mesh, Trajectory, Brdf

    @classmethod
    def _read(cls, made, parts):
        mesh, motion, brdf = parts
        pose = Pose._read(made.pose)
        if mesh is None and not pose.rotation.any():  # the library's own worlds have zeros where it reads no pose
            pose = Pose()
        return cls(PRIMITIVES[made.kind], tuple(made.first), tuple(made.second), made.radius, mesh, pose,
                   Material(tuple(made.material.color), made.material.reflectance), motion, brdf)


class Scene(SceneMethods, Specified):
    """A world of surfaces: Scene([Primitive.sphere((3, 0, 1), 0.5)]), Scene.named("room").

    primitives   Primitives; the id of each is its place
    threads      the most that cast one array of rays; 0 for all processors. Standard: 1

    s.cast(origin_x, origin_y, origin_z, direction_x, direction_y, direction_z) gives Hit.

    >>> room = cubemap.Scene.named("room")
    >>> len(room.primitives)
    13
    >>> camera = cubemap.Camera(64, 48, 52, 52, 31.5, 23.5)
    >>> seen = room.render(camera, cubemap.Pose(position=(0, 0, 1.2)))
    >>> seen.distance.shape, bool(np.isfinite(seen.distance).all())
    ((48, 64), True)
    """

    _standard = {"threads": 1}
    _is_remade = False

    def __init__(self, primitives: list | tuple = (), *, threads: int = 1) -> None:
        primitives = tuple(primitives)
        given = [checked_kind(one, Primitive, "primitives")._struct() for one in primitives]
        parts = tuple(one._parts for one in primitives)
        self._handle = created(library.cm_scene_create, "cm_scene_destroy",
                               keep=tuple(part._handle for own in parts for part in own if part is not None))
        for place, one in enumerate(given):
            try:
                library.cm_scene_add(self._handle, ctypes.byref(one), None)
            except Error as error:
                raise Error(error.status, f"primitives[{place}]: {error}") from None
        self._parts = parts
        self._threads = checked_threads(threads)

    @classmethod
    def named(cls, name: str, *, threads: int = 1) -> Scene:
        """One of SCENES; z is up, metres."""
        if name not in SCENES:
            raise Error(library.CM_ERROR_ARGUMENT, f"no world {name!r}: there are {', '.join(SCENES)}")
        made = object.__new__(cls)
        made._handle = created(library.cm_scene_create_named, "cm_scene_destroy", checked_text(name, "name"))
        made._parts = ((None, None, None),) * library.cm_scene_count(made._handle)
        made._threads = checked_threads(threads)
        return made

    def _arguments(self):
        return {"primitives": self.primitives, "threads": self._threads}

    @property
    def primitives(self) -> tuple[Primitive, ...]:
        """What it is made of; normals have length 1."""
        return tuple(Primitive._read(library.cm_scene_at(self._handle, place).contents, parts)
                     for place, parts in enumerate(self._parts))

    def render(self, camera: Camera, pose: Pose = Pose()) -> Hit:
        """What all pixels of a camera see, as Hit of its shape: distance is depth, of omnidirectional cameras range."""
        rays = np.stack(checked_kind(camera, Camera, "camera").ray(*camera.pixels()), axis=-1)
        directions = Pose(checked_kind(pose, Pose, "pose").rotation).apply_back(rays)
        return self.cast(*pose.position, *np.moveaxis(directions, -1, 0))
