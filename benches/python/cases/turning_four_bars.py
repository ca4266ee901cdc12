"""Four-bars near each other that all turn: two angles with two analogues each."""

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

OUTPUTS = ("coupler", "rocker")


def case(quick: bool) -> Case:
    designs, positions = (40, 36) if quick else (10_000, 360)
    return Case("turning_four_bars", "position", {"": lambda: subject(designs, positions)})


def subject(designs: int, positions: int) -> Subject:
    space, q = spaces.turning_four_bars(designs), turn(positions)
    contenders = ours.sweeps(space, q, OUTPUTS, 2)
    columns = [row[:, None] for row in space.values]
    out = [np.zeros((designs, positions)) for _ in range(6)]

    def whole() -> Any:
        return closed_form.angles(*columns, q)

    def blocked() -> Any:
        return closed_form.blocked(closed_form.angles, columns, q, out, memory.cores())

    contenders["NumPy, whole arrays"] = Contender(whole, tuple)
    contenders["NumPy, in blocks, 2 threads"] = Contender(blocked, tuple)
    if installed("numba"):
        contenders |= by_numba(space.values, q, out)
    few = min(designs, 100)
    if installed("jax"):
        contenders["JAX"] = by_jax(space.values, q)
    if installed("casadi"):
        contenders["CasADi"] = by_casadi(space.values[:, :few], q, few)
    contenders |= memory.ceilings(out)
    return Subject(designs, positions, contenders, designs * positions, angles=(0, 3))


def by_numba(lengths: Float, q: Float, out: list[Float]) -> dict[str, Contender]:
    from rivals import plain_numba, specialist

    cos, sin = np.cos(q), np.sin(q)
    coupler, rocker = tuple(out[:3]), tuple(out[3:])

    def plain() -> list[Float]:
        plain_numba.four_bar(lengths, q, coupler, rocker)
        return out

    def expert() -> list[Float]:
        specialist.four_bar(lengths, cos, sin, coupler, rocker)
        return out

    return {"numba": Contender(plain, list), "numba, by an expert": Contender(expert, list)}


def by_jax(lengths: Float, q: Float) -> Contender:
    from rivals import with_jax

    def answer(orders: Any) -> list[Float]:
        return [np.asarray(orders[k][..., i]) for i in range(2) for k in range(3)]

    return Contender(lambda: with_jax.run(with_jax.four_bar, lengths, q), answer)


def by_casadi(lengths: Float, q: Float, designs: int) -> Contender:
    from rivals import with_casadi

    function = with_casadi.four_bar()

    def answer(orders: Any) -> list[Float]:
        return [orders[k][i].reshape(designs, -1) for i in range(2) for k in range(3)]

    return Contender(lambda: with_casadi.solve(function, lengths, q), answer, designs)
