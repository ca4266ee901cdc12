"""Designs and positions chosen in brackets, against solving for them alone."""

from __future__ import annotations

import copy
import pickle
from functools import partial
from typing import Any, cast

import numpy as np
import pytest

import assur
from models.errors.refusals import refused

Q = np.linspace(0.1, 6.0, 9)


def batch() -> assur.Mechanism:
    """Designs of shape (3, 4); the last one of a row is no four-bar."""
    rocker = np.linspace(2.2, 2.8, 3)[:, None]
    coupler = np.array([2.9, 3.0, 3.1, -1.0])
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    return four_bar.with_dimensions({"rocker.length": rocker, "coupler.length": coupler})


def same(part: assur.Motion, wanted: assur.Motion) -> None:
    assert part.shape == wanted.shape
    np.testing.assert_array_equal(part.q, wanted.q)
    np.testing.assert_array_equal(part.status, wanted.status)
    for name in ("C", "rocker"):
        for order in ("value", "d1", "d2"):
            found = getattr(part[name], order)
            np.testing.assert_array_equal(found, getattr(wanted[name], order))
            assert not found.flags.writeable
    np.testing.assert_array_equal(part.condition, wanted.condition)
    np.testing.assert_array_equal(part.transmission_angle("C"), wanted.transmission_angle("C"))
    ours, theirs = (motion.sensitivity("rocker.length").joint("C") for motion in (part, wanted))
    np.testing.assert_array_equal(ours.d1, theirs.d1)


DESIGNS: list[Any] = [
    0,
    -1,
    slice(1, None),
    [2, 0],
    np.array([True, False, True]),
    (slice(None), 1),
]
DESIGNS += [(1, 2), ([0, 2], [1, 3, 0]), (..., slice(0, 2)), np.array([], dtype=int)]


@pytest.mark.parametrize("index", DESIGNS, ids=str)
def test_designs(index: Any) -> None:
    """The same designs as NumPy's indexing axis by axis, and their motion."""
    many = batch()
    some = many[index]
    entries = index if isinstance(index, tuple) else (index,)
    if entries[0] is Ellipsis:
        entries = (*entries, slice(None))
    rows = many.solve(Q, on_error="nan")
    same(rows[entries], some.solve(Q, on_error="nan"))
    assert rows[entries].mechanism == some


@pytest.mark.parametrize("position", [0, -2, slice(None, None, 3), [5, 1], Q > 3.0], ids=str)
def test_positions(position: Any) -> None:
    many = batch()
    rows = many.solve(Q, on_error="nan")
    same(rows[..., position], many.solve(Q[position], on_error="nan"))
    same(rows[1, :, position], many[1].solve(Q[position], on_error="nan"))
    same(rows[1, 2, position], many[1, 2].solve(Q[position], on_error="nan"))
    own = Q + np.linspace(0.0, 0.3, 12).reshape(3, 4, 1)
    rows = many.solve(own, on_error="nan")
    if not isinstance(position, int):
        same(rows[1:, :, position], many[1:].solve(own[1:][..., position], on_error="nan"))
    same(rows[2, 1, position], many[2, 1].solve(own[2, 1, position], on_error="nan"))


def test_a_batch_is_a_sequence() -> None:
    many = batch()
    assert len(many) == 3
    assert [one.shape for one in many] == [(4,)] * 3
    assert bool(many)
    assert bool(many[0, 0])
    mask = np.zeros((3, 4), dtype=bool)
    mask[0, 1] = mask[2, 2] = True
    assert [one == many[i] for one, i in zip(many[mask], [(0, 1), (2, 2)], strict=True)]
    with pytest.raises(TypeError, match="no length"):
        len(many[0, 0])
    motion = many[0].solve(Q, on_error="nan")
    assert len(motion) == 4
    assert [one.shape for one in motion] == [(9,)] * 4
    with pytest.raises(TypeError, match="no length"):
        len(many[0, 0].solve(0.5))


def test_a_part_is_a_motion() -> None:
    part = batch().solve(Q, on_error="nan")[0, :2, ::2]
    for other in (copy.copy(part), pickle.loads(pickle.dumps(part))):
        same(other, part)
    assert part.explain((0, 0)).startswith("at q = 0.1, the position is solved")
    refused(assur.InputError, "copy", partial(batch()[0, :2].solve, Q[::2], out=part))
    kept = assur.sweep(batch()[0], {"rocker.length": [2.5, 0.1, 2.6, 2.7]}, Q, on_error="drop")
    assert kept.kept is not None
    chosen = kept[1:].kept
    assert chosen is not None
    assert chosen.tolist() == kept.kept[1:].tolist()


def test_values_by_name() -> None:
    motion = assur.SliderCrank(1.0, 3.0).solve(Q)
    np.testing.assert_array_equal(np.asarray(motion["bore"]), motion.slide("bore").value)
    np.testing.assert_array_equal(motion["rod"], motion.link("rod").value)
    assert np.array(motion["rod"], dtype=np.float32).dtype == np.float32
    two = motion.joint(["A", "B"])
    assert two.value.shape == (2, 9, 2)
    np.testing.assert_array_equal(two.velocity(2.0)[1], motion.joint("B").velocity(2.0))
    np.testing.assert_array_equal(two.d2[0], motion.joint("A").d2)


def test_refusals() -> None:
    many, motion = batch(), batch().solve(Q, on_error="nan")
    refused(assur.InputError, "outside (3, 4)", partial(many.__getitem__, 3))
    refused(assur.InputError, "outside", partial(many.__getitem__, [0, 3]))
    refused(assur.InputError, "axes", partial(many.__getitem__, (0, 0, 0)))
    refused(assur.InputError, "mask", partial(many.__getitem__, np.ones(4, dtype=bool)))
    refused(assur.InputError, "slice", partial(many.__getitem__, cast("Any", 1.5)))
    refused(assur.InputError, "slice", partial(many.__getitem__, cast("Any", "coupler")))
    refused(assur.InputError, "one mechanism", partial(many[0, 0].__getitem__, 0))
    refused(assur.InputError, "slide has this name", partial(motion.__getitem__, "Z"))
    refused(assur.InputError, "outside", partial(motion.__getitem__, (0, 0, 9)))
    refused(assur.InputError, "name", partial(motion.joint, []))
    refused(assur.InputError, "Z", partial(motion.joint, ["C", "Z"]))
