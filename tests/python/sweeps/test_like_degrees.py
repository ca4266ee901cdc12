"""Angles of a sweep that look like degrees: coordinates, parts of the turn, limits."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import metric

if TYPE_CHECKING:
    from assur.metric import Condition

Q = np.linspace(0.0, 2 * np.pi, 36, endpoint=False)
SPACE = {"rocker.length": [2.4, 2.5]}
M = assur.FourBar(1.0, 3.0, 2.5, 3.2)
SWING = {"swing": metric.span("rocker")}
GAMMA = metric.min_transmission_angle("C")


@pytest.mark.parametrize("words", [{}, {"metrics": SWING}, {"on_error": "drop"}])
def test_coordinates(words: dict[str, Any]) -> None:
    with pytest.warns(assur.AssurWarning, match="q = 355 is 355 rad") as caught:
        assur.sweep(M, SPACE, np.arange(0, 360, 5), **words)
    # Once, and where the user wrote it.
    assert [one.filename for one in caught] == [__file__]


def test_a_part_of_the_turn() -> None:
    with pytest.warns(assur.AssurWarning, match=r"span\('rocker', over=\(0.0, 90.0\)\)") as caught:
        assur.sweep(M, SPACE, Q, metrics={"a": metric.span("rocker", over=(0, 90))})
    assert "np.radians(90)" in str(caught[0].message)
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    "condition",
    [
        GAMMA > 40,
        GAMMA - metric.mean("rocker") < 40,
        metric.max("rocker") < 120,
        metric.argmin("C.x") < 90,
    ],
)
def test_limits(condition: Condition) -> None:
    limit = int(condition.limit)
    with pytest.warns(assur.AssurWarning, match=rf"{limit} is in rad; {limit}° is np.radians"):
        assur.sweep(M, SPACE, Q, metrics=SWING, where=[condition])


def test_others_are_meant() -> None:
    turn = metric.function(lambda motion: np.zeros(motion.shape[0]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        conditions = [
            GAMMA > 0.698,
            GAMMA * (180 / np.pi) > 40,
            metric.span("C.x") < 40,
            metric.max("rocker", order=1) < 40,
            metric.span("crank") < 6.9,
            turn < 40,
        ]
        asked = {"a": metric.span("rocker", over=(6.0, 12.0))}
        assert len(assur.sweep(M, SPACE, Q, metrics=asked, where=conditions).kept) == 2
        driven = assur.SliderCrank(50.0, 200.0).with_driver("bore", assembly={"A": 1})
        part = {"a": metric.span("crank", over=(200, 220))}
        assur.sweep(driven, {"crank.length": [50.0, 51.0]}, np.arange(200, 221), metrics=part)
