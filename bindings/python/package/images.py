# SPDX-License-Identifier: MIT
"""Pictures of the sphere: surfaces, and from one to another. Pictures are arrays of NumPy.

A picture is (rows, columns) or (rows, columns, channels); where a surface has several, as the six faces of a cube, they are
stacked along a first axis: (6, rows, columns, channels). Numbers are uint8, uint16, float16 or float32. Only the channels
of a pixel need be side by side; all other strides will do, and nothing is copied. What a masked array masks is no data,
nor is what is made from it: that is masked, too.

>>> earth = np.zeros((64, 128, 3), np.uint8)
>>> earth[:32] = 255  # the north is white
>>> six = cubemap.resample(earth, "equirect", "cube:coupled;size=32")
>>> six.shape, six[4, 16, 16].tolist(), six[5, 16, 16].tolist()
((6, 32, 32, 3), [255, 255, 255], [0, 0, 0])
"""

from __future__ import annotations

import ctypes
import operator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from . import _library as library
from ._errors import Error, in_words
from ._masked_pictures import as_nan, filled, is_masked, levelled, unmasked, with_mask
from ._methods import SurfaceMethods
from ._texts import Specified, checked_kind, checked_text, created, decoded, handle_of, number_of, struct, words_of
from .earth import Rotation
from .mapping import Mapping, checked_threads
from .pixels import ORDERS

FILTERS = words_of(library.cm_filter_name)
TRANSFERS = ("stored", "srgb", "gamma")
NOT_FINITE = ("spread", "skip", "zero")
PIXEL_TYPES = ("uint8", "uint16", "float16", "float32")


