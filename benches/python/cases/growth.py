"""Four-bars that turn, an angle: time over the number of designs, and of positions."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
import spaces
from rivals import closed_form
from subject import OURS, Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from subject import Float

POSITIONS, DESIGNS = 36, 100


def designs(quick: bool) -> Case:
    subjects = {10**k: partial(subject, 10**k, POSITIONS, 10**k) for k in range(3 if quick else 7)}
    return Case("growth_of_designs", "design", subjects, axis="designs")


def positions(quick: bool) -> Case:
    counts = [36 * 10**k for k in range(2 if quick else 4)]
    subjects = {n: partial(subject, DESIGNS, n, DESIGNS * n) for n in counts}
    return Case("growth_of_positions", "position", subjects, axis="positions")


def subject(designs: int, positions: int, units: int) -> Subject:
    space, q = spaces.turning_four_bars(designs), turn(positions)

    def run(out: assur.Motion | None = None) -> assur.Motion:
        return assur.sweep(space.mechanism, space.columns, q, outputs=["rocker"], order=0, out=out)

    contenders = {OURS: Contender(partial(run, run()), lambda m: [m.link("rocker").value])}
    columns = [row[:, None] for row in space.values]

    def by_numpy() -> Float:
        return closed_form.rocker(*columns, q)

    contenders["NumPy"] = Contender(by_numpy, lambda angles: [angles])
    if installed("numba"):
        from rivals import specialist

        cos, sin, out = np.cos(q), np.sin(q), np.empty((designs, positions))

        def expert() -> Any:
            specialist.rocker(space.values, cos, sin, out)
            return out

        contenders["numba, by an expert"] = Contender(expert, lambda angles: [angles])
    return Subject(designs, positions, contenders, units, angles=(0,))
