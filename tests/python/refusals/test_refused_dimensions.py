"""Bad dimensions and designs: errors that name them, or a status for each design."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Status
from models.errors.refusals import BATCH, M, refused

if TYPE_CHECKING:
    from collections.abc import Callable

nan, inf = math.nan, math.inf


@pytest.mark.parametrize("value", [0, -0.0, -1, nan, inf, -inf])
def test_invalid_lengths_are_refused(value: float) -> None:
    def ask() -> object:
        return M.with_dimensions({"coupler.length": value})

    need = "positive" if math.isfinite(value) else "finite"
    words, name = f"coupler.length {need}", "coupler.length"
    error = refused(assur.DimensionError, words, ask, dimension=name, value=float(value))
    assert isinstance(error, ValueError)


@pytest.mark.parametrize("make", [assur.FourBar, assur.SliderCrank])
def test_named_mechanisms_refuse_bad_lengths(make: Callable[..., assur.Mechanism]) -> None:
    lengths: list[Any] = [1.0, 3.0, 2.5, 3.0] if make is assur.FourBar else [1.0, 3.0]
    names = ["crank.length", "coupler.length", "rocker.length", "ground.D.x"]
    if make is assur.SliderCrank:
        names = ["crank.length", "rod.length"]
    for place, name in enumerate(names):
        for bad in (0.0, -3.0, nan):
            with pytest.raises(assur.DimensionError) as caught:
                make(*lengths[:place], bad, *lengths[place + 1 :])
            assert caught.value.dimension == name
            np.testing.assert_equal(caught.value.value, bad)
    wrong: Any = "x"
    ask = lambda: assur.FourBar(1, 3, 2.5, 3, mode=wrong)  # noqa: E731
    refused(assur.InputError, "mode 'x' open crossed", ask)


def test_unknown_dimensions_name_the_nearest() -> None:
    refused(
        assur.InputError,
        "cupler.length coupler.length",
        lambda: M.with_dimensions({"cupler.length": 1}),
        dimension="cupler.length",
    )


@pytest.mark.parametrize(
    ("value", "words"),
    [
        *((value, "real numbers") for value in ("x", 1 + 2j, np.array([1 + 2j]))),
        *((value, "number array of numbers") for value in ([[1, 2], [3]], 10**400)),
    ],
)
def test_non_numeric_dimensions_are_refused(value: Any, words: str) -> None:
    refused(
        assur.InputError,
        f"coupler.length {words}",
        lambda: M.with_dimensions({"coupler.length": value}),
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
    assert '"C" cannot be assembled' in motion.explain((6, 0))


def test_the_first_bad_design_is_named_and_the_rest_counted() -> None:
    refused(
        assur.DimensionError,
        "(1,) coupler.length NaN 9 14",
        lambda: BATCH.solve([0.0, 1.0]),
        design=(1,),
        dimension="coupler.length",
        q=0.0,
        value=nan,
    )


@pytest.mark.parametrize("index", [7, -8, (0, 0), (), 1.5, "0", True, slice, 10**30])
def test_designs_that_are_not_there(index: Any) -> None:
    index = np.s_[0:2] if index is slice else index
    refused(assur.InputError, f"design {index!r} (7,)", lambda: BATCH.design(index))


def test_designs_that_are_there() -> None:
    assert BATCH.design(-2) == BATCH.design(5) == BATCH.design(np.int64(5))  # type: ignore[arg-type]
    name = "coupler.length"
    refused(assur.DimensionError, f"{name} NaN", lambda: BATCH.design(1), dimension=name, value=nan)
    refused(assur.InputError, "configuration_curve (7,)", BATCH.configuration_curve)


def test_an_empty_batch() -> None:
    motion = M.with_dimensions({"coupler.length": []}).solve([1.0, 2.0])
    assert motion.joint("C").value.shape == (0, 2, 2)
