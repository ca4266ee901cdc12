"""One number a design, of random four-bars: a search, and two metrics of all."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import metric
from subject import OURS, Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from subject import Float

Q = turn(72)
ANGLE = np.radians(40.0)
BEST = 10


def case(quick: bool) -> Case:
    search, angles = (2000, 500) if quick else (200_000, 1_000_000)
    subjects = {
        "straightest half turn, transmission above 40°": partial(straightest, search),
        "least transmission angle and span": partial(transmission, angles),
    }
    return Case("metrics", "design", subjects)


def four_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "C": (3.5, 2.0), "D": (3, 0), "P": (3, 3)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def space(count: int) -> dict[str, Float]:
    """Random four-bars, most of which do not turn fully."""
    draw = np.random.default_rng(1).uniform
    return {
        "crank.length": draw(0.5, 2.0, count),
        "coupler.length": draw(1.0, 4.0, count),
        "rocker.length": draw(1.0, 4.0, count),
        "ground.D.x": draw(1.0, 4.0, count),
        "ground.D.y": np.zeros(count),
        "coupler.P.x": draw(-2.0, 4.0, count),
        "coupler.P.y": draw(-3.0, 3.0, count),
    }


def rows(dimensions: dict[str, Float], *names: str) -> Float:
    return np.stack([dimensions[name] for name in names])


LENGTHS = ("crank.length", "coupler.length", "rocker.length", "ground.D.x")


def straightest(count: int) -> Subject:
    dimensions, mechanism = space(count), four_bar()

    def search() -> Float:
        measures = assur.sweep(
            mechanism,
            dimensions,
            Q,
            metrics={"off": metric.deviation("P", "line")},
            where=[metric.min_transmission_angle("C") > ANGLE],
        )
        return measures["off"]

    def winners(off: Float) -> list[Float]:
        best = np.argsort(off)[:BEST]
        return [best.astype(float), off[best]]

    contenders = {f"{OURS}, metrics": Contender(search, winners)}
    if installed("numba"):
        from rivals import straight_line

        lengths = rows(dimensions, *LENGTHS)
        point, cos, sin = rows(dimensions, "coupler.P.x", "coupler.P.y"), np.cos(Q), np.sin(Q)

        def by_numba() -> Float:
            off = np.empty(count)
            straight_line.search(lengths, point, cos, sin, ANGLE, off)
            return off

        contenders["numba, the whole job"] = Contender(by_numba, winners)
    return Subject(count, len(Q), contenders, count)


def transmission(count: int) -> Subject:
    dimensions, mechanism = space(count), four_bar()
    asked = {"angle": metric.min_transmission_angle("C"), "span": metric.span("rocker")}

    def measured() -> assur.Measures:
        return assur.sweep(mechanism, dimensions, Q, metrics=asked)

    def both(measures: Any) -> list[Float]:
        return [measures["angle"], measures["span"]]

    few = min(count, 20_000)
    part = {name: values[:few] for name, values in dimensions.items()}

    def stored() -> dict[str, Float]:
        motion = assur.sweep(mechanism, part, Q, outputs=["B", "C", "D", "rocker"], order=0)
        angles = motion.transmission_angle("C").min(axis=-1)
        return {"angle": angles, "span": np.ptp(motion.link("rocker").value, axis=-1)}

    contenders = {
        f"{OURS}, metrics": Contender(measured, both),
        f"{OURS}, stored motions and NumPy": Contender(stored, both, few),
    }
    if installed("numba"):
        from rivals import specialist

        lengths, cos, sin = rows(dimensions, *LENGTHS), np.cos(Q), np.sin(Q)

        def by_numba() -> dict[str, Float]:
            out = np.empty((2, count))
            specialist.transmission_and_span(lengths, cos, sin, out)
            return {"angle": out[0], "span": out[1]}

        contenders["numba, the whole job"] = Contender(by_numba, both)
    return Subject(count, len(Q), contenders, count)
