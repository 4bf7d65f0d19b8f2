# SPDX-License-Identifier: MIT
"""Motion between channels that are taken one after the other, and what makes channels comparable; docs/guide/sim-motion.md.

Pictures are (rows, columns) of float32, flows (rows, columns, 2): columns and rows to where a pixel's content is.

>>> cubemap.sim.compensation_flows("NCM", 4)[0]
FlowPair(from_frame=0, from_channel=1, to_frame=0, to_channel=0)
>>> picture = np.zeros((4, 6), np.float32)
>>> picture[1, 2] = 1
>>> flow = np.zeros((4, 6, 2), np.float32)
>>> flow[..., 0] = 1  # all content goes one column to the right
>>> moved, coverage = cubemap.sim.flow_warp(picture, flow)
>>> np.argwhere(moved == 1).tolist()
[[1, 3]]
"""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _library as library
from .._errors import Error
from .._texts import number_of, struct, words_of
from ..mapping import pool_of
from ._dense import dense

COMPENSATIONS = words_of(library.cm_compensation_name)


class FlowPair(NamedTuple):
    """A flow goes from one picture to another; frame 0 is this one, -1 the one before."""

    from_frame: int
    from_channel: int
    to_frame: int
    to_channel: int


def _scheme(word):
    return number_of(word, [one.lower() for one in COMPENSATIONS], "scheme")


def compensation_flows(scheme: str, channels: int) -> tuple[FlowPair, ...]:
    """The flows that a scheme, one of COMPENSATIONS, needs, in the order in which compensate takes them."""
    count = ctypes.c_size_t()
    try:
        library.cm_compensation_flows(_scheme(scheme), channels, 0, None, ctypes.byref(count))
    except Error as error:
        if error.status != library.CM_ERROR_SPACE:
            raise
    pairs = (library.cm_flow_pair * count.value)()
    library.cm_compensation_flows(_scheme(scheme), channels, count.value, pairs, ctypes.byref(count))
    return tuple(FlowPair(*(getattr(pair, name) for name in FlowPair._fields)) for pair in pairs)


def _input(now, before, flows):
    """The struct of what is to be compensated, and what it points into."""
    now = dense(now, "now", (None, None, None))
    given = struct(library.cm_compensation_input, width=now.shape[2], height=now.shape[1], channels=now.shape[0],
                   now=now.ctypes.data)
    kept = [now]
    for name, values, shape in (("before", before, now.shape), ("flow", flows, (None, *now.shape[1:], 2))):
        if values is not None:
            kept.append(dense(values, name, shape))
            setattr(given, name, kept[-1].ctypes.data)
    return given, kept


def compensate(now: ArrayLike, flows: ArrayLike, scheme: str, before: ArrayLike | None = None, *,
               threads: int = 1) -> np.ndarray:
    """All channels at the time of the first.

    now, before   (channels, rows, columns) of this frame and of the one before, which "NCM" does not need
    flows         (n, rows, columns, 2), those of compensation_flows
    """
    given, kept = _input(now, before, flows)
    wanted = len(compensation_flows(scheme, given.channels))
    if len(kept[-1]) != wanted:
        raise ValueError(f"flows: {wanted} for {scheme} of {given.channels} channels, not {len(kept[-1])}")
    corrected = np.empty_like(kept[0])
    library.cm_compensate(ctypes.byref(given), _scheme(scheme), pool_of(threads), corrected.ctypes.data)
    return corrected


def compensate_pixelwise(now: ArrayLike, before: ArrayLike, threshold: float) -> tuple[np.ndarray, int]:
    """Channels in which what came between them is taken from the frame before, without flows, and how many pixels
    changed."""
    given, kept = _input(now, before, None)
    corrected, changed = np.empty_like(kept[0]), ctypes.c_size_t()
    library.cm_compensate_pixelwise(ctypes.byref(given), threshold, corrected.ctypes.data, ctypes.byref(changed))
    return corrected, changed.value


def flow_warp(picture: ArrayLike, flow: ArrayLike, part: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """A picture moved by a part of its flow, and how much of something came to each pixel, 0 to 1."""
    picture = dense(picture, "picture", (None, None))
    flow = dense(flow, "flow", (*picture.shape, 2))
    moved, coverage = np.empty((2, *picture.shape), np.float32)
    rows, columns = picture.shape
    library.cm_flow_warp(columns, rows, picture.ctypes.data, flow.ctypes.data, part, moved.ctypes.data,
                         coverage.ctypes.data)
    return moved, coverage


def _changed(change, picture, *options, dtype=np.float32):
    """What a function that takes a picture makes of it."""
    picture = dense(picture, "picture", (None, None))
    made = np.empty(picture.shape, dtype)
    change(picture.shape[1], picture.shape[0], picture.ctypes.data, *options, made.ctypes.data)
    return made


def channel_gradient(picture: ArrayLike) -> np.ndarray:
    """Lengths of the gradient by Sobel's operator."""
    return _changed(library.cm_channel_gradient, picture)


def channel_census(picture: ArrayLike) -> np.ndarray:
    """The census of 3 x 3 pixels, uint8: bit k is 1 if neighbour k, by rows, is less than the pixel."""
    return _changed(library.cm_channel_census, picture, dtype=np.uint8)


def channel_normalize(picture: ArrayLike, most: float = 1.0) -> np.ndarray:
    """From the least and greatest finite value to 0 to most."""
    return _changed(library.cm_channel_normalize, picture, most)


def channel_normalize_locally(picture: ArrayLike, radius: int) -> np.ndarray:
    """(I - mean) / deviation of the window of 2 radius + 1 pixels each way."""
    return _changed(library.cm_channel_normalize_locally, picture, radius)


def channel_equalize(picture: ArrayLike, bins: int = 256) -> np.ndarray:
    """How many pixels are no greater, as a part of all, in so many steps."""
    return _changed(library.cm_channel_equalize, picture, bins)


def channel_equalize_locally(picture: ArrayLike, tiles: int = 8, limit: float = 3.0) -> np.ndarray:
    """Contrast limited adaptive equalization in tiles x tiles parts."""
    return _changed(library.cm_channel_equalize_locally, picture, tiles, limit)
