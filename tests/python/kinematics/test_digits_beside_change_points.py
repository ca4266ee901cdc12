"""Digits of analogues beside a change point, by the condition: as conventions state."""

from __future__ import annotations

import math

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

import assur

# u of the conventions, and their factor for positions near a change point.
U = 2.0**-52
FACTOR = 8.0
# Conditions up to which a second and a third analogue have four digits.
FOUR_DIGITS = {2: 3800.0, 3: 480.0}


def analogues(crank: float, rod: float, offset: float, q: float, side: int) -> list[float]:
    """The first three derivatives of r cos q ± √(l² − (r sin q − e)²), by numbers of 60 digits."""
    with mpmath.workdps(60):
        r, rod_, e = mpmath.mpf(crank), mpmath.mpf(rod), mpmath.mpf(offset)

        def value(t: mpmath.mpf) -> mpmath.mpf:
            return r * mpmath.cos(t) + side * mpmath.sqrt(rod_**2 - (r * mpmath.sin(t) - e) ** 2)

        step = mpmath.mpf(10) ** -18
        return [float(mpmath.diff(value, mpmath.mpf(q), n, h=step)) for n in (1, 2, 3)]


@pytest.mark.parametrize(
    ("rod", "offset", "change"),
    [(1.3, 0.3, -0.5), (1.7, 0.7, -0.5), (1.25, 0.25, -0.5), (0.6, 0.4, 0.5)],
)
def test_errors_grow_with_a_power_of_the_condition(
    rod: float, offset: float, change: float
) -> None:
    m = assur.SliderCrank(1.0, rod, offset)
    side = np.geomspace(1.3e-4, 3e-2, 12)
    q = change * math.pi + np.concatenate([-side[::-1], side])
    motion = m.solve(q, order=3)
    bore = motion["bore"]
    assert (motion.status <= assur.Status.NEAR_SINGULAR).all()
    lost = 0.0
    for i, at in enumerate(q):
        ahead = float(bore.value[i]) > math.cos(at)
        right = analogues(1.0, rod, offset, float(at), 1 if ahead else -1)
        condition = float(motion.condition[i])
        for order, own in enumerate((bore.d1[i], bore.d2[i], bore.d3[i]), 1):
            error = abs(float(own) - right[order - 1])
            # The size of everything is 1 here.
            assert error <= FACTOR * U * condition ** (order + 1), (at, order)
            if order > 1 and condition <= FOUR_DIGITS[order]:
                assert error <= 1e-4
            lost = max(lost, error)
    # At some thousand a third analogue has lost its digits though the position is solved.
    assert lost > 1e-2
