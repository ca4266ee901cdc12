"""Counterweights by least squares, against SciPy and closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import lsq_linear

import assur
from assur import Body, balance
from assur.balance.bounded import bounded_least_squares

TURN = np.arange(60) * (math.tau / 60)
INF = math.inf


@pytest.mark.parametrize("seed", range(40))
def test_bounded_least_squares(seed: int) -> None:
    """The same as SciPy's, or better; of dependent columns the same residual."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 12))
    rows = int(rng.integers(1, 30))
    matrix = rng.normal(size=(rows, n)) * 10.0 ** rng.uniform(-4, 4, n)
    independent = rows >= n and rng.random() < 0.7
    if not independent and n > 2:
        matrix[:, -1] = -2.0 * matrix[:, 0]
    right = rng.normal(size=rows)
    size = 1.0 / np.linalg.norm(matrix, axis=0)
    lower, upper = -size * rng.exponential(size=n), size * rng.exponential(size=n)
    shift = size * rng.normal(size=n)
    lower, upper = lower + shift, upper + shift
    lower[rng.random(n) < 0.3] = -INF
    upper[rng.random(n) < 0.3] = INF
    found = bounded_least_squares(matrix, right, lower, upper)
    assert (found >= lower).all()
    assert (found <= upper).all()
    known = lsq_linear(
        matrix / np.linalg.norm(matrix, axis=0), right, (lower / size, upper / size), "bvls"
    )
    left = np.linalg.norm(matrix @ found - right)
    best = math.sqrt(2.0 * known.cost)
    assert left <= best * (1 + 1e-9) + 1e-12
    if independent and known.success:
        assert left >= best * (1 - 1e-9) - 1e-12
    # Karush, Kuhn and Tucker: no step within the bounds helps.
    slope = (matrix.T @ (right - matrix @ found)) * size
    tiny = 1e-12 * np.linalg.norm(right)
    assert (slope[found < upper] <= tiny).all()
    assert (slope[found > lower] >= -tiny).all()


@pytest.mark.parametrize("size", [1e-310, 1e-160, 1.0, 1e160, 1e305])
@pytest.mark.parametrize("right_size", [1e-310, 1e-160, 1.0, 1e160, 1e305])
def test_sizes_of_any_order(size: float, right_size: float) -> None:
    """Scaled by powers of two: no number overflows on the way."""
    matrix = np.array([[3.0, 1.0], [1.0, -2.0], [0.5, 0.25]]) * size
    right = np.array([1.0, 2.0, 3.0]) * right_size
    ratio = 10.0 ** np.clip(np.log10(right_size) - np.log10(size), -300, 300)
    bounds = np.array([-INF, 0.0]), np.array([INF, 0.1 * ratio])
    found = bounded_least_squares(matrix, right, *bounds)
    assert not np.isnan(found).any()
    if 1e-300 < ratio < 1e300 and size > 1e-300 < right_size:
        known = lsq_linear(matrix / size, right / right_size, (bounds[0], [INF, 0.1]), "bvls").x
        np.testing.assert_allclose(found / ratio, known, rtol=1e-10, atol=1e-12)


def four_bar() -> assur.Machine:
    bodies = {
        "crank": Body(mass=0.5, inertia=2e-4, at=(0.02, 0.006)),
        "coupler": Body(mass=1.2, inertia=3e-3, at=(0.08, 0.012)),
        "rocker": Body(mass=0.8, inertia=1.5e-3, at=(0.06, -0.012)),
    }
    return assur.Machine(assur.FourBar(0.05, 0.15, 0.12, 0.16), bodies=bodies)


def force(machine: assur.Machine) -> Any:
    return machine.reactions(TURN, 20.0, 3.0).shaking_force


def test_free_moments_are_the_closed_form() -> None:
    """With nothing that limits it, the fit is Berkof and Lowen's full balance."""
    machine = four_bar()
    free = {"crank": balance.MomentBounds(), "rocker": balance.MomentBounds()}
    found = balance.fit(machine, TURN, free, 20.0, 3.0)
    for one, known in zip(found, balance.four_bar(machine), strict=True):
        assert one.moment == pytest.approx(known.moment, rel=1e-11)
        assert one.angle == pytest.approx(known.angle, abs=1e-11)
    after = machine.with_counterweights(one.with_radius(0.05) for one in found)
    assert np.abs(force(after)).max() <= 1e-12 * np.abs(force(machine)).max()


