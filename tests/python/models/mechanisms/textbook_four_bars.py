"""The four-bars of the textbook's formulas as mechanisms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import assur

if TYPE_CHECKING:
    from oracles.kinematics.textbook import FourBars


def mechanism_of(four_bars: FourBars) -> assur.Mechanism:
    """Designs of these lengths, with the point P on the coupler."""
    drawn = assur.Mechanism(
        joints={"A": (0, 0), "B": (0, 1), "C": (2.5, 2), "D": (3, 0), "P": (1.5, 3)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )
    x, y = four_bars.point
    return drawn.with_dimensions(
        {
            "crank.length": four_bars.crank,
            "coupler.length": four_bars.coupler,
            "rocker.length": four_bars.rocker,
            "ground.D.x": four_bars.ground,
            "coupler.P.x": x,
            "coupler.P.y": y,
        }
    )
