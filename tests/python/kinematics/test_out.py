"""A motion written over another: the same numbers in the same memory."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import assur

Q = np.linspace(0, 2 * np.pi, 50)


def batch(shift: float = 0.0) -> assur.Mechanism:
    lengths = np.linspace(2.9, 3.1, 40) + shift
    return assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"coupler.length": lengths})


def everything(motion: assur.Motion) -> list[Any]:
    tracks = [motion.joint(j) for j in motion.mechanism.joints]
    tracks += [motion.link(link) for link in motion.mechanism.links]
    return [motion.status, *(a for t in tracks for a in (t.value, t.d1, t.d2))]


def test_the_numbers_and_the_object_are_those_of_the_call() -> None:
    first = batch().solve(Q)
    second, q = batch(0.05), Q + 0.1
    fresh = second.solve(q)
    over = second.solve(q, out=first)
    assert over is first
    assert over.mechanism is second
    np.testing.assert_array_equal(over.q, q)
    for a, b in zip(everything(over), everything(fresh), strict=True):
        np.testing.assert_array_equal(a, b)
    assert over.residual.max() < 1e-14


def test_no_new_memory() -> None:
    motion = batch().solve(Q)
    before = [a.__array_interface__["data"][0] for a in everything(motion)]
    batch(0.05).solve(Q, out=motion)
    after = [a.__array_interface__["data"][0] for a in everything(motion)]
    assert before == after
    assert not motion.joint("C").value.flags.writeable


def test_rows_begin_with_a_line_of_the_cache() -> None:
    for array in everything(batch().solve(Q))[1:]:
        assert array.__array_interface__["data"][0] % 64 == 0


def test_unreachable_positions_are_nan_again() -> None:
    motion = batch().solve(Q)
    rocker = assur.FourBar(3.0, 1.0, 2.5, 3.0).with_dimensions({"coupler.length": np.ones(40)})
    rocker.solve(Q, on_error="nan", out=motion)
    bad = motion.status == assur.Status.UNREACHABLE
    assert bad.any()
    assert not bad.all()
    assert np.isnan(motion.joint("C").value[bad]).all()
    assert np.isfinite(motion.joint("C").value[~bad]).all()


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"q": Q[:-1]}, r"shape \(40, 50\), this call needs \(40, 49\)"),
        ({"order": 1}, "order 2, this call needs 1"),
        ({"outputs": ["C", "rocker"]}, r"joints \['A', 'B', 'C', 'D'\]"),
        ({"outputs": ["A", "B", "C", "D", "coupler", "rocker"]}, "out has links"),
        ({"out": "motion"}, "a motion is needed"),
    ],
)
def test_motions_that_do_not_fit_are_refused(change: dict[str, Any], sentence: str) -> None:
    motion = batch().solve(Q)
    kept = [a.copy() for a in everything(motion)]
    arguments: dict[str, Any] = {"q": Q, "out": motion} | change
    with pytest.raises(assur.InputError, match=sentence):
        batch(0.1).solve(**arguments)
    for a, b in zip(everything(motion), kept, strict=True):
        np.testing.assert_array_equal(a, b)


def test_a_copy_is_not_overwritten() -> None:
    motion = batch().solve(Q)
    for other in (pickle.loads(pickle.dumps(motion)), copy.deepcopy(motion), copy.copy(motion)):
        with pytest.raises(assur.InputError, match="a copy cannot be overwritten"):
            batch().solve(Q, out=other)


def test_scalars_and_single_mechanisms() -> None:
    one = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    motion = one.solve(1.0)
    again = one.solve(2.0, out=motion)
    assert again.joint("C").value.shape == (2,)
    np.testing.assert_array_equal(again.joint("C").value, one.solve(2.0).joint("C").value)