class Surface(SurfaceMethods, Specified):
    """How the sphere lies on pictures: Surface("equirect;size=1024"), Surface("cube:coupled;frame=gl;size=256").

    specification   KIND[:PARAMETERS][;KEY=VALUE...]; surface_kinds() lists the kinds
    width, height   of each picture; 0: as the specification says
    rotation        how the surface stands on the Earth, a Rotation or its text

    s.positions(x, y, z) gives plane, column and row, and s.directions(plane, column, row) gives x, y and z.

    >>> s = cubemap.Surface("equirect;size=1024")
    >>> s.shape
    (512, 1024)
    >>> plane, column, row = s.positions(1.0, 0.0, 0.0)
    >>> plane, column, row
    (0, 512.0, 256.0)
    """

    _standard = {"width": 0, "height": 0, "rotation": None, "instructions": None, "threads": 1}

    def __init__(self, specification: str, width: int = 0, height: int = 0, *, rotation: str | Rotation | None = None,
                 instructions: str | None = None, threads: int = 1) -> None:
        text = checked_text(specification, "specification")
        rotation = rotation if rotation is None or isinstance(rotation, Rotation) else Rotation(rotation)
        options = struct(library.cm_surface_options, width=width, height=height,
                         instructions=None if instructions is None else checked_text(instructions, "instructions"))
        if rotation is not None:
            options.rotation = rotation._pointer()
        in_words(library.cm_surface_check, text, ctypes.byref(options))
        try:
            self._handle = created(library.cm_surface_create, "cm_surface_destroy", text, ctypes.byref(options))
        except Error as error:
            if error.status == library.CM_ERROR_RANGE and not width and not height:
                raise Error(error.status, f"{specification!r} has no size: {specification};size=512, or width and height") from None
            raise
        self._given = (specification, width, height, rotation, instructions)
        self._threads = checked_threads(threads)

    def _arguments(self):
        return dict(zip(("specification", "width", "height", "rotation", "instructions", "threads"), (*self._given, self._threads), strict=True))

    def _same(self):
        return self.specification, self._given[3], self._given[4]

    @property
    def specification(self) -> str:
        """All that is not as it is without a word, size included; rotations are not in it."""
        return decoded(library.cm_surface_specification(self._handle))

    @property
    def shape(self) -> tuple[int, ...]:
        """Of its pictures as an array, without channels: (rows, columns), or (6, rows, columns)."""
        count = library.cm_surface_picture_count(self._handle)
        size = (library.cm_surface_height(self._handle), library.cm_surface_width(self._handle))
        return size if count == 1 else (count, *size)

    @property
    def plane_shape(self) -> tuple[int, int, int]:
        """The planes and the size of each: (planes, rows, columns)."""
        handle = self._handle
        return (library.cm_surface_plane_count(handle), library.cm_surface_plane_height(handle),
                library.cm_surface_plane_width(handle))

    @property
    def pictures(self) -> int:
        """How many pictures it has."""
        return library.cm_surface_picture_count(self._handle)

    @property
    def rotation(self) -> Rotation | None:
        """How it stands on the Earth; None if it was not turned."""
        return self._given[3]

    @property
    def mapping(self) -> Mapping | None:
        """The mapping behind faces; None of what has none."""
        address = library.cm_surface_mapping(self._handle)
        if not address:
            return None
        kind, *keys = self.specification.split(";")
        frame = next((key.partition("=")[2] for key in keys if key.startswith("frame=")), "geo")
        name = decoded(library.cm_mapping_describe(address).contents.identifier)
        given = kind.partition(":")[2]
        return Mapping(given if given.startswith(name) else name, frame)

    def sample(self, pictures: ArrayLike, x: ArrayLike, y: ArrayLike, z: ArrayLike, filter: str = "auto") -> np.ndarray:
        """Values of pictures in directions, float32 with the channels along the last axis; whole numbers are 0 to 1."""
        if any(map(is_masked, (pictures, x, y, z))):
            return self._sample_masked(pictures, x, y, z, filter)
        images, channels, _ = images_of(pictures, self)
        x, y, z = np.broadcast_arrays(x, y, z)
        out = np.empty((*x.shape, channels), np.float32)
        x, y, z = (np.ascontiguousarray(one, np.float64) for one in (x, y, z))
        library.cm_sample(self._handle, images, number_of(filter, FILTERS, "filter"), x.size, x.ctypes.data, y.ctypes.data,
                          z.ctypes.data, out.ctypes.data)
        return out

    def _sample_masked(self, pictures, x, y, z, filter):
        bare = tuple(map(np.ma.getdata, (x, y, z)))
        if filter == "auto" and is_masked(pictures):
            filter = Plan(self, self).filter_of(pictures, dtype=np.float32)
        found = self.sample(filled(pictures), *bare, filter)
        gone = self.sample(as_nan(pictures), *bare, filter)
        masks = np.broadcast_arrays(*map(np.ma.getmaskarray, (x, y, z)))
        return with_mask(found, np.where(np.logical_or.reduce(masks)[..., np.newaxis], np.nan, gone))


class SurfaceKind(NamedTuple):
    """A kind of surface."""

    identifier: str
    name: str
    parameters: str
    keys: tuple


def surface_kinds() -> tuple[SurfaceKind, ...]:
    """The kinds of surfaces."""
    found = [library.cm_surface_kind_at(index).contents for index in range(library.cm_surface_kind_count())]
    return tuple(SurfaceKind(decoded(one.identifier), decoded(one.name), decoded(one.parameters), tuple(decoded(one.keys).split()))
                 for one in found)


class SurfacePreset(NamedTuple):
    """How a program or an interface wants its pictures of the sphere."""

    identifier: str
    name: str
    source: str
    specification: str
    rotation: Rotation


def surface_presets() -> tuple[SurfacePreset, ...]:
    """The presets of surfaces."""
    found = [library.cm_surface_preset_at(index).contents for index in range(library.cm_surface_preset_count())]
    return tuple(SurfacePreset(decoded(one.identifier), decoded(one.name), decoded(one.source), decoded(one.specification),
                               Rotation(np.array(one.rotation.row))) for one in found)


def pixel_type(dtype):
    """The number of a type of pixels; TypeError for others."""
    name = np.dtype(dtype).name
    if name not in PIXEL_TYPES:
        raise TypeError(f"dtype: {', '.join(PIXEL_TYPES)}, not {name}")
    return PIXEL_TYPES.index(name)


def images_of(pictures, surface, writes=False):
    """Structs of the library for an array of a surface's pictures, the channels, and the array that they point into."""
    return images_in(checked_kind(surface, Surface, "surface").shape, pictures, writes)


