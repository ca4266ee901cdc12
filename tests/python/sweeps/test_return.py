"""Whether the path is closed after a turn is found of each design: some need two turns."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur import Status, metric
from models.mechanisms import higher_drawings
from net import design_spaces
from oracles.kinematics import textbook

Q = 0.1 + np.linspace(0.0, 2 * np.pi, 72, endpoint=False)


def kites() -> assur.Mechanism:
    """Galloway's linkage: after a turn of the crank C is on the other side; among others."""
    one = assur.FourBar(1.0, 2.5, 2.5, 1.0)
    return one.with_dimensions({"coupler.length": [2.5, 2.5, 2.5], "ground.D.x": [1.0, 3.0, 1.0]})


def off_line(m: assur.Mechanism, design: int, joint: str, closed: bool, count: int) -> float:
    path = m.solve(Q, order=0, on_error="nan").joint(joint).value[design]
    return textbook.off_line(path, count, closed, False)


def test_a_change_point() -> None:
    m = kites()
    one, next_turn = (m.solve(q, order=0).joint("C").value for q in (Q, Q + 2 * np.pi))
    returns = [np.allclose(one[k], next_turn[k], atol=1e-6) for k in range(3)]
    assert returns == [False, True, False]
    asked = {
        "off": metric.deviation("C", part=0.25),
        "ratio": metric.time_ratio("C.x"),
        "crank": metric.deviation("B", shape="circle", part=0.25),
        "across": metric.deviation("C", part=1.0, over=(6.0, 7.0)),
        "before": metric.deviation("C", part=1.0, over=(4.0, 5.0)),
    }
    found = assur.sweep(m, {}, Q, metrics=asked)
    for design, closed in enumerate(returns):
        # Of a closed path there is one step more.
        expected = off_line(m, design, "C", closed, 19 if closed else 18)
        assert found["off"][design] == pytest.approx(expected, rel=1e-8)
    # The path of B is closed in any case.
    assert (found["crank"] < 1e-15).all()
    assert np.isnan(found["ratio"]).tolist() == [True, False, True]
    assert np.isnan(found["across"]).tolist() == [True, False, True]
    assert not np.isnan(found["before"]).any()


def test_an_angle_that_goes_on_does_not_return() -> None:
    """Strokes are to and fro: a link that turns has none."""
    double_crank = assur.FourBar(3.0, 2.5, 3.0, 1.0)
    asked = {"link": metric.time_ratio("rocker"), "point": metric.time_ratio("C.x")}
    found = assur.sweep(double_crank, {}, Q, metrics=asked)
    assert np.isnan(found["link"])
    assert found["point"] >= 1.0


def test_higher_classes() -> None:
    """Most are where they were; some have a gap between the last position and the next turn."""
    every = design_spaces.space(higher_drawings.triad_two_guides(), np.random.default_rng(1), 1500)
    asked = {"off": metric.deviation("D", part=0.5), "ratio": metric.time_ratio("D.y")}
    batch = assur.sweep(every, {}, Q, metrics=asked).designs([*range(30), 498, 660, 999])
    here, after = (batch.solve(q, order=0, on_error="nan") for q in (Q, Q + 2 * np.pi))
    apart = np.abs(here.joint("D").value - after.joint("D").value).max(axis=(1, 2))
    found = assur.sweep(batch, {}, Q, metrics=asked)
    moves = np.flatnonzero((found.status < Status.UNREACHABLE) | (found.status == Status.NO_VALUE))
    returns = apart[moves] < 1e-6
    # Without a time ratio a design is not kept.
    assert found.kept.tolist() == moves[returns].tolist()
    assert np.count_nonzero(~returns) == 3
    assert np.count_nonzero(returns) > 3
    assert np.isnan(found["ratio"][moves]).tolist() == (~returns).tolist()
    for design, closed in zip(moves.tolist(), returns, strict=True):
        expected = off_line(batch, design, "D", closed, 37 if closed else 36)
        assert found["off"][design] == pytest.approx(expected, rel=1e-7, abs=1e-12)
