"""Why a search found nothing: which of its conditions is in the way."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur.errors import FitError
from assur.fitting.measured import Spent, measured
from assur.fitting.wanted import started

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur.fitting.target import PathTarget
    from assur.fitting.wanted import Wanted

# Conditions that most paths leave room within.
EASY_JOINTS, EASY_APEX, EASY_FRAME, EASY_ARC = 12, np.pi / 18.0, 20.0, 0.5 * np.pi


class Relaxed(NamedTuple):
    """Conditions with one of them relaxed, and what that is in words."""

    what: str
    wanted: Wanted


def nothing_found(target: PathTarget, wanted: Wanted, offered: int, spent: Spent) -> FitError:
    """Return the error: the conditions, and which of them alone leaves linkages if relaxed."""
    conditions = (
        f"at most {wanted.joints} joints, apex angles of at least "
        f"{np.rad2deg(wanted.min_apex_angle):.4g}°, a frame of {wanted.frame:.4g} radii"
    )
    if not target.closed:
        conditions += f", an arc of at least {np.rad2deg(wanted.min_arc):.4g}°"
    message = f"no linkage keeps all conditions: {conditions}; {spent.evaluations} were evaluated"
    if offered:
        message += f", and the best {offered} failed the proof"
    helped = [
        relaxed.what for relaxed in _relaxed(target, wanted) if _leaves_some(target, relaxed.wanted)
    ]
    hint = (
        f"there are linkages with {', or with '.join(helped)}"
        if helped
        else "no single condition is in the way: relax several, or try another seed"
    )
    return FitError(f"{message}; {hint}", hint=hint, joint=target.joint)


def _relaxed(target: PathTarget, wanted: Wanted) -> Iterator[Relaxed]:
    """Yield the conditions with one of them relaxed, where it is narrower than most paths need."""
    if wanted.min_apex_angle > EASY_APEX:
        of = f"min_apex_angle={EASY_APEX:.4g} ({np.rad2deg(EASY_APEX):.0f}°)"
        yield Relaxed(of, replace(wanted, min_apex_angle=EASY_APEX))
    if wanted.joints < EASY_JOINTS:
        yield Relaxed(f"joints={EASY_JOINTS}", replace(wanted, joints=EASY_JOINTS))
    if wanted.frame < EASY_FRAME:
        yield Relaxed(f"frame={EASY_FRAME:g}", replace(wanted, frame=EASY_FRAME))
    if wanted.min_arc > EASY_ARC and not target.closed:
        of = f"min_arc={EASY_ARC:.4g} ({np.rad2deg(EASY_ARC):.0f}°)"
        yield Relaxed(of, replace(wanted, min_arc=EASY_ARC))


def _leaves_some(target: PathTarget, wanted: Wanted) -> bool:
    """Whether a search with these conditions has linkages to begin with."""
    search = started(target, wanted)
    search.start()
    spent = Spent(0.0, search.evaluations)
    return any(measured([one], target, wanted, spent)[0] for one in search.finish())
