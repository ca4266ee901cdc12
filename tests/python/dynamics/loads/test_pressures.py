"""Pressures in cylinders: closed gases by their energy, tables, both sides, reactions."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Gas, Machine, Pressure, Table
from models.machines.shapers import CRANK, STROKE, TURN, integral, place, slider

AREA, AMBIENT = 0.005, 101325.0
# Beyond the outer dead centre: a tenth of the volume at the inner one is left.
SWEPT = AREA * 2.0 * CRANK
CLEARANCE = SWEPT / 9.0
START = 1.0e5


def gas(exponent: float = 1.3) -> Gas:
    return Gas(START, CLEARANCE + SWEPT, at=STROKE[0], exponent=exponent)


def cylinder(exponent: float = 1.3, **options: Any) -> Pressure:
    return Pressure("bore", AREA, gas(exponent), expands="backward", **options)


def volume(q: Any) -> Any:
    return CLEARANCE + AREA * (STROKE[1] - place(q)[0])


def pressure(q: Any, exponent: float = 1.3) -> Any:
    return START * ((CLEARANCE + SWEPT) / volume(q)) ** exponent


def energy(q: Any, exponent: float = 1.3) -> Any:
    """−∫ (p − p₀) dV from the greatest volume."""
    whole, own = CLEARANCE + SWEPT, volume(q)
    if exponent == 1.0:
        stored = START * whole * np.log(whole / own)
    else:
        stored = (pressure(q, exponent) * own - START * whole) / (exponent - 1.0)
    return stored - AMBIENT * (whole - own)


@pytest.mark.parametrize("exponent", [1.0, 1.3, 1.4])
def test_a_closed_gas_is_a_spring(exponent: float) -> None:
    machine = Machine(slider(), bodies={"crank": Body(inertia=0.3)}, loads=[cylinder(exponent)])
    q = np.linspace(-2.0, 9.0, 45)
    np.testing.assert_allclose(machine.potential(q), energy(q, exponent), rtol=1e-11, atol=1e-11)
    force = -AREA * (pressure(q, exponent) - AMBIENT) * place(q)[1]
    np.testing.assert_allclose(machine.reduced_moment(q), force, rtol=1e-11, atol=1e-11)
    run = machine.run(t_end=1.0, q0=math.pi, speed0=40.0, rtol=1e-12)
    kinetic = 0.15 * run.speed**2 + energy(run.q, exponent)
    np.testing.assert_allclose(kinetic, kinetic[0], rtol=1e-11)
    assert run.energy.error < 1e-11
    assert np.abs(run.energy.work).max() == 0.0
    assert run.statistics.restarts == 0


def test_small_oscillations_on_a_gas() -> None:
    # A piston of mass m on a gas at the atmosphere's pressure: ω² = n p A²/(V m).
    mechanism = assur.Mechanism(
        {"O": (0.0, 0.0), "B": (0.2, 0.0)},
        {"ground": ["O"], "piston": ["B"]},
        driver="tube",
        slides={"tube": assur.Slide("piston", on="ground", angle=0.0, origin="O")},
    )
    air = Gas(AMBIENT, 0.2 * AREA, at=0.2, exponent=1.4)
    machine = Machine(
        mechanism,
        bodies={"piston": Body(mass=0.7)},
        loads=[Pressure("tube", AREA, air, expands="forward")],
    )
    found = machine.equilibria(between=(0.1, 0.4))
    np.testing.assert_allclose(found.q, [0.2], rtol=1e-12)
    frequency = math.sqrt(1.4 * AMBIENT * AREA**2 / (0.2 * AREA * 0.7))
    np.testing.assert_allclose(found.frequency, [frequency], rtol=1e-12)
    assert found.stable.all()


def test_an_engine_that_compresses_and_expands_along_two_lines() -> None:
    # Heat at the outer dead centre trebles the pressure there: compression and expansion are one
    # power each, and the work of a turn is the area between them.
    q = np.linspace(math.pi, TURN, 200)
    low = Table(place(q)[0], pressure(q), spline="natural", over="bore")
    high = Table(place(q)[0], 3.0 * pressure(q), spline="natural", over="bore")
    loads = [
        Pressure("bore", AREA, low, expands="backward", while_="forward"),
        Pressure("bore", AREA, high, expands="backward", while_="backward"),
    ]
    engine = Machine(slider(), bodies={"crank": Body(inertia=0.3)}, loads=loads)
    run = engine.run(q_end=math.pi + TURN, q0=math.pi, speed0=60.0, rtol=1e-11)
    whole = CLEARANCE + SWEPT
    work = 2.0 * (pressure(0.0) * CLEARANCE - START * whole) / 0.3
    gained = 0.15 * (float(run.speed[-1]) ** 2 - 3600.0)
    assert gained == pytest.approx(work, rel=1e-7)
    found = Machine(slider(), loads=loads).flywheel(0.02, mean_speed=60.0)
    assert found.motor_moment == pytest.approx(-work / TURN, rel=1e-7)


def test_four_strokes_are_a_table_over_two_turns() -> None:
    q = np.array([0.0, math.pi, TURN, TURN, 3.0 * math.pi, 2.0 * TURN])
    values = np.array([9e4, 9e4, 9e5, 3e6, 1.1e5, 9e4])
    table = Table(q, values, spline="linear")
    load = Pressure("bore", AREA, table, expands="backward")
    machine = Machine(slider(), bodies={"crank": Body(inertia=6.0)}, loads=[load])

    def moment(at: float) -> float:
        within = at % (2.0 * TURN)
        half = slice(0, 3) if within < TURN else slice(3, 6)
        side = np.interp(within, q[half], values[half])
        return float(-AREA * (side - AMBIENT) * place(at)[1])

    points = np.linspace(0.1, 2.0 * TURN - 0.1, 25)
    exact = [moment(float(at)) for at in points]
    np.testing.assert_allclose(machine.reduced_moment(points), exact, rtol=1e-11)
    # The motor that keeps the speed takes the work of the two turns; the speed follows from it.
    steady = machine.steady_state(40.0, turns=2, q0=0.1)
    cuts = [math.pi * k for k in range(1, 5)]
    work = integral(moment, 0.1, 0.1 + 2.0 * TURN, *cuts)
    assert work > 100.0
    assert steady.power * steady.period == pytest.approx(-work, rel=1e-10)
    mean = work / (2.0 * TURN)
    some = 7.0
    gained = integral(moment, 0.1, some, *cuts) - mean * (some - 0.1)
    speed2 = float(steady.speed[0]) ** 2 + 2.0 * gained / 6.0
    assert float(steady.at(some).speed) == pytest.approx(math.sqrt(speed2), rel=1e-10)


def test_both_links_of_a_cylinder_feel_it() -> None:
    # An oscillating cylinder pushes a crank: reactions give the effort, and its far end bears on
    # the ground with the force itself.
    mechanism = assur.Mechanism(
        {"A": (0.0, 0.0), "D": (1.0, 0.0), "C": (0.2, 0.3)},
        {"ground": ["A", "D"], "arm": ["A", "C"]},
        driver="arm",
        slides={"ram": assur.Cylinder("D", "C")},
    )
    name = next(iter(mechanism.slides))
    load = Pressure(name, 0.002, 5e6, expands="forward", ambient=0.0)
    machine = Machine(mechanism, loads=[load])
    q = np.linspace(0.6, 2.4, 13)
    found = machine.reactions(q)
    effort = machine.effort(q)
    np.testing.assert_allclose(found.driver, effort, rtol=1e-11)
    pin = 0.36055512754639896 * np.stack([np.cos(q), np.sin(q)], axis=-1)
    span = pin - [1.0, 0.0]
    length = np.hypot(*span.T)
    unit = span / length[:, None]
    torque = 1e4 * (pin[:, 0] * unit[:, 1] - pin[:, 1] * unit[:, 0])
    np.testing.assert_allclose(effort, -torque, rtol=1e-11)
    np.testing.assert_allclose(found.joint("C", on="arm"), 1e4 * unit, rtol=1e-10, atol=1e-6)
    np.testing.assert_allclose(found.joint("D", on="ground"), -1e4 * unit, rtol=1e-10, atol=1e-6)
    pressed = Machine(mechanism, loads=[Pressure(name, 0.002, Gas(3e5, 0.002, 0.9), "forward")])
    np.testing.assert_allclose(pressed.reactions(q).driver, pressed.effort(q), rtol=1e-11)


def test_reactions_and_the_rod_of_an_engine() -> None:
    machine = Machine(slider(), bodies={"piston": Body(mass=1.2)}, loads=[cylinder()])
    q = np.linspace(0.3, 6.0, 15)
    effort = machine.effort(q, 50.0)
    np.testing.assert_allclose(machine.reactions(q, 50.0).driver, effort, rtol=1e-11)
    plain = Machine(slider(), loads=[cylinder()])
    force = AREA * (pressure(q) - AMBIENT)
    sine = CRANK * np.sin(q) / 0.4
    axial = plain.internal_loads("rod", q).axial
    np.testing.assert_allclose(axial[:, 0], -force / np.sqrt(1.0 - sine**2), rtol=1e-9)


def test_designs_copies_and_functions() -> None:
    batch = Machine(slider().with_dimensions({"crank.length": [0.08, 0.1]}), loads=[cylinder()])
    q = np.linspace(0.0, 6.0, 9)
    for index in range(2):
        np.testing.assert_array_equal(
            batch.reduced_moment(q)[index], batch.design(index).reduced_moment(q)
        )
    twin = pickle.loads(pickle.dumps(batch))
    np.testing.assert_array_equal(twin.potential(q), batch.potential(q))
    called = Pressure("bore", AREA, lambda *given: 2e5 + 1e4 * given[2], expands="backward")
    machine = Machine(slider(), loads=[called])
    own = -AREA * (2e5 + 3e4 - AMBIENT) * place(q)[1]
    np.testing.assert_allclose(machine.reduced_moment(q, 3.0), own, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(machine.reactions(q, 3.0).driver, -own, rtol=1e-11, atol=1e-9)


def test_no_volume_left() -> None:
    tight = Pressure("bore", AREA, Gas(1e5, 0.5 * SWEPT, STROKE[0]), expands="backward")
    with pytest.raises(assur.MotionError, match=r"its gas has no volume at bore = 0\.5 m"):
        Machine(slider(), loads=[tight]).reduced_moment(0.0)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Gas(0.0, 1e-3, 0.1), r"Gas: pressure is 0, it must be positive"),
        (lambda: Gas(1e5, -1e-3, 0.1), r"Gas: volume is -0.001, it must be positive"),
        (lambda: Gas(1e5, 1e-3, math.nan), r"Gas at is nan"),
        (lambda: Pressure("bore", 0.0, 1e5, "forward"), r"Pressure: area is 0"),
        (lambda: Pressure("bore", 1e-3, 1e5, "outward"), r"Pressure expands is 'outward'"),  # type: ignore[arg-type]
        (lambda: Pressure("bore", 1e-3, "hot", "forward"), r"Pressure pressure"),  # type: ignore[arg-type]
        (
            lambda: Machine(slider(), loads=[Pressure("bor", 1e-3, 1e5, "forward")]),
            r'"bore"',
        ),
    ],
)
def test_wrong_pressures_are_refused(make: Any, message: str) -> None:
    with pytest.raises(assur.AssurError, match=message):
        make()


def test_a_force_may_turn_with_a_link() -> None:
    # Along the rod toward the crank: the moment about the crank's centre by the lever alone.
    force = assur.Force("A", (500.0, 0.0), axes="rod")
    machine = Machine(slider(), loads=[force])
    q = np.linspace(0.1, 6.2, 21)
    a = CRANK * np.stack([np.cos(q), np.sin(q)], axis=-1)
    along = (np.stack([place(q)[0], 0.0 * q], axis=-1) - a) / 0.4
    lever = a[:, 0] * along[:, 1] - a[:, 1] * along[:, 0]
    np.testing.assert_allclose(machine.reduced_moment(q), 500.0 * lever, rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(machine.reactions(q).driver, -500.0 * lever, rtol=1e-10, atol=1e-10)
