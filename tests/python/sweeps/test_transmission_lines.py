"""Which two lines a transmission angle is between, where nothing is said."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur import metric

SIX_BARS = [
    ("watt_1", "C", ("B", "D")), ("watt_2", "C", ("B", "D")), ("watt_2", "F", ("E", "G")),
    ("stephenson_3", "C", ("B", "D")), ("jansen_leg", "T", ("M", "B")),
    ("jansen_leg", "L", ("M", "B")), ("klann_leg", "E", ("M", "L")),
    ("toggle_press", "B", ("A", "D")),
]  # fmt: skip


@pytest.mark.parametrize(("example", "joint", "outer"), SIX_BARS)
def test_a_dyad_that_carries_others_has_its_own_lines(
    example: str, joint: str, outer: tuple[str, str]
) -> None:
    m = getattr(assur.examples, example)()
    q = float(m.q0) + np.linspace(-0.2, 0.2, 5)
    motion = m.solve(q)
    np.testing.assert_array_equal(
        motion.transmission_angle(joint), motion.transmission_angle(joint, between=outer)
    )
    least = {"own": metric.min_transmission_angle(joint)}
    given = {"own": metric.min_transmission_angle(joint, between=outer)}
    assert (
        assur.sweep(m, {}, q, metrics=least)["own"] == assur.sweep(m, {}, q, metrics=given)["own"]
    )