def images_in(shape, pictures, writes=False):
    """The same of pictures of a shape without channels: (rows, columns), or (pictures, rows, columns)."""
    pictures = checked_kind(pictures, np.ndarray, "out") if writes else np.asarray(unmasked(pictures, "pictures"))
    if not writes and not pictures.dtype.isnative:
        pictures = pictures.astype(pictures.dtype.newbyteorder("="))  # as files of FITS have them
    name = pictures.dtype.name
    if name not in PIXEL_TYPES or not pictures.dtype.isnative:
        raise TypeError(f"pictures: {', '.join(PIXEL_TYPES)}, not {pictures.dtype}")
    if pictures.shape[:len(shape)] != shape or pictures.ndim > len(shape) + 1 or pictures.shape[-1] == 0:
        raise ValueError(f"pictures: {shape} or {(*shape, 'channels')}, not {pictures.shape}")
    stacked = pictures if len(shape) == 3 else pictures[np.newaxis]
    stacked = stacked if stacked.ndim == 4 else stacked[..., np.newaxis]
    size = stacked.dtype.itemsize
    if (stacked.shape[3] > 1 and stacked.strides[3] != size) or any(stride % size for stride in stacked.strides) \
            or not stacked.flags.aligned or (writes and any(
            stride == 0 and extent > 1 for stride, extent in zip(stacked.strides, stacked.shape, strict=True))):
        if writes:
            raise ValueError("out: the channels of a pixel must be side by side")
        stacked = np.ascontiguousarray(stacked)
    if writes and not stacked.flags.writeable:
        raise ValueError("out: not to be written to")
    images = (library.cm_image * len(stacked))()
    for image, picture in zip(images, stacked, strict=True):
        image.size = ctypes.sizeof(library.cm_image)
        image.data = picture.ctypes.data
        image.type = PIXEL_TYPES.index(name)
        image.height, image.width, image.channels = picture.shape
        # 0 means dense rows to the library; a picture of one row has any stride
        image.row_stride = picture.strides[0] if picture.shape[0] > 1 else 0
        image.pixel_stride = picture.strides[1] if picture.shape[1] > 1 else 0
    return images, stacked.shape[3], stacked


