"""Metrics of design spaces, beside stored motions and numba that does the whole job."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
import straight_line
from straight_line import Float

import assur
from assur import metric

if TYPE_CHECKING:
    from collections.abc import Callable

    from pytest_benchmark.fixture import BenchmarkFixture

Q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
ANGLE = np.radians(40.0)


def four_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "C": (3.5, 2.0), "D": (3, 0), "P": (3, 3)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def space(count: int) -> dict[str, Float]:
    """Random four-bars, of which most do not turn fully."""
    rng = np.random.default_rng(1)
    draw = rng.uniform
    return {
        "crank.length": draw(0.5, 2.0, count),
        "coupler.length": draw(1.0, 4.0, count),
        "rocker.length": draw(1.0, 4.0, count),
        "ground.D.x": draw(1.0, 4.0, count),
        "ground.D.y": np.zeros(count),
        "coupler.P.x": draw(-2.0, 4.0, count),
        "coupler.P.y": draw(-3.0, 3.0, count),
    }


def by_assur(dimensions: dict[str, Float]) -> Float:
    found = assur.sweep(
        four_bar(),
        dimensions,
        Q,
        metrics={"off": metric.deviation("P", "line")},
        where=[metric.least_transmission("C") > ANGLE],
    )
    return found["off"]


def by_numba(dimensions: dict[str, Float]) -> Float:
    names = ["crank.length", "coupler.length", "rocker.length", "ground.D.x"]
    lengths = np.stack([dimensions[name] for name in names])
    point = np.stack([dimensions["coupler.P.x"], dimensions["coupler.P.y"]])
    off = np.empty(lengths.shape[1])
    straight_line.search(lengths, point, np.cos(Q), np.sin(Q), ANGLE, off)
    return off


@pytest.mark.parametrize("by", [by_assur, by_numba])
def test_straightest_of_200_000(
    benchmark: BenchmarkFixture, by: Callable[[dict[str, Float]], Float]
) -> None:
    dimensions = space(200_000)
    winners = [np.argsort(search(dimensions))[:10] for search in (by_assur, by_numba)]
    assert winners[0].tolist() == winners[1].tolist()
    benchmark.pedantic(by, (dimensions,), rounds=9)


def stored(dimensions: dict[str, Float]) -> Float:
    """The same numbers from the positions."""
    batch = four_bar().with_dimensions(dimensions)
    motion = batch.solve(Q, 0, ["B", "C", "D", "rocker"], on_error="nan")
    angles = motion.transmission_angle("C").min(axis=-1)
    return angles + np.ptp(motion.link("rocker").value, axis=-1)


def only_stored(dimensions: dict[str, Float]) -> assur.Motion:
    batch = four_bar().with_dimensions(dimensions)
    return batch.solve(Q, 0, ["C", "rocker"], on_error="nan")


def measured(dimensions: dict[str, Float]) -> Float:
    asked = {"angle": metric.least_transmission("C"), "span": metric.span("rocker")}
    found = assur.sweep(four_bar(), dimensions, Q, metrics=asked)
    return found["angle"] + found["span"]


@pytest.mark.parametrize("by", [measured, only_stored, stored])
def test_transmission_and_span_of_a_million(
    benchmark: BenchmarkFixture, by: Callable[[dict[str, Float]], object]
) -> None:
    few = space(1000)
    np.testing.assert_allclose(measured(few), stored(few), rtol=1e-12)
    benchmark.pedantic(by, (space(1_000_000),), rounds=3)
