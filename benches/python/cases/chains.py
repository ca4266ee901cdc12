"""Chains of dyads, each on the one before: the last joint."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import assur
import spaces
from subject import OURS, Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from subject import Float


def case(quick: bool) -> Case:
    designs = 10 if quick else 2000
    subjects = {n: partial(subject, n, designs, 72) for n in ((1, 3) if quick else (1, 3, 10, 30))}
    return Case("chains", "position and dyad", subjects, axis="dyads")


def subject(dyads: int, designs: int, positions: int) -> Subject:
    space, q, tip = spaces.chain(dyads, designs), turn(positions), f"C{dyads}"

    def run(order: int, out: assur.Motion | None = None) -> assur.Motion:
        return assur.sweep(space.mechanism, space.columns, q, outputs=[tip], order=order, out=out)

    def answer(motion: assur.Motion) -> list[Float]:
        return [motion.joint(tip).value]

    contenders = {
        f"{OURS}, positions": Contender(partial(run, 0, run(0)), answer),
        f"{OURS}, two analogues": Contender(partial(run, 2, run(2)), answer),
    }
    if installed("numba"):
        contenders["numba, by an expert, positions"] = by_numba(space, dyads, q)
    return Subject(designs, positions, contenders, designs * positions * dyads)


def by_numba(space: spaces.Space, dyads: int, q: Float) -> Contender:
    from rivals import specialist

    mechanism, (crank,) = space.mechanism, space.values
    feet, lengths = spaces.chain_lengths(mechanism, dyads)
    # The crank's pin is above its pivot in the drawing, where its angle is that of the link.
    start = np.array(mechanism.joints["O"], dtype=float)
    cos, sin = np.cos(q), np.sin(q)
    out = np.zeros((crank.size, q.size, 2))

    def run() -> Float:
        specialist.chain_tip(crank, start, feet, lengths, cos, sin, out)
        return out

    return Contender(run, lambda tips: [tips])
