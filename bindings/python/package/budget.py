# SPDX-License-Identifier: MIT
"""Budgets: what a model leaves out, and why.

>>> entries = [cubemap.BudgetEntry("distortion", 0.004, 2.1), cubemap.BudgetEntry("multipath", 0.001, 46.0)]
>>> kept = cubemap.Budget(entries, "depth camera", "m", "ms").limit_error(0.002)
>>> kept.error, kept.cost, [entry.name for entry in kept.entries if entry.is_kept]
(0.001, 2.1, ['distortion'])
"""

from __future__ import annotations

import ctypes
from typing import NamedTuple

from . import _library as library
from ._texts import checked_text, decoded, string_of, struct


class BudgetEntry(NamedTuple):
    """An effect or a refinement: the error without it, what it costs, and whether it is kept, and why. unit None is
    the budget's."""

    name: str
    contribution: float
    cost: float
    unit: str | None = None
    is_required: bool = False
    is_kept: bool = False
    reason: str | None = None


def _bytes(text, what):
    return None if text is None else checked_text(text, what)


class Budget(NamedTuple):
    """All effects that a model might have: Budget([BudgetEntry("distortion", 0.004, 2.1)], "depth camera", "m", "ms").

    unit       of contributions, cost_unit of costs
    error      the sum of contributions over what is dropped, and cost that over what is kept, as of the last choice

    Every choice is a new Budget.
    """

    entries: tuple
    subject: str | None = None
    unit: str | None = None
    cost_unit: str | None = None
    error: float = 0.0
    cost: float = 0.0

    def __eq__(self, other):
        if not isinstance(other, Budget):
            return NotImplemented
        return (self._entries, *self[1:]) == (other._entries, *other[1:])

    def __ne__(self, other):
        return not self == other

    def __hash__(self):
        """Of a list of entries, too."""
        return hash((*self._entries, *self[1:]))

    @property
    def _entries(self):
        return [BudgetEntry(*entry) for entry in self.entries]

    def _struct(self):
        entries = (library.cm_budget_entry * len(self.entries))()
        for to, entry in zip(entries, self._entries, strict=True):
            to.size = ctypes.sizeof(library.cm_budget_entry)
            for name in ("contribution", "cost", "is_required", "is_kept"):
                setattr(to, name, getattr(entry, name))
            to.name, to.unit, to.reason = (_bytes(getattr(entry, name), name) for name in ("name", "unit", "reason"))
        texts = {name: _bytes(getattr(self, name), name) for name in ("subject", "unit", "cost_unit")}
        return struct(library.cm_budget, count=len(entries),
                      entry=ctypes.cast(entries, ctypes.POINTER(library.cm_budget_entry)),
                      error=self.error, cost=self.cost, **texts)

    @classmethod
    def _read(cls, made):
        """Of what the library has filled."""
        entries = tuple(BudgetEntry(decoded(one.name), one.contribution, one.cost, decoded(one.unit), bool(one.is_required),
                                    bool(one.is_kept), decoded(one.reason)) for one in made.entry[:made.count])
        return cls(entries, *map(decoded, (made.subject, made.unit, made.cost_unit)), made.error, made.cost)

    def _chosen(self, choose, *limit):
        made = self._struct()
        choose(ctypes.byref(made), *limit)
        entries = (entry._replace(is_kept=bool(one.is_kept), reason=decoded(one.reason))
                   for entry, one in zip(self._entries, made.entry[:made.count], strict=True))
        return self._replace(entries=tuple(entries), error=made.error, cost=made.cost)

    def limit_error(self, limit: float) -> Budget:
        """What is needed for an error of at most that: what pays least for its cost is dropped first."""
        return self._chosen(library.cm_budget_limit_error, limit)

    def limit_cost(self, limit: float) -> Budget:
        """What a cost of at most that pays for: what is required, then what contributes most for its cost."""
        return self._chosen(library.cm_budget_limit_cost, limit)

    def sum(self) -> Budget:
        """Error and cost of what is kept as it is."""
        return self._chosen(library.cm_budget_sum)

    def to_json(self) -> str:
        """One object of JSON with all of it."""
        made = self._struct()
        return string_of(lambda text, size, length: library.cm_budget_json(ctypes.byref(made), text, size, length))
