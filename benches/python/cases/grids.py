"""Metrics over a grid of four-bars, up to ten million of them: time in proportion, memory flat."""

from __future__ import annotations

import sys
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import assur
from assur import metric
from subject import OURS, Case, Contender, Subject, turn

if TYPE_CHECKING:
    from subject import Float

Q = turn(72)
# Values a dimension, of three: lengths of coupler and rocker, and the ground's.
AXES = (22, 46, 100, 216)
METRICS = {"angle": metric.min_transmission_angle("C"), "span": metric.span("rocker")}


def case(quick: bool) -> Case:
    axes = (5, 10) if quick else AXES
    subjects = {n**3: partial(subject, n) for n in axes}
    return Case("grids", "design", subjects, axis="designs", rounds=3)


def subject(values: int) -> Subject:
    grid = assur.Grid(
        {
            "coupler.length": np.linspace(1.0, 4.0, values),
            "rocker.length": np.linspace(1.0, 4.0, values),
            "ground.D.x": np.linspace(1.0, 4.0, values),
        }
    )
    mechanism = assur.FourBar(1.0, 3.0, 2.5, 3.2)

    def measured() -> assur.Measures:
        return assur.sweep(mechanism, grid, Q, metrics=METRICS)

    def answer(measures: assur.Measures) -> list[Float]:
        return [measures["angle"], measures["span"]]

    before = greatest_memory()
    measures = measured()
    more = greatest_memory() - before
    kept = sum(a.nbytes for a in (*answer(measures), measures.status, measures.kept))
    turns = len(measures.kept) / values**3
    note = f"{turns:.0%} turn fully; memory grows by {more / 1e6:.0f} MB, "
    note += f"of which {kept / 1e6:.0f} are the result"
    contenders = {f"{OURS}, metrics": Contender(measured, answer)}
    return Subject(values**3, len(Q), contenders, values**3, note=note)


def greatest_memory() -> int:
    """The greatest that this process has had, bytes; 0 where the system does not say."""
    if sys.platform != "linux":
        return 0
    import resource

    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
