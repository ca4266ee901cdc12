"""Errors of runs, of steady states and of tables: a case for each kind."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import assur
from assur import (
    Body,
    InputError,
    JointFriction,
    LinearMotor,
    Machine,
    MotionError,
    PositionError,
    Table,
    Torque,
    TorsionDamper,
    TorsionSpring,
    flywheel,
)
from models.errors.error_case import Case
from models.errors.error_cases_kinematics import nearly_in_line
from models.machines.machines import press, wheel

TURN = math.tau
# P3's press.
PHI = np.linspace(0.0, TURN, 9)
MOMENT = np.array([-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23])
INERTIA = np.array([4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93])
INDUCTION = assur.InductionMotor(breakdown=60.0, slip=0.2, synchronous=100.0)
MOTOR = LinearMotor(90.0, 30.0)


def driven(motor: Any, *loads: Any, inertia: float = 2.0) -> Machine:
    """A crank with an inertia and a motor; nothing else has mass."""
    return Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"crank": Body(inertia=inertia)},
        loads=loads,
        motor=motor,
    )


def toothed() -> Torque:
    """A load with three knots a turn."""
    return Torque("crank", Table([0.0, 3.0, TURN], [0.0, 1.0, 0.0], spline="linear"))


def pole(_: float, q: float, __: float) -> float:
    """A load that becomes infinite at 3 rad."""
    return 1.0 / (q - 3.0) if q != 3.0 else 0.0


def overrun() -> Machine:
    """A load so much stronger than its motor that the speed hardly depends on the motor."""
    return Machine(
        assur.FourBar(1.0, 3.0, 2.5, 3.2),
        bodies={"crank": Body(inertia=0.05), "rocker": Body(mass=0.9, inertia=0.1)},
        loads=[Torque("crank", 50.0)],
        motor=assur.InductionMotor(3.78, 0.145, 14.64),
    )


def through_change_points() -> Machine:
    """A four-bar that takes two turns to come back."""
    bodies = {"crank": Body(inertia=0.2), "rocker": Body(inertia=2.0), "coupler": Body(mass=1.0)}
    damper = TorsionDamper("rocker", 0.5)
    return Machine(assur.FourBar(1.0, 2.0, 3.0, 4.0), bodies=bodies, loads=[damper])


def half_turning() -> Machine:
    bodies = {"crank": Body(inertia=1.0), "rocker": Body(inertia=1.0)}
    return Machine(assur.FourBar(2.0, 3.0, 3.0, 4.5), bodies=bodies)


def sized(**changed: Any) -> flywheel.Flywheel:
    """The flywheel of P3's press, or of what is said instead."""
    given: dict[str, Any] = {"phi": PHI, "moment": MOMENT, "inertia": INERTIA}
    return flywheel.from_table(**given | {"fluctuation": 0.125, "mean_speed": 15.0} | changed)


def evaluated(**changed: Any) -> flywheel.Flywheel:
    given: dict[str, Any] = {"phi": PHI, "moment": MOMENT, "inertia": INERTIA}
    return flywheel.evaluate(**given | changed)


def torn(row: int, value: float) -> Any:
    """The moments with another one in a row."""
    return np.where(np.arange(9) == row, value, MOMENT)


def jammed() -> Machine:
    """Beside its stretched position friction in the pins leaves no motion against the load."""
    pins = {name: JointFriction(0.1, 1.0) for name in "ABCD"}
    linkage = assur.FourBar(1.0, 4.5, 1.5, 4.985)
    return Machine(
        linkage,
        bodies={"crank": Body(inertia=1.0)},
        loads=[Torque("rocker", -100.0)],
        friction=pins,
    )


RUN: dict[str, Case] = {
    "locked": Case(MotionError, lambda: jammed().run(1.0, q0=3.1, speed0=1.0), {"q": 3.1}),
    "no_inertia": Case(
        InputError,
        lambda: wheel(inertia=0.0).run(1.0, speed0=1.0),
        {"driver": "crank", "q": 0.0, "value": 0.0},
    ),
    "not_finite": Case(
        MotionError,
        lambda: wheel(Torque("crank", lambda *_: 1e308)).run(1.0, speed0=1e200),
        {"t": 0.0},
    ),
    "options": Case(InputError, lambda: wheel().run(-1e308, t0=1e308)),
    "too_many_knots": Case(
        InputError, lambda: wheel(toothed()).run(q_end=1e12, q0=0.0, speed0=1.0)
    ),
    "table_ends": Case(
        InputError,
        lambda: Machine.from_table([0, 1], [1, 1], [1, 1], periodic=False).run(1.0, q0=3.0),
        {"value": 3.0},
    ),
}

