"""`Run.at` gives the motion within the run and nothing beyond it."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur
from assur import Body
from models.errors.refusals import refused


def coasting(driver: str = "crank") -> assur.Machine:
    wheel = assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver(driver)
    return assur.Machine(wheel, bodies={"crank": Body(inertia=0.3), "rocker": Body(inertia=2.0)})


def test_a_time_outside_the_run_is_refused() -> None:
    run = coasting().run(3.0, 0.0, 2.0, t0=1.0)
    for t in (0.999, 3.001, -1e300, math.inf):
        error = refused(assur.InputError, f"{t!r} 1.0 3.0", lambda t=t: run.at(t))  # type: ignore[misc]
        assert error.value == t
    refused(assur.InputError, "t nan outside", lambda: run.at(math.nan), value=math.nan)
    # The first of them, wherever it is.
    refused(
        assur.InputError, "t = 4.0 outside", lambda: run.at([[1.5, 2.0], [4.0, 5.0]]), value=4.0
    )


def test_a_coordinate_outside_a_run_over_it_is_refused() -> None:
    for sign in (1.0, -1.0):
        run = coasting().run(q_end=sign * 5.0, q0=0.0, speed0=sign * 2.0)
        assert run.at(q=sign * 5.0).q == sign * 5.0
        for q in (-0.1 * sign, 5.1 * sign):
            said = f"q = {q!r} outside {sign * 5.0!r}"
            refused(assur.InputError, said, lambda r=run, q=q: r.at(q=q))  # type: ignore[misc]


def test_a_run_that_ended_early_says_so() -> None:
    run = coasting("rocker").run(50.0, 2.0, 1.0)
    assert run.end == "dead point"
    last = float(run.t[-1])
    assert run.at(last).q == run.q[-1]
    refused(assur.InputError, f"outside {last!r} dead point", lambda: run.at(last * 1.001))
    stopped = coasting().run(50.0, 0.0, 2.0, events=[assur.events.Position(4.0)])
    refused(assur.InputError, "outside Position", lambda: stopped.at(50.0))


def test_last_digits_beyond_an_end_are_at_it() -> None:
    run = coasting().run(0.3, 0.0, 2.0, t0=0.1)
    ends = {0.1: run.q[0], 0.3: run.q[-1]}
    for end, q in ends.items():
        for toward in (-math.inf, math.inf):
            beside = end
            for _ in range(3):
                beside = math.nextafter(beside, toward)
            assert run.at(beside).q == pytest.approx(q, rel=1e-15, abs=1e-15)
    # 0.1 + 0.2 + … as a loop adds them up.
    times = np.cumsum(np.full(3, 0.1))
    assert times[-1] > 0.3
    assert run.at(times).q[-1] == run.q[-1]


def test_a_run_of_no_length_has_its_one_place() -> None:
    run = coasting().run(1.0, 0.3, 2.0, t0=1.0)
    assert run.at(1.0).speed == 2.0
    refused(assur.InputError, "t = 1.1 outside", lambda: run.at(1.1))


def test_a_periodic_motion_has_a_value_at_every_coordinate() -> None:
    steady = coasting().steady_state(5.0, mean="period")
    turn = 2.0 * math.pi
    first = float(steady.q[0])
    q = first + np.array([0.0, 1e-16, 1.0, turn, -1e-16, -turn, 7.0, -100.0, 1e9, -1e15, 1e300])
    state = steady.at(q)
    assert np.isfinite(state.speed).all()
    np.testing.assert_array_equal(state.q, q)
    # The same places by the exact remainder of what the floating-point numbers are.
    for at, speed in zip(q, state.speed, strict=True):
        within = first + math.fmod(at - first, float(steady.q[-1] - steady.q[0]))
        within += turn if within < first else 0.0
        within = min(within, float(steady.q[-1]))
        assert speed == pytest.approx(steady.run.at(q=within).speed, rel=1e-12)
    assert steady.at(steady.q).speed.tobytes() == steady.run.at(q=steady.q).speed.tobytes()
    refused(assur.InputError, "q nan", lambda: steady.at([0.0, math.nan]))
