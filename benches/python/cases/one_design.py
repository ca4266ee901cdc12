"""One four-bar: what a call costs, as in a notebook or inside an optimiser."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
import ours
from rivals import closed_form
from subject import OURS, Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from subject import Float

LENGTHS = np.array([1.0, 3.0, 2.5, 3.2])
POINT = np.array([1.5, 1.0])


def case(quick: bool) -> Case:
    positions = 36 if quick else 360
    subjects = {
        f"{positions} positions, two angles, two analogues": partial(angles, positions),
        f"{positions} positions of a coupler point": partial(path, positions),
        "one position of one joint": one_joint,
        "one position, default call": default_call,
        "new lengths, then one position": new_lengths,
    }
    return Case("one_design", "call", subjects, plotted=False)


def four_bar() -> assur.Mechanism:
    a, b, c, g = LENGTHS
    return assur.FourBar(a, b, c, g)


def angles(positions: int) -> Subject:
    mechanism, q, outputs = four_bar(), turn(positions), ["coupler", "rocker"]

    def answer(motion: assur.Motion) -> list[Float]:
        return ours.arrays(motion, outputs, 2)

    contenders = {
        OURS: Contender(lambda: mechanism.solve(q, order=2, outputs=outputs), answer),
        "NumPy": Contender(lambda: closed_form.angles(*LENGTHS, q), tuple),
    }
    if installed("numba"):
        from rivals import specialist

        cos, sin, lengths = np.cos(q), np.sin(q), LENGTHS[:, None]

        def expert() -> list[Float]:
            out = [np.empty((1, positions)) for _ in range(6)]
            specialist.four_bar_alone(lengths, cos, sin, tuple(out[:3]), tuple(out[3:]))
            return out

        contenders["numba, by an expert"] = Contender(expert, lambda out: [a[0] for a in out])
    if installed("jax"):
        contenders["JAX"] = by_jax(q)
    if installed("casadi"):
        contenders["CasADi"] = by_casadi(q)
    return Subject(1, positions, contenders, angles=(0, 3))


def path(positions: int) -> Subject:
    """Only its own words say where a point is on the coupler."""
    joints = {"A": (0, 0), "B": (1, 0), "C": (3.1, 2.4), "D": (3.2, 0), "P": (2.0, 2.0)}
    links = {"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"}
    lengths = dict(zip(("crank.length", "coupler.length", "rocker.length"), LENGTHS, strict=False))
    point = {"coupler.P.x": POINT[0], "coupler.P.y": POINT[1]}
    mechanism = assur.Mechanism(joints, links, "crank").with_dimensions({**lengths, **point})
    q = turn(positions)
    contenders = {
        OURS: Contender(
            lambda: mechanism.solve(q, order=0, outputs=["P"]), lambda m: [m.joint("P").value]
        ),
        "NumPy": Contender(
            lambda: closed_form.four_bar_point(*LENGTHS, *POINT, q),
            lambda xy: [np.stack(xy, axis=-1)],
        ),
    }
    if installed("pylinkage"):
        from rivals import with_pylinkage

        linkage = with_pylinkage.four_bar(LENGTHS, POINT, positions)

        def answer(places: Any) -> list[Float]:
            return [np.array([joints[-1] for joints in places], dtype=float)]

        # It goes on from where it is: after a whole turn at the beginning again.
        contenders["pylinkage, stepped"] = Contender(
            lambda: with_pylinkage.step(linkage, positions), answer
        )
    return Subject(1, positions, contenders)


def one_joint() -> Subject:
    mechanism = four_bar()
    contenders = {
        OURS: Contender(
            lambda: mechanism.solve(1.0, order=0, outputs=["C"]), lambda m: [m.joint("C").value]
        ),
        "NumPy": Contender(lambda: place(LENGTHS, 1.0), lambda c: [np.array(c)]),
    }
    return Subject(1, 1, contenders)


def default_call() -> Subject:
    mechanism = four_bar()
    contenders = {
        OURS: Contender(lambda: mechanism.solve(1.0), lambda m: [m.link("rocker").d2]),
        "NumPy": Contender(
            lambda: closed_form.vectors(*LENGTHS, 1.0), lambda vectors: [vectors.rocker2]
        ),
    }
    return Subject(1, 1, contenders)


def new_lengths() -> Subject:
    mechanism = four_bar()
    lengths = dict(zip(("crank.length", "coupler.length"), (1.01, 3.01), strict=True))

    def run() -> assur.Motion:
        return mechanism.with_dimensions(lengths).solve(1.0, order=0, outputs=["C"])

    values = np.array([1.01, 3.01, *LENGTHS[2:]])
    contenders = {
        OURS: Contender(run, lambda m: [m.joint("C").value]),
        "NumPy": Contender(lambda: place(values, 1.0), lambda c: [np.array(c)]),
    }
    return Subject(1, 1, contenders)


def place(lengths: Float, q: float) -> Any:
    """Joint C: a coupler point at the coupler's end."""
    return closed_form.four_bar_point(*lengths, lengths[1], 0.0, q)


def by_jax(q: Float) -> Contender:
    from rivals import with_jax

    lengths = LENGTHS[:, None]

    def answer(orders: Any) -> list[Float]:
        return [np.asarray(orders[k][0, :, i]) for i in range(2) for k in range(3)]

    return Contender(lambda: with_jax.run(with_jax.four_bar, lengths, q), answer)


def by_casadi(q: Float) -> Contender:
    from rivals import with_casadi

    function, lengths = with_casadi.four_bar(), LENGTHS[:, None]

    def answer(orders: Any) -> list[Float]:
        return [orders[k][i] for i in range(2) for k in range(3)]

    return Contender(lambda: with_casadi.solve(function, lengths, q), answer)
