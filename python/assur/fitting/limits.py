"""Conditions of a fit: metrics with limits, as the core takes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import short
from assur.errors import InputError
from assur.fitting.condition import Condition as Shown
from assur.sweeps.measuring import located
from assur.sweeps.terms import Condition, FullRotation, Leaf, Metric

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

# The least transmission angle where none is asked for, rad, and what counts as a miss of 1.
FOLDED, GUARD_UNIT = 0.02, 0.1
# Positions at which names are checked.
TURN = np.linspace(0.0, 2.0 * np.pi, 256, endpoint=False)


class Limit(NamedTuple):
    """A condition, whether its limit is a least one, what counts as a miss of 1."""

    condition: Condition
    # The metric as the core takes it.
    metric: Metric
    is_least: bool
    unit: float

    @property
    def parts(self) -> tuple[Metric, str, float, float]:
        """It as the core takes it."""
        word = "at least" if self.is_least else "at most"
        return self.metric, word, self.condition.limit, self.unit

    def shown(self, value: float) -> Shown:
        """Return it as a report shows it."""
        return Shown(repr(self.condition.metric), value, self.condition.limit, self.is_least)


def checked_limits(m: Mechanism, where: Any) -> tuple[list[Limit], bool]:
    """Return the conditions, and whether one of them asks for a full turn."""
    limits: list[Limit] = []
    must_turn = False
    try:
        listed = [where] if isinstance(where, Condition) else list(where)
    except TypeError as error:
        message = f"where is {short(where)}: a list of conditions is needed"
        raise InputError(message) from error
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
        metric = taken(m, condition.metric)
        limits.append(Limit(condition, metric, condition.relation in (">", ">="), unit))
    return limits, must_turn


def guards(m: Mechanism, limits: list[Limit]) -> list[Limit]:
    """Return limits that keep every dyad without one of its own from the place where it folds.

    Descents slide along them; at the fold itself they would end.
    """
    leaves = [leaf for limit in limits for leaf in limit.condition.metric.leaves()]
    known = {
        leaf.of
        for leaf in leaves
        if isinstance(leaf, Leaf) and leaf.kind == "min_transmission_angle"
    }
    conditions = [
        Leaf("min_transmission_angle", joint, 0, (None,), None) > FOLDED
        for joint in m.assembly
        if joint not in known
    ]
    return [
        Limit(condition, taken(m, condition.metric), True, GUARD_UNIT) for condition in conditions
    ]


def taken(m: Mechanism, metric: Metric) -> Metric:
    """Return a metric as the core takes it; refuse one that has no meaning for the mechanism."""
    for leaf in metric.leaves():
        if not isinstance(leaf, Leaf):
            message = f"{leaf!r} has no gradient: fit cannot aim at it; rank what it found by it"
            raise InputError(message)
        if leaf.kind == "function_error":
            message = f"{leaf!r}: pass the function as a target, {{'rocker': (theta, values)}}"
            raise InputError(message)
        refusal = m.core.refusal_of_metric(TURN, located(leaf, m, TURN))
        if refusal is not None:
            message = f"{leaf!r}: {refusal}"
            raise InputError(message)
    return located(metric, m, TURN)
