"""Reductions, runs and periods through change points and beside them."""

from __future__ import annotations

import math
from typing import Any

import mpmath as mp  # type: ignore[import-untyped]
import numpy as np
import pytest

import assur
from assur import Body, Gravity, Torque
from assur.dynamics.motion.run import NearChangePoint

TURN = math.tau


def test_change_points_have_reductions() -> None:
    machine = assur.Machine(assur.FourBar(1.0, 3.0, 1.0, 3.0), bodies={"rocker": Body(inertia=2.0)})
    beside = np.array([0.0, 1e-9, 1e-6, 1e-3, 0.02, 0.029])
    value, d1 = machine.reduced_inertia([beside, math.pi - beside])
    assert np.abs(value - 2.0).max() < 1e-12
    assert np.abs(d1).max() < 1e-10


def test_beside_change_points_analogues_are_known() -> None:
    """The joint of a kite is on its axis: its place and two derivatives in closed form."""
    machine = assur.Machine(
        assur.FourBar(1.0, 2.5, 2.5, 1.0), bodies={"rocker": Body(mass=1.0, at="C")}
    )
    steps = np.logspace(-9, math.log10(0.4), 60)
    for change in (0.0, TURN):
        q = change + np.concatenate([-steps, [0.0], steps])
        value, d1 = machine.reduced_inertia(q)
        c, s = np.cos(0.5 * q), np.sin(0.5 * q)
        root = np.sqrt(5.25 + c * c)
        first = -0.5 * c * s / root
        second = -0.25 * (c * c - s * s) / root - first**2 / root
        # Along the axis, and around it.
        along, rate, bend = c + root, -0.5 * s + first, -0.25 * c + second
        assert np.abs(value - (rate**2 + 0.25 * along**2)).max() < 1e-12
        exact = 2.0 * rate * bend + 0.5 * along * rate
        assert np.abs(d1 - exact).max() < 4e-11


@pytest.mark.parametrize("lengths", [(1.0, 2.5, 2.5, 1.0), (1.0, 2.0, 4.0, 3.0)])
def test_periods_through_change_points_meet_tight_tolerances(lengths: Any) -> None:
    bodies = {
        "crank": Body(inertia=0.3),
        "rocker": Body(mass=1.0, inertia=0.4, at=(0.2, 0.3)),
        "coupler": Body(mass=2.0, inertia=0.3, at=(1.0, 0.5)),
    }
    loads = (Torque("rocker", -1.0), Gravity())
    machine = assur.Machine(
        assur.FourBar(*lengths), bodies=bodies, loads=loads, motor=assur.LinearMotor(30.0, 30.0)
    )
    with pytest.raises(assur.MotionError, match=r"not periodic over this span.*turns=2"):
        machine.steady_state()
    loose, tight = (machine.steady_state(turns=2, rtol=rtol) for rtol in (1e-9, 1e-12))
    assert abs(tight.mean_speed / loose.mean_speed - 1.0) < 1e-7
    assert tight.run.statistics.steps < 400
    assert tight.run.energy.error < 1e-9


def four_bar_rates(lengths: Any, q: float, sign: int) -> tuple[float, float]:
    """Rocker's two analogues of a four-bar, with 50 digits; `sign` of its assembly."""
    with mp.workdps(50):
        a, b, c, d, q = (mp.mpf(x) for x in (*lengths, q))

        def angle(q: Any) -> Any:
            x, y = a * mp.cos(q) - d, a * mp.sin(q)
            far = mp.hypot(x, y)
            return mp.atan2(y, x) + sign * mp.acos((c * c + far * far - b * b) / (2 * c * far))

        return float(mp.diff(angle, q, 1, h=mp.mpf(10) ** -16)), float(
            mp.diff(angle, q, 2, h=mp.mpf(10) ** -14)
        )


@pytest.mark.parametrize(
    ("lengths", "accuracy"),
    [
        # Nearly a deltoid: beside the change point the rocker turns 128 times as fast as the crank.
        ((1.0, 1.5, 1.5 + 1 / 64, 1.0 + 1 / 64), 1e-7),
        ((50.0, 80.0, 82.0, 52.0), 1e-8),
        # A dead point beside the change point.
        ((1.0, 2.00146484375, 0.00146484375, 3.0), 1e-7),
        ((1.0, 2.00048828125, 0.00048828125, 3.0), 1e-6),
        ((1.0, 2.0020751953125, 0.0020751953125, 3.0), 1e-7),
    ],
)
def test_change_points_with_something_beside(lengths: Any, accuracy: float) -> None:
    linkage = assur.FourBar(*lengths)
    machine = assur.Machine(linkage, bodies={"rocker": Body(inertia=1.0)})
    motion = linkage.solve([1e-6, -1e-6], order=1)
    for q in (1e-7, 1e-6, 1e-4, 1e-3, 0.01, 0.02):
        for at in (-q, q):
            both = [four_bar_rates(lengths, at, sign) for sign in (1, -1)]
            value, d1 = machine.reduced_inertia(at)
            first, second = min(both, key=lambda pair: abs(pair[0] ** 2 - value))
            assert abs(value - first**2) < accuracy * first**2
            assert abs(d1 - 2.0 * first * second) < accuracy * (first**2 + abs(first * second))
            if q == 1e-6:
                own = motion.link("rocker").d1[0 if at > 0.0 else 1]
                assert abs(own - first) < accuracy * abs(first)


