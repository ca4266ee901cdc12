"""The least transmission angle of each dyad over the turn that is played."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion


def transmission_angles(motion: Motion) -> Iterator[tuple[str, Float]]:
    """Yield the transmission angles of the inner pairs of the dyads that a name selects."""
    for name in motion.mechanism.assembly:
        # Refused where more links meet than two.
        with suppress(InputError):
            yield name, motion.transmission_angle(name)


def min_transmission_angle(mechanism: Mechanism, line: Float, place: Float) -> list[dict[str, Any]]:
    """Return the least angle, rad, of each dyad at these coordinates, and where it is.

    `place` is what the page calls the coordinate: with several drivers that of the one that moves.
    """
    motion = mechanism.solve(line, order=0, on_error="nan")
    listed = []
    for name, angles in transmission_angles(motion):
        if np.isfinite(angles).any():
            row = int(np.nanargmin(angles))
            listed.append({"at": name, "min": float(angles[row]), "q": float(place[row])})
    return listed
