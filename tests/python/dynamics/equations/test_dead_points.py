"""Even steps toward dead points, against runs and triangles; swings, which go on beside them."""

from __future__ import annotations

import math
from functools import cache
from typing import Any, Literal

import numpy as np
import pytest

import assur
from models.machines.stepping_machines import dead_ends, five_bar, pendulum

pytestmark = pytest.mark.filterwarnings("ignore::assur.AssurWarning")
LAST_GOOD = assur.Status.NEAR_SINGULAR
UPRIGHT = math.pi / 2.0
# Of ground, crank, coupler and rocker, one of each four-bar.
Lengths = list[Any]


def ends_of_runs(machine: assur.Machine, q: Any, speed: Any, t: float) -> Any:
    runs = machine.run(
        t, q0=q, speed0=speed, rtol=1e-10, keep="ends", on_error="nan", max_steps=3000
    )
    return runs.end


def four_bars(count: int, rng: np.random.Generator) -> tuple[Lengths, Any]:
    """Random four-bars, and where triangles let the crank go: π where that is no dead point."""
    rows: list[Any] = []
    while len(rows) < count:
        ground, crank, coupler, rocker = lengths = rng.uniform(1.0, 4.0, 4)
        least, greatest = (
            math.acos(min(max(_cosine(ground, crank, reach), -1.0), 1.0))
            for reach in (abs(coupler - rocker), coupler + rocker)
        )
        # The drawing has the crank upright.
        if least < UPRIGHT - 0.4 and greatest > UPRIGHT + 0.4:
            rows.append([*lengths, greatest])
    *columns, ends = np.array(rows).T
    return list(columns), ends


def _cosine(ground: float, crank: float, reach: float) -> float:
    return (ground**2 + crank**2 - reach**2) / (2.0 * ground * crank)


def swinging(lengths: Lengths, rng: np.random.Generator) -> tuple[assur.Machine, Any]:
    """Machines with a spring that holds the crank upright, and its stiffness."""
    ground, crank, coupler, rocker = lengths
    count = len(ground)
    stiffness = 10.0 ** rng.uniform(1.0, 3.0, count)
    bodies = {
        name: assur.Body(
            mass=rng.uniform(0.1, 2.0, count), inertia=rng.uniform(0.01, 1.0, count), at=(0.3, 0.1)
        )
        for name in ("crank", "coupler", "rocker")
    }
    spring = assur.TorsionSpring("crank", stiffness, angle=UPRIGHT)
    mechanism = assur.FourBar(crank, coupler, rocker, ground)
    return assur.Machine(mechanism, bodies=bodies, loads=[spring]), stiffness


@pytest.mark.parametrize("steps", [25, 50, 100, 200, 1000])
def test_no_even_step_leads_over_a_dead_point(steps: int) -> None:
    """Of these motions one in fifteen went on in another assembly."""
    machine, t = dead_ends(), 0.5
    rng = np.random.default_rng(0)
    q, speed = rng.uniform(0.5, 1.3, 200), rng.uniform(-3.0, 5.0, 200)
    ends = ends_of_runs(machine, q, speed, t)
    is_dead = ends == "dead point"
    assert is_dead.sum() > 80
    after = machine.step(q, speed, 0.0, t / steps, n=steps, on_error="hold")
    assert (after.status[is_dead] > LAST_GOOD).all()
    assert (after.status[is_dead] == assur.Status.UNREACHABLE).mean() > 0.9
    # The cosine of the dead point follows from the triangle of the other links.
    end = math.acos((3.0**2 + 4.0**2 - 4.5**2) / 24.0)
    require_held_before(end, after, is_dead, t / steps)


def require_held_before(end: Any, after: Any, of: Any, dt: float) -> None:
    """What is held is less than a step before the dead point."""
    gap = (end - after.q)[of]
    assert (gap >= 0.0).all()
    assert (gap <= dt * after.speed[of]).all()


