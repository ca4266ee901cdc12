"""Bad dimensions, coordinates and questions: named errors, or a status in their own place."""

from __future__ import annotations

import copy
import math
import pickle
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Status
from test_refusals_structure import FIVE, FIVE_LINKS, TRIAD, build, slide

if TYPE_CHECKING:
    from collections.abc import Callable

M = build()
APART = assur.FourBar(40, 120, 80, 210)  # opens near the top of the turn
TWO = build(joints=FIVE, links=FIVE_LINKS, driver=["left", "right"])
BATCH = M.with_dimensions({"coupler.length": [4.4, math.nan, -1, 0, math.inf, 4.5, 20]})
nan, inf = math.nan, math.inf


def refused(
    kind: type[assur.AssurError], words: str, ask: Callable[[], object]
) -> assur.AssurError:
    """Ask; every word must be in the message."""
    with pytest.raises(kind) as caught:
        ask()
    missing = [word for word in words.split() if word not in str(caught.value)]
    assert not missing, f"{missing} not in: {caught.value}"
    return caught.value


# -- dimensions ----------------------------------------------------------------------------------


@pytest.mark.parametrize("value", [0, -0.0, -1, nan, inf, -inf])
def test_a_length_that_is_none(value: float) -> None:
    def ask() -> object:
        return M.with_dimensions({"coupler.length": value})

    error = refused(assur.DimensionError, "coupler.length", ask)
    assert isinstance(error, ValueError)
    assert error.dimension == "coupler.length"
    np.testing.assert_equal(error.value, float(value))


@pytest.mark.parametrize("make", [assur.FourBar, assur.SliderCrank])
def test_named_mechanisms_refuse_bad_lengths(make: Callable[..., assur.Mechanism]) -> None:
    lengths: list[Any] = [1.0, 3.0, 2.5, 3.0] if make is assur.FourBar else [1.0, 3.0]
    for place in range(len(lengths)):
        for bad in (0.0, -3.0, nan):
            with pytest.raises(assur.DimensionError):
                make(*lengths[:place], bad, *lengths[place + 1 :])
    refused(assur.InputError, "mode open crossed", lambda: assur.FourBar(1, 3, 2.5, 3, "x"))  # type: ignore[arg-type]


def test_unknown_dimensions_name_the_nearest() -> None:
    error = refused(
        assur.InputError,
        "cupler.length coupler.length",
        lambda: M.with_dimensions({"cupler.length": 1}),
    )
    assert error.dimension == "cupler.length"


@pytest.mark.parametrize("value", ["x", 1 + 2j, np.array([1 + 2j]), [[1, 2], [3]], 10**400])
def test_values_that_are_no_numbers(value: Any) -> None:
    refused(
        assur.InputError, "coupler.length", lambda: M.with_dimensions({"coupler.length": value})
    )


def test_shapes_that_do_not_broadcast() -> None:
    wanted: dict[str, Any] = {"coupler.length": [4, 5, 6], "rocker.length": [1, 2]}
    refused(
        assur.InputError,
        "coupler.length (3,) rocker.length (2,)",
        lambda: M.with_dimensions(wanted),
    )


def test_single_bad_designs_stay_in_their_place() -> None:
    motion = BATCH.solve([0.0, 1.0], on_error="nan")
    bad, far = Status.BAD_DIMENSION, Status.UNREACHABLE
    assert motion.status[:, 0].tolist() == [Status.OK, bad, bad, bad, bad, Status.OK, far]
    reached = np.isfinite(motion.joint("C").value).all(axis=(1, 2))
    assert reached.tolist() == [True, False, False, False, False, True, False]
    alone = BATCH.design(5).solve([0.0, 1.0])
    assert motion.joint("C").value[5].tobytes() == alone.joint("C").value.tobytes()
    assert "coupler.length" in motion.explain((2, 1))
    assert "-1" in motion.explain((2, 1))
    assert '"C" does not close' in motion.explain((6, 0))


def test_the_first_bad_design_is_named_and_the_rest_counted() -> None:
    error = refused(
        assur.DimensionError, "(1,) coupler.length NaN 9 14", lambda: BATCH.solve([0.0, 1.0])
    )
    assert (error.design, error.dimension, error.q) == ((1,), "coupler.length", 0.0)
    assert error.value is not None
    assert math.isnan(error.value)


@pytest.mark.parametrize("index", [7, -8, (0, 0), (), 1.5, "0", True, slice, 10**30])
def test_designs_that_are_not_there(index: Any) -> None:
    index = np.s_[0:2] if index is slice else index
    refused(assur.InputError, "design", lambda: BATCH.design(index))


