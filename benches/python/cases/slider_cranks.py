"""Slider-cranks near each other: slide and rod angle with two analogues each."""

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
    designs, positions = (40, 36) if quick else (10_000, 360)
    return Case("slider_cranks", "position", {"": lambda: subject(designs, positions)})


def subject(designs: int, positions: int) -> Subject:
    space, q = spaces.slider_cranks(designs), turn(positions)
    contenders = ours.sweeps(space, q, ("bore", "rod"), 2)
    columns = [row[:, None] for row in space.values]
    out = [np.zeros((designs, positions)) for _ in range(6)]

    def whole() -> Any:
        return closed_form.slider_crank(*columns, q)

    contenders["NumPy, whole arrays"] = Contender(whole, tuple)
    if installed("numba"):
        contenders |= by_numba(space.values, q, out)
    contenders |= memory.ceilings(out)
    return Subject(designs, positions, contenders, designs * positions, angles=(3,))


def by_numba(lengths: Float, q: Float, out: list[Float]) -> dict[str, Contender]:
    from rivals import plain_numba, specialist

    cos, sin = np.cos(q), np.sin(q)
    slide, rod = tuple(out[:3]), tuple(out[3:])

    def plain() -> list[Float]:
        plain_numba.slider_crank(lengths, q, slide, rod)
        return out

    def expert() -> list[Float]:
        specialist.slider_crank(lengths, cos, sin, slide, rod)
        return out

    return {"numba": Contender(plain, list), "numba, by an expert": Contender(expert, list)}
