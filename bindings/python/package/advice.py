# SPDX-License-Identifier: MIT
"""Which mappings keep given limits, the cheapest first, and what the others miss.

>>> costs = [cubemap.Cost("coupled", ns=(7.2, 5.1)), cubemap.Cost("gnomonic", ns=(1.9, 2.2))]
>>> advice = cubemap.advise(costs, {"area error": 0.2})
>>> advice[0].specification, advice.qualified
('coupled', 1)
>>> advice[1].reason
'area error 1.721, 1.52 more than 0.2'
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterable
from typing import Any, NamedTuple

from . import _library as library
from ._texts import Changing, checked_text, created, decoded, number_of, struct, words_of
from .earth import LATITUDES, Ellipsoid, ellipsoid_of
from .mapping import SMOOTHNESS
from .measures import PRECISIONS

LIMITS = words_of(library.cm_limit_name)


class Cost(NamedTuple):
    """What a mapping costs on a machine: nanoseconds a point in arrays and alone, forward and inverse; NaN where not known."""

    specification: str
    precision: str = "double"
    ns: tuple = (float("nan"), float("nan"))
    single_ns: tuple = (float("nan"), float("nan"))


class Candidate(NamedTuple):
    """A row of costs, judged: cubemap/advise.h says what each member is. `reason` says what it misses; "" if it qualifies."""

    specification: str
    precision: str
    latitude: str
    values: dict
    missed: tuple
    excess: float
    is_near: bool
    index: int
    reason: str


class Advice(Changing):
    """A ranked list: len(a), a[0], and a.qualified, how many of the first keep all limits.

    >>> advice = cubemap.advise([cubemap.Cost("coupled"), cubemap.Cost("seamless")], equal_area=True)
    >>> [candidate.specification for candidate in advice], advice.qualified
    (['seamless', 'coupled'], 1)
    """

    def __init__(self, handle: Any) -> None:
        self._handle = handle

    def __repr__(self):
        return f"<cubemap.Advice of {len(self)} candidates, {self.qualified} qualified>"

    def __len__(self) -> int:
        return library.cm_advice_count(self._handle)

    @property
    def qualified(self) -> int:
        """How many keep all limits: the first so many."""
        return library.cm_advice_qualified(self._handle)

    def __getitem__(self, index: int) -> Candidate:
        index = range(len(self))[index]
        found = library.cm_advice_at(self._handle, index).contents
        reason = ctypes.create_string_buffer(1024)
        library.cm_advice_reason(self._handle, index, reason, len(reason))
        return Candidate(decoded(found.specification), PRECISIONS[found.precision], LATITUDES[found.latitude],
                         dict(zip(LIMITS, found.value, strict=False)),
                         tuple(name for bit, name in enumerate(LIMITS) if found.missed >> bit & 1), found.excess, bool(found.is_near),
                         found.index, reason.value.decode())


def advise(costs: Iterable[Cost | tuple], limits: dict[str, float] | None = None, *, equal_area: bool = False,
           smooth: str = "torn", edge: str = "torn", precisions: Iterable[str] = (),
           directions: Iterable[str] = ("forward", "inverse"), single: bool = False,
           ellipsoid: str | Ellipsoid | None = None, latitude_ns: tuple[float, float] = (0.0, 0.0),
           latitude_single_ns: tuple[float, float] = (0.0, 0.0)) -> Advice:
    """The candidates that costs has, ranked, as Advice.

    costs     of Cost, or tuples of its members
    limits    {name of LIMITS that is a number: the most that may be}
    """
    rows = [Cost(*cost) for cost in costs]
    table = (library.cm_advice_cost * len(rows))()
    for to, one in zip(table, rows, strict=True):
        to.specification = checked_text(one.specification, "specification")
        to.precision = number_of(one.precision, PRECISIONS, "precision")
        to.ns[:], to.single_ns[:] = one.ns, one.single_ns
    given = struct(library.cm_advice_costs, count=len(rows), cost=table)
    given.latitude_ns[:], given.latitude_single_ns[:] = latitude_ns, latitude_single_ns
    request = struct(library.cm_advice_request, equal_area=bool(equal_area), smooth=number_of(smooth.lower(), _SMOOTH, "smooth"),
                     edge=number_of(edge.lower(), _SMOOTH, "edge"), single=bool(single),
                     precisions=sum(1 << number_of(name, PRECISIONS, "precisions") for name in set(precisions)),
                     directions=sum(1 << number_of(name, ("forward", "inverse"), "directions") for name in set(directions)))
    for name, value in (limits or {}).items():
        bit = number_of(name, LIMITS[:len(request.limit)], "limits")
        request.limited |= 1 << bit
        request.limit[bit] = value
    if ellipsoid is not None:
        ellipsoid = ellipsoid_of(ellipsoid)
        request.ellipsoid = ctypes.pointer(ellipsoid._struct)
    return Advice(created(library.cm_advise, "cm_advice_destroy", ctypes.byref(request), ctypes.byref(given)))


_SMOOTH = tuple(name.lower() for name in SMOOTHNESS)