def test_designs_that_are_there() -> None:
    assert BATCH.design(-2) == BATCH.design(5) == BATCH.design(np.int64(5))  # type: ignore[arg-type]
    refused(assur.DimensionError, "coupler.length NaN", lambda: BATCH.design(1))
    refused(assur.InputError, "design (7,)", lambda: BATCH.assemblies(1.0))


def test_an_empty_batch() -> None:
    motion = M.with_dimensions({"coupler.length": []}).solve([1.0, 2.0])
    assert motion.joint("C").value.shape == (0, 2, 2)


# -- coordinates ---------------------------------------------------------------------------------


@pytest.mark.parametrize("q", [nan, inf, -inf])
def test_a_coordinate_that_is_no_number(q: float) -> None:
    error = refused(assur.InputError, "q finite", lambda: M.solve([1.0, q]))
    np.testing.assert_equal(error.q, q)
    assert M.solve([1.0, q], on_error="nan").status.tolist() == [Status.OK, Status.BAD_INPUT]
    refused(assur.InputError, "q", lambda: M.assemblies(q))


@pytest.mark.parametrize(
    "q", ["x", 1j, np.array([1 + 1j]), {1}, {"a": 1}, [[1, 2], [3]], 10**400, M, iter([1.0])]
)
def test_q_that_is_no_array(q: Any) -> None:
    refused(assur.InputError, "q", lambda: M.solve(q))


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
    """Too far to be followed from the drawing: said so, at once, instead of hours of following."""
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
        error = refused(assur.PositionError, "A close", partial(m.solve, q, order=order))
        assert (error.joint, error.q) == ("A", q)
        assert len(str(error)) < 150


@pytest.mark.parametrize("far", [1e4, 1e6, 1e8, 1e12, 1e160, 1e300])
def test_a_far_coupler_point_leaves_the_rest_alone(far: float) -> None:
    """Beyond the range of lengths it is refused."""
    if far > 1e153:
        refused(
            assur.DimensionError, "coupler.P.x 1e", lambda: M.with_dimensions({"coupler.P.x": far})
        )
        return
    m = M.with_dimensions({"coupler.P.x": far})
    motion = m.solve(1.0, order=0, on_error="nan")
    assert m.solve(1.0).status <= Status.NEAR_SINGULAR
    np.testing.assert_allclose(motion.joint("C").value, M.solve(1.0).joint("C").value, rtol=1e-12)


def test_positions_out_of_reach() -> None:
    error = refused(assur.PositionError, "q = 3 C close m 1 3", lambda: APART.solve([0, 3, 3.1]))
    assert isinstance(error, ArithmeticError)
    assert (error.joint, error.q, error.design) == ("C", 3.0, None)
    motion = APART.solve([0, 3, 6.2], on_error="nan")
    assert motion.status.tolist() == [Status.OK, Status.UNREACHABLE, Status.OK]
    assert np.isnan(motion.joint("C").value[1]).all()
    assert motion.explain(1) in str(error)
    assert APART.assemblies(3.0) == []


# -- several drivers -----------------------------------------------------------------------------


@pytest.mark.parametrize("q", [1.0, [1.0, 2.0, 3.0], np.ones((2, 3))])
def test_two_drivers_need_two_coordinates(q: Any) -> None:
    refused(assur.InputError, "shape 2 drivers", lambda: TWO.solve(q))
    refused(assur.InputError, "2 drivers", lambda: TWO.assemblies(q))


def test_two_drivers() -> None:
    motion = TWO.solve(np.tile(np.asarray(TWO.q0), (4, 1)), order=3)
    c = motion.joint("C")
    assert [a.shape for a in (c.value, c.d1, c.d2, c.d3)] == [(4, 2) + (2,) * k for k in range(4)]
    refused(assur.InputError, "2 drivers", lambda: c.velocity(1.0))
    for ask in (motion.curvature, motion.instant_centre, motion.mechanical_advantage):
        refused(assur.InputError, "one driver 2", partial(ask, "l2"))
    error = refused(assur.PositionError, "3.1 C", lambda: TWO.solve([3.1, 0.0]))
    assert error.q == (3.1, 0.0)
    assert TWO.solve(np.ones((0, 2))).joint("C").d2.shape == (0, 2, 2, 2)


# -- arguments -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        *(({"order": order}, "order 3") for order in (-1, 4, True, 1.5, "2", None)),
        ({"on_error": "ignore"}, "on_error raise nan"),
        ({"outputs": "C"}, "outputs C list"),
        ({"outputs": ["C", "Q"]}, "outputs Q 'C' 'rocker'"),
        ({"assembly": {"X": 1}}, "assembly X C"),
        ({"assembly": {"C": 0}}, "assembly C 0 +1 -1"),
        ({"assembly": {"C": "x"}}, "assembly C x +1 -1"),
        ({"assembly": {"C": nan}}, "assembly C nan"),
    ],
)
def test_arguments_of_solve(arguments: dict[str, Any], words: str) -> None:
    refused(assur.InputError, words, lambda: M.solve(1.0, **arguments))


