"""Motion with friction: stick and slip against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Gravity, JointFriction, Machine, SlideFriction, Torque

G = 9.81


def block(**friction: float) -> Machine:
    """A block of 2 kg on a level guide, with a spring of 800 N/m to the origin."""
    way = assur.Mechanism(
        joints={"O": (0, 0), "B": (0.05, 0)},
        links={"ground": "O", "block": "B"},
        slides={"way": assur.Slide("block", "ground", angle=0.0, origin="O")},
        driver="way",
    )
    spring = assur.Spring("O", "B", stiffness=800.0, length=0.0)
    return Machine(
        way,
        bodies={"block": Body(mass=2.0)},
        loads=[Gravity(), spring],
        friction={"way": SlideFriction(**friction)},
    )


def test_a_block_on_a_spring() -> None:
    """Each half swing loses twice Δ = f m g/k; it rests where the spring no longer moves it."""
    run = block(coefficient=0.3, length=0.1).run(t_end=1.0, q0=0.05, speed0=0.0)
    assert run.end == "reached"
    stick = run.events[-1]
    assert stick.event == "stick"
    assert abs(stick.t - 3 * math.pi / 20) < 1e-9
    delta = 0.3 * 2.0 * G / 800.0
    turns = [(-1) ** n * (0.05 - 2 * n * delta) for n in (1, 2, 3)]
    for n, place in enumerate(turns, 1):
        assert abs(run.at(n * math.pi / 20).q - place) < 1e-10
    assert (run.q[-1], run.speed[-1]) == (stick.q, 0.0)
    assert run.energy.error < 1e-9


def test_a_run_says_from_when_on_it_stands_still() -> None:
    machine = block(coefficient=0.3, length=0.1)
    run = machine.run(t_end=15.0, q0=0.05)
    assert (run.end, run.at_rest_from) == ("reached", run.events[-1].t)
    assert repr(run).endswith("1 event, reached, stands still from t = 0.471239 s on>")
    assert run.message == "reached its end, stands still from t = 0.471239 s on"
    # Not where it moves, nor where it only comes to rest at the end.
    moving = machine.run(t_end=0.4, q0=0.05)
    assert (moving.at_rest_from, moving.message) == (None, "reached its end")
    stopped = machine.run(t_end=1.0, q0=0.05, events=[assur.events.Rest()])
    assert (stopped.end, stopped.at_rest_from) == ("event", None)
    assert engine(1.0).run(t_end=0.3, q0=0.3, speed0=40.0).at_rest_from is None
    # A machine in balance stands still without friction, too.
    still = Machine(assur.SliderCrank(0.1, 0.4), bodies={"crank": Body(inertia=1.0)}).run(t_end=1.0)
    assert still.at_rest_from == 0.0


def test_static_friction_holds_earlier() -> None:
    """With 0.9 at rest it stays after the second half swing."""
    machine = block(coefficient=0.3, length=0.1, static_coefficient=0.9)
    run = machine.run(t_end=1.0, q0=0.05, speed0=0.0)
    stick = run.events[-1]
    # 0.9 holds up to 0.0220725 m, which |x₂| = 0.02057 does not reach.
    assert stick.event == "stick"
    assert abs(stick.t - 2 * math.pi / 20) < 1e-9
    assert abs(run.q[-1] - 0.02057) < 1e-10


def test_a_wheel_comes_to_rest() -> None:
    wheel = assur.Mechanism(
        joints={"O": (0, 0), "A": (1, 0)}, links={"ground": "O", "wheel": "OA"}, driver="wheel"
    )
    machine = Machine(
        wheel,
        bodies={"wheel": Body(mass=10.0, inertia=0.2, at="O")},
        loads=[Gravity()],
        friction={"O": JointFriction(0.1, 0.02)},
    )
    run = machine.run(t_end=40.0, q0=0.0, speed0=30.0)
    assert [one.event for one in run.events] == ["stick"]
    assert abs(run.events[0].t - 30.58103975535) < 1e-9
    assert abs(run.events[0].q - 458.7155963303) < 1e-8
    assert run.t[-1] == 40.0
    over = machine.run(q_end=500.0, q0=0.0, speed0=30.0)
    assert over.end == "rest"
    assert abs(over.q[-1] - 458.7155963303) < 1e-6


def test_a_rotor_with_an_unbalance() -> None:
    """α = −c ω², so ω = ω₀/(1 + c ω₀ t)."""
    rotor = assur.Mechanism(
        joints={"O": (0, 0), "A": (1, 0)}, links={"ground": "O", "rotor": "OA"}, driver="rotor"
    )
    machine = Machine(
        rotor,
        bodies={"rotor": Body(mass=4.0, inertia=0.02, at=(0.03, 0.0))},
        friction={"O": JointFriction(0.15, 0.05)},
    )
    kappa = 0.15 * 0.05 * 4.0 * 0.03 / (0.02 + 4.0 * 0.03**2)
    c = kappa / math.sqrt(1 - kappa**2)
    run = machine.run(t_end=1.0, q0=0.0, speed0=100.0)
    t = np.linspace(0.0, 1.0, 11)
    np.testing.assert_allclose(run.at(t).speed, 100.0 / (1 + c * 100.0 * t), rtol=1e-9)
    half = run.at(0.2620314748788)
    np.testing.assert_allclose(half.speed, 50.0, rtol=1e-9)
    np.testing.assert_allclose(half.q, 18.16263780302, rtol=1e-9)


def test_it_slips_when_the_load_allows() -> None:
    """A force that grows with time moves the block at static, then kinetic friction."""
    way = assur.Mechanism(
        joints={"O": (0, 0), "B": (0.5, 0)},
        links={"ground": "O", "block": "B"},
        slides={"way": assur.Slide("block", "ground", angle=0.0, origin="O")},
        driver="way",
    )
    push = Force("B", (lambda t, _q, _v: 10.0 * t, 0.0), on="block")
    machine = Machine(
        way,
        bodies={"block": Body(mass=2.0)},
        loads=[Gravity(), push],
        friction={"way": SlideFriction(0.3, 0.1, static_coefficient=0.5)},
    )
    run = machine.run(t_end=2.0, q0=0.5, speed0=0.0)
    begins = 0.5 * 2.0 * G / 10.0
    assert [one.event for one in run.events] == ["slip"]
    assert abs(run.events[0].t - begins) < 1e-9
    # v = ∫ (10 t/m − f g) dt from there.
    speed = 2.5 * (4.0 - begins**2) - 0.3 * G * (2.0 - begins)
    np.testing.assert_allclose(run.speed[-1], speed, rtol=1e-9)


def test_viscous_friction_alone() -> None:
    wheel = assur.Mechanism(
        joints={"O": (0, 0), "A": (1, 0)}, links={"ground": "O", "wheel": "OA"}, driver="wheel"
    )
    machine = Machine(
        wheel,
        bodies={"wheel": Body(inertia=0.5)},
        friction={"O": JointFriction(0.0, 0.0, viscous=0.2)},
    )
    run = machine.run(t_end=3.0, q0=0.0, speed0=4.0)
    np.testing.assert_allclose(run.speed[-1], 4.0 * math.exp(-0.2 / 0.5 * 3.0), rtol=1e-9)


def engine(part: float) -> Machine:
    friction: dict[str, Any] = {
        name: JointFriction(0.08 * part, radius)
        for name, radius in {"O": 0.02, "A": 0.025, "B": 0.012}.items()
    }
    return Machine(
        assur.SliderCrank(crank=0.1, rod=0.35),
        bodies={
            "crank": Body(inertia=0.2),
            "rod": Body(mass=1.2, inertia=0.015, at=(0.12, 0.0)),
            "piston": Body(mass=2.0),
        },
        loads=[Gravity(), Torque("crank", -3.0)],
        friction={**friction, "bore": SlideFriction(0.1 * part, 0.06)} if part else {},
    )


def test_reactions_along_a_run_ask_for_no_drive() -> None:
    """The acceleration is the one at which the drive gives nothing, friction included."""
    machine = engine(1.0)
    run = machine.run(t_end=0.6, q0=0.3, speed0=40.0)
    found = machine.reactions(run)
    moving = abs(run.speed) > 1e-6
    assert moving.sum() > 50
    size = abs(found.joint("A", on="rod")).max() * 0.1
    assert abs(found.driver[moving]).max() <= 1e-9 * size
    assert run.energy.error < 1e-9
    # What friction takes is what is missing.
    taken = np.sum([*found.losses.values()], axis=0)
    assert (taken[moving] > 0.0).all()


def test_no_friction_is_the_limit() -> None:
    free = engine(0.0).run(t_end=0.5, q0=0.3, speed0=40.0).speed[-1]
    last = 10.0
    for part in (1e-2, 1e-4, 1e-6):
        off = abs(engine(part).run(t_end=0.5, q0=0.3, speed0=40.0).speed[-1] - free)
        assert off < 0.02 * last
        last = max(off, 1e-9)


def test_what_has_no_friction_yet_refuses_it() -> None:
    machine = engine(1.0)
    for call in (
        lambda: machine.steady_state(speed=10.0),
        lambda: machine.flywheel(0.1, mean_speed=10.0),
        machine.equilibria,
    ):
        with pytest.raises(assur.InputError, match="has no friction yet"):
            call()


def test_efficiency_over_a_cycle() -> None:
    """What friction takes over a turn is the integral of the losses of all pairs."""
    machine = engine(1.0)
    q = np.linspace(0.0, 2 * math.pi, 721)
    duty = machine.duty(q[:-1], 30.0)
    losses = machine.reactions(q, 30.0).losses
    lost = sum(np.trapezoid(power, q / 30.0) for power in losses.values())
    np.testing.assert_allclose(duty.lost, lost, rtol=1e-4)
    # The torque on the crank takes all that is not lost.
    output = 3.0 * 2 * math.pi
    np.testing.assert_allclose(duty.energy, output + duty.lost, rtol=1e-6)
    np.testing.assert_allclose(duty.efficiency, output / duty.energy, rtol=1e-6)
    free = engine(0.0).duty(q[:-1], 30.0)
    assert (free.lost, free.efficiency) == (0.0, 1.0)


def test_friction_bends_a_rod() -> None:
    """Its moments act at the pins: beyond the last one nothing is left inside."""
    rod = Body(mass=4.0, inertia=4.0 * 0.4**2 / 12, at=(0.2, 0.0))
    pins = {name: JointFriction(0.1, 0.03) for name in "OAB"}
    machine = Machine(
        assur.SliderCrank(0.1, 0.4), bodies={"rod": rod, "piston": Body(mass=20.0)}, friction=pins
    )
    q = np.linspace(0.1, 6.0, 7)
    inside = machine.internal_loads("rod", q, speed=30.0)
    found = machine.reactions(q, 30.0)
    first, last = (found.joint_moment(name, "rod") for name in "AB")
    np.testing.assert_allclose(inside.moment[:, 0], -first, rtol=1e-12)
    # At the last place the loads there do not count: what is left balances the pin's moment.
    np.testing.assert_allclose(inside.moment[:, -1], last, rtol=1e-9)


def test_friction_is_of_the_interval_in_which_it_moves() -> None:
    """Behind a gap the guide slides the other way; where a run moves its friction opposes it."""
    mechanism = assur.Mechanism(
        joints={"A": (0, 0), "B": (0.6, -0.8), "C": (3.2, -2.4), "D": (4, 0), "E": (7.5, 0)},
        links={
            "ground": "AD",
            "crank": "AB",
            "coupler": "BC",
            "rocker": "CD",
            "rod": "CE",
            "block": "E",
        },
        driver="rocker",
        slides={"guide": assur.Slide("block", on="ground", angle=0.0)},
    )
    bodies = {
        name: assur.Body(mass=1.0, inertia=0.05)
        for name in ("crank", "coupler", "rocker", "rod", "block")
    }
    friction = {"guide": assur.SlideFriction(0.2, 0.3)}
    machine = assur.Machine(mechanism, bodies=bodies, loads=[assur.Gravity()], friction=friction)
    (low, high), _ = (own for own in mechanism.limits().intervals[::-1])
    for q in np.linspace(low + 0.02, high - 0.02, 9):
        for speed in (1.0, -1.0):
            run = machine.run(1e-9, q, speed)
            found = machine.reactions(run.q, run.speed, run.acceleration)
            # Nothing drives it but gravity.
            np.testing.assert_allclose(found.driver, 0.0, atol=1e-9)
