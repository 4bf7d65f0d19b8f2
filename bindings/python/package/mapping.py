# SPDX-License-Identifier: MIT
"""Mappings, their catalogue and their frames.

>>> cubemap.frames()
('geo', 'gl', 'fits', 's2')
>>> cubemap.find_mapping("cobe").name
'COBE quadrilateralized spherical cube'
>>> [parameter.name for parameter in cubemap.find_mapping("tangent").parameters]
['c']
"""

from __future__ import annotations

import ctypes
import dataclasses
import operator
from typing import Any, NamedTuple

from . import _library as library
from ._errors import Error, in_words
from ._methods import MappingMethods
from ._method import name_results
from ._texts import Specified, checked_text, created, decoded, number_of, struct, words_of

RECOMMENDED = "coupled"
KINDS = ("cube", "disc-square", "azimuthal", "layout")
FAMILIES = ("univariate", "bivariate", "hybrid")
SMOOTHNESS = words_of(library.cm_smoothness_name)
TIERS = ("exact", "fast")
NO_FACE = 255


class Distortion(NamedTuple):
    """Tissot's indicatrix, what follows from it, and a texel: cubemap/distortion.h says what each is."""

    major: Any
    minor: Any
    orientation: Any
    scale: Any
    deformation: Any
    area: Any
    isotropy: Any
    texel_aspect: Any
    texel_area: Any


for _name in ("cm_forward_distortion_array", "cm_inverse_distortion_array", "cm_grid_forward_distortion",
              "cm_grid_inverse_distortion"):
    name_results(_name, Distortion)


class Face(NamedTuple):
    """How a face sits: signed axes, 1 is +x and -1 is -x."""

    name: str
    outward: int
    u: int
    v: int


@dataclasses.dataclass(frozen=True)
class Frame:
    """How the six faces sit on the axes. `Frame.named("geo")` is one of the library's; any table of your own will do.

    >>> frame = cubemap.Frame.named("gl")
    >>> frame.faces[0]
    Face(name='+x', outward=1, u=-3, v=-2)
    >>> cubemap.Mapping("coupled", frame).forward(2.0, 1.0, 0.5)[0]
    0
    """

    identifier: str
    faces: tuple
    first_row_v: int = 1
    name: str = ""

    def __post_init__(self):
        """Rows of any kind are Faces: a frame is a value, whatever it was made of."""
        try:
            faces = tuple(Face(*face) for face in self.faces)
        except TypeError:
            raise Error(library.CM_ERROR_FRAME, f"faces: six of (name, outward, u, v), not {self.faces!r}") from None
        object.__setattr__(self, "faces", faces)

    @classmethod
    def named(cls, identifier: str) -> Frame:
        """The frame geo, gl, fits or s2."""
        found = library.cm_frame_find(checked_text(identifier, "frame"))
        if not found:
            raise Error(library.CM_ERROR_FRAME, f"no frame {identifier!r}: there are {', '.join(frames())}")
        return cls._read(found.contents)

    @classmethod
    def _read(cls, table):
        faces = tuple(Face(decoded(face.name), face.outward, face.u, face.v) for face in table.face)
        return cls(decoded(table.identifier), faces, table.first_row_v, decoded(table.name))

    def _struct(self):
        table = struct(library.cm_frame, identifier=checked_text(self.identifier, "identifier"),
                       name=checked_text(self.name, "name"),
                       first_row_v=self.first_row_v)
        if len(self.faces) != 6:
            raise Error(library.CM_ERROR_FRAME, f"a frame has six faces, not {len(self.faces)}")
        for to, face in zip(table.face, self.faces, strict=True):
            to.name, to.outward, to.u, to.v = checked_text(face.name, "name"), face.outward, face.u, face.v
        library.cm_frame_check(ctypes.byref(table))
        return table


def frames() -> tuple[str, ...]:
    """The identifiers of the library's frames."""
    return tuple(decoded(library.cm_frame_at(index).contents.identifier) for index in range(library.cm_frame_count()))


class Parameter(NamedTuple):
    """A parameter of a mapping."""

    name: str
    meaning: str
    standard: float
    low: float
    high: float


@dataclasses.dataclass(frozen=True)
class MappingInfo:
    """A row of the catalogue: cubemap/catalogue.h says what each member is.

    >>> info = cubemap.find_mapping("lee-cube")
    >>> info.identifier, info.kind, info.conformal
    ('conformal', 'cube', True)
    """

    identifier: str
    aliases: tuple
    name: str
    source: str
    kind: str
    family: str
    equal_area: bool
    conformal: bool
    smooth_face: str
    smooth_edge: str
    smooth_corner: str
    parameters: tuple
    presets: tuple
    parts: str
    bounds: dict = dataclasses.field(hash=False)

    @classmethod
    def _read(cls, info):
        parameters = tuple(Parameter(decoded(one.name), decoded(one.meaning), one.standard, one.low, one.high)
                           for one in info.parameter[:info.parameter_count])
        return cls(decoded(info.identifier), tuple(decoded(info.aliases).split()), decoded(info.name), decoded(info.source),
                   KINDS[info.kind], FAMILIES[info.family], bool(info.properties & 1), bool(info.properties & 2),
                   SMOOTHNESS[info.smooth_face], SMOOTHNESS[info.smooth_edge], SMOOTHNESS[info.smooth_corner], parameters,
                   tuple((decoded(info.presets) or "").split()), decoded(info.parts),
                   {name: getattr(info.bounds, name) for name, _ in library.cm_bounds._fields_})


