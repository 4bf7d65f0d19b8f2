# SPDX-License-Identifier: MIT
"""What does not fit into memory, or onto one machine: Dask and xarray.

apply(m, "forward", x, y, z) calls a method of an object of this package for arrays of Dask, DataArrays of xarray or what is
left to NumPy; reproject brings a raster of the whole Earth to another surface, tile by tile. Each task works on one thread:
Dask has its own.

>>> import dask.array as da
>>> from cubemap import large
>>> raster = da.ones((64, 128), chunks=(32, 64), dtype="float32")
>>> faces = large.reproject(raster, "cube:coupled", 32, tile=16)
>>> faces.shape, float(faces.mean())
((6, 32, 32), 1.0)
>>> x = da.ones(1000, chunks=100)
>>> face, u, v = large.apply(cubemap.Mapping("coupled"), "forward", x, 0.5 * x, 0.25 * x)
>>> round(float(u.mean()), 6)
0.620558
"""

from __future__ import annotations

import itertools
import math
import re
from typing import Any

import numpy as np

from . import _methods
from .earth import Rotation
from .images import PIXEL_TYPES, Surface
from .mapping import Mapping


class _Call:
    """A method by its name, and by its types, which are those of all chunks: it travels to workers as the object's specification."""

    def __init__(self, owner, name, types, options):
        self.owner, self.name, self.types, self.options = owner, name, types, options
        self.__name__ = name

    def __call__(self, *arrays):
        result = getattr(self.owner, self.name)(*arrays, **self.options, signature=self.types)
        return tuple(result) if isinstance(result, tuple) else result


def _types(function, arrays):
    """Of inputs and outputs, as "ddd->Bdd": the first loop to which all casts are safe, as NumPy has it. Numbers of Python are
    real ones of any precision beside arrays of real ones."""
    ufunc = function.ufunc
    given = [np.dtype(getattr(array, "dtype", None) or np.asarray(array).dtype) for array in arrays]
    adapts = [type(array) in (int, float) for array in arrays]
    has_real = any(one.kind == "f" and not weak for one, weak in zip(given, adapts, strict=True))
    for types in ufunc.types:
        if all(np.can_cast(one, kind, "safe") or (has_real and weak and np.dtype(kind).kind == "f")
               for one, weak, kind in zip(given, adapts, types.partition("->")[0], strict=True)):
            return types
    raise TypeError(f"{ufunc.__name__} takes none of {', '.join(map(str, given))}")


def _signature(function):
    """The core dimensions of inputs and outputs by names, and how large each is: (),(3)->(4,3)."""
    ufunc = function.ufunc
    text = ufunc.signature or ",".join(["()"] * ufunc.nin) + "->" + ",".join(["()"] * ufunc.nout)
    names = (f"core{number}" for number in itertools.count())
    sides, sizes = [], {}
    for side in text.split("->"):
        operands = []
        for operand in re.findall(r"\(([^)]*)\)", side):
            extents = [int(extent) for extent in operand.split(",") if extent]
            own = [next(names) for _ in extents]
            sizes.update(zip(own, extents, strict=True))
            operands.append(own)
        sides.append(operands)
    return sides[0], sides[1], sizes


def _bound(owner, name, options):
    """The function behind a method, which has a ufunc: of one that takes options, that of these."""
    if name in getattr(owner, "_bound_names", ()):
        return owner._bound_with(name, **options)
    function = getattr(owner, name)
    if not hasattr(function, "ufunc"):
        raise TypeError(f"name: a method that is a ufunc, not {name!r}")
    if options:
        raise TypeError(f"{name} has no option {', '.join(options)}")
    return function