class Plan(Specified):
    """What resampling from one surface to another needs: made once, used for many pictures.

    source, target   Surfaces or their specifications
    filter           of FILTERS: "auto" is the cheapest that is good enough for the picture
    tolerance        of positions in source pixels: 0 for 1/4096, negative for as exact as a double is
    pixels_most      of one EWA footprint; 0 for 4096
    transfer         "stored", or "srgb" and "gamma": mixed as linear light
    alpha            the channel of opacity, counted from 1; alpha_multiplied: are the others multiplied by it?
    vector           the first of three channels that are a vector, counted from 1
    not_finite       "spread", "skip" or "zero"
    dither           are whole numbers dithered?

    >>> plan = cubemap.Plan("cube:coupled;size=64", "equirect;size=128", filter="bilinear")
    >>> plan.resample(np.ones((6, 64, 64), np.float32)).shape
    (64, 128)
    """

    _standard = {"filter": "auto", "tolerance": 0.0, "pixels_most": 0.0, "transfer": "stored", "gamma": 0.0, "alpha": 0,
                 "alpha_multiplied": False, "vector": 0, "not_finite": "spread", "dither": False, "instructions": None}

    def __init__(self, source: str | Surface, target: str | Surface, **options: Any) -> None:
        self.source = source if isinstance(source, Surface) else Surface(source)
        self.target = target if isinstance(target, Surface) else Surface(target)
        unknown = set(options) - set(self._standard)
        if unknown:
            raise TypeError(f"Plan has no option {', '.join(sorted(unknown))}")
        self._options = {**self._standard, **options}
        given = dict(self._options)
        instructions = given.pop("instructions")
        made = struct(library.cm_plan_options, filter=number_of(given.pop("filter"), FILTERS, "filter"),
                      transfer=number_of(given.pop("transfer"), TRANSFERS, "transfer"),
                      not_finite=number_of(given.pop("not_finite"), NOT_FINITE, "not_finite"),
                      instructions=None if instructions is None else checked_text(instructions, "instructions"), **given)
        self._handle = created(library.cm_plan_create, "cm_plan_destroy", self.source._handle, self.target._handle,
                               ctypes.byref(made))

    def _arguments(self):
        return {"source": self.source, "target": self.target, **self._options}

    def _same(self):
        return tuple(self._arguments().items())

    def resample(self, pictures: ArrayLike, out: np.ndarray | None = None, *, dtype: DTypeLike | None = None,
                 rows: tuple[int, ...] | None = None, threads: int = 1) -> np.ndarray:
        """The target's pictures from the source's; what the source does not show is 0.

        out       an array to write into; dtype is that of a new one, and as the source's without a word
        rows      (plane, first row, rows) or (plane, first row, rows, first column, columns): only that part is written
        threads   the most that work; 0 for all processors
        """
        if is_masked(pictures):
            return self._resample_masked(pictures, out, dtype=dtype, rows=rows, threads=threads)
        images, channels, kept = images_of(pictures, self.source)
        if out is None:
            shape = (*self.target.shape, *((channels,) if np.ndim(pictures) > len(self.source.shape) else ()))
            out = np.zeros(shape, kept.dtype if dtype is None else dtype)
        to, to_channels, _ = images_of(np.ma.getdata(out) if is_masked(out) else out, self.target, writes=True)
        if to_channels != channels:
            raise ValueError(f"out: {channels} channels, as the pictures have, not {to_channels}")
        source = created(library.cm_source_create, "cm_source_destroy", self._handle, images, PIXEL_TYPES.index(out.dtype.name),
                         checked_threads(threads), keep=(self._handle, images, kept))
        part = library.cm_rows(*(rows or ()))
        library.cm_resample_source(self._handle, source, to, part, checked_threads(threads))
        return out

    def _resample_masked(self, pictures, out, **how):
        """Of the mask as of the pictures, by the filter that these have. Opacity and vectors take a pixel's channels together."""
        options = self._options
        numbers = filled(pictures, options["not_finite"])
        of_pixels = bool(options["alpha"] or options["vector"])
        plain = {name: options[name] for name in ("tolerance", "pixels_most", "not_finite", "instructions")}
        chosen = self.filter_of(pictures, dtype=how["dtype"])
        by_filter = Plan(self.source, self.target, filter=chosen, **plain)
        of_numbers = self if chosen == options["filter"] else Plan(self.source, self.target, **{**options, "filter": chosen})
        result = of_numbers.resample(numbers, out, **how)
        before = as_nan(out) if is_masked(out) else None
        gone = by_filter.resample(as_nan(pictures, of_pixels), before, **{**how, "dtype": np.float32})
        return with_mask(result, gone, out)

    def to_text(self) -> str:
        """The plan as text, for a file; from_text reads it."""
        from ._texts import string_of

        return string_of(lambda text, size, length: library.cm_plan_write(self._handle, text, size, length))


    @classmethod
    def from_text(cls, text: str, *, instructions: str | None = None) -> Plan:
        """The plan of a text that to_text has made: it gives the same bits."""
        data = checked_text(text, "text")
        made = object.__new__(cls)
        made._handle = created(library.cm_plan_read, "cm_plan_destroy", data, len(data),
                               None if instructions is None else checked_text(instructions, "instructions"))
        lines = dict(line.split(" ", 1) for line in text.splitlines() if " " in line)
        made.source, made.target = (_surface_of_lines(lines, name) for name in ("from", "to"))
        numbers = {name: float(lines[name.replace("_", "-")]) for name in cls._standard if name not in ("filter", "instructions")}
        made._options = {**cls._standard, **numbers, "filter": lines["filter"], "transfer": TRANSFERS[int(numbers["transfer"])],
                         "not_finite": NOT_FINITE[int(numbers["not_finite"])], "instructions": instructions,
                         **{name: int(numbers[name]) for name in ("alpha", "vector")},
                         **{name: bool(numbers[name]) for name in ("alpha_multiplied", "dither")}}
        return made

    def filter_of(self, pictures: ArrayLike, *, dtype: DTypeLike | None = None) -> str:
        """The filter that is taken for pictures: the plan's, or what "auto" chooses."""
        images, _, kept = images_of(levelled(pictures) if is_masked(pictures) else pictures, self.source)
        source = created(library.cm_source_create, "cm_source_destroy", self._handle, images,
                         pixel_type(kept.dtype if dtype is None else dtype), 1, keep=(self._handle, images, kept))
        return FILTERS[library.cm_source_filter(source)]


