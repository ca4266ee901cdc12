"""Reactions and efforts along runs with friction that begin, turn back or stop at rest."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

import assur
from assur import (
    Body,
    ConstantTorque,
    Force,
    Gravity,
    JointFriction,
    Machine,
    SlideFriction,
    Spring,
    Torque,
)

G = 9.81


def block(*loads: Any, **friction: float) -> Machine:
    """A block of 2 kg on a level guide."""
    way = assur.Mechanism(
        joints={"O": (0, 0), "B": (0.5, 0)},
        links={"ground": "O", "block": "B"},
        slides={"way": assur.Slide("block", "ground", angle=0.0, origin="O")},
        driver="way",
    )
    own = {"way": SlideFriction(**friction)}
    return Machine(way, bodies={"block": Body(mass=2.0)}, loads=[Gravity(), *loads], friction=own)


def engine(*loads: Any, motor: Any = None) -> Machine:
    rod = Body(mass=1.2, inertia=1.2 * 0.35**2 / 12, at=(0.175, 0.0))
    bodies = {"crank": Body(inertia=0.2), "rod": rod, "piston": Body(mass=2.0)}
    friction: dict[str, Any] = {
        "O": JointFriction(0.08, 0.02),
        "A": JointFriction(0.08, 0.025),
        "B": JointFriction(0.08, 0.012),
        "bore": SlideFriction(0.1, 0.06),
    }
    own = [Gravity(), *loads]
    return Machine(
        assur.SliderCrank(0.1, 0.35), bodies=bodies, loads=own, motor=motor, friction=friction
    )


def greatest(found: Any) -> float:
    return float(np.nanmax(np.abs(found.joint("A", on="rod")))) * 0.1


def test_a_run_from_rest_has_the_sense_of_its_motion() -> None:
    for torque in (5.0, -5.0):
        machine = engine(Torque("crank", torque))
        run = machine.run(t_end=0.5, q0=0.3)
        found = machine.reactions(run)
        assert run.speed[0] == 0.0
        assert not found.at_rest.any()
        # Nothing but the loads drives it.
        assert np.abs(found.driver).max() <= 1e-9 * greatest(found)
        np.testing.assert_array_equal(machine.effort(run), found.driver)
        # As at a speed next to none.
        near = machine.reactions(0.3, math.copysign(1e-9, torque), run.acceleration[0])
        np.testing.assert_allclose(found.joint("A", "rod")[0], near.joint("A", "rod"), rtol=1e-9)
        np.testing.assert_allclose(found.joint_moment("A", "rod")[0], near.joint_moment("A", "rod"))
        assert [float(loss[0]) for loss in found.losses.values()] == [0.0] * 4
        assert math.isnan(found.efficiency[0])


def test_where_it_turns_back_and_stops() -> None:
    """Half swings of a block on a spring, until friction holds it."""
    machine = block(Spring("O", "B", 800.0, 0.45), coefficient=0.3, length=0.1)
    run = machine.run(t_end=1.0)
    found = machine.reactions(run)
    stops = run.events[-1].t
    assert run.events[-1].event == "stick"
    np.testing.assert_array_equal(found.at_rest, run.t > stops)
    np.testing.assert_array_equal(np.isnan(found.driver), found.at_rest)
    np.testing.assert_array_equal(np.isnan(found.slide("way").friction), found.at_rest)
    # At the ends of half swings, too, whatever rounding makes of the speed.
    assert np.nanmax(np.abs(found.driver)) < 1e-7
    assert found.undetermined == ()
    assert not found.locked.any()
    weight = 0.3 * 2.0 * G
    moves = ~found.at_rest
    np.testing.assert_allclose(np.abs(found.slide("way").friction[moves]), weight, rtol=1e-12)
    np.testing.assert_array_equal(machine.effort(run), found.driver)
    again = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(again.at_rest, found.at_rest)
    states = run.at(np.linspace(0.0, 1.0, 41))
    rests = machine.reactions(states).at_rest
    np.testing.assert_array_equal(rests, states.t > stops)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_where_it_leaves_its_rest(sign: float) -> None:
    """Static friction is at its limit there, and the drive gives nothing yet."""
    push = Force("B", (lambda t, _q, _v: sign * 10.0 * t, 0.0), on="block")
    machine = block(push, coefficient=0.3, length=0.1, static_coefficient=0.5)
    run = machine.run(t_end=2.0)
    found = machine.reactions(run)
    begins = int(np.flatnonzero(run.speed)[0]) - 1
    np.testing.assert_array_equal(found.at_rest, np.arange(run.t.size) < begins)
    assert np.nanmax(np.abs(found.driver)) < 1e-12
    friction = found.slide("way").friction
    np.testing.assert_allclose(friction[begins], -sign * 0.5 * 2.0 * G, rtol=1e-12)
    np.testing.assert_allclose(friction[begins + 1 :], -sign * 0.3 * 2.0 * G, rtol=1e-12)


def test_a_run_that_never_moves() -> None:
    machine = block(coefficient=0.3, length=0.1)
    run = machine.run(t_end=1.0)
    found = machine.reactions(run)
    assert found.at_rest.all()
    assert np.isnan(machine.effort(run)).all()
    assert run.at_rest_from == 0.0
    # Asked for a sense it is what the drive needs to move it.
    np.testing.assert_allclose(machine.reactions(run, sense=1).driver, 0.3 * 2.0 * G)
    with pytest.raises(assur.InputError, match="speed is 0 at q"):
        machine.reactions(0.5)


def test_loads_of_one_way_at_rest() -> None:
    brake = Force("B", (-3.0, 0.0), on="block", while_="forward")
    way = block(coefficient=0.3, length=0.1).mechanism
    assert way is not None
    machine = Machine(
        way, bodies={"block": Body(mass=2.0)}, loads=[brake, Force("B", (8.0, 0.0), on="block")]
    )
    run = machine.run(t_end=1.0)
    assert np.abs(machine.effort(run)).max() < 1e-12
    assert np.abs(machine.reactions(run).driver).max() < 1e-12


def test_what_follows_from_reactions_of_a_run_from_rest() -> None:
    machine = engine(motor=ConstantTorque(6.0))
    run = machine.run(t_end=0.4, q0=0.3)
    duty = machine.duty(run)
    assert (float(duty.time), run.speed[0]) == (run.t[-1], 0.0)
    np.testing.assert_allclose(duty.energy, 6.0 * (run.q[-1] - run.q[0]), rtol=1e-9)
    np.testing.assert_allclose(duty.rms, 6.0, rtol=1e-9)
    assert duty.lost > 0.0
    close = machine.duty(run.at(np.linspace(0.0, 0.4, 400)))
    np.testing.assert_allclose(close.energy, duty.energy, rtol=1e-7)
    inside = machine.internal_loads("rod", run)
    assert np.isfinite(inside.moment).all()
    assert math.isfinite(inside.peak("moment").value)
    assert np.isfinite(machine.reactions(run).bearing("A", "rod").size).all()