def test_points_around_the_pivots() -> None:
    """Masses at corners: full balance is within them, by masses that are not negative."""
    machine = four_bar()
    corners: Any = [(-0.05, -0.05), (-0.05, 0.05), (0.05, -0.05), (0.05, 0.05)]
    found = balance.fit(machine, TURN, {"crank": corners, "rocker": np.array(corners)}, 20.0, 3.0)
    assert len(found) == 8
    assert all((one.mass or 0.0) >= 0.0 for one in found)
    after = machine.with_counterweights(found)
    assert np.abs(force(after)).max() <= 1e-12 * np.abs(force(machine)).max()


@pytest.mark.parametrize("moment_weight", [0.0, 8.0])
@pytest.mark.parametrize("most", [INF, 0.3, {"crank": 0.2, "rocker": 0.0}])
def test_points_against_scipy(most: Any, moment_weight: float) -> None:
    """Columns from point masses written as their accelerations, on three links."""
    machine = four_bar()
    m = machine.mechanism
    assert m is not None
    points: dict[str, list[tuple[float, float]]] = {
        "crank": [(-0.04, 0.01)],
        "coupler": [(-0.05, 0.0), (0.03, 0.08)],
        "rocker": [(-0.06, 0.0), (0.0, -0.05)],
    }
    motion = m.solve(TURN, order=2)
    columns, greatest = [], []
    for link, listed in points.items():
        joint, angle = motion.joint(m.links[link][0]), motion.link(link)
        spin, second = angle.velocity(20.0), angle.acceleration(20.0, 3.0)
        for x, y in listed:
            arm = (x + 1j * y) * np.exp(1j * angle.value)
            place = joint.value @ [1, 1j] + arm
            away = joint.acceleration(20.0, 3.0) @ [1, 1j] + (1j * second - spin**2) * arm
            moment = (np.conj(place) * away).imag
            columns.append(-np.concatenate([away.real, away.imag, moment_weight * moment]))
            greatest.append(most.get(link, INF) if isinstance(most, dict) else most)
    before = machine.reactions(TURN, 20.0, 3.0)
    right = np.concatenate([*before.shaking_force.T, moment_weight * before.shaking_moment])
    limits = np.zeros(5), np.maximum(greatest, 1e-300)
    known = lsq_linear(np.transpose(columns), -right, limits, "bvls", tol=1e-15)
    found = balance.fit(machine, TURN, points, 20.0, 3.0, most=most, moment_weight=moment_weight)
    masses = np.array([one.mass for one in found], float)
    np.testing.assert_allclose(masses, known.x, rtol=1e-9, atol=1e-12)
    # and each is where it was asked for
    for one, (x, y) in zip(found, (p for listed in points.values() for p in listed), strict=True):
        if one.mass:
            assert one.radius == pytest.approx(math.hypot(x, y))
            assert one.angle == pytest.approx(math.atan2(y, x))
    after = machine.with_counterweights(found).reactions(TURN, 20.0, 3.0)
    left = np.concatenate([*after.shaking_force.T, moment_weight * after.shaking_moment])
    assert np.linalg.norm(left) == pytest.approx(math.sqrt(2 * known.cost), rel=1e-9)


@pytest.mark.parametrize("ratio", [1.5, 3.0, 10.0])
def test_half_the_piston_is_the_best(ratio: float) -> None:
    """Whatever the rod: one weight on the crank balances half of the reciprocating mass."""
    machine = assur.Machine(assur.SliderCrank(0.2, 0.2 * ratio), bodies={"piston": Body(mass=3.0)})
    (found,) = balance.fit(machine, TURN, {"crank": balance.MomentBounds()})
    (known,) = balance.slider_crank(machine, fraction=0.5)
    assert found.moment == pytest.approx(0.5 * 3.0 * 0.2, rel=1e-12)
    assert (found.moment, abs(found.angle)) == pytest.approx((known.moment, known.angle))


def test_moment_bounds_hold() -> None:
    bounds = balance.MomentBounds(x=(-0.02, 0.0), y=(0.001, INF))
    (found,) = balance.fit(four_bar(), TURN, {"rocker": bounds}, 20.0)
    place = found.moment * np.exp(1j * found.angle)
    assert place.real == pytest.approx(-0.02)
    assert place.imag >= 0.001 * (1 - 1e-12)


