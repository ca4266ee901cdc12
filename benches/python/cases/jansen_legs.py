"""Jansen's leg, four dyads: places of six joints."""

from __future__ import annotations

from typing import Any

import numpy as np

import memory
import ours
import spaces
from assur.examples import jansen_leg
from rivals import closed_form
from subject import Case, Contender, Subject, turn

OUTPUTS = ("M", "T", "W", "L", "K", "F")


def case(quick: bool) -> Case:
    designs, positions = (40, 36) if quick else (10_000, 360)
    return Case("jansen_legs", "position", {"": lambda: subject(designs, positions)})


def subject(designs: int, positions: int) -> Subject:
    space, q = spaces.near(jansen_leg(), designs), turn(positions)
    contenders = ours.sweeps(space, q, OUTPUTS, 0)
    columns = [row[:, None] for row in space.values]
    out = [np.zeros((designs, positions)) for _ in range(12)]

    def whole() -> Any:
        return closed_form.jansen(*columns, q)

    def blocked() -> Any:
        return closed_form.blocked(closed_form.jansen, columns, q, out, memory.cores())

    def answer(columns: Any) -> list[Any]:
        return [np.stack(columns[i : i + 2], axis=-1) for i in range(0, 12, 2)]

    contenders["NumPy, whole arrays"] = Contender(whole, answer)
    contenders["NumPy, in blocks, 2 threads"] = Contender(blocked, answer)
    contenders |= memory.ceilings(out)
    return Subject(designs, positions, contenders, designs * positions)
