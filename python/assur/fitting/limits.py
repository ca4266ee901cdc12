"""Conditions of a fit: metrics with limits, as the core takes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from assur._arrays import short
from assur.errors import InputError
from assur.fitting.condition import Condition as Shown
from assur.sweeps.terms import Condition, FullRotation, Metric

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur.kinematics.mechanism import Mechanism

# By how much a limit is narrowed, over its unit: positions of the travel may miss an extreme by it.
MARGIN = 5e-5


class Limit(NamedTuple):
    """A condition: the metric, the limit, whether it is a least one, what counts as a miss of 1."""

    condition: Condition
    is_least: bool
    unit: float

    @property
    def parts(self) -> tuple[Metric, str, float, float]:
        """It as the core takes it."""
        margin = MARGIN * self.unit
        limit = self.condition.limit
        if self.is_least:
            return self.condition.metric, "at least", limit + margin, self.unit
        return self.condition.metric, "at most", limit - margin, self.unit

    def shown(self, value: float) -> Shown:
        """Return it as a report shows it."""
        return Shown(repr(self.condition.metric), value, self.condition.limit, self.is_least)


def checked_limits(m: Mechanism, where: Any) -> tuple[list[Limit], bool]:
    """Return the conditions, and whether one of them asks for a full turn."""
    limits: list[Limit] = []
    must_turn = False
    listed: Iterable[Any] = [where] if isinstance(where, Condition) else where
    for condition in listed:
        if not isinstance(condition, Condition):
            message = (
                f"where has {short(condition)}: a condition on a metric is needed, metric > limit"
            )
            raise InputError(message)
        if isinstance(condition.metric, FullRotation):
            condition.metric.check(m)
            must_turn = True
            continue
        unit = abs(condition.limit) or 1.0
        limits.append(Limit(condition, condition.relation in (">", ">="), unit))
    return limits, must_turn
