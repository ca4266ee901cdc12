"""Near misses of change points: a run ends there and says by how much the lengths miss."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import assur
from assur import Body
from assur.dynamics.motion.run import NearChangePoint


def in_line(miss: float) -> assur.Machine:
    """Crank and ground are as long as coupler and rocker together, but for the miss."""
    linkage = assur.FourBar(1.0, 3.0, 2.0 + miss, 4.0)
    return assur.Machine(
        linkage,
        bodies={"rocker": Body(mass=1.0, inertia=0.5), "coupler": Body(mass=2.0, inertia=0.3)},
    )


def near(run: assur.Run) -> NearChangePoint:
    """The near change point that ended a run."""
    event = run.events[-1].event
    assert isinstance(event, NearChangePoint)
    return event


@pytest.mark.parametrize("miss", [1e-9, 1e-10, 1e-12, 1e-13])
def test_a_near_miss_is_an_event_that_says_by_how_much_the_lengths_miss(miss: float) -> None:
    run = in_line(miss).run(q_end=7.0, q0=1.0, speed0=1.0)
    assert run.end == "near_change_point"
    last = run.events[-1]
    assert last.event == "near_change_point"
    assert near(run).dyad == "C"
    # At half a turn the coupler and the rocker are in line but for the miss: 5 = 3 + 2.
    assert near(run).miss == pytest.approx(miss, rel=0.02, abs=2e-15)
    assert near(run).q == pytest.approx(math.pi, abs=1e-6)
    assert last.q == pytest.approx(math.pi, abs=1e-3)
    assert last.q < math.pi
    assert run.energy.error < 1e-7
    assert "miss one by" in run.message


@pytest.mark.parametrize("seconds", [5.0])
def test_in_time_as_along_the_coordinate(seconds: float) -> None:
    run = in_line(1e-10).run(seconds, 1.0, 1.0)
    along = in_line(1e-10).run(q_end=7.0, q0=1.0, speed0=1.0)
    assert run.end == along.end == "near_change_point"
    assert near(run).miss == pytest.approx(near(along).miss, rel=1e-3)
    assert run.t[-1] == pytest.approx(along.t[-1], abs=1e-3)


def test_change_points_themselves_and_misses_that_can_be_integrated_are_passed() -> None:
    for miss in (0.0, 1e-5):
        run = in_line(miss).run(q_end=7.0, q0=1.0, speed0=1.0)
        assert run.end == "reached"
        assert run.energy.error < 1e-8


def test_lengths_off_in_the_other_direction_are_named() -> None:
    """The crank cannot pass, and the dead point is too near the near miss to be integrated to."""
    run = in_line(-1e-10).run(q_end=7.0, q0=1.0, speed0=1.0)
    assert run.end == "near_change_point"
    assert near(run).miss == pytest.approx(1e-10, rel=0.02)
    assert in_line(-1e-5).run(q_end=7.0, q0=1.0, speed0=1.0).end == "dead point"


def test_a_slider_crank_that_nearly_passes_its_dead_point_says_so() -> None:
    """As long a rod as the crank, but for the miss: the piston could stay in the middle."""
    machine = assur.Machine(assur.SliderCrank(1.0, 1.0 + 1e-10), bodies={"piston": Body(mass=1.0)})
    run = machine.run(q_end=3.0, q0=0.5, speed0=1.0)
    assert run.end == "near_change_point"
    assert near(run).miss == pytest.approx(1e-10, rel=0.02)
    assert near(run).q == pytest.approx(math.pi / 2.0, abs=1e-6)


def test_drawings_of_eleven_digits_are_named() -> None:
    """The rocker comes out as 2.000000000028 (faults of a drawing seen elsewhere)."""
    a, b = 1.0095700695598306, 0.355121308403808
    first = np.array([math.cos(a), math.sin(a)])
    second = first + 3.0 * np.array([math.cos(b), math.sin(b)])
    m = assur.Mechanism(
        {"A": (0.0, 0.0), "B": tuple(first), "C": tuple(second), "D": (4.0, 0.0)},
        {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"},
        "crank",
    )
    machine = assur.Machine(
        m, bodies={"rocker": Body(mass=2.0, inertia=0.02)}, loads=[assur.Gravity((0.0, -9.81))]
    )
    run = machine.run(3.0, float(m.q0), 5.0, rtol=1e-11)
    miss = abs(m.dimensions["rocker.length"] + m.dimensions["coupler.length"] - 5.0)
    assert run.end == "near_change_point"
    assert near(run).miss == pytest.approx(miss, rel=0.01)
    again = pickle.loads(pickle.dumps(run))
    assert near(again).miss == near(run).miss


def test_a_periodic_motion_through_a_near_miss_is_refused_with_it() -> None:
    with pytest.raises(
        assur.PositionError, match=r"nearly has a change point.*miss one by 1e-10 m"
    ):
        in_line(1e-10).steady_state(1.0)