def apply(owner: Any, name: str, *arrays: Any, **options: Any) -> Any:
    """A method of an object of this package, or a function if owner is the package, for arrays of Dask or xarray.

    The ufuncs themselves cannot: Dask refuses those of several outputs. DataArrays keep their coordinates. What a method takes
    beside arrays is an option: apply(cells, "forward_lonlat", lon, lat, level=12).
    """
    owner = owner if owner is not None else _methods
    function = _bound(owner, name, options)
    inputs, outputs, sizes = _signature(function)
    if len(arrays) != len(inputs):
        raise TypeError(f"{name} takes {len(inputs)} arrays, not {len(arrays)}")
    types = _types(function, arrays)
    call, dtypes = _Call(owner, name, types, options), [np.dtype(kind) for kind in types.partition("->")[2]]
    if any(type(array).__module__.startswith("xarray.") for array in arrays):
        import xarray

        return xarray.apply_ufunc(call, *arrays, input_core_dims=inputs, output_core_dims=outputs, dask="parallelized",
                                  output_dtypes=dtypes, dask_gufunc_kwargs={"output_sizes": {
                                      one: sizes[one] for one in itertools.chain(*outputs)}})
    if any(type(array).__module__.startswith("dask.") for array in arrays):
        import dask.array

        text = "->".join(",".join(f"({','.join(operand)})" for operand in side) for side in (inputs, outputs))
        alone = len(outputs) == 1
        return dask.array.apply_gufunc(call, text, *arrays, output_dtypes=dtypes[0] if alone else dtypes,
                                       output_sizes={one: sizes[one] for one in itertools.chain(*outputs)}, allow_rechunk=True)
    return call(*arrays)


# ---- rasters ----

class _Raster:
    """A raster of longitude and latitude in even steps, the north first, and how it is cut into blocks."""

    def __init__(self, array, west, east, south, north, halo):
        self.array, self.halo = array, halo
        self.west, self.north = west, north
        self.column, self.row = (east - west) / array.shape[1], (north - south) / array.shape[0]  # of a pixel, degrees
        self.is_round = abs(east - west - 360) < 1e-9
        self.goes_on = self.is_round and array.numblocks[1] > 1  # does a block go on beyond the raster's sides?
        self.row_ends = np.cumsum((0, *array.chunks[0]))
        self.column_ends = np.cumsum((0, *array.chunks[1]))

    def with_halo(self):
        """Each block with what is around it: across the antimeridian too, but not across the poles."""
        from dask.array import overlap

        boundary = {0: "none", 1: "periodic" if self.goes_on else "none"}
        return overlap.overlap(self.array, depth={0: self.halo, 1: self.halo * (self.array.numblocks[1] > 1)}, boundary=boundary, allow_rechunk=False)

    def box(self, i, j):
        """The surface of a block with its halo, and the rows and columns of the raster that are the block's own."""
        rows, columns = self.row_ends[i:i + 2].tolist(), self.column_ends[j:j + 2].tolist()
        top, bottom = self.halo * (i > 0), self.halo * (i < len(self.row_ends) - 2)
        left, right = (self.halo * (self.goes_on or j > 0), self.halo * (self.goes_on or j < len(self.column_ends) - 2))
        north, south = self.north - self.row * (rows[0] - top), self.north - self.row * (rows[1] + bottom)
        west, east = self.west + self.column * (columns[0] - left), self.west + self.column * (columns[1] + right)
        text = f"equirect;west={west!r};east={east!r};south={max(south, -90.0)!r};north={min(north, 90.0)!r}"
        return (text, columns[1] - columns[0] + left + right, rows[1] - rows[0] + top + bottom), (*rows, *columns)

    @property
    def layout(self):
        """What `_whole_places` takes."""
        return self.west, self.north, self.column, self.row, *self.array.shape[:2], self.is_round

    def places(self, lon, lat):
        """Row and column, as real numbers; columns from 0 to the width of the whole turn."""
        return (self.north - np.degrees(lat)) / self.row, np.mod(np.degrees(lon) - self.west, 360.0) / self.column


def _lonlat_of_tile(surface, plane, rows, columns, step=1):
    """Directions of a tile's pixels, or of so many steps along each side, edges included."""
    if step == 1:
        row, column = np.arange(*rows) + 0.5, np.arange(*columns) + 0.5
    else:
        row, column = np.linspace(*rows, step), np.linspace(*columns, step)
    return surface.directions(np.uint8(plane), column[np.newaxis, :], row[:, np.newaxis])


