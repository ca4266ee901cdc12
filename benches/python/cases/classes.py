"""Classes II, III and IV: all joints that a group places, without and with two analogues."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import ours
import spaces
from assur.examples import loom, triad
from subject import Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import assur
    from subject import Float

# Of the loom, in the order that the iteration takes them.
LOOM = [
    *("crank.length", "l234.length", "l234.4.x", "l234.4.y", "l365.length", "l365.5.x"),
    *("l365.5.y", "l48.length", "l876.length", "l876.6.x", "l876.6.y", "l95.length"),
    *("l107.length", "ground.9.x", "ground.9.y", "ground.10.x", "ground.10.y"),
]
TRIAD = [
    *("crank.length", "rod.length", "plate.length", "plate.D.x", "plate.D.y", "right.length"),
    *("left.length", "ground.E.x", "ground.E.y", "ground.F.x", "ground.F.y"),
]
TOLERANCE = 1e-10


def case(quick: bool) -> Case:
    designs, positions = (10, 90) if quick else (1024, 360)
    subjects: dict[str | int, Callable[[], Subject]] = {}
    for order, words in ((0, "positions"), (2, "two analogues")):
        subjects |= {
            f"II, {words}": partial(dyad, designs, positions, order),
            f"III, {words}": partial(group, triad(), TRIAD, "BCD", designs, positions, order),
            f"IV, {words}": partial(group, loom(), LOOM, "2345678", designs, positions, order),
        }
    return Case("classes", "position", subjects)


def dyad(designs: int, positions: int, order: int) -> Subject:
    space, q = spaces.turning_four_bars(designs), turn(positions)
    contenders = ours.sweeps(space, q, ("B", "C"), order)
    return Subject(designs, positions, contenders, designs * positions)


def group(
    mechanism: assur.Mechanism,
    names: Sequence[str],
    outputs: Sequence[str],
    designs: int,
    positions: int,
    order: int,
) -> Subject:
    space, q = spaces.near(mechanism, designs, names), turn(positions) + mechanism.q0
    contenders = ours.sweeps(space, q, tuple(outputs), order)
    if installed("numba"):
        contenders["numba, Newton"] = by_numba(space, q, len(outputs), order)
    return Subject(designs, positions, contenders, designs * positions, tolerance=TOLERANCE)


def by_numba(space: spaces.Space, q: Float, joints: int, order: int) -> Contender:
    from rivals import newton, triad_newton

    mechanism = space.mechanism
    is_loom = "107" in "".join(mechanism.links)
    ends = [("2", "3"), ("3", "6"), ("4", "8"), ("8", "7")] if is_loom else [("A", "B"), ("B", "C")]
    chords = [np.subtract(mechanism.joints[b], mechanism.joints[a]) for a, b in ends]
    start = np.array([np.arctan2(y, x) for x, y in chords])
    dimensions = np.ascontiguousarray(space.values.T)
    out = np.zeros((len(dimensions), q.size, joints * (order + 1), 2))
    sweep = newton.sweep if is_loom else triad_newton.sweep

    def run() -> Any:
        sweep(dimensions, start, q, order, out)
        return out

    def answer(solved: Float) -> list[Float]:
        places = [(k, j) for j in range(joints) for k in range(order + 1)]
        return [solved[:, :, joints * k + j] for k, j in places]

    return Contender(run, answer)
