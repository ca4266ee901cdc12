"""Goals of a Pareto front: metrics to be made small or large."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import counted, short
from assur._validate import checked_name
from assur.errors import InputError
from assur.sweeps.terms import Metric

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float


class Objective(NamedTuple):
    """A metric that is to be small, or large."""

    name: str
    metric: Metric
    is_maximized: bool

    def cost(self, values: Float) -> Float:
        """Return what is to be small."""
        return -values if self.is_maximized else values


def checked_objectives(minimize: Any, maximize: Any) -> list[Objective]:
    """Return the goals, those to be made small first; errors name the goal and what to do."""
    objectives: list[Objective] = []
    for what, goals in (("minimize", minimize), ("maximize", maximize)):
        if goals is None:
            continue
        if not isinstance(goals, Mapping):
            message = f"{what} is {short(goals)}: a mapping is needed, {{'name': metric}}"
            raise InputError(message)
        for name, metric in goals.items():
            known = checked_name(name, what)
            if not isinstance(metric, Metric):
                message = (
                    f"{what}[{known!r}] is {short(metric)}: one of assur.metric is needed; "
                    "limits of metrics go into where="
                )
                raise InputError(message)
            if any(known == other.name for other in objectives):
                message = f"{known!r} is in minimize and in maximize: give the goals two names"
                raise InputError(message)
            objectives.append(Objective(known, metric, what == "maximize"))
    if len(objectives) < 2:
        message = (
            f"minimize and maximize have {counted(len(objectives), 'goal')}: a front is of two or "
            "more; for one goal there are assur.fit with target.Near, and sweep(...).nsmallest"
        )
        raise InputError(message)
    return objectives


def undominated(costs: Float) -> npt.NDArray[np.intp]:
    """Return the rows of which none is as good in all columns and better in one, by the first.

    Of equal rows the first is taken. `costs` (n, M) are finite.
    """
    # In this order what dominates a row comes before it; if that is dominated, so is the row by
    # one of the front. Of the first column nothing is left to compare.
    order = np.lexsort(costs.T[::-1])
    rest = costs[order, 1:]
    if rest.shape[1] == 1:
        least = np.minimum.accumulate(rest[:, 0])
        is_best = np.ones(len(order), dtype=np.bool_)
        is_best[1:] = rest[1:, 0] < least[:-1]
        return order[is_best]
    front = np.empty_like(rest.T, order="C")
    chosen: list[int] = []
    for row, further in enumerate(rest):
        known = front[:, : len(chosen)]
        if not (known <= further[:, np.newaxis]).all(axis=0).any():
            front[:, len(chosen)] = further
            chosen.append(row)
    return order[chosen]
