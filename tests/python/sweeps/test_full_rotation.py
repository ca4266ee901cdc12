"""Whether a driver goes round is proved in a sweep, whatever its positions show."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur import metric

RNG = np.random.default_rng(52)
TURN = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
BOTH = {"samples": metric.reachable(), "proof": metric.full_rotation()}


def grashof(a: float, b: float, c: float, d: float) -> bool:
    """Whether the crank a of a four-bar turns: on both sides of the ground the triangles close."""
    return abs(d - a) > abs(b - c) and d + a < b + c


def test_random_four_bars_by_their_triangles() -> None:
    lengths = RNG.uniform(0.5, 4.0, (4, 2000))
    batch = assur.FourBar(*lengths)
    found = assur.sweep(batch, {}, TURN + np.radians(15.0), metrics=BOTH)
    known = np.array([grashof(*each) for each in lengths.T.tolist()])
    can_be = ~np.isnan(found["proof"])
    np.testing.assert_array_equal(found["proof"][can_be] == 1.0, known[can_be])
    assert not known[~can_be].any()
    # Some of them stop between two positions.
    assert ((found["samples"] == 1.0) & (found["proof"] == 0.0)).any()
    assert not ((found["samples"] == 0.0) & (found["proof"] == 1.0)).any()


def test_it_is_what_limits_say_of_any_class() -> None:
    loom = assur.examples.loom().with_dimensions({"l48.length": np.linspace(1.0, 1.4, 9)})
    found = assur.sweep(loom, {}, TURN, metrics=BOTH)
    np.testing.assert_array_equal(found["proof"] == 1.0, loom.limits().full_rotation)


def test_a_condition_keeps_those_that_go_round() -> None:
    four_bar, grounds = assur.FourBar(1.0, 2.0, 2.0, 3.0), {"ground.D.x": [2.9, 3.003, -1.0, 2.95]}
    q = TURN + np.radians(15.0)
    asked = {"span": metric.span("rocker"), **BOTH}
    found = assur.sweep(four_bar, grounds, q, metrics=asked, where=[metric.full_rotation() > 0.5])
    assert found.kept.tolist() == [0, 2, 3]
    assert np.isnan(found["span"][1])
    again = assur.sweep(four_bar, grounds, q, metrics={"both": metric.full_rotation() * 2.0 + 1.0})
    assert again["both"].tolist() == [3.0, 1.0, 3.0, 3.0]


def test_bad_dimensions_and_several_drivers() -> None:
    four_bar, rockers = assur.FourBar(1.0, 2.0, 2.0, 2.9), {"rocker.length": [2.0, np.nan, -1.0]}
    found = assur.sweep(four_bar, rockers, TURN, metrics=BOTH)
    np.testing.assert_array_equal(found["proof"], [1.0, np.nan, np.nan])
    five_bar = assur.examples.five_bar()
    q0 = np.asarray(five_bar.q0)[np.newaxis]
    with pytest.raises(assur.InputError, match=r"full_rotation\(\): it is for one driver"):
        assur.sweep(five_bar, {}, q0, metrics=BOTH)
