"""Random Stephenson III six-bars: a point of the fifth link, a dyad on a coupler point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import memory
import ours
import spaces
from rivals import closed_form
from subject import Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from subject import Float


def case(quick: bool) -> Case:
    designs = 200 if quick else 100_000
    return Case("random_six_bars", "design", {"": lambda: subject(designs, 72)})


def subject(designs: int, positions: int) -> Subject:
    space, q = spaces.random_six_bars(designs), turn(positions)
    contenders = ours.sweeps(space, q, ("T",), 0)
    columns = [row[:, None] for row in space.values]
    out = np.zeros((designs, positions, 2))

    def whole() -> Any:
        with np.errstate(invalid="ignore"):
            return closed_form.stephenson_point(columns[:6], *columns[6:], q)

    contenders["NumPy, whole arrays"] = Contender(whole, lambda xy: [np.stack(xy, axis=-1)])
    if installed("numba"):
        contenders |= by_numba(space.values, q, out)
    contenders |= memory.ceilings([out])
    motion = space.batch().solve(q, order=0, outputs=["T"], on_error="nan")
    turns = np.isfinite(motion.joint("T").value[..., 0]).all(axis=-1)
    return Subject(
        designs,
        positions,
        contenders,
        designs,
        good=lambda: ours.good(motion),
        note=f"{turns.mean():.0%} of them turn fully",
    )


def by_numba(values: Float, q: Float, out: Float) -> dict[str, Contender]:
    from rivals import plain_numba, specialist

    cos, sin = np.cos(q), np.sin(q)
    rows = np.split(values, [4, 6, 10])

    def plain() -> Float:
        plain_numba.six_bar_point(*rows, q, out)
        return out

    def expert() -> Float:
        specialist.stephenson_point(*rows, cos, sin, out)
        return out

    def answer(points: Float) -> list[Float]:
        return [points]

    return {"numba": Contender(plain, answer), "numba, by an expert": Contender(expert, answer)}