def test_arguments_that_are_fine() -> None:
    assert M.solve(1.0, order=np.int64(1)).order == 1  # type: ignore[arg-type]
    assert M.solve(1.0, outputs=[]).status == Status.OK
    only = M.solve(1.0, outputs=iter(["C", "C"]))
    error = refused(assur.InputError, "P outputs", lambda: only.joint("P"))
    assert error.joint == "P"


def test_assemblies_refuse_other_signs() -> None:
    error = refused(assur.InputError, "C 2 +1 -1", lambda: assur.Assembly({"C": 2}))
    assert error.joint == "C"


@pytest.mark.parametrize("ask", ["solve", "assemblies"])
def test_higher_classes_are_not_solved_yet(ask: str) -> None:
    triad = build(**TRIAD)
    refused(assur.AssurError, "III b1 plate class II", lambda: getattr(triad, ask)(triad.q0))


# -- questions to a motion -----------------------------------------------------------------------

MOTION = M.solve([0.0, 1.0, 2.0])


@pytest.mark.parametrize(
    ("kind", "name"),
    [("joint", "nope"), ("joint", "crank"), ("link", "couplr"), ("link", "C"), ("slide", "crank")],
)
def test_names_that_are_not_there(kind: str, name: str) -> None:
    error = refused(assur.InputError, f"{kind} {name}", lambda: getattr(MOTION, kind)(name))
    assert getattr(error, kind) == name


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: MOTION.joint("C").d3, "C order 2 3 d3"),
        (lambda: MOTION.joint("C").jerk(1.0), "C order 2 3"),
        (lambda: M.solve(1.0, order=0).joint("C").velocity(1.0), "C order 0 1"),
        (lambda: M.solve(1.0, order=1).curvature("C"), "C order 1 2"),
        (lambda: MOTION.joint("C").velocity([1.0, 2.0]), "(2,) (3,)"),
        (lambda: MOTION.curvature("Z"), "Z"),
        (lambda: MOTION.instant_centre("coupler", "rockr"), "rockr rocker"),
        (lambda: MOTION.mechanical_advantage("rockr"), "rockr rocker"),
        (lambda: MOTION.transmission_angle("P"), "P between"),
        (lambda: MOTION.transmission_angle("Z"), "Z"),
        (lambda: MOTION.transmission_angle("C", between=("B", "Z")), "Z"),
        (lambda: MOTION.transmission_angle("C", between=("C", "B")), "C"),
        (lambda: MOTION.transmission_angle("C", between=("B", "D", "A")), "between"),  # type: ignore[arg-type]
        (lambda: M.assemblies("x"), "q x"),
        (lambda: M.assemblies([1.0, 2.0]), "(2,)"),
        (lambda: M.plot([1.0, 2.0]), "one"),  # type: ignore[arg-type]
    ],
)
def test_questions_refused(ask: Callable[[], object], words: str) -> None:
    refused(assur.InputError, words, ask)


@pytest.mark.parametrize("index", [3, -4, (0, 0), (), 1.0, True, None, 10**30])
def test_indices_out_of_range(index: Any) -> None:
    refused(assur.InputError, "index (3,)", lambda: MOTION.explain(index))
    refused(assur.InputError, "index (3,)", lambda: MOTION.coordinate(index))


# -- values that do not change -------------------------------------------------------------------


def test_results_are_read_only() -> None:
    pickled = pickle.loads(pickle.dumps(MOTION))
    for motion in (MOTION, pickled, copy.deepcopy(MOTION)):
        c = motion.joint("C")
        for array in (c.value, c.d2, motion.q, motion.status, motion.residual, motion.condition):
            assert not array.flags.writeable
            assert array.flags.c_contiguous


@pytest.mark.parametrize("m", [M, BATCH, TWO, APART, assur.SliderCrank(1, 3)])
def test_mechanisms_are_values(m: assur.Mechanism) -> None:
    for other in (pickle.loads(pickle.dumps(m)), copy.copy(m), copy.deepcopy(m)):
        assert other == m
        assert hash(other) == hash(m)
        assert other.structure == m.structure
    assert m != 3
    for name in ("joints", "driver", "structure", "anything"):
        with pytest.raises(AttributeError):
            setattr(m, name, 1)
    with pytest.raises(TypeError):
        m.joints["A"] = (1, 1)  # type: ignore[index]


def test_errors_are_pickled_with_their_fields() -> None:
    error = refused(assur.PositionError, "C", lambda: APART.solve(3.0))
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert (str(again), again.__dict__) == (str(error), error.__dict__)