def _surface_of_lines(lines, name):
    rotation = lines.get(name + "-rotation")
    matrix = None if rotation is None else np.array(rotation.split(), float).reshape(3, 3)
    return Surface(lines[name], rotation=None if matrix is None else Rotation(matrix))


def resample(pictures: ArrayLike, source: str | Surface, target: str | Surface, **options: Any) -> np.ndarray:
    """Pictures of one surface as those of another, in one step: options are those of Plan and of Plan.resample.

    A specification without a size takes that of the pictures, which have one or three channels behind it, or none.
    """
    passed = {name: options.pop(name) for name in ("out", "dtype", "rows", "threads") if name in options}
    if not isinstance(source, Surface):
        source = surface_of(pictures, source)
    return Plan(source, target, **options).resample(pictures, **passed)


def surface_of(pictures: ArrayLike, specification: str) -> Surface:
    """The surface of a specification that has the size of pictures."""
    shape = np.shape(pictures)
    if len(shape) == 4 or (len(shape) == 3 and shape[0] == 6 and shape[1] == shape[2]):
        return Surface(specification, shape[2], shape[1])
    if len(shape) < 2:
        raise ValueError(f"pictures: of rows and columns, not {shape}")
    return Surface(specification, shape[1], shape[0])


def mips(surface: Surface, pictures: ArrayLike, *, transfer: str = "stored", gamma: float = 0.0, alpha: int = 0,
         alpha_multiplied: bool = False, not_finite: str = "spread", dither: bool = False,
         threads: int = 1) -> list[np.ndarray]:
    """All levels of a surface's pictures, each of half the size of the one before, filtered across seams: a list of arrays."""
    if is_masked(pictures):
        how = {"not_finite": not_finite, "threads": threads}
        levels = mips(surface, filled(pictures, not_finite), transfer=transfer, gamma=gamma, alpha=alpha,
                      alpha_multiplied=alpha_multiplied, dither=dither, **how)
        return list(map(with_mask, levels, mips(surface, as_nan(pictures, bool(alpha)), **how)))
    images, channels, kept = images_of(pictures, surface)
    options = struct(library.cm_plan_options, transfer=number_of(transfer, TRANSFERS, "transfer"), gamma=gamma, alpha=alpha,
                     alpha_multiplied=alpha_multiplied, not_finite=number_of(not_finite, NOT_FINITE, "not_finite"), dither=dither)
    made = created(library.cm_mips_create, "cm_mips_destroy", surface._handle, images, ctypes.byref(options),
                   checked_threads(threads), keep=(images, kept))
    return [_level(made, level, surface.pictures, channels, kept.dtype, np.shape(pictures))
            for level in range(library.cm_mips_count(made))]


def _level(made, level, pictures, channels, dtype, shape):
    """A copy of a level: the library's own is gone with it."""
    first = library.cm_mips_pictures(made, level)
    found = []
    for picture in range(pictures):
        image = first[picture]
        size = image.height * image.width * channels * dtype.itemsize
        found.append(np.frombuffer(ctypes.string_at(image.data, size), dtype).reshape(image.height, image.width, channels))
    stacked = np.stack(found) if pictures > 1 else found[0].copy()
    return stacked if len(shape) == stacked.ndim else stacked[..., 0]


