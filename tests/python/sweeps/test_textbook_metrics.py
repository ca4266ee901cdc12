"""Every metric against NumPy over the formulas of textbooks, which share no code with it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import metric
from models.mechanisms.textbook_four_bars import mechanism_of
from oracles.kinematics import textbook

if TYPE_CHECKING:
    from collections.abc import Callable

Float = npt.NDArray[np.float64]

Q = 0.1 + np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
POINT = (1.3, 0.8)
# Of kept designs the sine of the transmission angle is at least this: the jerk divides by its fifth
# power.
LEAST = 0.25


def four_bars(count: int = 200) -> tuple[assur.Mechanism, textbook.FourBars]:
    rng = np.random.default_rng(8)
    crank = rng.uniform(0.3, 1.5, count)
    coupler, rocker, ground = rng.uniform(1.0, 4.0, (3, count))
    four_bars = textbook.FourBars(crank, coupler, rocker, ground, POINT)
    return mechanism_of(four_bars), four_bars


REDUCTIONS: dict[str, tuple[Any, Callable[[Float], Float]]] = {
    "span": (metric.span, lambda v: np.ptp(v, axis=1)),
    "least": (metric.min, lambda v: v.min(axis=1)),
    "greatest": (metric.max, lambda v: v.max(axis=1)),
    "mean": (metric.mean, lambda v: v.mean(axis=1)),
    "rms": (metric.rms, lambda v: np.sqrt((v * v).mean(axis=1))),
}


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_coordinates_and_their_derivatives(order: int) -> None:
    batch, oracle = four_bars()
    moves = oracle.moves(Q)
    good = np.zeros_like(moves)
    with np.errstate(invalid="ignore"):
        good[moves] = np.sin(oracle.transmission(Q)[moves]).min(axis=1) > LEAST
        motion = oracle.motion(Q)
    assert good.sum() > 20
    asked = {
        f"{word} {of}": make(of, order=order)
        for word, (make, _) in REDUCTIONS.items()
        for of in motion
    }
    places = {f"at {of}": metric.argmax(of, order=order) for of in motion}
    found = assur.sweep(batch, {}, Q, metrics={**asked, **places})
    assert found.kept.tolist() == np.flatnonzero(moves).tolist()
    for of, series in motion.items():
        values = series[order][good]
        if of in ("rocker", "coupler") and order == 0:
            # Whole turns are counted from the drawing.
            turns = np.round((found[f"mean {of}"][good] - values.mean(axis=1)) / (2 * np.pi))
            values = values + 2 * np.pi * turns[:, None]
        size = np.abs(values).max()
        for word, (_, reduce) in REDUCTIONS.items():
            np.testing.assert_allclose(
                found[f"{word} {of}"][good], reduce(values), rtol=1e-11, atol=1e-11 * size
            )
        at = np.searchsorted(Q, found[f"at {of}"][good])
        assert (Q[at] == found[f"at {of}"][good]).all()
        highest = np.take_along_axis(values, at[:, None], axis=1)[:, 0]
        np.testing.assert_allclose(highest, values.max(axis=1), rtol=1e-11, atol=1e-11 * size)


def test_transmission_and_rotation() -> None:
    batch, oracle = four_bars()
    moves = oracle.moves(Q)
    asked = {"angle": metric.min_transmission_angle("C"), "turns": metric.reachable()}
    found = assur.sweep(batch, {}, Q, metrics=asked)
    assert (found["turns"] == moves).all()
    with np.errstate(invalid="ignore"):
        expected = oracle.transmission(Q).min(axis=1)
    np.testing.assert_allclose(found["angle"][moves], expected[moves], rtol=0, atol=1e-7)
    large = moves & (expected > 0.1)
    np.testing.assert_allclose(found["angle"][large], expected[large], rtol=1e-12)
    assert np.isnan(found["angle"][~moves]).all()


def test_strokes_of_offset_slider_cranks() -> None:
    rng = np.random.default_rng(3)
    crank, rod, offset = rng.uniform(0.5, 1, 99), rng.uniform(2, 4, 99), rng.uniform(-0.9, 0.9, 99)
    dimensions = {"crank.length": crank, "rod.length": rod, "bore.offset": offset}
    asked = {"stroke": metric.span("bore"), "ratio": metric.time_ratio("bore")}
    found = assur.sweep(assur.SliderCrank(1.0, 3.0), dimensions, Q, metrics=asked)
    assert len(found.kept) == 99
    place = textbook.piston(crank, rod, offset, Q)
    np.testing.assert_allclose(found["stroke"], np.ptp(place, axis=1), rtol=1e-13)
    ahead = np.abs(place.argmax(axis=1) - place.argmin(axis=1)) / len(Q)
    ratio = np.maximum(ahead, 1 - ahead) / np.minimum(ahead, 1 - ahead)
    np.testing.assert_allclose(found["ratio"], ratio, rtol=1e-12)
    # With many positions it is that of the dead centres, where crank and rod are in line.
    fine = np.linspace(0, 2 * np.pi, 20_000, endpoint=False)
    found = assur.sweep(assur.SliderCrank(1.0, 3.0), dimensions, fine, metrics=asked)
    between = np.arcsin(offset / (rod + crank)) - np.arcsin(offset / (rod - crank))
    slow = np.pi + np.abs(between)
    np.testing.assert_allclose(found["ratio"], slow / (2 * np.pi - slow), rtol=1e-3)


@pytest.mark.parametrize("count", [36, 360])
def test_places_and_ratios_are_off_by_what_the_manual_says(count: int) -> None:
    offset = np.random.default_rng(5).uniform(-1.2, 1.2, 40)
    m = assur.SliderCrank(1.0, 3.0)
    asked = {"ratio": metric.time_ratio("bore"), "place": metric.argmax("bore")}
    even = np.linspace(0.0, 2 * np.pi, count, endpoint=False)
    found = assur.sweep(m, {"bore.offset": offset}, even, metrics=asked)
    exact = [m.with_dimensions({"bore.offset": one}).extremes("bore") for one in offset]
    ratio = np.array([one.time_ratio for one in exact], dtype=float)
    error = np.abs(found["ratio"] - ratio) * count / (1.0 + ratio) ** 2
    # Not better either: nothing is interpolated.
    assert 0.4 < error.max() < 1.0
    away = found["place"] - [one.max.q for one in exact]
    away = np.abs((away + np.pi) % (2 * np.pi) - np.pi) * count / (2 * np.pi)
    assert 0.4 < away.max() < 0.51


@pytest.mark.parametrize("shape", ["line", "circle"])
@pytest.mark.parametrize("part", [0.1, 0.5, 1.0])
def test_deviation_of_every_stretch(shape: Any, part: float) -> None:
    batch, oracle = four_bars(80)
    count = {0.1: 8, 0.5: 37, 1.0: 72}[part]
    # Of 72 positions over a part of the turn there is one step less.
    open_count = {0.1: 8, 0.5: 36, 1.0: 72}[part]
    ahead = np.linspace(0.3, 5.0, 72)
    asked = {
        str(relative): metric.deviation("P", shape=shape, part=part, relative=relative)
        for relative in (False, True)
    }
    oracles = {"line": textbook.off_line, "circle": textbook.off_circle}
    for q, closed, size in ((Q, True, count), (ahead, False, open_count)):
        with np.errstate(invalid="ignore"):
            motion = oracle.motion(q)
        paths = np.stack([motion["P.x"][0], motion["P.y"][0]], axis=-1)
        found = assur.sweep(batch, {}, q, metrics=asked)
        assert len(found.kept) > 10
        for design in found.kept:
            for relative in (False, True):
                expected = oracles[shape](paths[design], size, closed, relative)
                value = found[str(relative)][design]
                assert value == pytest.approx(expected, rel=1e-7, abs=1e-12)
