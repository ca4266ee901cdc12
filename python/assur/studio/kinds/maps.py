"""``map``: a metric over two dimensions, computed by the sweep engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.kinematics.table import driven_angles
from assur.pictures.scene.course import TURN
from assur.studio import document
from assur.studio.kinds.words import metric_of
from assur.studio.limits import MOST_CELLS
from assur.studio.request import Fields
from assur.studio.session import Answer
from assur.sweeps.reasons import reasons
from assur.sweeps.sweep import sweep

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.files.node import Node
    from assur.kinematics.mechanism import Mechanism
    from assur.studio.session import Session

ROWS, CELLS = 73, 41
AXIS = ("dimension", "low", "high")


def map_of(data: dict[str, Any], session: Session) -> Answer:
    """Return the metric at each cell, row by row from low y; where it is missing, why."""
    known = ("document", "x", "y", "metric", "n", "rows", "low", "high")
    fields = Fields(data, known, ("document", "x", "y", "metric"))
    contents = document.read(fields["document"])
    mechanism = contents.mechanism
    n = fields.whole("n", CELLS, 2, MOST_CELLS)
    (x, along), (y, up) = (axis(fields.node(key), mechanism, n) for key in ("x", "y"))
    if x == y:
        raise fields.error("y", f"is {y!r}, as x: two dimensions are needed")
    metric = metric_of(fields.node("metric"))
    q = measured_coordinates(fields, mechanism, ROWS)
    across, upward = np.meshgrid(along, up)

    def report(done: int, every: int) -> None:
        del done, every
        session.deadline.check()

    measures = sweep(
        contents.machine or mechanism,
        {x: across.ravel(), y: upward.ravel()},
        q,
        metrics={"value": metric},
        progress=report,
    )
    values = measures["value"]
    words, reason = [], np.zeros(values.size, np.uint8)
    for text, which in reasons(measures, values):
        words.append(text)
        reason[which] = len(words)
    dimensions = mechanism.dimensions
    return Answer(
        {
            "x": {"dimension": x, "at": float(dimensions[x])},
            "y": {"dimension": y, "at": float(dimensions[y])},
            "metric": str(metric),
            "reasons": words,
        },
        {
            "x": along,
            "y": up,
            "value": values.reshape(n, n),
            "reason": reason.reshape(n, n),
        },
    )


def axis(node: Node, mechanism: Mechanism, n: int) -> tuple[str, Float]:
    """Return a dimension and n values of it from low to high."""
    entries = node.keys(AXIS, required=AXIS)
    name = entries["dimension"].word(mechanism.dimensions)
    low, high = entries["low"].number(), entries["high"].number()
    if not low < high:
        message = f"is {high:g}: it must be above low, {low:g}"
        raise entries["high"].error(message)
    return name, np.linspace(low, high, n)


def measured_coordinates(fields: Fields, mechanism: Mechanism, usual: int) -> Float:
    """Return the positions that are measured: a turn, or from low to high."""
    rows = fields.rows(usual)
    if mechanism.driver_count > 1:
        message = "a metric is of the turn of one driver; this mechanism has several"
        raise InputError(message)
    if "low" in fields or "high" in fields:
        return np.linspace(fields.number("low"), fields.number("high"), rows)
    if not driven_angles(mechanism)[0]:
        raise fields.error("low", "is missing: a driven slide is measured from low to high, m")
    return np.linspace(0.0, TURN, rows - 1, endpoint=False)