def border(surface: Surface, pictures: ArrayLike, pixels: int, *, dtype: DTypeLike | None = None,
           threads: int = 1) -> np.ndarray:
    """The planes of a surface with so many pixels of what the sphere has around them: (planes, rows, columns[, channels])."""
    if is_masked(pictures):
        return with_mask(border(surface, filled(pictures), pixels, dtype=dtype, threads=threads),
                         border(surface, as_nan(pictures), pixels, threads=threads))
    images, channels, kept = images_of(pictures, surface)
    planes, rows, columns = surface.plane_shape
    kind = pixel_type(kept.dtype if dtype is None else dtype)
    out = np.zeros((planes, rows + 2 * pixels, columns + 2 * pixels, channels), PIXEL_TYPES[kind])
    to = (library.cm_image * planes)()
    for image, picture in zip(to, out, strict=True):
        image.size, image.data, image.type = ctypes.sizeof(library.cm_image), picture.ctypes.data, kind
        image.height, image.width, image.channels = picture.shape
    library.cm_border(surface._handle, images, pixels, None, checked_threads(threads), to)
    return out if np.ndim(pictures) > len(surface.shape) else out[..., 0]


def healpix_arrange(values: ArrayLike, nside: int, order: str = "ring", *, to_list: bool = False) -> np.ndarray:
    """The pixels of a HEALPix map, (12 nside^2[, channels]), as the picture of the surface "healpix", (nside, 12 nside[, channels]);
    or back."""
    if is_masked(values):
        data, mask = (healpix_arrange(one, nside, order, to_list=to_list) for one in (values.data, np.ma.getmaskarray(values)))
        return np.ma.array(data, mask=mask)
    values = np.ascontiguousarray(values)
    if operator.index(nside) < 1:
        raise Error(library.CM_ERROR_PIXEL, f"nside: 1 to 2^29, not {nside}")
    shape = (nside, 12 * nside) if to_list else (12 * nside * nside,)
    if values.shape[:len(shape)] != shape or values.ndim > len(shape) + 1:
        raise ValueError(f"values: {shape}, not {values.shape}")
    rest = values.shape[len(shape):]
    result = np.empty(((12 * nside * nside,) if to_list else (nside, 12 * nside)) + rest, values.dtype)
    library.cm_healpix_arrange(nside, number_of(order, ORDERS, "order"), bool(to_list), values.nbytes // (12 * nside * nside),
                               values.ctypes.data, result.ctypes.data)
    return result


class Panorama(NamedTuple):
    """What a photograph of the sphere says of itself: cubemap/panorama.h says what each member is. heading may be NaN."""

    full_width: int = 0
    full_height: int = 0
    cropped_left: int = 0
    cropped_top: int = 0
    cropped_width: int = 0
    cropped_height: int = 0
    heading: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0

    @classmethod
    def read(cls, text: str | bytes) -> Panorama:
        """From a text that has the fields somewhere, as XMP has."""
        if isinstance(text, int):
            raise TypeError("text: a text or bytes, not a number")
        data = text.encode() if isinstance(text, str) else bytes(text)
        made = struct(library.cm_panorama)
        library.cm_panorama_read(data, len(data), ctypes.byref(made))
        return cls(*(getattr(made, name) for name in cls._fields))

    def _struct(self):
        made = struct(library.cm_panorama, **self._asdict())
        library.cm_panorama_check(ctypes.byref(made))
        return made

    def write(self) -> str:
        """As a packet of XMP."""
        text = ctypes.create_string_buffer(4096)
        library.cm_panorama_write(ctypes.byref(self._struct()), text, len(text))
        return text.value.decode()

    def surface(self, width: int, height: int) -> Surface:
        """The surface that a picture of that size is, and how it stands."""
        text, rotation = ctypes.create_string_buffer(512), library.cm_rotation()
        library.cm_panorama_surface(ctypes.byref(self._struct()), width, height, text, len(text), ctypes.byref(rotation))
        return Surface(text.value.decode(), width, height, rotation=Rotation(np.array(rotation.row)))

    @classmethod
    def of_surface(cls, surface: Surface) -> Panorama:
        """The fields of a surface of kind equirect."""
        made = struct(library.cm_panorama)
        library.cm_panorama_of_surface(handle_of(surface, Surface, "surface"), ctypes.byref(made))
        return cls(*(getattr(made, name) for name in cls._fields))
