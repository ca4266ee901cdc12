"""Motions held to the law: what two tests of agreement share."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

import agreement

if TYPE_CHECKING:
    import assur
    import oracle
    from agreement import Q
    from mechanism_data import Description


def along(start: Q, move: Q, t: float) -> Q:
    return tuple(a + t * b for a, b in zip(start, move, strict=True))


def solve(mechanism: assur.Mechanism, qs: list[Q]) -> assur.Motion:
    points = np.array(qs)
    points = points[:, 0] if points.shape[1] == 1 else points
    return mechanism.solve(points, order=3, on_error="nan")


# An error that half-unit changes of the drawing's coordinates cause too, within this factor: the
# best that a computation in doubles can promise where the law's own terms (the condition, the
# size of an analogue) say less than the input does. 2250 mechanisms of a separate scan: 1 in 300
# misses the law, none by more than this (an analogue that is small by accident, a short arm).
INHERENT = 4.0


def check_law(d: Description, q: Q, solution: oracle.Solution, gap: agreement.Gap) -> None:
    """Nothing is further off than the law allows, or than the drawing's own last bits."""
    for k, (used, whose) in enumerate(zip((gap.position, *gap.analogues), gap.worst, strict=True)):
        if used > 1:
            own = agreement.inherent(d, q, solution, k)
            # Nor is anything expected below one unit in the last place of the size itself.
            if gap.errors[k] <= max(INHERENT * own, agreement.U):
                continue
            pytest.fail(
                f"order {k}, {whose}: {used:.3g} times what the law allows, {gap.errors[k]:.3g} "
                f"(condition {gap.condition:.3g}; half a u of the size in the drawing "
                f"changes this order by {own:.3g}) at q = {q} of {d}"
            )


def whole_turns(motion: assur.Motion, i: int, solution: oracle.Solution) -> dict[str, float]:
    gaps = {n: float(motion.link(n).value[i] - j.value) for n, j in solution.links.items()}
    return {n: math.tau * round(gap / math.tau) for n, gap in gaps.items()}
