"""``find``: the value of a dimension with which a metric has a wanted value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.studio import document
from assur.studio.kinds.maps import axis, measured_coordinates
from assur.studio.kinds.words import metric_of
from assur.studio.request import Fields
from assur.studio.session import Answer
from assur.sweeps.sweep import sweep

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.studio.session import Session

# Positions of a turn: extremes are found among them.
ROWS = 721
# Values between low and high, then between the two about the target, this many times.
VALUES, FINER, TIMES = 61, 21, 4


def find(data: dict[str, Any], session: Session) -> Answer:
    """Return the value nearest to the present one, or null, and the range of the metric."""
    known = ("document", "x", "metric", "value", "rows", "low", "high")
    fields = Fields(data, known, ("document", "x", "metric", "value"))
    contents = document.read(fields["document"])
    mechanism = contents.mechanism
    name, along = axis(fields.node("x"), mechanism, VALUES)
    metric = metric_of(fields.node("metric"))
    target = fields.number("value")
    q = measured_coordinates(fields, mechanism, ROWS)
    present = float(mechanism.dimensions[name])

    def measured(values: Float) -> Float:
        session.deadline.check()
        measures = sweep(
            contents.machine or mechanism, {name: values}, q, metrics={"value": metric}
        )
        return np.asarray(measures["value"], float)

    values = measured(along)
    finite = values[np.isfinite(values)]
    header: dict[str, Any] = {
        "dimension": name,
        "value": None,
        "metric": None,
        "min": float(finite.min()) if finite.size else None,
        "max": float(finite.max()) if finite.size else None,
    }
    at = _crossing(along, values, target, present)
    if at is None:
        return Answer(header, {})
    for _ in range(TIMES):
        along = np.linspace(along[at], along[at + 1], FINER)
        values = measured(along)
        at = _crossing(along, values, target, present)
        if at is None:
            # Between the two there are designs that do not work.
            return Answer(header, {})
    nearest = at + int(abs(values[at + 1] - target) < abs(values[at] - target))
    return Answer({**header, "value": float(along[nearest]), "metric": float(values[nearest])}, {})


def _crossing(along: Float, values: Float, target: float, present: float) -> int | None:
    """Return after which place the wanted value lies between two, nearest to the present place."""
    # NaN is neither below nor above.
    below, above = values <= target, values >= target
    places = np.flatnonzero((below[:-1] & above[1:]) | (above[:-1] & below[1:]))
    if not len(places):
        return None
    middles = (along[places] + along[places + 1]) / 2.0
    return int(places[np.argmin(np.abs(middles - present))])
