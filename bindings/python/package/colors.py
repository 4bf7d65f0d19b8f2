# SPDX-License-Identifier: MIT
"""Perceptually uniform colour maps, for matplotlib too.

>>> len(cubemap.colormaps()), cubemap.find_colormap("sequential-single")
(14, 'sequential-single')
>>> cubemap.Colormap("sequential-single").samples(3, np.uint8).tolist()
[[17, 17, 18], [68, 109, 185], [239, 241, 246]]
"""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike

from . import _library as library
from ._errors import in_words
from ._method import name_results
from ._methods import ColormapMethods
from ._texts import Specified, checked_text, created, decoded


class Color(NamedTuple):
    """Colours of a map: three numbers along the last axis of each. `inside` says whether sRGB has the colour."""

    lch: Any
    luv: Any
    linear: Any
    srgb: Any
    inside: Any


name_results("cm_colormap_color_at", Color)


class Clipping(NamedTuple):
    """What has been cut to [0, 1]: cubemap/colormap.h says what each member is."""

    count: int
    first: int
    first_t: float
    excess: float


class Colormap(ColormapMethods, Specified):
    """A colour map: Colormap("sequential-single:hue=140"); colormaps() lists the models.

    c.samples(256) are colours whose steps are equal for the eye; c.color_at(t) is the colour at t in [0, 1].

    >>> c = cubemap.Colormap("uniform-blue-red")
    >>> c.inside, c.samples(256).shape
    (True, (256, 3))
    >>> c.color_at(0.5).srgb.round(3).tolist()
    [0.933, 0.933, 0.933]
    """

    _threads = 1

    def __init__(self, specification: str) -> None:
        text = checked_text(specification, "specification")
        in_words(library.cm_colormap_check, text)
        self._handle = created(library.cm_colormap_create, "cm_colormap_destroy", text)

    def _arguments(self):
        return {"specification": self.specification}

    @property
    def specification(self) -> str:
        """With all parameters: it makes a map of the same bits."""
        size = library.cm_colormap_specification(self._handle, None, 0)
        text = ctypes.create_string_buffer(size + 1)
        library.cm_colormap_specification(self._handle, text, len(text))
        return text.value.decode()

    @property
    def identifier(self) -> str:
        """Of its model."""
        return decoded(library.cm_colormap_describe(self._handle).contents.identifier)

    @property
    def inside(self) -> bool:
        """Is every colour of it inside sRGB?"""
        return bool(library.cm_colormap_inside(self._handle))

    @property
    def length(self) -> float:
        """Of the path in the map's space."""
        return library.cm_colormap_length(self._handle)

    @property
    def corners(self) -> np.ndarray:
        """The places where the path changes its direction."""
        return self.corner(np.arange(library.cm_colormap_corner_count(self._handle), dtype=np.uint64))

    @property
    def stops(self) -> np.ndarray:
        """Place and hue of the stops of a list: (n, 2)."""
        return self.stop(np.arange(library.cm_colormap_stop_count(self._handle), dtype=np.uint64))

    @property
    def largest_saturation(self) -> float:
        """With which the whole map is inside sRGB."""
        return library.cm_colormap_largest_saturation(self._handle)

    def samples(self, n: int = 256, dtype: DTypeLike = np.float64) -> np.ndarray:
        """n colours, (n, 3), of nonlinear sRGB: float64 in [0, 1], or uint8."""
        return self._samples(n, dtype)[0]

    def clipping(self, n: int = 256) -> Clipping:
        """What is cut of n samples because sRGB has no such colour."""
        return self._samples(n, np.float64)[1]

    def _samples(self, n, dtype):
        functions = {"float64": library.cm_colormap_samples, "uint8": library.cm_colormap_samples_u8}
        name = np.dtype(dtype).name
        if name not in functions:
            raise TypeError(f"dtype: float64 or uint8, not {name}")
        if n < 0:
            raise ValueError(f"n: 0 or more, not {n}")
        colors, cut = np.empty((n, 3), dtype), library.cm_colormap_clipping()
        functions[name](self._handle, n, colors.ctypes.data, ctypes.byref(cut))
        return colors, Clipping(cut.count, cut.first, cut.first_t, cut.excess)

    def fit(self) -> Colormap:
        """This map made to fit into sRGB."""
        made = created(library.cm_colormap_fit, "cm_colormap_destroy", self._handle)
        fitted = object.__new__(Colormap)
        fitted._handle = made
        return fitted

    def to_matplotlib(self, name: str | None = None, n: int = 256) -> Any:
        """As a colour map of matplotlib."""
        from matplotlib.colors import ListedColormap

        return ListedColormap(self.samples(n), name or f"cubemap.{self.identifier}")


def colormaps() -> tuple[str, ...]:
    """The identifiers of the models."""
    return tuple(decoded(library.cm_colormap_at(index).contents.identifier) for index in range(library.cm_colormap_count()))


def find_colormap(name: str) -> str | None:
    """The identifier of the model that a name or an alias means; None if there is none."""
    found = library.cm_colormap_find(checked_text(name, "name"))
    return decoded(found.contents.identifier) if found else None


def register_colormaps(prefix: str = "cubemap.") -> tuple[str, ...]:
    """Give matplotlib all models, and each turned round as PREFIX_r: plt.imshow(values, cmap="cubemap.uniform-blue-red").

    Registered again, they stay. Returns the names.
    """
    import matplotlib

    names = []
    for identifier in colormaps():
        made = Colormap(identifier).to_matplotlib(prefix + identifier)
        for one in (made, made.reversed()):
            if one.name not in matplotlib.colormaps:
                matplotlib.colormaps.register(one)
            names.append(one.name)
    return tuple(names)