@pytest.mark.parametrize("dt", [1e-3, 3e-3, 1e-2])
def test_none_of_random_four_bars(dt: float) -> None:
    """Each goes toward a dead point at a speed that nothing stops before."""
    rng = np.random.default_rng(3)
    lengths, ends = four_bars(300, rng)
    is_end = ends < math.pi
    machine, _ = swinging([length[is_end] for length in lengths], rng)
    mechanism, end = machine.mechanism, ends[is_end]
    assert mechanism is not None
    free = assur.Machine(mechanism, bodies=machine.bodies)
    q, speed = end - rng.uniform(0.05, 0.3, end.size), rng.uniform(0.5, 2.0, end.size)
    after = free.step(q, speed, 0.0, dt, n=round(2.0 / dt), on_error="hold")
    assert end.size > 50
    assert (after.status > LAST_GOOD).all()
    assert (after.status == assur.Status.UNREACHABLE).mean() > 0.9
    require_held_before(end, after, after.status == assur.Status.UNREACHABLE, dt)


@pytest.mark.parametrize("dt", [1e-3, 1e-2])
def test_swings_without_a_dead_point_go_on(dt: float) -> None:
    """A thousand machines, whose drivers turn back three times and more, 0.15 rad from any end."""
    rng = np.random.default_rng(4)
    lengths, _ = four_bars(1000, rng)
    machine, stiffness = swinging(lengths, rng)
    inertia = machine.reduced_inertia(np.full(1000, UPRIGHT)).value
    # By the energy of spring and links the crank stays within a quarter of a radian of upright.
    speed = 0.25 * np.sqrt(stiffness / inertia)
    q = np.full(1000, UPRIGHT)
    turns = np.zeros(1000, dtype=int)
    for _ in range(200):
        after = machine.step(q, speed, 0.0, dt, n=round(1e-2 / dt))
        assert (after.status <= LAST_GOOD).all()
        assert (np.abs(after.q - UPRIGHT) < 0.3).all()
        turns += after.speed * speed < 0.0
        q, speed = after.q, after.speed
    assert np.median(turns) >= 3


def test_a_pendulum_swings_on() -> None:
    machine = pendulum()
    q = np.linspace(-math.pi, 0.0, 500)
    after = machine.step(q, 0.0, 0.0, 0.02, n=500)
    assert (after.status == 0).all()


@cache
def of_five_bars(t: float) -> tuple[Any, Any, Any]:
    """States of a five-bar, and how runs from them end."""
    machine, rng = five_bar(), np.random.default_rng(0)
    q0 = np.asarray(machine.mechanism.q0)  # type: ignore[union-attr]
    q, speed = q0 + rng.uniform(-0.3, 0.3, (100, 2)), 4.0 * rng.normal(size=(100, 2))
    ends = ends_of_runs(machine, q, speed, t)
    assert (ends == "dead point").sum() > 20
    return q, speed, ends


@pytest.mark.parametrize("dt", [1e-3, 3e-3, 1e-2])
def test_several_drivers(dt: float) -> None:
    """What goes on where a run ends has another path; what ends has a dead point just ahead."""
    machine, t = five_bar(), 0.3
    q, speed, ends = of_five_bars(t)
    is_dead = ends == "dead point"
    after = machine.step(q, speed, 0.0, dt, n=round(t / dt), on_error="hold")
    has_failed = after.status > LAST_GOOD
    assert (is_dead & ~has_failed).sum() <= 1
    early = has_failed & (ends == "reached")
    later = ends_of_runs(machine, q[early], speed[early], t + 2.0 * dt)
    assert (later == "dead point").all()


@pytest.mark.parametrize("method", ["RK45", "DOP853"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-4])
def test_tolerances_that_resolve_no_turn(rtol: float, method: Literal["RK45", "DOP853"]) -> None:
    machine, t = five_bar(), 0.3
    q, speed, ends = of_five_bars(t)
    after = machine.step(q, speed, 0.0, t / 10, n=10, method=method, rtol=rtol)
    has_failed = after.status > LAST_GOOD
    assert has_failed[ends == "dead point"].all()
    assert not has_failed[ends == "reached"].any()