def test_several_drivers() -> None:
    """A five-bar of two drivers: weights on both cranks take away what they can."""
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)},
        links={"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"},
        driver=["left", "right"],
    )
    machine = assur.Machine(
        m,
        bodies={
            "left": Body(mass=1.0, inertia=0.1, at="B"),
            "right": Body(mass=2.0, inertia=0.1, at="D"),
        },
    )
    q = np.asarray(m.q0) + np.random.default_rng(1).uniform(-0.2, 0.2, (20, 2))
    places: Any = {"left": balance.MomentBounds(), "right": [(-0.5, 0.0)]}
    found = balance.fit(machine, q, places, (2.0, -1.0), (0.5, 3.0))
    arm = m.dimensions["right.length"]
    assert found[0].moment == pytest.approx(m.dimensions["left.length"])
    assert found[1].mass == pytest.approx(2.0 * arm / 0.5)
    after = machine.with_counterweights([found[0].with_radius(1.0), found[1]])
    assert np.abs(after.reactions(q, (2.0, -1.0), (0.5, 3.0)).shaking_force).max() < 1e-12


def test_parallel_cranks_replace_each_other() -> None:
    """Dependent columns: one of the solutions, without a shaking force."""
    m = assur.FourBar(0.1, 0.3, 0.1, 0.3)
    machine = assur.Machine(m, bodies={"coupler": Body(mass=1.0, inertia=0.01, at=(0.15, 0.0))})
    free = {"crank": balance.MomentBounds(), "rocker": balance.MomentBounds()}
    q = np.linspace(0.3, 2.5, 20)
    found = balance.fit(machine, q, free, 5.0)
    after = machine.with_counterweights(one.with_radius(0.05) for one in found)
    before = np.abs(machine.reactions(q, 5.0).shaking_force).max()
    assert np.abs(after.reactions(q, 5.0).shaking_force).max() <= 1e-12 * before


FIT = four_bar()
ENGINE = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies={"piston": Body(mass=1.0)})
NAN = math.nan


@pytest.mark.parametrize(
    ("places", "more", "said"),
    [
        ({}, {}, "places"),
        ([("crank", (1, 0))], {}, "places"),
        ({"cranks": (0.1, 0.0)}, {}, "cranks"),
        ({3: (0.1, 0.0)}, {}, "not a string"),
        ({"ground": (0.1, 0.0)}, {}, "ground"),
        ({"crank": (0.1, NAN)}, {}, "crank"),
        ({"crank": 0.1}, {}, "not a place"),
        ({"crank": []}, {}, "not a place"),
        ({"crank": [(0.1, 0.0), (0.1,)]}, {}, "crank"),
        ({"crank": (0.1, 0.0, 0.3)}, {}, "crank"),
        ({"crank": "C"}, {}, "joint 'C'"),
        ({"coupler": balance.MomentBounds()}, {}, "first joint moves"),
        ({"crank": balance.MomentBounds()}, {"moment_weight": 1.0}, "give points"),
        ({"crank": "B"}, {"moment_weight": -1.0}, "moment_weight"),
        ({"crank": "B"}, {"moment_weight": INF}, "moment_weight"),
        ({"crank": "B"}, {"most": -1.0}, "most"),
        ({"crank": "B"}, {"most": {"crank": NAN}}, "most"),
        ({"crank": "B"}, {"most": {"rocker": 1.0}}, "most has 'rocker'"),
        ({"crank": "B"}, {"most": "much"}, "most"),
        ({"crank": "B"}, {"q": []}, "q has no"),
        ({"crank": "B"}, {"q": [NAN]}, "q"),
        ({"crank": "B"}, {"speed": [1.0, 2.0]}, "speed"),
    ],
)
def test_refusals(places: Any, more: dict[str, Any], said: str) -> None:
    given: Any = {"q": TURN, **more}
    with pytest.raises(assur.InputError, match=said):
        balance.fit(FIT, places=places, **given)


def test_other_refusals() -> None:
    with pytest.raises(assur.MotionError):
        balance.fit(FIT, TURN, {"crank": "B"}, 1e200)
    with pytest.raises(assur.InputError, match="greater"):
        balance.MomentBounds(x=(1.0, 1.0))
    with pytest.raises(assur.InputError, match="y"):
        balance.MomentBounds(y=(1.0, NAN))
    batch = assur.Machine(assur.SliderCrank(0.1, [0.3, 0.4]))
    with pytest.raises(assur.InputError, match="design"):
        balance.fit(batch, TURN, {"crank": "A"})
    # A piston's only joint moves, a weight on it can only be a point.
    with pytest.raises(assur.InputError, match="first joint moves"):
        balance.fit(ENGINE, TURN, {"piston": balance.MomentBounds()})
