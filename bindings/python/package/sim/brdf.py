# SPDX-License-Identifier: MIT
"""What part of the light from one direction a surface scatters to another.

>>> plastic = cubemap.sim.Brdf("cook-torrance", diffuse=0.5, specular=0.4, roughness=0.2, eta=1.5)
>>> to, away = (0.6, 0.0, 0.8), (-0.6, 0.0, 0.8)  # a mirror's way
>>> plastic.value((0.0, 0.0, 1.0), to, away) > plastic.value((0.0, 0.0, 1.0), to, to)
True
"""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _library as library
from .. import _methods
from .._methods import BrdfMethods
from .._texts import Specified, created, number_of, struct

_KINDS = ("lambert", "cook-torrance", "measured")
_FACETS = ("diffuse", "specular", "roughness", "eta", "absorption")


class BrdfSample(NamedTuple):
    """A measured value, per steradian, for angles of the light, of the detector, and between both around the normal."""

    theta_in: float
    theta_out: float
    azimuth: float
    value: float


class Brdf(BrdfMethods, Specified):
    """How a surface scatters: Brdf(), Brdf("cook-torrance", specular=0.4, roughness=0.2, eta=1.5), Brdf("measured",
    samples=[BrdfSample(0.1, 0.5, 1.2, 0.3), ...]).

    diffuse, specular   of "cook-torrance": the parts that Lambert's law and facets scatter; at most 1 together
    roughness           root mean square of the facets' slope, 0.01 to 1
    eta, absorption     the index of refraction and its imaginary part
    samples             of "measured": BrdfSamples in any order

    Of directions (..., 3) of length 1 away from the surface: b.value(normal, in, out), b.density(normal, in, out) and
    b.sample_direction(normal, out, u) with u in [0, 1); of angles: b.albedo(theta_in). A Primitive takes it by
    primitive._replace(brdf=b), whose material's reflectance multiplies it.

    >>> b = cubemap.sim.Brdf()
    >>> round(b.value((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), (0.6, 0.0, 0.8)) * np.pi, 12)
    1.0
    >>> round(b.albedo(0.3), 6)
    1.0
    """

    _standard = {**dict.fromkeys(_FACETS, 0.0), "samples": ()}

    def __init__(self, kind: str = "lambert", *, diffuse: float = 0.0, specular: float = 0.0, roughness: float = 0.0,
                 eta: float = 0.0, absorption: float = 0.0, samples: ArrayLike = ()) -> None:
        facets = dict(zip(_FACETS, (diffuse, specular, roughness, eta, absorption), strict=True))
        kind = _KINDS[number_of(kind, _KINDS, "kind")]
        if (kind != "cook-torrance" and any(facets.values())) or (kind != "measured" and len(samples)):
            raise ValueError(f"kind: {kind!r} has other arguments")
        self._given = {"kind": kind, **facets, "samples": tuple(BrdfSample(*map(float, one)) for one in samples)}
        self._handle = self._create()
        self._threads = 1

    def _create(self):
        given = self._given
        if given["kind"] == "lambert":
            return created(library.cm_brdf_create_lambert, "cm_brdf_destroy")
        if given["kind"] == "cook-torrance":
            options = struct(library.cm_cook_torrance, **{name: given[name] for name in _FACETS})
            return created(library.cm_brdf_create_cook_torrance, "cm_brdf_destroy", ctypes.byref(options))
        samples = given["samples"]
        made = (library.cm_brdf_sample * len(samples))(*samples)
        return created(library.cm_brdf_create_measured, "cm_brdf_destroy", len(samples), made)

    def _arguments(self):
        return dict(self._given)


def brdf_goniometer(alpha: ArrayLike, beta: ArrayLike, gamma: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """theta_in, theta_out and azimuth of a gonioreflectometer's angles: alpha turns the sample, beta the detector, gamma
    raises the normal."""
    return _methods.brdf_goniometer(alpha, beta, gamma)[:3]
