"""The exact strokes of slides, for guides that are dimensioned."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.errors import AssurError

if TYPE_CHECKING:
    from assur._faces import Motion
    from assur.pictures.linkage.subject import Subject

Stroke = tuple[float, float]


def strokes(subject: Subject, motion: Motion) -> dict[str, Stroke]:
    """Return how far each slide goes back and forth from a position, over the motion it is part of.

    Positions of a picture are samples, between which a slide goes on beyond all of them. Those that
    have no limit, or where a part is out of sight, are left out.
    """
    mechanism = subject.mechanism
    if mechanism.driver_count > 1 or not subject.is_all_seen:
        return {}
    signs = [subject.assembly[name] for name, _ in mechanism.core.assembly]
    values, q = mechanism.values.tolist(), float(motion.q)
    ranges = {}
    for name in mechanism.slides:
        try:
            ends = mechanism.core.extremes(values, signs, name, 0, q)
        except AssurError:
            # Not every assembly of a higher group can be followed to its ends.
            continue
        present = float(motion.slide(name).value)
        if ends is not None and np.isfinite([value for value, _ in ends]).all():
            ranges[name] = (ends[0][0] - present, ends[1][0] - present)
    return ranges
