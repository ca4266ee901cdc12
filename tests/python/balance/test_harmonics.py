"""Harmonics of shaking forces against closed forms and NumPy's transform."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, balance

N = 64
TURN = np.arange(N) * (math.tau / N)


def test_slider_crank() -> None:
    """The printed series of the piston's force: 4 n² A_2n of cos 2nq, a rod of three cranks."""
    machine = assur.Machine(assur.SliderCrank(1.0, 3.0), bodies={"piston": Body(mass=1.0)})
    force = machine.reactions(TURN, 1.0).shaking_force
    found = balance.harmonics(TURN, force[:, 0], count=8)
    wanted = [1.0, 0.343108577285, -0.0100990791524, 3.34432153297e-4]
    np.testing.assert_allclose(found.cosine[[1, 2, 4, 6]], wanted, rtol=6e-12)
    assert np.abs(found.cosine[[0, 3, 5, 7]]).max() < 1e-15
    assert np.abs(found.sine).max() < 1e-15
    np.testing.assert_allclose(found.amplitude[[1, 2, 4, 6]], np.abs(wanted), rtol=6e-12)
    np.testing.assert_allclose(found.phase[[1, 2, 4, 6]], [0, 0, math.pi, 0], atol=1e-11)


@pytest.mark.parametrize("n", [1, 2, 7, 30])
@pytest.mark.parametrize("start", [0.0, 2.5, -40.0])
def test_any_series(n: int, start: float) -> None:
    """Batches of noise, from any start, forward and backward, against NumPy's transform."""
    rng = np.random.default_rng(n)
    count = (n - 1) // 2
    values = rng.normal(size=(3, 2, n))
    spectrum = np.fft.rfft(values)[..., : count + 1] / n * np.where(np.arange(count + 1), 2, 1)
    for sign in (1, -1):
        q = start + sign * np.arange(n) * (math.tau / n)
        found = balance.harmonics(q, values, count=count)
        turned = np.conj(spectrum) * np.exp(1j * np.arange(count + 1) * start * sign)
        shifted = turned.real + 1j * sign * turned.imag
        if n == 1:
            shifted = values.astype(complex)
        np.testing.assert_allclose(found.cosine, shifted.real, atol=1e-13)
        np.testing.assert_allclose(found.sine, shifted.imag, atol=1e-13)
        again = sum(
            found.amplitude[..., k, np.newaxis] * np.cos(k * q - found.phase[..., k, np.newaxis])
            for k in range(count + 1)
        )
        if n == 7:  # odd: nothing is left out
            np.testing.assert_allclose(again, values, atol=1e-13)


def test_rotating_parts() -> None:
    """The force is the sum of its rotating parts, for a batch of designs."""
    m = assur.FourBar(0.05, [0.15, 0.16], 0.12, 0.16)
    machine = assur.Machine(
        m,
        bodies={"coupler": Body(mass=1.2, inertia=3e-3, at=(0.08, 0.01)), "rocker": Body(mass=1.0)},
    )
    force = machine.reactions(TURN + 0.3, 20.0).shaking_force
    parts = balance.rotating_parts(TURN + 0.3, force, count=31)
    turn = np.arange(32) * (TURN[:, np.newaxis] + 0.3)
    ahead, back = (
        (size * np.exp(1j * angle))[:, np.newaxis, :]
        for size, angle in (
            (parts.forward, parts.forward_angle),
            (parts.backward, parts.backward_angle),
        )
    )
    whole = (ahead * np.exp(1j * turn) + back * np.exp(-1j * turn)).sum(axis=-1)
    assert parts.forward.shape == (2, 32)
    tiny = 1e-12 * np.abs(force).max()
    np.testing.assert_allclose(np.stack([whole.real, whole.imag], -1), force, atol=tiny)
    assert (parts.backward[:, 0] == 0.0).all()


def test_one_weight_rotates_forward_only() -> None:
    crank = assur.SliderCrank(0.1, 0.3)
    for turn, speed in ((TURN, 7.0), (-TURN, -7.0)):
        machine = assur.Machine(
            crank, bodies={"crank": Body(mass=2.0, inertia=0.0, at=(0.0, 0.05))}
        )
        parts = balance.rotating_parts(turn, machine.reactions(turn, speed).shaking_force, count=3)
        np.testing.assert_allclose(parts.forward, [0.0, 4.9, 0.0, 0.0], atol=1e-14)
        assert parts.backward.max() < 1e-14
        assert parts.forward_angle[1] == pytest.approx(math.pi / 2)


def test_a_design_without_a_motion_is_nan() -> None:
    values = np.ones((2, N))
    values[1, 3] = math.nan
    found = balance.harmonics(TURN, values, count=2)
    np.testing.assert_allclose(found.cosine, [[1.0, 0.0, 0.0], [math.nan] * 3], atol=1e-15)
    force = np.ones((2, N, 2))
    force[0, 5, 1] = math.inf
    parts = balance.rotating_parts(TURN, force, count=1)
    assert np.isnan(parts.forward[0]).all()
    assert np.isfinite(parts.forward[1]).all()


ONES = np.ones(N)


@pytest.mark.parametrize(
    ("q", "values", "count", "said"),
    [
        (np.linspace(0.0, math.tau, N), ONES, 2, "leave out its end"),
        (TURN[:-1], ONES[:-1], 2, "63 even steps"),
        (TURN * 2, ONES, 2, "even steps"),
        (TURN**2 / 6, ONES, 2, "even steps"),
        (np.degrees(TURN), ONES, 2, "even steps"),
        (TURN, ONES[:-1], 2, "63"),
        (TURN, 1.0, 2, "shape"),
        (TURN, ONES, 32, "more than 64"),
        (TURN, ONES, -1, "count"),
        (TURN, ONES, 1.5, "count"),
        (TURN, ONES, True, "count"),
        (TURN, np.full(N, math.nan), 2, "nan"),
        (TURN, np.full(N, math.inf), 2, "inf"),
        (TURN, np.full(N, 1e308), 2, "greatest number"),
        (TURN, np.ones((0, N)), 2, "finite"),
        (TURN, "high", 2, "high"),
        ([], [], 0, "shape"),
        (0.0, ONES, 2, "shape"),
        ([math.nan] * N, ONES, 2, "nan"),
    ],
)
def test_refusals(q: Any, values: Any, count: Any, said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        balance.harmonics(q, values, count=count)
    if np.shape(values) == (N,):
        with pytest.raises(assur.InputError, match=said):
            balance.rotating_parts(q, np.stack([values, values], -1), count=count)


@pytest.mark.parametrize("force", [np.ones((N, 3)), ONES, np.ones((2, N)), 1.0])
def test_forces_have_two_components(force: Any) -> None:
    with pytest.raises(assur.InputError, match="force has the shape"):
        balance.rotating_parts(TURN, force)
