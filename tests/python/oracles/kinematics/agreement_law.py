"""The law of accuracy for motions, shared by two tests of agreement."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from models.mechanisms.mechanism_data import arguments
from oracles.kinematics import agreement, oracle, oracle_dimension
from oracles.kinematics.oracle_system import MP

if TYPE_CHECKING:
    from models.mechanisms.mechanism_data import Description
    from oracles.kinematics.agreement import Q


def along(start: Q, move: Q, t: float) -> Q:
    return tuple(a + t * b for a, b in zip(start, move, strict=True))


def solve(mechanism: assur.Mechanism, qs: list[Q]) -> assur.Motion:
    points = np.array(qs)
    points = points[:, 0] if points.shape[1] == 1 else points
    return mechanism.solve(points, order=3, on_error="nan")


# An error that half-unit changes of the drawing's coordinates or of a dimension cause too, within
# this factor: the
# best that a computation in doubles can promise where the law's own terms (the condition, the
# size of an analogue) say less than the input does. 2250 mechanisms of a separate scan: 1 in 300
# misses the law, none by more than this (an analogue that is small by accident, a short arm).
INHERENT = 4.0


def by_dimensions(d: Description, q: Q, solution: oracle.Solution, order: int) -> float:
    """Greatest change of an order when one dimension moves by half a u (of the size).

    A design is its dimensions, each rounded by itself. Beside the drawing these matter more than
    the drawing's own last bits, which change several dimensions together so that it still closes.
    """
    size = agreement.extent(d, solution)
    arm, most = agreement.arms(d, solution, size), 0.0
    for name in assur.Mechanism(**arguments(d)).dimensions:
        if not oracle_dimension.known(d, name):
            continue
        bit = agreement.U / 2 * (1.0 if name.endswith("angle") else size)
        change = oracle_dimension.changed(name, MP.mpf(bit))
        other = oracle.solve(d, q, solution.pose, order, change)
        for kind in ("joints", "links", "slides"):
            for output, jet in getattr(solution, kind).items():
                moved = getattr(other, kind)[output].tensor(order) - jet.tensor(order)
                unit = arm[output] if kind == "links" else 1.0
                most = max(most, float(np.max(np.abs(moved))) * float(unit))
    return most


def check_law(d: Description, q: Q, solution: oracle.Solution, gap: agreement.Gap) -> None:
    """No error exceeds the law, or what the drawing's own last bits cause."""
    for k, (used, whose) in enumerate(zip((gap.position, *gap.analogues), gap.worst, strict=True)):
        if used > 1:
            own = max(agreement.inherent(d, q, solution, k), by_dimensions(d, q, solution, k))
            # Nor is anything expected below one unit in the last place of the size itself.
            if gap.errors[k] <= max(INHERENT * own, agreement.U):
                continue
            pytest.fail(
                f"order {k}, {whose}: {used:.3g} times what the law allows, {gap.errors[k]:.3g} "
                f"(condition {gap.condition:.3g}; half a u of the size in drawing or dimensions "
                f"changes this order by {own:.3g}) at q = {q} of {d}"
            )


def whole_turns(motion: assur.Motion, i: int, solution: oracle.Solution) -> dict[str, float]:
    gaps = {n: float(motion.link(n).value[i] - j.value) for n, j in solution.links.items()}
    return {n: math.tau * round(gap / math.tau) for n, gap in gaps.items()}
