"""Why designs of a sweep have no metric, in a few words for its pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.description.words import Status, is_reached
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.sweeps._measured import Measured
    from assur.sweeps.terms import Condition

Flags = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]

WORDS = {
    Status.SINGULAR: "singular",
    Status.LOST: "stops",
    Status.NOT_CONVERGED: "not converged",
    Status.BAD_DIMENSION: "bad dimension",
    Status.BAD_INPUT: "bad coordinate",
    Status.NO_VALUE: "no value",
}


def reasons(measures: Measured, values: Float) -> list[tuple[str, Flags]]:
    """Return every reason that occurs, with the designs that have it, in C order.

    Every design without a value has one.
    """
    status = measures.status.reshape(-1)
    left = np.isnan(values.reshape(-1))
    missed = np.zeros_like(left)
    missed[measures.missed] = True
    answer = [(_conditions(measures._measuring.conditions), left & missed)]
    left = left & ~missed
    unreachable = left & (status == Status.UNREACHABLE)
    answer += _unreachable(measures, unreachable)
    left = left & ~unreachable
    answer += [(_words(measures, code), left & (status == code)) for code in WORDS]
    for code in (Status.UNREACHABLE, *WORDS):
        left = left & (status != code)
    answer.append(("no value", left))
    return [(text, which) for text, which in answer if which.any()]


def _conditions(conditions: Sequence[Condition]) -> str:
    """Return what a design misses: at least one of several conditions."""
    relations = {"<": "≥", "<=": ">", ">": "≤", ">=": "<"}
    wrong = [f"{c.metric!r} {relations[c.relation]} {c.limit:.6g}" for c in conditions]
    return " or ".join(wrong).replace("'", "")


def _words(measures: Measured, code: Status) -> str:
    text = WORDS[code]
    if code == Status.NO_VALUE and (measures.status == code).any():
        first = int(np.flatnonzero(measures.status.reshape(-1) == code)[0])
        undefined = measures._measuring.undefined(measures.designs(first))
        return f"{undefined.subject or undefined.metric} has no value".replace("'", "")
    return f"{_driver(measures)} stops" if code == Status.LOST else text


def explained(measures: Measured, index: npt.NDArray[np.intp]) -> str | None:
    """See `Measures.explain`."""
    if index.ndim:
        message = "explain() is of one design: an integer, or a tuple of integers, is needed"
        raise InputError(message)
    flat, measuring = int(index), measures._measuring
    if flat in measures.kept:
        return None
    if flat in measures.missed:
        return f"it misses a condition: {_conditions(measuring.conditions)}"
    status = int(measures.status.reshape(-1)[flat])
    design = measures.designs(flat)
    if status == Status.NO_VALUE:
        undefined = measuring.undefined(design)
        return f"{undefined.metric}: {undefined.reason}"
    motion = design.solve(measuring.q, order=0, outputs=[], on_error="nan")
    failed = np.flatnonzero(~is_reached(motion.status))
    if not failed.size:
        return Status(status).name
    same = np.flatnonzero(motion.status == status)
    return motion.explain(int(same[0] if same.size else failed[0]))


def _driver(measures: Measured) -> str:
    driver = measures._designs.mechanism.driver
    return driver if isinstance(driver, str) else "the driver"


def _unreachable(measures: Measured, which: Flags) -> list[tuple[str, Flags]]:
    """Separate designs that cannot be assembled at all from those whose driver stops on its way."""
    mechanism = measures._designs.mechanism
    indices = np.flatnonzero(which)
    if not indices.size:
        return []
    if mechanism.driver_count > 1 or mechanism.core.cls > 2:
        # Limits of a higher class take too long.
        return [("out of reach", which)]
    limits = measures._designs.some(indices).limits()
    nowhere = np.isnan(limits.intervals).all(axis=(-2, -1))
    never, stops = np.zeros_like(which), np.zeros_like(which)
    never[indices[nowhere]] = True
    stops[indices[~nowhere]] = True
    return [("cannot be assembled", never), (f"{_driver(measures)} stops", stops)]
