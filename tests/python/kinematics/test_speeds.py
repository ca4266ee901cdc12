"""Speeds and motions broadcast by NumPy's rules, whatever axes each has."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import assur
from assur import Analogues
from models.errors.refusals import refused

# One letter for each driver's axis of an einsum.
AXES = "ijk"


def contracted(derivative: Any, speeds: list[Any], shape: tuple[int, ...], is_point: bool) -> Any:
    """Σ d…ᵢⱼ wᵢ wⱼ, by einsum over every index of the common shape."""
    tail = (2,) if is_point else ()
    orders = len(speeds)
    inner = derivative.shape[derivative.ndim - orders :]
    own = np.broadcast_to(derivative, (*shape, *tail, *inner))
    wide = [np.broadcast_to(speed, (*shape, speed.shape[-1])) for speed in speeds]
    rule = AXES[:orders] + "," + ",".join(AXES[:orders])
    found = np.empty((*shape, *tail))
    for place in itertools.product(*map(range, shape)):
        for part in itertools.product(*map(range, tail)):
            here = [speed[place] for speed in wide]
            found[(*place, *part)] = np.einsum(rule, own[(*place, *part)], *here)
    return found


@st.composite
def shapes_that_fit(draw: st.DrawFn, count: int) -> list[tuple[int, ...]]:
    """Shapes that broadcast together: 0 to 3 axes, sizes of 0 and 1 among them."""
    whole = draw(st.lists(st.sampled_from([0, 1, 2, 3]), max_size=3))
    shapes = []
    for _ in range(count):
        length = draw(st.integers(0, len(whole)))
        own = whole[len(whole) - length :]
        shapes.append(tuple(1 if draw(st.booleans()) else size for size in own))
    return shapes


@given(st.data(), st.sampled_from([1, 2, 3]), st.booleans(), st.integers(0, 2**32 - 1))
def test_speeds_broadcast_against_motions(
    data: st.DataObject, drivers: int, is_point: bool, seed: int
) -> None:
    motion, *given_shapes = data.draw(shapes_that_fit(4))
    rng = np.random.default_rng(seed)
    tail = (2,) if is_point else ()
    inner = [(drivers,) * order if drivers > 1 else () for order in range(4)]
    arrays = tuple(rng.normal(size=(*motion, *tail, *axes)) for axes in inner)
    last = (drivers,) if drivers > 1 else ()
    omega, alpha, beta = (rng.normal(size=(*shape, *last)) for shape in given_shapes)
    quantity = Analogues("x", arrays, drivers, is_point)

    # The oracle has an axis of drivers always, and each speed all the axes of the result.
    d1, d2, d3 = (
        a if drivers > 1 else a.reshape(a.shape + (1,) * k) for k, a in enumerate(arrays[1:], 1)
    )
    w, a, b = (x if drivers > 1 else x[..., np.newaxis] for x in (omega, alpha, beta))

    def expected(*speeds: Any) -> Any:
        return np.broadcast_shapes(motion, *(speed.shape[:-1] for speed in speeds))

    def close(found: Any, terms: list[tuple[float, Any, list[Any]]], shape: Any) -> None:
        assert found.shape == (*shape, *tail)
        exact = sum(f * contracted(d, speeds, shape, is_point) for f, d, speeds in terms)
        np.testing.assert_allclose(found, exact, rtol=1e-13, atol=1e-13)

    close(quantity.velocity(omega), [(1.0, d1, [w])], expected(w))
    close(quantity.acceleration(omega, alpha), [(1.0, d2, [w, w]), (1.0, d1, [a])], expected(w, a))
    terms = [(1.0, d3, [w, w, w]), (3.0, d2, [w, a]), (1.0, d1, [b])]
    close(quantity.jerk(omega, alpha, beta), terms, expected(w, a, b))


@pytest.mark.parametrize("name", ["joint", "link"])
def test_several_speeds_at_one_position_are_that_position_solved_for_each(name: str) -> None:
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0, order=3)
    one = motion.joint("C") if name == "joint" else motion.link("rocker")
    speeds = np.array([1.0, 2.0, 3.0])
    for together, single in (
        (one.velocity(speeds), one.velocity),
        (one.acceleration(speeds, speeds), lambda w: one.acceleration(w, w)),
        (one.jerk(speeds, speeds, speeds), lambda w: one.jerk(w, w, w)),
    ):
        each = np.stack([single(float(w)) for w in speeds])
        assert together.tobytes() == each.tobytes()


def test_a_batch_takes_speeds_of_more_axes() -> None:
    designs = assur.FourBar(1.0, np.array([3.0, 3.1]), 2.5, 3.0)
    pin = designs.solve([0.5, 1.0, 1.5], order=3).joint("C")
    for shape in ((5, 1, 1), (5, 2, 3), (2, 1), (1, 3), (4, 5, 2, 1)):
        omega = np.linspace(1.0, 2.0, int(np.prod(shape))).reshape(shape)
        whole = (*np.broadcast_shapes((2, 3), shape), 2)
        wide = np.broadcast_to(omega, whole[:-1])[..., np.newaxis]
        np.testing.assert_allclose(pin.acceleration(omega), pin.d2 * wide**2, rtol=1e-15)
        np.testing.assert_allclose(pin.jerk(omega), pin.d3 * wide**3, rtol=1e-15)


def test_speeds_that_do_not_fit_are_named() -> None:
    pin = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.5, 1.0, 1.5]).joint("C")
    refused(assur.InputError, "speed (2,) broadcast (3,)", lambda: pin.velocity([1.0, 2.0]))
    two = np.ones((2, 1)), np.ones((4, 1))
    refused(assur.InputError, "speed acceleration (2, (4, (3,)", lambda: pin.acceleration(*two))
    words: Any = ["fast"]
    refused(assur.InputError, "acceleration fast", lambda: pin.acceleration(1.0, words))
