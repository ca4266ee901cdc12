"""Positions of rest against the oracle: where the drive of the machine at rest is zero.

At rest the drive is dV/dq, with V the potential of weights, springs and constant loads; its rate is
V″, and what an acceleration of 1 adds to it is the reduced inertia J.  Rest is stable where V″ > 0,
with the natural frequency √(V″/J) in rad/s.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.optimize import brentq

import assur
from assur import Body, Force, Gravity, Spring, Torque, TorsionSpring
from models.machines.machines import four_bar, pendulum
from models.machines.reaction_machines import reaction_case
from oracles.dynamics.multipliers import Reactions

if TYPE_CHECKING:
    from assur import Machine

STEPS = 240  # of the search over a turn


def held() -> Machine:
    """A four-bar with weights, springs and a constant force."""
    bodies = {
        "crank": Body(mass=3.0, inertia=0.4, at=(0.3, 0.2)),
        "coupler": Body(mass=2.0, inertia=0.5, at=(1.1, 0.4)),
        "rocker": Body(mass=4.0, inertia=0.6, at=(0.7, -0.3)),
    }
    loads: list[Any] = [
        Gravity(),
        Spring("P", ("ground", (2.0, 4.5)), 40.0, 0.8, preload=3.0),
        TorsionSpring("rocker", 6.0, angle=1.9),
        Force("C", (11.0, -4.0)),
        Torque("crank", 2.5),
    ]
    return assur.Machine(four_bar(), bodies=bodies, loads=loads)


def drive(machine: Machine, q: float, acceleration: float = 0.0) -> float:
    return Reactions(machine, q, 0.0, acceleration).driver()


def rests(machine: Machine) -> list[tuple[float, bool, float]]:
    """Each q within a turn from 0, whether it is stable, and its frequency (NaN: none)."""
    grid = np.linspace(0.0, math.tau, STEPS + 1) + 0.013
    values = [drive(machine, float(q)) for q in grid]
    out = []
    for k in range(STEPS):
        if values[k] * values[k + 1] < 0.0:
            q = float(brentq(lambda x: drive(machine, x), grid[k], grid[k + 1], xtol=1e-14))
            step = 1e-4  # fourth order: 1e-16 of it is left, 1e-11 of roundoff
            near = [drive(machine, q + j * step) for j in (-2, -1, 1, 2)]
            rate = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * step)
            inertia = drive(machine, q, 1.0) - drive(machine, q)
            frequency = math.sqrt(rate / inertia) if rate > 0 else math.nan
            out.append((q % math.tau, rate > 0, frequency))
    return sorted(out)


def test_the_oracle_on_a_pendulum() -> None:
    """Of 1 m in a field of 1 m/s² along −x: it hangs at π with 1 rad/s and stands at 0."""
    found = rests(pendulum())
    assert [stable for _, stable, _ in found] in ([False, True], [True, False])
    for q, stable, frequency in found:
        assert abs(math.remainder(q - (math.pi if stable else 0.0), math.tau)) < 1e-12
        if stable:
            assert abs(frequency - 1.0) < 1e-9


@pytest.mark.parametrize("make", [pendulum, held])
def test_equilibria(make: Any) -> None:
    machine = make()
    found, wanted = machine.equilibria(), rests(machine)
    assert len(wanted) >= 2
    q = np.asarray(found.q, np.float64)
    assert q.shape == np.shape(found.stable) == np.shape(found.frequency) == (len(wanted),)
    for place, stable, frequency in wanted:
        away = [abs(math.remainder(float(one) - place, math.tau)) for one in q]
        k = int(np.argmin(away))
        assert away[k] < 1e-10
        assert bool(found.stable[k]) is stable
        if stable:
            assert abs(float(found.frequency[k]) - frequency) < 1e-8 * frequency


def test_rest_needs_no_drive() -> None:
    machine: Any = held()
    found = machine.equilibria().q
    assert found.shape == (2,)
    for q in found:
        scale = abs(float(machine.effort(float(q) + 0.5, 0.0, 0.0))) + 1.0
        assert abs(float(machine.effort(float(q), 0.0, 0.0))) < 1e-11 * scale


def constant(machine: Machine) -> Machine:
    """The machine without the loads that are functions."""

    def is_constant(load: Any) -> bool:
        values = [*getattr(load, "force", ()), getattr(load, "torque", 0.0)]
        return not any(callable(value) for value in values)

    mechanism = machine.mechanism
    assert mechanism is not None
    return assur.Machine(
        mechanism, bodies=machine.bodies, loads=[x for x in machine.loads if is_constant(x)]
    )


@pytest.mark.parametrize("seed", range(60))
def test_random_machines_against_a_fine_grid(seed: int) -> None:
    """All changes of sign between 4000 positions are found, and what is found changes its sign.

    Random machines have gaps, islands, dead points, and groups where moments go to infinity.
    """
    case = reaction_case(seed)
    if np.size(case.mechanism.q0) > 1:
        pytest.skip("several drivers")
    machine, q0 = constant(case.machine), float(case.mechanism.q0)
    reach = 1.0 if case.mechanism.driver in case.mechanism.slides else math.pi
    found = machine.equilibria(between=(q0 - reach, q0 + reach))
    grid = np.linspace(q0 - reach, q0 + reach, 4001)

    def moment(q: Any) -> Any:
        return machine.reduced_moment(q, on_error="nan")

    values = moment(grid)
    for k in np.flatnonzero(values[:-1] * values[1:] < 0.0):
        try:
            q = float(brentq(moment, grid[k], grid[k + 1], xtol=1e-14))
        except ValueError:  # a gap in between
            continue
        if abs(moment(q)) < 1e-3 * abs(values[k : k + 2]).min():
            assert np.abs(found.q - q).min() < 1e-9
    assert found.indifferent.size == 0
    for q, stable in zip(found.q, found.stable, strict=True):
        before, after = moment(q + np.array([-1e-9, 1e-9]))
        assert (before > 0.0 > after) if stable else (before < 0.0 < after)
    h = 1e-6
    for q, stiffness in zip(found.q, found.stiffness, strict=True):
        near = moment(q + h * np.array([-2, -1, 1, 2]))
        slope = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * h)
        if np.isfinite(near).all():  # beside a dead point the slope changes within 1e-6
            bend = abs(near[0] + near[3] - near[1] - near[2]) / h
            assert abs(slope + stiffness) < 1e-6 * abs(stiffness) + bend
