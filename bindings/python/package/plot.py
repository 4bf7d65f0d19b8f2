# SPDX-License-Identifier: MIT
"""Drawings of mappings with matplotlib: faces, crosses, meridians and parallels, Tissot's indicatrices.

Each function draws into axes that it is given, or makes a figure, and returns the axes.

>>> import cubemap.plot
>>> axes = cubemap.plot.indicatrices("coupled", count=5)
>>> len(axes.collections)
8
>>> import matplotlib.pyplot as plt
>>> plt.close(axes.figure)
"""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import Normalize
from numpy.typing import ArrayLike

from .mapping import Distortion, Mapping, mapping_of

# where faces stand in a cross, by their names in each frame: column and row, the row upwards
_PLACES = {"geo": ((0, 0), (1, 0), (2, 0), (-1, 0), (0, 1), (0, -1)),
           "fits": ((0, 1), (0, 0), (1, 0), (2, 0), (-1, 0), (0, -1)),
           "gl": ((1, 0), (-1, 0), (0, 1), (0, -1), (0, 0), (2, 0))}


def _axes(axes, size):
    if axes is None:
        _, axes = plt.subplots(figsize=size, layout="constrained")
    axes.set_aspect("equal")
    axes.set_axis_off()
    return axes


def _offsets(mapping, arrangement):
    """The middle of each face: in a row, or as a cross."""
    count = mapping.face_count
    if arrangement not in ("row", "cross"):
        raise ValueError(f"arrangement: row or cross, not {arrangement!r}")
    identifier = mapping.frame.identifier
    if arrangement == "cross" and count == 6 and identifier in _PLACES:
        return 2.0 * np.array(_PLACES[identifier])
    return np.array([(2.2 * face, 0.0) for face in range(count)])


def _outlines(axes, mapping, offsets):
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)], float)
    axes.add_collection(LineCollection([corners + offset for offset in offsets], colors="0.2", linewidths=0.8))
    low, high = offsets.min(axis=0) - 1.05, offsets.max(axis=0) + 1.05
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])


def _in_one_scale(pictures, keywords):
    """Keywords of imshow with which a colour means the same number on all faces: of all finite ones, if nothing else is said."""
    norm = keywords.get("norm")
    finite = np.ma.masked_invalid(pictures).compressed()
    if isinstance(norm, Normalize):
        norm.autoscale_None(finite)  # matplotlib refuses limits beside it
        return keywords
    return {"vmin": finite.min(), "vmax": finite.max(), **keywords} if finite.size else keywords


def _checked_count(count, name):
    if not count > 0:
        raise ValueError(f"{name}: more than 0, not {count}")


def faces(pictures: ArrayLike, mapping: str | Mapping = "coupled", *, axes: Axes | None = None,
          arrangement: str = "cross", **keywords: Any) -> Axes:
    """The pictures of six faces, (6, rows, columns[, channels]), the first row at the top: as a cross, or in a row.

    keywords go to imshow: cmap="cubemap.sequential-single", vmin=..., norm=..., interpolation="bilinear". All faces have one
    scale of colours.
    """
    mapping = mapping_of(mapping)
    pictures = np.asanyarray(pictures)
    if pictures.ndim not in (3, 4) or len(pictures) != mapping.face_count:
        raise ValueError(f"pictures: ({mapping.face_count}, rows, columns[, channels]), not {pictures.shape}")
    if pictures.shape[3:] == (1,):
        pictures = pictures[..., 0]
    offsets = _offsets(mapping, arrangement)
    axes = _axes(axes, (8, 6) if arrangement == "cross" else (12, 2.4))
    if pictures.ndim == 3:
        keywords = _in_one_scale(pictures, keywords)
    # v grows down in the pictures of gl: its cross is drawn as pictures are stored
    for picture, (column, row) in zip(pictures, offsets, strict=True):
        axes.imshow(picture, extent=(column - 1, column + 1, row - 1, row + 1), **{"interpolation": "nearest", **keywords})
    _outlines(axes, mapping, offsets)
    return axes


def _upwards(mapping, v):
    """v as it is drawn: the first row of a picture is at the top."""
    return -v if mapping.frame.first_row_v < 0 else v


def _broken(points, face):
    """Pieces of a line that stay on one face, by face."""
    cuts = np.flatnonzero(np.diff(face)) + 1
    for piece, where in zip(np.split(points, cuts), np.split(face, cuts), strict=True):
        if where[0] != 255 and len(piece) > 1:
            yield int(where[0]), piece


