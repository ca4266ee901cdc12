"""Coordinates in degrees, and those in rad that look like them."""

from __future__ import annotations

import warnings
from functools import partial
from typing import Any

import numpy as np
import pytest

import assur
from models.errors.refusals import refused


def test_degrees_are_a_factor() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    deg = np.array([0.0, 30.0, 90.0, -400.0])
    motion = m.solve(deg=deg)
    np.testing.assert_array_equal(motion.q, deg * (np.pi / 180.0))
    np.testing.assert_array_equal(motion["C"], m.solve(motion.q)["C"])
    assert m.solve(deg=90).shape == ()


@pytest.mark.parametrize(
    "q", [90, 90.0, -30, [0, 30, 60], np.arange(0, 360, 10), np.array([[720]])]
)
def test_whole_numbers_beyond_two_turns_are_asked_about(q: Any) -> None:
    with pytest.warns(assur.AssurWarning, match=r"for degrees: deg=\.\.\."):
        assur.FourBar(1.0, 3.0, 2.5, 3.2).solve(q)


@pytest.mark.parametrize("q", [1, 12, np.linspace(0.0, 12.0, 13), [0.5, 90.0], np.nan, np.inf, []])
def test_others_are_not(q: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assur.FourBar(1.0, 3.0, 2.5, 3.2).solve(q, on_error="nan")
        assur.SliderCrank(50.0, 200.0).with_driver("bore", assembly={"A": 1}).solve(220.0)


def test_refusals() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    refused(assur.InputError, "both", partial(m.solve, 1.0, deg=90.0))
    refused(assur.InputError, "neither", m.solve)
    driven = assur.SliderCrank(1.0, 3.0).with_driver("bore", assembly={"A": 1})
    refused(assur.InputError, "slide bore", partial(driven.solve, deg=1.0))
    refused(assur.InputError, "deg", partial(m.solve, deg="right"))
