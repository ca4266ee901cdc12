"""Computations of the papers: slider-crank and its series, class IV, crank-rocker with jamming."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import crank_rocker, slider_crank
from assur.papers.crank_rocker.theory import TABLE, TABLE_GROUNDS
from net import bits

if TYPE_CHECKING:
    from collections.abc import Iterator

PHI = np.arange(-12, 37) * 0.2617993877991494
RATIOS = np.array([1.1, 2.0, 3.0, 3.7, 4.0, 7.5])
CLASS_IV = {
    "1": (0, 0),
    "2": (0.35, 0),
    "3": (1.24, 0.99),
    "4": (0.75, 1.91),
    "5": (3.02, -0.73),
    "6": (2.45, 1.02),
    "7": (3.2, 2.24),
    "8": (1.85, 2.35),
    "9": (1.62, -1.11),
    "10": (4.28, 1.52),
}


def place_first(extreme: Any) -> list[Any]:
    """An extreme as it was pinned."""
    return [extreme.q, extreme.value]


def analogues(a: assur.Analogues) -> list[Any]:
    return [a.value, a.d1, a.d2]


def slider_cranks() -> Iterator[tuple[str, Any]]:
    k = RATIOS[:, np.newaxis]
    yield "stroke", analogues(slider_crank.stroke(PHI, 1.0, k))
    yield "coordinate", analogues(slider_crank.coordinate(PHI, 1.0, k))
    yield "rod angle", analogues(slider_crank.rod_angle(PHI, 1.0, k))
    yield "rod point", analogues(slider_crank.rod_point(PHI, 0.3, 1.2, 0.4, 0.1))
    yield "fourier", slider_crank.fourier(RATIOS)
    for method in ("exact", "series", "perpendicular"):
        yield (
            f"greatest speed, {method}",
            place_first(slider_crank.greatest_speed(RATIOS, method=method)),
        )
    yield "greatest acceleration", place_first(slider_crank.greatest_acceleration(RATIOS))
    for n in (1, 2, 3, 5):
        yield f"deviation {n}", list(slider_crank.deviation(1.0 / RATIOS, n))
    yield "contour", slider_crank.contour(0.7, 1.0, 3.0)


def crank_rockers() -> Iterator[tuple[str, Any]]:
    ground = np.array(TABLE_GROUNDS)[:, np.newaxis]
    own = crank_rocker.solve(PHI, *TABLE, ground)
    yield "positions", list(own.__dict__.values())
    yield "margins", list(crank_rocker.crank_turns(1, [2, 4.5], 1.5, 3))
    yield "kinds", np.asarray(crank_rocker.grashof([1, 2, 3, 1], [4.5, 2, 1, 1], 1.5, 4.8)).tolist()
    yield "ground", np.asarray(crank_rocker.ground_range([3.0, 4.5], [1.5, 1.2], gamma_min=0.3))
    yield "least angle", crank_rocker.least_transmission_angle(0.1, 0.05, 0.12, 0.06, [0.5, 1.5])
    yield "extremes", list(crank_rocker.transmission_extremes(1, 4.5, 1.5, ground[:, 0]))
    for l4 in (4.0, 4.8, 4.995, 5.2):
        yield f"blocked {l4}", crank_rocker.blocked(1, 4.5, 1.5, l4, 0.2)
    yield "table", list(crank_rocker.table1())
    for l4, turns in ((4.995, 2.0), (5.1, 1.0)):
        jammed = crank_rocker.run(1, 4.5, 1.5, l4, gamma_min=0.2, turns=turns)
        found: list[Any] = [v for v in jammed.__dict__.values() if isinstance(v, np.ndarray)]
        for event in jammed.events:
            found += [event.kind, event.side, event.t, event.phi1, event.l4]
        yield f"jams {l4}", found


def class_iv() -> Iterator[tuple[str, Any]]:
    m = assur.ClassIV(CLASS_IV)
    motion = m.solve(PHI, order=3)
    yield "motion", bits.bits(motion)
    yield "equations", m.paper_equations(motion)
    lengths = {"1-2": 0.35, "2-3": 1.33, "2-4": 1.95, "3-5": 2.48, "3-6": 1.21, "4-8": 1.19}
    lengths |= {"6-8": 1.46, "7-8": 1.35, "5-9": 1.45, "7-10": 1.3}
    made = assur.ClassIV(
        lengths=lengths,
        angles={"4-2-3": -0.46, "6-3-5": -0.79, "7-8-6": -1.07},
        pivots={"1": (0, 0), "9": (1.62, -1.11), "10": (4.28, 1.52)},
        start={"1-2": 0.0, "2-4": 1.36, "3-6": 0.02, "4-8": 0.38, "7-8": -0.08},
    )
    yield "from the paper's lengths", bits.bits(made.solve(PHI, order=2, on_error="nan"))


def results() -> Iterator[tuple[str, Any]]:
    for source in (slider_cranks, class_iv, crank_rockers):
        for name, value in source():
            yield f"{source.__name__}, {name}", value