def test_motions_through_near_deltoids_come_to_an_end() -> None:
    machine = assur.Machine(
        assur.FourBar(0.05, 0.08, 0.082, 0.052),
        bodies={
            "crank": Body(inertia=1e-3),
            "coupler": Body(mass=0.2, inertia=1e-4),
            "rocker": Body(mass=0.1, inertia=1e-4),
        },
        loads=[Torque("crank", -0.1)],
        motor=assur.LinearMotor(1.0, 30.0),
    )
    run = machine.run(3.0, max_seconds=20.0)
    assert run.end == "reached"
    assert run.energy.error < 1e-7
    assert machine.steady_state(turns=2).multiplier < 1.0


def test_nearly_a_parallelogram_ends_at_its_near_change_point() -> None:
    """Within 1e-6 rad a change point and a gap cannot be distinguished."""
    nearly = assur.FourBar(1.0 - 3e-14, 3.0, 1.0, 3.0)
    machine = assur.Machine(
        nearly,
        bodies={
            "crank": Body(inertia=0.1),
            "rocker": Body(mass=1.0, inertia=0.2),
            "coupler": Body(mass=2.0, inertia=0.3),
        },
    )
    run = machine.run(q_end=7.0, q0=1.0, speed0=1.0)
    assert run.end == "near_change_point"
    event = run.events[-1].event
    assert isinstance(event, NearChangePoint)
    assert event.miss == pytest.approx(3e-14, rel=0.2)
    assert run.energy.error < 1e-6


def test_forces_grow_toward_a_change_point_and_the_drive_has_a_limit() -> None:
    """A parallelogram's coupler translates: the drive is m g r cos q.

    The rocker bears half the weight and inertia by a force along itself: T sin q = −m (g + a) / 2.
    """
    machine = assur.Machine(
        assur.FourBar(1.0, 3.0, 1.0, 3.0),
        bodies={"coupler": Body(mass=2.0, inertia=1.5, at=(1.5, 0.0))},
        loads=[Gravity()],
    )
    q = np.pi + np.array([-1e-3, -1e-6, 0.0, 1e-6, 1e-3])
    found = machine.reactions(q, speed=10.0)
    assert found.status[2] == assur.Status.SINGULAR
    assert np.isnan(found.joint("C", "rocker")[2]).all()
    assert np.isnan(found.driver[2])
    exact = 2.0 * 9.81 * np.cos(q)
    assert np.abs(machine.effort(q, speed=10.0) - exact).max() < 1e-9 * np.abs(exact).max()
    beside = [0, 1, 3, 4]
    across = found.joint("C", "rocker")[beside, 0] * np.tan(q[beside])
    # The coupler's second analogue, 0, is known to u κ³: 1e-7 at 1e-3 from the change point.
    assert np.allclose(across, -(9.81 - 100.0 * np.sin(q[beside])), rtol=1e-5)


def test_reactions_at_a_dead_point_are_refused() -> None:
    """Unlike a change point it has no analogues; beside it the effort grows without a limit."""
    linkage = assur.Mechanism(
        joints={"O": (0.0, 0.0), "A": (0.6, 0.8), "B": (3.0, 0.0)},
        links={"ground": ["O"], "crank": ["O", "A"], "rod": ["A", "B"], "piston": ["B"]},
        slides={"bore": assur.Slide("piston", "ground", angle=0.0, origin="O")},
        driver="bore",
    )
    machine = assur.Machine(linkage, bodies={"rod": Body(mass=1.0, inertia=0.1)}, loads=[Gravity()])
    top = linkage.dimensions["crank.length"] + linkage.dimensions["rod.length"]
    for method in (machine.reactions, machine.effort):
        with pytest.raises(assur.PositionError, match='dyad "A" is flat'):
            method(top, 1.0)
    assert np.isnan(machine.reactions(top, 1.0, on_error="nan").driver)