def graticule(mapping: str | Mapping = "coupled", *, step: float = 15, axes: Axes | None = None,
              arrangement: str = "cross", color: Any = "0.55") -> Axes:
    """Meridians and parallels each so many degrees."""
    _checked_count(step, "step")
    mapping = mapping_of(mapping)
    offsets = _offsets(mapping, arrangement)
    axes = _axes(axes, (8, 6) if arrangement == "cross" else (12, 2.4))
    along = np.radians(np.linspace(-180, 180, 2881))
    lines = []
    circles = [(along, np.full_like(along, np.radians(lat))) for lat in np.arange(-90 + step, 90, step)]
    circles += [(np.full_like(along, np.radians(lon)), along / 2) for lon in np.arange(-180, 180, step)]
    for lon, lat in circles:
        face, u, v = mapping.forward_lonlat(lon, lat)
        for where, piece in _broken(np.stack((u, _upwards(mapping, v)), axis=-1), face):
            jumps = np.flatnonzero(np.abs(np.diff(piece, axis=0)).max(axis=1) > 0.5) + 1
            lines += [part + offsets[where] for part in np.split(piece, jumps) if len(part) > 1]
    axes.add_collection(LineCollection(lines, colors=color, linewidths=0.6))
    _outlines(axes, mapping, offsets)
    return axes


def indicatrices(mapping: str | Mapping = "coupled", *, count: int = 7, radius: float | None = None,
                 axes: Axes | None = None, arrangement: str = "cross", color: Any = "#c2452d") -> Axes:
    """Tissot's indicatrices: what circles of one radius on the sphere become, so many along each edge of a face.

    radius   of the circles, radians; without one they nearly touch
    """
    _checked_count(count, "count")
    mapping = mapping_of(mapping)
    offsets = _offsets(mapping, arrangement)
    axes = graticule(mapping, axes=axes, arrangement=arrangement)
    middle = (2 * np.arange(count) + 1) / count - 1
    u, v = np.meshgrid(middle, middle)
    radius = 0.4 * np.sqrt(4 * np.pi / mapping.face_count) / 2 * 2 / count if radius is None else radius
    for face, offset in enumerate(offsets):
        there = mapping.inverse_distortion(np.uint8(face), u, v)
        good = np.isfinite(there.major) & np.isfinite(there.minor)
        angle = np.degrees(_upwards(mapping, there.orientation[good]))
        places = np.stack((u[good], _upwards(mapping, v[good])), axis=-1) + offset
        axes.add_collection(EllipseCollection(2 * radius * there.major[good], 2 * radius * there.minor[good], angle, units="xy",
                                              offsets=places, offset_transform=axes.transData, facecolors=color, alpha=0.6,
                                              edgecolors="none"))
    return axes


def distortion(mapping: str | Mapping = "coupled", quantity: str = "area", *, size: int = 128, axes: Axes | None = None,
               arrangement: str = "cross", **keywords: Any) -> Axes:
    """A quantity of Distortion over the faces in colours, with a bar that says what they mean."""
    if quantity not in Distortion._fields:
        raise ValueError(f"quantity: {quantity!r} is none of {', '.join(Distortion._fields)}")
    _checked_count(size, "size")
    mapping = mapping_of(mapping)
    middle = (2 * np.arange(size) + 1) / size - 1
    v = middle if mapping.frame.first_row_v < 0 else -middle
    face = np.arange(mapping.face_count, dtype=np.uint8)[:, np.newaxis, np.newaxis]
    values = getattr(mapping.inverse_distortion(face, middle[np.newaxis, np.newaxis], v[np.newaxis, :, np.newaxis]), quantity)
    axes = faces(values, mapping, axes=axes, arrangement=arrangement, **keywords)
    axes.figure.colorbar(axes.images[-1], ax=axes, shrink=0.6, label=quantity)
    return axes


def directions_of(mapping: str | Mapping, size: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The directions of the pixels' centres of all faces: x, y, z of (faces, rows, columns), the first row at the top."""
    mapping = mapping_of(mapping)
    middle = (2 * np.arange(size) + 1) / size - 1
    v = middle if mapping.frame.first_row_v < 0 else -middle
    face = np.arange(mapping.face_count, dtype=np.uint8)[:, np.newaxis, np.newaxis]
    return mapping.inverse(face, middle[np.newaxis, np.newaxis], v[np.newaxis, :, np.newaxis])
