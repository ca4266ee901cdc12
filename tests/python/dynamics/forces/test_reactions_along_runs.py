"""Reactions and efforts along motions: what a motor does in a run is what its reactions need.

In a run the motor is all that drives: the drive of the reactions is its torque less what turns its
rotor, and zero without a motor.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Damper, Force, Gravity, LinearMotor, Spring
from models.machines.machines import four_bar

BODIES = {
    "crank": Body(mass=3.0, inertia=0.4, at=(0.3, 0.2)),
    "coupler": Body(mass=2.0, inertia=0.5, at=(1.1, 0.4)),
    "rocker": Body(mass=4.0, inertia=0.6, at=(0.7, -0.3)),
}
LOADS: list[Any] = [
    Gravity(),
    Spring("P", ("ground", (2.0, 4.5)), 40.0, 0.8, preload=3.0),
    Damper("C", ("ground", (3.0, 1.0)), 0.7),
]
# Rounding of sums of some ten terms, of the greatest load.
CLOSE = 1e-12


def largest(found: Any, m: assur.Mechanism) -> float:
    forces = [found.joint(joint, link) for joint, link in (("B", "coupler"), ("C", "rocker"))]
    size = max(float(length) for length in m.dimensions.values())
    return size * max(float(np.abs(force).max()) for force in forces)


def waves(t: float, q: float, speed: float) -> float:
    """A load over time, coordinate and speed."""
    return 5.0 * math.sin(3.0 * t) + q - 0.1 * speed


def test_a_run_without_a_motor_needs_no_drive() -> None:
    m = four_bar()
    machine = assur.Machine(m, bodies=BODIES, loads=[*LOADS, Force("C", (waves, 2.0))])
    run = machine.run(t_end=2.0, q0=0.3, speed0=9.0)
    found = machine.reactions(run)
    assert np.array_equal(found.q, run.q)
    size = largest(found, m)
    assert np.abs(found.driver).max() < CLOSE * size
    assert np.abs(machine.effort(run)).max() < CLOSE * size
    # At another time the load is another.
    assert np.abs(machine.effort(run.q, run.speed, run.acceleration)).max() > 1e-3 * size


@pytest.mark.parametrize("kind", ["run", "steady state", "state"])
def test_the_motor_of_a_motion(kind: str) -> None:
    m = four_bar()
    motor = LinearMotor(stall=300.0, no_load=12.0, rotor_inertia=0.8)
    machine = assur.Machine(m, bodies=BODIES, loads=LOADS, motor=motor)
    motion: Any = machine.steady_state()
    if kind == "run":
        motion = machine.run(t_end=1.5, q0=0.1, speed0=8.0)
    along = motion.at(np.linspace(0.0, 1.2, 7)) if kind == "state" else motion
    given = motion.run if kind == "steady state" else along
    found, effort = machine.reactions(along), machine.effort(along)
    torque = 300.0 * (1.0 - given.speed / 12.0) - 0.8 * given.acceleration
    # The dense output's acceleration is not that of the equation of motion.
    allowed = (1e-5 if kind == "state" else CLOSE) * largest(found, m)
    assert np.abs(found.driver - torque).max() < allowed
    assert np.abs(effort - found.driver).max() < CLOSE * largest(found, m)


def test_loads_inside_a_link_along_a_run() -> None:
    """As at the run's numbers, and not at other times."""
    load = Force(("coupler", (1.0, 0.0)), (0.0, waves))
    rod = Body(mass=2.0, inertia=2.0 * 3.0**2 / 12, at=(1.5, 0.0))
    bodies = {"crank": Body(mass=3.0, inertia=0.4), "coupler": rod}
    heavy = assur.Machine(assur.FourBar(1.0, 3.0, 2.5, 3.2), bodies=bodies, loads=[load])
    run = heavy.run(t_end=0.3, q0=0.3, speed0=9.0)
    own = heavy.internal_loads("coupler", run)
    given = heavy.internal_loads("coupler", run.q, run.speed, run.acceleration, t=run.t)
    then = heavy.internal_loads("coupler", run.q, run.speed, run.acceleration)
    for quantity in ("axial", "shear", "moment"):
        assert np.array_equal(getattr(own, quantity), getattr(given, quantity))
    assert np.abs(own.moment - then.moment).max() > 1e-3 * np.abs(own.moment).max()
    # Rates differ from position to position, so peaks are those of positions.
    assert own.peak("shear").q in run.q


def test_the_duty_of_a_motor() -> None:
    """Over a run, the drive gives what the motor gives to all but its rotor."""
    motor = LinearMotor(stall=300.0, no_load=12.0)
    machine = assur.Machine(four_bar(), bodies=BODIES, loads=LOADS, motor=motor)
    run = machine.run(t_end=1.5, q0=0.1, speed0=8.0)
    t = np.linspace(0.0, 1.5, 20_001)
    state = run.at(t)
    duty = machine.duty(state)
    torque = 300.0 * (1.0 - state.speed / 12.0)
    work = np.trapezoid(torque * state.speed, t)
    assert duty.energy == pytest.approx(work, rel=1e-5)
    assert duty.time == pytest.approx(1.5, rel=1e-9)
    assert duty.energy == pytest.approx(duty.work_in - duty.work_out, rel=1e-12)
    with pytest.raises(assur.InputError, match="speed is given with a Run"):
        machine.duty(run, 3.0)
    with pytest.raises(assur.InputError, match="speed is 0"):
        machine.duty(run.q)


def test_times_are_broadcast() -> None:
    machine = assur.Machine(four_bar(), bodies=BODIES, loads=[Force("C", (waves, 0.0))])
    times = np.array([0.0, 0.2, 0.7])
    together = machine.effort(0.5, 2.0, 1.0, t=times[0])
    assert together == machine.effort(0.5, 2.0, 1.0)
    each = [machine.effort(0.5, 2.0, 1.0, t=t) for t in times]
    assert len(set(each)) == 3
    assert machine.effort(np.full(3, 0.5), 2.0, 1.0, t=times).tolist() == each
    drives = machine.reactions(np.full(3, 0.5), 2.0, 1.0, t=times).driver
    assert np.allclose(drives, each, rtol=1e-12)


def test_what_does_not_fit_is_refused() -> None:
    machine = assur.Machine(four_bar(), bodies=BODIES, loads=LOADS)
    run = machine.run(t_end=0.1, q0=0.3, speed0=9.0)
    with pytest.raises(assur.InputError, match="speed is given with a Run"):
        machine.reactions(run, 3.0)
    with pytest.raises(assur.InputError, match="t is given with a State"):
        machine.effort(run.at(0.05), t=1.0)
    with pytest.raises(assur.InputError, match="t has the shape"):
        machine.effort(0.5, t=[0.0, 1.0])
    with pytest.raises(assur.InputError, match="t is nan"):
        machine.reactions(0.5, t=math.nan)