def _blocks_of(raster, surface, plane, rows, columns):
    """The blocks that a tile may need: those near any of 33 x 33 of its points, as far as the next point is."""
    x, y, z = _lonlat_of_tile(surface, plane, rows, columns, 33)
    directions = np.stack((x, y, z))
    reach = max(np.nanmax(np.linalg.norm(np.diff(directions, axis=axis), axis=0)) for axis in (1, 2)) * 1.5
    good = ~np.isnan(x)
    lon, lat = _methods.lonlat_from_direction(x[good], y[good], z[good])
    row, column = raster.places(lon, lat)
    above = np.degrees(reach) / raster.row
    nearest = np.clip(np.cos(lat) - reach, 0, None)  # to the axis
    with np.errstate(divide="ignore"):
        beside = np.where(nearest > reach, np.degrees(reach) / np.maximum(nearest, 1e-300) / raster.column, np.inf)
    height = raster.row_ends[-1]
    turn = 360.0 / raster.column
    first, last = raster.column_ends[:-1], raster.column_ends[1:]
    middle, half = (first + last) / 2, (last - first) / 2
    needed = []
    for i in range(len(raster.row_ends) - 1):
        near = (row + above >= raster.row_ends[i]) & (row - above <= raster.row_ends[i + 1]) & (row >= -1) & (row <= height + 1)
        if near.any():
            apart = np.abs(np.mod(column[near, np.newaxis] - middle + turn / 2, turn) - turn / 2)
            needed += [(i, j) for j in np.flatnonzero((apart <= half + beside[near, np.newaxis] + 1).any(axis=0)).tolist()]
    return needed


def _whole_places(lon, lat, layout):
    """Row and column of the pixel that a point is in, -1 for none: the same in every task, so that each point is in one
    block alone, whatever rounding does."""
    west, north, column_step, row_step, height, width, is_round = layout
    row = np.floor((north - np.degrees(lat)) / row_step)
    column = np.floor(np.mod(np.degrees(lon) - west, 360.0) / column_step)
    with np.errstate(invalid="ignore"):
        # the south pole, and what rounds up to a whole turn
        row = np.where((row == height) & (north - np.degrees(lat) <= row_step * height * (1 + 1e-12)), height - 1, row)
        column = np.where((column == width) & is_round, width - 1, column)
        good = (row >= 0) & (row < height) & (column >= 0) & (column < width)
    return np.where(good, row, -1), np.where(good, column, -1)


def _owned_places(layout, owns, surface_given, plane, rows, columns):
    """For each of some blocks which pixels of a tile lie in it."""
    surface = Surface(*surface_given[0], **surface_given[1])
    directions = _lonlat_of_tile(surface, plane, rows, columns)
    row, column = (one.ravel() for one in _whole_places(*_methods.lonlat_from_direction(*directions), layout))
    return [np.flatnonzero((row >= own[0]) & (row < own[1]) & (column >= own[2]) & (column < own[3])).astype(np.uint32) for own in owns]


def _sample_part(block, places, number, box, surface_given, plane, rows, columns, filter):
    """Of a tile the pixels that lie in a block: their places in the tile, and their values."""
    place = places[number]
    surface = Surface(*surface_given[0], **surface_given[1])
    row, column = np.divmod(place, np.uint32(columns[1] - columns[0]))
    x, y, z = surface.directions(np.uint8(plane), column + (columns[0] + 0.5), row + (rows[0] + 0.5))
    return place, np.ma.filled(Surface(*box).sample(np.asanyarray(block), x, y, z, filter), np.nan)


def _join_parts(shape, channels, whole, *parts):
    """A tile from the parts that blocks have of it."""
    tile = np.zeros((shape[0] * shape[1], channels), np.float32)
    for place, values in parts:
        tile[place] = values
    found = sum(len(place) for place, _ in parts)
    if whole and found != len(tile):
        raise RuntimeError(f"{len(tile) - found} pixels of a tile lie in no block that was asked: please report this")
    return tile.reshape(*shape, channels)


