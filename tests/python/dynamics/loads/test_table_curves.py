"""The curve of a table: by default nowhere beyond the rows on its two sides."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

import assur
from assur import Table

TURN = 2.0 * np.pi
SEEDS = range(40)


def rows(rng: np.random.Generator, count: int) -> tuple[Any, Any]:
    """Coordinates, and values among them level ones, corners and spikes."""
    q = np.cumsum(rng.uniform(0.05, 1.0, count) * 10.0 ** rng.integers(-2, 2, count))
    value = rng.choice([0.0, 0.0, 1.0, -3.0, 1e6, 1e-6], count) * rng.uniform(0.5, 1.5, count)
    return q, value


def between(table: Table, parts: int = 33) -> tuple[Any, Any, Any]:
    """Values inside each piece, and the rows at its ends."""
    keep = np.diff(table.q) > 0.0
    low, wide = table.q[:-1][keep], np.diff(table.q)[keep]
    x = low[:, None] + wide[:, None] * np.linspace(0.0, 1.0, parts, endpoint=False)[1:]
    return table.at(x), table.value[:-1][keep], table.value[1:][keep]


def stays_between(table: Table) -> bool:
    found, left, right = between(table)
    slack = 4e-16 * np.abs(table.value).max()
    low, high = np.minimum(left, right) - slack, np.maximum(left, right) + slack
    return bool(((found >= low[:, None]) & (found <= high[:, None])).all())


def test_a_force_with_corners_is_not_exceeded() -> None:
    q, force = [0.0, 4.0, 5.0, 5.5, 6.0, 6.28], [0.0, 0.0, 5e5, 1e6, 0.0, 0.0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        table = Table(q, force)
    assert table.at(1.0) == 0.0
    assert table.at(np.linspace(0.0, 6.28, 10_001)).max() <= 1e6
    assert table.at(np.linspace(0.0, 6.28, 10_001)).min() >= 0.0
    own = assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies={}, loads=[assur.Torque("crank", table)]
    )
    assert own.reduced_moment(1.0) == 0.0


@pytest.mark.parametrize("seed", SEEDS)
def test_as_scipy(seed: int) -> None:
    rng = np.random.default_rng(seed)
    q, value = rows(rng, int(rng.integers(2, 12)))
    x = rng.uniform(q[0], q[-1], 200)
    own = Table(q, value, periodic=False)
    other = PchipInterpolator(q, value)
    np.testing.assert_allclose(own.at(x), other(x), rtol=1e-10, atol=1e-14 * np.abs(value).max())
    assert stays_between(own)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_period_closes_smoothly(seed: int) -> None:
    """As SciPy's curve through several periods one after another."""
    rng = np.random.default_rng(seed)
    q, value = rows(rng, int(rng.integers(2, 12)))
    value[-1] = value[0]
    period = q[-1] - q[0]
    turns = [q[:-1] + k * period for k in range(-2, 3)]
    other = PchipInterpolator(np.concatenate(turns), np.tile(value[:-1], 5))
    x = rng.uniform(q[0], q[-1], 200)
    own = Table(q, value)
    np.testing.assert_allclose(own.at(x), other(x), rtol=1e-9, atol=1e-13 * np.abs(value).max())
    assert stays_between(own)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_jumps_part_the_curve(seed: int, periodic: bool) -> None:
    """A period's last section goes on into its first one."""
    rng = np.random.default_rng(seed)
    first, second = rows(rng, 5), rows(rng, 6)
    later = first[0][-1] + (second[0] - second[0][0])
    q = np.concatenate([first[0], later])
    value = np.concatenate([first[1], second[1]])
    if periodic:
        value[-1] = value[0]
    table = Table(q, value, periodic=periodic)
    x = rng.uniform(first[0][0], first[0][-1], 50), rng.uniform(later[0], later[-1], 50)
    if periodic:
        whole = np.concatenate([later, first[0][1:] - first[0][0] + later[-1]])
        both = PchipInterpolator(whole, np.concatenate([value[5:], first[1][1:]]))
        wanted = both(x[0] - first[0][0] + later[-1]), both(x[1])
    else:
        halves = PchipInterpolator(*first), PchipInterpolator(later, value[5:])
        wanted = halves[0](x[0]), halves[1](x[1])
    size = 1e-13 * np.abs(value).max()
    for at, other in zip(x, wanted, strict=True):
        np.testing.assert_allclose(table.at(at), other, rtol=1e-9, atol=size)
    assert stays_between(table)


@pytest.mark.parametrize("seed", SEEDS)
def test_monotone_rows_give_a_monotone_curve(seed: int) -> None:
    rng = np.random.default_rng(seed)
    q, value = rows(rng, 9)
    value = np.cumsum(np.abs(value))
    found = Table(q, value, periodic=False).at(np.linspace(q[0], q[-1], 2000))
    assert (np.diff(found) >= -4e-16 * value[-1]).all()


def test_a_jump_at_the_seam_ends_the_curve_there() -> None:
    own = Table([0.0, 0.0, 1.0, 2.0, 3.0], [1.0, 4.0, 3.0, 1.5, 1.0])
    x = np.linspace(0.0, 2.99, 100)
    other = PchipInterpolator([0.0, 1.0, 2.0, 3.0], [4.0, 3.0, 1.5, 1.0])
    np.testing.assert_allclose(own.at(x), other(x), rtol=1e-13)


def test_a_motor_has_no_more_torque_than_its_rows() -> None:
    speeds, torques = [0.0, 140.0, 150.0, 157.0], [60.0, 60.0, 55.0, 0.0]
    motor = Table(speeds, torques)
    curve = PchipInterpolator(speeds, torques)
    machine = assur.Machine.from_table(
        np.linspace(0.0, TURN, 9), np.zeros(9), np.ones(9), motor=motor
    )
    run = machine.run(t_end=2.0, speed0=0.0, rtol=1e-10)
    np.testing.assert_allclose(run.acceleration, curve(run.speed), rtol=1e-6, atol=1e-6)
    assert run.acceleration.max() <= 60.0 * (1.0 + 1e-12)


@pytest.mark.parametrize("spline", assur.flywheel.SPLINES)
def test_every_curve_is_there_by_name(spline: assur.flywheel.Spline) -> None:
    q = np.linspace(0.0, TURN, 25)
    value = 2.0 + np.cos(q)
    value[-1] = value[0]
    table = Table(q, value, spline=spline)
    assert table.spline == spline
    assert table.at(1.0) == pytest.approx(2.0 + np.cos(1.0), rel=2e-2)
    law = assur.laws.Tabulated(q, value, spline=spline)
    assert float(law.at(1.0)[0]) == pytest.approx(2.0 + np.cos(1.0), rel=2e-2)
    sized = assur.flywheel.from_table(q, value, fluctuation=0.1, mean_speed=10.0, spline=spline)
    exact = 2.0 / (100.0 * 0.1)
    assert sized.inertia == pytest.approx(exact, rel=2e-2)


def test_a_flywheel_of_a_table_keeps_its_cubic_spline() -> None:
    q = np.linspace(0.0, TURN, 9)
    moment = [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23]
    wanted: Any = {"fluctuation": 0.125, "mean_speed": 15.0}
    plain = assur.flywheel.from_table(q, moment, **wanted)
    named = assur.flywheel.from_table(q, moment, **wanted, spline="not-a-knot")
    other = assur.flywheel.from_table(q, moment, **wanted, spline="pchip")
    assert plain.inertia == named.inertia != other.inertia
