"""Bad driver coordinates: errors that name them, or a status for each position."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import pytest

import assur
from assur import Status
from models.errors.refusals import APART, TWO, M, build, refused, slide

nan, inf = math.nan, math.inf


@pytest.mark.parametrize("q", [nan, inf, -inf])
def test_non_finite_coordinates_are_refused(q: float) -> None:
    refused(assur.InputError, "q finite", lambda: M.solve([1.0, q]), q=q)
    assert M.solve([1.0, q], on_error="nan").status.tolist() == [Status.OK, Status.BAD_INPUT]
    refused(assur.InputError, "q finite", lambda: M.assemblies(q), value=q)


@pytest.mark.parametrize(
    ("q", "words"),
    [
        *((q, "q real numbers") for q in ("x", 1j, np.array([1 + 1j]))),
        *(
            (q, "q number array of numbers")
            for q in ({1}, {"a": 1}, [[1, 2], [3]], 10**400, M, iter([1.0]))
        ),
    ],
)
def test_q_that_is_not_an_array(q: Any, words: str) -> None:
    refused(assur.InputError, words, lambda: M.solve(q))


@pytest.mark.parametrize("shape", [(3, 2), (1, 3), (2, 3, 1)])
def test_q_of_other_shapes(shape: tuple[int, ...]) -> None:
    pair = M.with_dimensions({"coupler.length": [4.4, 4.5]})
    refused(assur.InputError, f"q {shape} (2,)", lambda: pair.solve(np.ones(shape)))


@pytest.mark.parametrize(
    ("q", "shape"),
    [
        ([], (0,)),
        ((1, 2), (2,)),
        (range(3), (3,)),
        (np.array([1, 2], dtype=np.int8), (2,)),
        (np.arange(9.0)[::-2], (5,)),
        (np.ones((2, 6), order="F")[:, ::3], (2, 2)),
        (np.float32(1), ()),
        ([[]], (1, 0)),
    ],
)
def test_q_of_any_kind(q: Any, shape: tuple[int, ...]) -> None:
    motion = M.solve(q)
    assert motion.shape == shape
    plain = M.solve(np.array(q, dtype=np.float64, order="C"))
    assert motion.joint("C").d2.tobytes() == plain.joint("C").d2.tobytes()
    assert len(motion.to_dataframe()) == math.prod(shape)


def test_many_turns() -> None:
    turns = 2 * math.pi * 1e6
    far, near = M.solve([1.0 + turns, 1e15, 1e300]), M.solve(1.0)
    assert (far.status == Status.OK).all()
    np.testing.assert_allclose(far.joint("C").value[0], near.joint("C").value, rtol=1e-8)
    np.testing.assert_allclose(far.link("crank").value, [1.0 + turns, 1e15, 1e300], rtol=1e-15)
    assert abs(far.link("coupler").value).max() < math.pi


def test_many_turns_of_one_of_two_drivers() -> None:
    """Too far to be followed from the drawing: refused at once instead of after hours."""
    m = build(
        joints={"O": (0, 0), "A": (0.3, 0.4), "B": (2.3, 0), "G": (5, 1)},
        links={"ground": "O", "crank": "OA", "cart": "B", "long": "AG", "short": "GB"},
        slides={"s": slide("cart", "ground", 0)},
        driver=["crank", "s"],
    )
    q0 = np.asarray(m.q0)
    far = m.solve([[1e9, 1.0], q0.tolist()], on_error="nan")
    assert far.status.tolist() == [Status.BAD_INPUT, Status.OK]
    assert "1000 turns" in far.explain(0)
    assert m.solve(q0 + np.array([60 * np.pi, 0.0]), on_error="nan").status == Status.OK


@pytest.mark.parametrize("q", [1.0, 1e3, 1e16, 1e153, 1e160, 1e300, -1e300])
def test_a_slide_pulled_too_far(q: float) -> None:
    m = build(
        joints={"O": (0, 0), "A": (0.03, 0.04), "B": (0.23, 0)},
        links={"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"},
        slides={"bore": slide("piston", "ground", 0.0, "O")},
        driver="bore",
    )
    assert m.solve(q, on_error="nan").status == Status.UNREACHABLE
    for order in (0, 1):
        ask = partial(m.solve, q, order=order)
        error = refused(assur.PositionError, "A assembled", ask, joint="A", q=q)
        assert len(str(error)) < 150


@pytest.mark.parametrize("far", [1e4, 1e6, 1e8, 1e12, 1e160, 1e300])
def test_a_far_coupler_point_leaves_the_rest_alone(far: float) -> None:
    """Beyond the range of lengths it is refused."""
    if far > 1e153:
        refused(
            assur.DimensionError,
            "coupler.P.x within",
            lambda: M.with_dimensions({"coupler.P.x": far}),
            dimension="coupler.P.x",
            value=far,
        )
        return
    m = M.with_dimensions({"coupler.P.x": far})
    motion = m.solve(1.0, order=0, on_error="nan")
    assert m.solve(1.0).status <= Status.NEAR_SINGULAR
    np.testing.assert_allclose(motion.joint("C").value, M.solve(1.0).joint("C").value, rtol=1e-12)


def test_positions_out_of_reach() -> None:
    error = refused(
        assur.PositionError,
        "q = 3 C assembled m 1 3",
        lambda: APART.solve([0, 3, 3.1]),
        joint="C",
        q=3.0,
        design=None,
    )
    assert isinstance(error, ArithmeticError)
    motion = APART.solve([0, 3, 6.2], on_error="nan")
    assert motion.status.tolist() == [Status.OK, Status.UNREACHABLE, Status.OK]
    assert np.isnan(motion.joint("C").value[1]).all()
    assert motion.explain(1) in str(error)
    assert APART.assemblies(3.0) == []


# -- several drivers -----------------------------------------------------------------------------


@pytest.mark.parametrize("q", [1.0, [1.0, 2.0, 3.0], np.ones((2, 3))])
def test_two_drivers_need_two_coordinates(q: Any) -> None:
    refused(assur.InputError, f"q {np.shape(q)} 2 drivers", lambda: TWO.solve(q))
    refused(assur.InputError, f"q {np.shape(q)} 2 drivers", lambda: TWO.assemblies(q))


def test_two_drivers() -> None:
    motion = TWO.solve(np.tile(np.asarray(TWO.q0), (4, 1)), order=3)
    c = motion.joint("C")
    assert [a.shape for a in (c.value, c.d1, c.d2, c.d3)] == [(4, 2) + (2,) * k for k in range(4)]
    refused(assur.InputError, "speed () 2 drivers", lambda: c.velocity(1.0))
    for ask in (motion.curvature, motion.instant_centre, motion.mechanical_advantage):
        refused(assur.InputError, f"{ask.__name__} one driver 2", partial(ask, "l2"))
    refused(
        assur.PositionError,
        "(3.1, 0) C assembled",
        lambda: TWO.solve([3.1, 0.0]),
        joint="C",
        q=(3.1, 0.0),
    )
    assert TWO.solve(np.ones((0, 2))).joint("C").d2.shape == (0, 2, 2, 2)