def reproject(raster: Any, target: str = "cube:coupled", size: int | None = None, *, tile: int = 1024,
              filter: str = "bilinear", west: float = -180.0, east: float = 180.0, south: float = -90.0,
              north: float = 90.0, rotation: str | Rotation | None = None) -> Any:
    """A raster in longitude and latitude as pictures of another surface, lazily: an array of Dask, or a DataArray.

    raster     (rows, columns) or (rows, columns, channels), the north first, of Dask or of NumPy; or a DataArray with the
               dimensions lat and lon, in even steps
    target     a specification of a surface; size is the edge of a face, or the picture's width
    tile       pixels along an edge of the result's chunks
    filter     of cubemap.FILTERS, but for "ewa" and "auto": where the target is coarser than the raster, average that first
    west, ...  the raster's outer edges, degrees

    The result is float32, whole numbers of the raster are 0 to 1 as everywhere in pictures. A task needs a block of the
    raster with its neighbours' pixels around it, and a tile: memory does not grow with the raster. Within half a pixel of
    a pole there is no interpolation across it.
    """
    if type(raster).__module__.startswith("xarray."):
        return _reproject_dataarray(raster, target, size, tile=tile, filter=filter, rotation=rotation)
    import dask.array
    from dask.base import tokenize
    from dask.highlevelgraph import HighLevelGraph

    array = raster if isinstance(raster, dask.array.Array) else dask.array.from_array(raster)
    if array.dtype.newbyteorder("=").name not in PIXEL_TYPES:
        raise TypeError(f"raster: {', '.join(PIXEL_TYPES)}, not {array.dtype}")
    if tile < 1:
        raise ValueError(f"tile: 1 or more, not {tile}")
    if array.ndim not in (2, 3) or not all(array.shape):
        raise ValueError(f"raster: rows and columns, and channels if there are some, not the shape {array.shape}")
    if not -math.inf < west < east < math.inf or not -math.inf < south < north < math.inf:
        raise ValueError(f"the raster's outer edges: from {west} to {east} in longitude, from {south} to {north} in latitude")
    flat = array.ndim == 2
    array = array[..., np.newaxis] if flat else array
    array = array.rechunk({2: -1})
    given = ((target, size or 0, 0), {"rotation": rotation}) if size else ((target,), {"rotation": rotation})
    if size and target.lower().startswith("cube"):
        given = ((f"{target};size={size}",), {"rotation": rotation})
    surface = Surface(*given[0], **given[1])
    planes, height, width = surface.plane_shape
    if surface.shape not in ((planes, height, width), (height, width)):
        raise ValueError(f"target: a surface whose pictures are its planes, not {target!r}")
    halo = {"nearest": 1, "bilinear": 1, "catmull-rom": 2, "mitchell": 2, "lanczos3": 3, "spline36": 3, "bspline5": 16}.get(filter)
    if halo is None:
        raise ValueError(f"filter: {filter!r} has no block of its own")
    if max(array.chunks[1]) + 2 * halo > array.shape[1]:
        array = array.rechunk({1: -1})  # a block that is nearly as wide as the raster has the whole turn
    halo = min(halo, *array.chunks[0], *array.chunks[1])
    cut = _Raster(array, west, east, south, north, halo)
    blocks, channels = cut.with_halo(), array.shape[2]
    row_chunks, column_chunks = (tuple(min(tile, extent - first) for first in range(0, extent, tile)) for extent in (height, width))
    whole = planes == 6 and cut.is_round and abs(cut.row * array.shape[0] - 180) < 1e-9
    name = "reproject-" + tokenize(blocks, given, tile, filter, west, east, south, north)
    graph = {}
    for plane, i, j in itertools.product(range(planes), range(len(row_chunks)), range(len(column_chunks))):
        rows = (sum(row_chunks[:i]), sum(row_chunks[:i + 1]))
        columns = (sum(column_chunks[:j]), sum(column_chunks[:j + 1]))
        needed = _blocks_of(cut, surface, plane, rows, columns)
        boxes = [cut.box(*block) for block in needed]
        places = (name + "-places", plane, i, j)
        graph[places] = (_owned_places, cut.layout, [own for _, own in boxes], given, plane, rows, columns)
        parts = []
        for number, (block, (box, _)) in enumerate(zip(needed, boxes, strict=True)):
            key = (name + "-part", plane, i, j, number)
            graph[key] = (_sample_part, (blocks.name, *block, 0), places, number, box, given, plane, rows, columns, filter)
            parts.append(key)
        graph[name, plane, i, j, 0] = (_join_parts, (row_chunks[i], column_chunks[j]), channels, whole, *parts)
    # a layer of Dask has tiles as blocks: planes are joined below
    tiles = {(name + "-tile", *key[1:]): (_as_plane, key) for key in list(graph) if key[0] == name}
    graph.update(tiles)
    layers = HighLevelGraph.from_collections(name + "-tile", graph, dependencies=[blocks])
    made = dask.array.Array(layers, name + "-tile", chunks=((1,) * planes, row_chunks, column_chunks, (channels,)), dtype=np.float32)
    made = made if len(surface.shape) == 3 else made[0]
    return made[..., 0] if flat else made


