"""Bad arguments of solve and bad questions to a motion: named errors."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Status
from refusals import MOTION, M, refused

if TYPE_CHECKING:
    from collections.abc import Callable

nan, inf = math.nan, math.inf


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


# -- questions to a motion -----------------------------------------------------------------------


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
