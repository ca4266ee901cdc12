"""Positions that could not be solved: a line about them, and the exit status."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.cli.terminal import note
from assur.description.words import Status

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur.kinematics.motion import Motion

INCOMPLETE = 3


def report(status: npt.NDArray[Any], least: Status, motion: Motion | None = None) -> int:
    """Say how many positions have no result, and why the first has none.

    `least` is the first status without one.
    """
    failed = status >= least
    count = int(failed.sum())
    if not count:
        return 0
    index = tuple(int(i) for i in np.argwhere(failed)[0])
    why = motion.explain(index) if motion is not None else Status(int(status[index])).name
    note(f"{count} of {status.size} positions could not be solved; the first: {why}")
    return INCOMPLETE