def _as_plane(tile):
    return tile[np.newaxis]


def _edges(values, what):
    """The outer edges of pixels whose centres are in even steps."""
    values = np.asarray(values, np.float64)
    steps = np.diff(values)
    if values.size < 2 or not np.allclose(steps, steps.mean(), rtol=0, atol=1e-6 * abs(steps.mean())):
        raise ValueError(f"{what}: not in even steps")
    # centres are written with few digits: edges are taken to a millionth of a pixel
    half = steps.mean() / 2
    return values[0] - half, values[-1] + half


def _reproject_dataarray(raster, target, size, *, tile, filter, rotation):
    import xarray

    for name in ("lat", "lon"):
        if name not in raster.dims:
            raise ValueError(f"raster: a DataArray with the dimensions lat and lon, not {raster.dims}")
    if raster["lat"].size > 1 and raster["lat"][0] < raster["lat"][1]:
        raster = raster.isel(lat=slice(None, None, -1))
    others = [name for name in raster.dims if name not in ("lat", "lon")]
    if len(others) > 1:
        raise ValueError(f"raster: one dimension beside lat and lon, not {others}")
    raster = raster.transpose("lat", "lon", *others)
    north, south = _edges(raster["lat"], "lat")
    west, east = _edges(raster["lon"], "lon")
    north, south = (round(edge) if abs(edge - round(edge)) < 1e-6 else edge for edge in (north, south))
    west, east = (round(edge) if abs(edge - round(edge)) < 1e-6 else edge for edge in (west, east))
    made = reproject(raster.data, target, size, tile=tile, filter=filter, west=float(west), east=float(east), south=float(south),
                     north=float(north), rotation=rotation)
    planes = made.ndim - len(others) == 3
    dims = (*(("face",) if planes else ()), *(("v", "u") if planes else ("row", "column")), *others)
    coords = {name: raster[name] for name in others if name in raster.coords}
    if planes:
        edge = made.shape[1]
        mapping = Mapping(*_mapping_of(target))
        middle = (2 * np.arange(edge) + 1) / edge - 1
        coords.update(face=[face.name for face in mapping.frame.faces], v=middle if mapping.frame.first_row_v < 0 else -middle, u=middle)
    return xarray.DataArray(made, dims=dims, coords=coords, name=raster.name, attrs={**raster.attrs, "surface": target})


def _mapping_of(target):
    """Specification of the mapping and the frame in that of a cube's surface."""
    kind, *keys = target.split(";")
    frame = next((key.split("=")[1] for key in keys if key.lower().startswith("frame=")), "geo")
    return kind.partition(":")[2] or "coupled", frame