def catalogue() -> tuple[MappingInfo, ...]:
    """All mappings, as MappingInfo."""
    return tuple(MappingInfo._read(library.cm_catalogue_at(index).contents) for index in range(library.cm_catalogue_count()))


def find_mapping(name: str) -> MappingInfo | None:
    """The mapping that an identifier or an alias names, as MappingInfo; None if there is none."""
    found = library.cm_catalogue_find(checked_text(name, "name"))
    return MappingInfo._read(found.contents) if found else None


def check_specification(specification: str) -> None:
    """Nothing if a mapping can be made of it; else Error, which says what is wrong and what would be right."""
    in_words(library.cm_specification_check, checked_text(specification, "specification"))


def instruction_sets() -> tuple[str, ...]:
    """The instruction sets that this machine can run, the simplest first, the standard last."""
    return words_of(lambda index: library.cm_instructions_at(index))


def options_of(instructions, tier):
    """A struct of options, as cubemap/options.h has it."""
    if instructions is not None:
        instructions = checked_text(instructions, "instructions")
        in_words(library.cm_instructions_check, instructions)
    return struct(library.cm_options, instructions=instructions, tier=number_of(tier, TIERS, "tier"))


class Mapping(MappingMethods, Specified):
    """A mapping of the sphere to six faces, a disc or a square: Mapping("coupled"), Mapping("tangent:c=1.1823", "gl").

    specification   NAME, NAME:PARAMETER=VALUE,... or NAME:PRESET
    frame           "geo", "gl", "fits", "s2", or a Frame
    instructions    one of instruction_sets(); None for the best
    tier            "exact", or "fast": arrays of double in float, where that is faster
    threads         the most that work on one array; 0 for all processors. Standard: 1

    m.forward(x, y, z) gives face, u, v, and m.inverse(face, u, v) gives x, y, z: of arrays ufuncs of NumPy, of numbers
    numbers. A direction that is none has face 255 and NaN; a face above 5 gives NaN.

    >>> m = cubemap.Mapping("algebraic:c=0.9")
    >>> m
    cubemap.Mapping('algebraic:c=0.9')
    >>> face, u, v = m.forward([2.0, 0.0], [1.0, -3.0], [0.5, 1.0])
    >>> face.tolist(), u.round(4).tolist()
    ([0, 3], [0.6134, 0.0])
    >>> round(m.forward_distortion(1.0, 0.0, 0.0).isotropy, 9)
    1.0
    """

    _standard = {"frame": "geo", "instructions": None, "tier": "exact", "threads": 1}

    def __init__(self, specification: str = RECOMMENDED, frame: str | Frame = "geo", *, instructions: str | None = None,
                 tier: str = "exact", threads: int = 1) -> None:
        text = checked_text(specification, "specification")
        table = (frame if isinstance(frame, Frame) else Frame.named(frame))._struct()
        options = options_of(instructions, tier)
        check_specification(specification)
        self._handle = created(library.cm_mapping_create_with, "cm_mapping_destroy", text, ctypes.byref(table),
                               ctypes.byref(options), keep=table)
        self._given = (specification, frame, instructions, tier)
        self._threads = checked_threads(threads)

    def _arguments(self):
        return dict(zip(("specification", "frame", "instructions", "tier", "threads"), (*self._given, self._threads), strict=True))

    def _same(self):
        name, colon, rest = self._given[0].lower().partition(":")
        parts = rest if self.info.parts else ""
        return self.info.identifier, parts, self.parameters, self.frame, self.tier, self.instructions

    @property
    def specification(self) -> str:
        """What it was made from."""
        return self._given[0]

    @property
    def info(self) -> MappingInfo:
        """Its row of the catalogue."""
        return MappingInfo._read(library.cm_mapping_describe(self._handle).contents)

    @property
    def frame(self) -> Frame:
        """Its frame."""
        given = self._given[1]
        return given if isinstance(given, Frame) else Frame._read(library.cm_mapping_frame(self._handle).contents)

    @property
    def parameters(self) -> tuple[float, ...]:
        """The values of its parameters, by the catalogue's order."""
        count = library.cm_mapping_describe(self._handle).contents.parameter_count
        return tuple(library.cm_mapping_parameter(self._handle, index) for index in range(count))

    @property
    def has_bounds(self) -> bool:
        """Do the bounds of the catalogue hold for these parameters?"""
        return bool(library.cm_mapping_has_bounds(self._handle))

    @property
    def tier(self) -> str:
        """"exact" or "fast": what is used."""
        return TIERS[library.cm_mapping_tier(self._handle)]

    @property
    def instructions(self) -> str:
        """The instruction set that is used."""
        return decoded(library.cm_mapping_instructions(self._handle))

    @property
    def face_count(self) -> int:
        """6, or 1 of what is no cube."""
        return 6 if self.info.kind == "cube" else 1


def checked_threads(threads: int) -> int:
    """Threads as the library counts them."""
    if isinstance(threads, bool) or not hasattr(threads, "__index__") or threads < 0:
        raise ValueError(f"threads: a whole number, 0 for all processors, not {threads!r}")
    if operator.index(threads) >= 2**32:
        raise Error(library.CM_ERROR_RANGE, f"threads: from 0 to {2**32 - 1}, not {threads}")
    return operator.index(threads) or library.cm_threads_available()


def pool_of(threads: int) -> object:
    """The threads that work together, for calls that take a pool; None for the calling one."""
    threads = checked_threads(threads)
    return None if threads == 1 else created(library.cm_pool_create, "cm_pool_destroy", threads)


def mapping_of(mapping: str | Mapping) -> Mapping:
    """A mapping, also from its specification."""
    return mapping if isinstance(mapping, Mapping) else Mapping(mapping)
