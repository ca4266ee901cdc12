"""Bad arguments of solve and of a motion's methods: errors that name them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Status
from models.errors.refusals import MOTION, M, refused

if TYPE_CHECKING:
    from collections.abc import Callable

nan, inf = math.nan, math.inf


# -- arguments -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        *(({"order": o}, f"order {o!r} 0, 1, 2 3") for o in (-1, 4, True, 1.5, "2", None)),
        ({"on_error": "ignore"}, "on_error 'ignore' 'raise' 'nan'"),
        ({"outputs": "C"}, "outputs='C' list ['C']"),
        ({"outputs": ["C", "Q"]}, "outputs 'Q' 'C' 'rocker'"),
        ({"assembly": {"X": 1}}, "assembly 'X' 'C'"),
        ({"assembly": {"C": 0}}, "assembly['C'] 0 +1 -1"),
        ({"assembly": {"C": "x"}}, "assembly['C'] 'x' +1 -1"),
        ({"assembly": {"C": nan}}, "assembly['C'] nan +1 -1"),
    ],
)
def test_arguments_of_solve(arguments: dict[str, Any], words: str) -> None:
    refused(assur.InputError, words, lambda: M.solve(1.0, **arguments))


def test_arguments_that_are_fine() -> None:
    assert M.solve(1.0, order=np.int64(1)).order == 1  # type: ignore[arg-type]
    assert M.solve(1.0, outputs=[]).status == Status.OK
    only = M.solve(1.0, outputs=iter(["C", "C"]))
    refused(assur.InputError, "P outputs", lambda: only.joint("P"), joint="P")


def test_assemblies_refuse_other_signs() -> None:
    refused(assur.InputError, "C 2 +1 -1", lambda: assur.Assembly({"C": 2}), joint="C")


def test_refusals_say_what_to_ask_instead() -> None:
    five = assur.examples.five_bar()
    refused(assur.InputError, "drop assur.sweep", lambda: M.solve(1.0, on_error="drop"))  # type: ignore[arg-type]
    refused(assur.InputError, "2 workspace()", five.limits)
    batch = M.with_dimensions({"rocker.length": [3.2, 3.3]})
    refused(assur.InputError, "design(i) assur.sweep", lambda: batch.extremes("rocker"))
    rocker = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    words = "assembled limits() configuration_curve().motion()"
    error = refused(assur.PositionError, words, lambda: rocker.solve(2.0), q=2.0)
    assert str(error).endswith(f"; {error.hint}")
    # It goes past the dead point, which is where limits() has it.
    _, high = rocker.limits().intervals[0]
    assert rocker.configuration_curve().motion().q.max() == pytest.approx(high, abs=1e-9)
    loom = assur.examples.loom().with_driver("l95")
    words = "with_driver configuration_curve().motion()"
    error = refused(assur.PositionError, words, lambda: loom.solve(loom.q0 + 2.0))
    assert str(error).endswith(f"; {error.hint}")
    # Of a design that closes nowhere there is no curve.
    with pytest.raises(assur.PositionError, match=r"by 4\.5 m$"):
        assur.FourBar(1.0, 9.0, 2.5, 3.0).solve(0.0)
    # A curve is of one design.
    with pytest.raises(assur.PositionError) as caught:
        rocker.with_dimensions({"rocker.length": [2.0, 2.1]}).solve(2.0)
    assert "configuration_curve" not in str(caught.value)
    machine = assur.Machine(rocker, bodies={"crank": assur.Body(inertia=1.0)})
    ran = machine.run(1.0, 0.0, 10.0)
    assert "another driver (with_driver)" in ran.message


# -- methods of a motion --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "name"),
    [("joint", "nope"), ("joint", "crank"), ("link", "couplr"), ("link", "C"), ("slide", "crank")],
)
def test_names_that_are_not_there(kind: str, name: str) -> None:
    words = f'no {kind} "{name}"'
    refused(assur.InputError, words, lambda: getattr(MOTION, kind)(name), **{kind: name})


@pytest.mark.parametrize(
    ("ask", "words", "fields"),
    [
        (lambda: MOTION.joint("C").d3, "'C' order 2 order=3 d3", {}),
        (lambda: MOTION.joint("C").jerk(1.0), "'C' order 2 order=3 d3", {}),
        (lambda: M.solve(1.0, order=0).joint("C").velocity(1.0), "'C' order 0 order=1 d1", {}),
        (lambda: M.solve(1.0, order=1).curvature("C"), "'C' order 1 order=2 d2", {}),
        (lambda: MOTION.joint("C").velocity([1.0, 2.0]), "speed (2,) broadcast (3,)", {}),
        (lambda: MOTION.curvature("Z"), 'no joint "Z"', {"joint": "Z"}),
        (
            lambda: MOTION.instant_centre("coupler", "rockr"),
            'no link "rockr" "rocker"',
            {"link": "rockr"},
        ),
        (
            lambda: MOTION.mechanical_advantage("rockr"),
            'no link "rockr" "rocker"',
            {"link": "rockr"},
        ),
        (
            lambda: MOTION.transmission_angle("P"),
            "'P' alone between=(joint, joint)",
            {"joint": "P", "link": "coupler"},
        ),
        (lambda: MOTION.transmission_angle("Z"), 'no joint "Z"', {"joint": "Z"}),
        (
            lambda: MOTION.transmission_angle("C", between=("B", "Z")),
            'no joint "Z"',
            {"joint": "Z"},
        ),
        (
            lambda: MOTION.transmission_angle("C", between=("C", "B")),
            "between=('C', 'B') two joints neither",
            {"joint": "C"},
        ),
        (
            lambda: MOTION.transmission_angle("C", between=("B", "D", "A")),  # type: ignore[arg-type]
            "between=('B', 'D', 'A') two joints",
            {"joint": "C"},
        ),
        (lambda: M.assemblies("x"), "q 'x' real numbers", {}),
        (lambda: M.plot(labels="both"), "labels 'both' first all none", {}),  # type: ignore[arg-type]
    ],
)
def test_questions_refused(
    ask: Callable[[], object], words: str, fields: dict[str, object]
) -> None:
    refused(assur.InputError, words, ask, **fields)


@pytest.mark.parametrize("index", [3, -4, (0, 0), (), 1.0, True, None, 10**30])
def test_indices_out_of_range(index: Any) -> None:
    refused(assur.InputError, f"index {index!r} (3,)", lambda: MOTION.explain(index))
    refused(assur.InputError, f"index {index!r} (3,)", lambda: MOTION.coordinate(index))
