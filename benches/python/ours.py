"""This package as a contender: the call that a user writes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from subject import GOOD, OURS, Contender

if TYPE_CHECKING:
    from collections.abc import Sequence

    from spaces import Space
    from subject import Bool, Float


def arrays(motion: assur.Motion, outputs: Sequence[str], order: int) -> list[Float]:
    """What a motion holds, output by output and order by order; joints as (..., 2)."""
    columns = []
    for name in outputs:
        if name in motion.mechanism.joints:
            held: Any = motion.joint(name)
        else:
            held = (motion.slide if name in motion.mechanism.slides else motion.link)(name)
        columns += [held.value, *(getattr(held, f"d{k}") for k in range(1, order + 1))]
    return columns


def good(motion: assur.Motion) -> Bool:
    """Where answers are to agree: beyond, rounding of the dimensions decides."""
    condition = motion.condition
    agrees: Bool = np.isnan(condition) | (condition < GOOD)
    return agrees


def sweeps(
    space: Space, q: Float, outputs: Sequence[str], order: int, threads: int | None = None
) -> dict[str, Contender]:
    """Make the batch anew in every call: into dropped memory, into given arrays, into new pages."""

    def run(out: assur.Motion | None = None) -> assur.Motion:
        return assur.sweep(
            space.mechanism,
            space.columns,
            q,
            outputs=outputs,
            order=order,
            out=out,
            threads=threads,
        )

    def answer(motion: assur.Motion) -> list[Float]:
        return arrays(motion, outputs, order)

    def drop() -> None:
        run()

    reused = run()
    return {
        # Other contenders take the memory that was dropped: before the clock starts, some is again.
        OURS: Contender(run, answer, prepare=drop),
        f"{OURS}, out=": Contender(partial(run, reused), answer),
        f"{OURS}, every result kept": Contender(run, answer, prepare=_forget, every_level=False),
    }


def _forget() -> None:
    """Leave no memory to be used again: a call takes it, and gives back what it does not need."""
    assur.FourBar(1.0, 3.0, 2.5, 3.2).solve(0.0, order=0, outputs=["C"])