STEADY: dict[str, Case] = {
    "needs_speed": Case(InputError, lambda: press().steady_state()),
    "stops": Case(
        MotionError,
        lambda: press(LinearMotor(40.0, 9.0)).steady_state(),
        {"q": 5.7590983, "value": 72.0},
    ),
    "cannot_carry": Case(
        MotionError,
        lambda: driven(INDUCTION, Torque("crank", -60.1), inertia=50.0).steady_state(),
        {"value": 100.0},
    ),
    "runs_away": Case(
        MotionError, lambda: press(MOTOR).steady_state(flywheel=1e300), {"value": 2.3883944e16}
    ),
    "unbalanced": Case(
        MotionError,
        lambda: press(assur.ConstantTorque(80.0)).steady_state(12.0),
        {"value": 80.0},
    ),
    "mean_not_reached": Case(
        MotionError, lambda: press().steady_state(1.0, mean="period"), {"value": 1.0}
    ),
    "poorly_determined": Case(
        MotionError, lambda: overrun().steady_state(), {"value": 3.8447023e-13}
    ),
    "dead_point": Case(
        PositionError,
        lambda: half_turning().steady_state(5.0),
        # Coupler and rocker in line, 6 m.
        {"joint": "C", "group": "C", "q": math.acos((4.0 + 20.25 - 36.0) / 18.0)},
    ),
    "near_change_point": Case(
        PositionError,
        lambda: nearly_in_line().steady_state(1.0),
        {"joint": "C", "group": "C", "q": math.pi, "value": 1e-10},
    ),
    "motor_table_ends": Case(
        InputError,
        lambda: driven(
            Table([-5.0, 10.0, 20.0, 30.0], [60.0, 50.0, 45.0, 0.0], spline="linear"),
            Torque("crank", 10.0),
        ).steady_state(),
        {"q": 0.0, "value": 30.0},
    ),
    "not_periodic": Case(
        MotionError, lambda: press(MOTOR, loads=[TorsionSpring("crank", 1.0)]).steady_state()
    ),
    "inertia_not_periodic": Case(
        MotionError,
        lambda: through_change_points().steady_state(5.0, q0=0.0, rtol=1e-9),
        {"q": 0.4 * math.pi, "value": 1.2747826},
    ),
    "already_met": Case(InputError, lambda: press(MOTOR).flywheel(1.5), {"value": 1.5}),
    "too_many_steps": Case(
        MotionError, lambda: press(MOTOR).steady_state(max_steps=1), {"q": 1.8362897189338e-3}
    ),
    "cancelled": Case(MotionError, lambda: press(MOTOR).steady_state(max_seconds=0.0), {"q": 0.0}),
    "stalled": Case(
        MotionError,
        lambda: press(MOTOR, loads=[Torque("crank", pole)]).steady_state(),
        {"q": 3.0},
    ),
}

TABLE: dict[str, Case] = {
    "too_short": Case(
        InputError,
        lambda: sized(phi=[0.0, TURN], moment=[1, 1], inertia=[1, 1], spline="periodic"),
        {"value": 2.0},
    ),
    "not_finite": Case(InputError, lambda: sized(moment=torn(3, math.nan)), {"value": math.nan}),
    "not_increasing": Case(
        InputError,
        lambda: sized(phi=PHI[::-1]),
        {"q": 1.75 * math.pi, "value": 1.75 * math.pi},
    ),
    "tripled": Case(
        InputError,
        lambda: Table([0.0, 1.0, 1.0, 1.0, 2.0], [0.0, 0.0, 1.0, 2.0, 0.0]),
        {"q": 1.0, "value": 1.0},
    ),
    "jump_at_end": Case(
        InputError,
        lambda: Table([0.0, 1.0, 2.0, 2.0], [0.0, 0.0, 1.0, 2.0], periodic=False),
        {"q": 2.0, "value": 2.0},
    ),
    "periodic_jump": Case(
        InputError,
        lambda: Table([0.0, 1.0, 1.0, 2.0], [0.0, 0.0, 1.0, 0.0], spline="periodic"),
        {"q": 1.0, "value": 1.0},
    ),
    "inertia_jumps": Case(
        InputError,
        lambda: sized(phi=[0, 1, 1, TURN], moment=[1, 1, 2, 1], inertia=[1, 1, 2, 1]),
        {"q": 1.0, "value": 2.0},
    ),
    "not_periodic": Case(InputError, lambda: sized(moment=torn(8, 3.0))),
    "negative": Case(
        InputError,
        lambda: sized(inertia=[1, 9, 1, 0.1, 9, 0.1, 1, 9, 1]),
        {"q": 4.2499975, "value": -1.4514574},
    ),
    "no_inertia": Case(
        InputError, lambda: evaluated(inertia=0.0, speed0=5.0), {"q": 0.0, "value": 0.0}
    ),
    "bad_fluctuation": Case(
        InputError, lambda: sized(fluctuation=[0.125, -1.0, 3.0]), {"design": (1,), "value": -1.0}
    ),
    "bad_speed": Case(InputError, lambda: sized(mean_speed=-1.0), {"value": -1.0}),
    "bad_inertia": Case(InputError, lambda: evaluated(flywheel=-1.0, speed0=15.0), {"value": -1.0}),
    "already_met": Case(InputError, lambda: sized(fluctuation=1.0), {"value": 1.0}),
    "no_flywheel": Case(MotionError, lambda: sized(fluctuation=1e-300), {"value": 1e-300}),
    "stalls": Case(MotionError, lambda: evaluated(speed0=5.0), {"q": 2.1869945, "value": 5.0}),
    "infinite": Case(InputError, lambda: evaluated(speed0=1e200), {"value": 1e200}),
    "no_mean": Case(MotionError, lambda: evaluated(mean_speed=1.0), {"value": 1.0}),
}
