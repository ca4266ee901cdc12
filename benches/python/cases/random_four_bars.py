"""A design space as users have it: random four-bars, most of which do not turn; a coupler point."""

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

# Designs that a loop in Python does, and the condition below which assemblies are far apart.
FEW, CLEAR = 1000, 10.0


def case(quick: bool) -> Case:
    designs = 200 if quick else 100_000
    return Case("random_four_bars", "design", {"": lambda: subject(designs, 72)})


def subject(designs: int, positions: int) -> Subject:
    space, q = spaces.random_four_bars(designs), turn(positions)
    contenders = ours.sweeps(space, q, ("P",), 0)
    columns = [row[:, None] for row in space.values]
    lengths, point = np.ascontiguousarray(space.values[:4]), np.ascontiguousarray(space.values[4:])
    out = np.zeros((designs, positions, 2))

    def whole() -> Any:
        with np.errstate(invalid="ignore"):
            return closed_form.four_bar_point(*columns, q)

    contenders["NumPy, whole arrays"] = Contender(whole, lambda xy: [np.stack(xy, axis=-1)])
    if installed("numba"):
        contenders |= by_numba(lengths, point, q, out)
    if installed("jax"):
        contenders["JAX"] = by_jax(lengths, point, q)
    motion = space.batch().solve(q, order=0, outputs=["P"], on_error="nan")
    if installed("pylinkage", "numba"):
        contenders["pylinkage, ensemble"] = by_pylinkage(space, q)
    contenders |= memory.ceilings([out])
    turns = np.isfinite(motion.joint("P").value[..., 0]).all(axis=-1)
    return Subject(
        designs,
        positions,
        contenders,
        designs,
        good=lambda: ours.good(motion),
        note=f"{turns.mean():.0%} of them turn fully",
    )


def by_numba(lengths: Float, point: Float, q: Float, out: Float) -> dict[str, Contender]:
    from rivals import plain_numba, specialist

    cos, sin = np.cos(q), np.sin(q)

    def plain() -> Float:
        plain_numba.four_bar_point(lengths, point, q, out)
        return out

    def expert() -> Float:
        specialist.four_bar_point(lengths, point, cos, sin, out)
        return out

    def answer(points: Float) -> list[Float]:
        return [points]

    return {"numba": Contender(plain, answer), "numba, by an expert": Contender(expert, answer)}


def by_jax(lengths: Float, point: Float, q: Float) -> Contender:
    from rivals import with_jax

    return Contender(
        lambda: with_jax.run(with_jax.four_bar_point, lengths, point, q),
        lambda points: [np.asarray(points)],
    )


def by_pylinkage(space: spaces.Space, q: Float) -> Contender:
    """It ends a design at its first gap, and goes to the nearer of two places, maybe the other."""
    from rivals import with_pylinkage

    few = spaces.Space(space.mechanism, space.names, space.values[:, :FEW])
    condition = few.batch().solve(q, order=0, outputs=["P"], on_error="nan").condition
    with np.errstate(invalid="ignore"):
        made = with_pylinkage.ensemble(few.values[:4], few.values[4:], q.size)
        # No gap, and the other assembly far away (NaN: a gap).
        clear = condition.max(axis=-1) < CLEAR
    return Contender(
        lambda: made.simulate(q.size, store=False),
        lambda points: [points[:, :, -1]],
        len(clear),
        where=np.broadcast_to(clear[:, None], condition.shape),
    )
