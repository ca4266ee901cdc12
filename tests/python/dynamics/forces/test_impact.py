"""Impacts against closed forms and worked numbers; momentum and energy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Machine, Torque
from models.machines.reaction_machines import reaction_case


def linkage() -> Machine:
    """The four-bar of the balance of forces, without counterweights."""

    def body(mass: float, radius: float, angle: float, inertia: float) -> Body:
        return Body(
            mass=mass, inertia=inertia, at=(radius * math.cos(angle), radius * math.sin(angle))
        )

    return Machine(
        assur.FourBar(0.05, 0.15, 0.12, 0.16),
        bodies={
            "crank": body(0.5, 0.02, 0.3, 2e-4),
            "coupler": body(1.2, 0.08, 0.15, 3e-3),
            "rocker": body(0.8, 0.06, -0.2, 1.5e-3),
        },
        loads=[assur.Gravity()],
    )


STOP = Force(("rocker", (0.1, 0.0)), (0.0, 1.0), axes="rocker")


def test_a_rocker_hits_a_stop() -> None:
    machine = linkage()
    back = Force(STOP.at, (0.0, -1.0), axes="rocker")
    hit = machine.impact(back, 2.0, 20.0, restitution=0.4)
    np.testing.assert_allclose(machine.reduced_inertia(2.0).value, 0.004184885421921, rtol=1e-12)
    assert hit.speed == pytest.approx(-8.0, rel=1e-14)
    np.testing.assert_allclose(hit.impulse, 2.807955474, rtol=1e-9)
    np.testing.assert_allclose(hit.energy_lost, 0.7030607509, rtol=1e-9)
    found = hit.reactions
    for joint, on, impulse in (
        ("A", "crank", (-0.03774643043, 0.1869939699)),
        ("B", "coupler", (-0.2465438898, 0.0004366839)),
        ("C", "rocker", (-1.793104590, -0.6710885063)),
        ("D", "rocker", (-0.2514058115, -0.2944279129)),
    ):
        np.testing.assert_allclose(found.joint(joint, on=on), impulse, rtol=0, atol=6e-10)
    assert abs(found.driver) < 1e-14
    # In the other direction the obstacle does not hold it.
    away = machine.impact(STOP, 2.0, 20.0, restitution=0.4)
    assert (away.speed, away.impulse, away.energy_lost) == (20.0, 0.0, 0.0)


def test_centre_of_percussion() -> None:
    """Struck at I/(m s) from its hinge a rod leaves the hinge alone."""
    rod = assur.Mechanism(
        joints={"O": (0, 0), "A": (1, 0)}, links={"ground": "O", "rod": "OA"}, driver="rod"
    )
    mass, centre, inertia = 2.0, 0.4, 0.1
    machine = Machine(rod, bodies={"rod": Body(mass=mass, inertia=inertia, at=(centre, 0.0))})
    at = (inertia + mass * centre**2) / (mass * centre)
    struck = machine.impact(Force(("rod", (at, 0.0)), (0.0, 1.0)), 0.0, 0.0, impulse=3.0)
    np.testing.assert_allclose(struck.speed, 3.0 * at / (inertia + mass * centre**2), rtol=1e-14)
    np.testing.assert_allclose(struck.reactions.joint("O", on="rod"), 0.0, atol=1e-14)
    assert struck.energy_lost == pytest.approx(-0.5 * 3.0 * at * struck.speed, rel=1e-14)


def test_a_clutch() -> None:
    """An impulse of two discs on each other makes their speeds equal: momentum stays."""
    own, other = 0.3, 0.2
    disc = assur.Mechanism(
        joints={"O": (0, 0), "A": (1, 0)}, links={"ground": "O", "disc": "OA"}, driver="disc"
    )
    machine = Machine(disc, bodies={"disc": Body(inertia=own)})
    both = (own * 5.0 + other * 30.0) / (own + other)
    given = other * (30.0 - both)
    np.testing.assert_allclose(
        machine.impact(Torque("disc", 1.0), 0.0, 5.0, impulse=given).speed, both, rtol=1e-14
    )


@pytest.mark.parametrize("seed", range(40))
def test_momentum_and_energy(seed: int) -> None:
    """Random machines of all classes: rebound, energy, and the momentum of the drivers."""
    case = reaction_case(seed)
    machine: Any = case.machine
    q, speed, _ = case.position(0)
    link = next(
        name for name in case.mechanism.links if case.mechanism.links[name] and name != "ground"
    )
    for sense in (1.0, -1.0):
        load = Force((link, (0.3, 0.2)), (0.6 * sense, 0.8 * sense))
        hit = machine.impact(load, q, speed, restitution=0.3)
        inertia = np.atleast_2d(machine.reduced_inertia(q).value)
        path = np.atleast_1d(Machine(case.mechanism, loads=[load]).reduced_moment(q))
        before, after = np.atleast_1d(speed), np.atleast_1d(hit.speed)
        way = float(path @ before)
        if way >= 0.0:
            assert hit.impulse == 0.0
            continue
        assert abs(path @ after + 0.3 * way) <= 1e-12 * abs(path) @ abs(after)
        gained = inertia @ (after - before) - path * hit.impulse
        assert abs(gained).max() <= 1e-12 * (abs(inertia) @ abs(after - before)).max()
        energy = [0.5 * v @ inertia @ v for v in (before, after)]
        assert abs(energy[0] - energy[1] - hit.energy_lost) <= 1e-12 * max(energy)
        # The drives are free.
        sizes = [np.abs(x).max() for x in hit.reactions.by_key.values() if np.isfinite(x).all()]
        assert np.abs(hit.reactions.driver).max() <= 1e-10 * max(sizes)


def test_positions_and_designs() -> None:
    machine = linkage()
    q = np.array([2.0, 2.5, 3.0])
    many = machine.impact(STOP, q, -20.0, restitution=[0.0, 0.5, 1.0])
    for k in range(3):
        one = machine.impact(STOP, q[k], -20.0, restitution=0.5 * k)
        np.testing.assert_array_equal(many.speed[k], one.speed)
        np.testing.assert_array_equal(
            many.reactions.joint("C", on="rocker")[k], one.reactions.joint("C", on="rocker")
        )
    np.testing.assert_allclose(many.energy_lost[2], 0.0, atol=1e-15)
    mechanism: Any = machine.mechanism
    wide = Machine(
        mechanism.with_dimensions({"rocker.length": [0.12, 0.13]}), bodies=machine.bodies
    )
    assert wide.impact(STOP, q, -20.0).speed.shape == (2, 3)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda m: m.impact(assur.Gravity(), 2.0, 1.0), "says not where the impact acts"),
        (lambda m: m.impact(Force("C", (0.0, 0.0)), 2.0, 1.0), "needs a direction"),
        (lambda m: m.impact(Torque("rocker", lambda *_: 1.0), 2.0, 1.0), "direction in numbers"),
        (lambda m: m.impact(STOP, 2.0, 1.0, restitution=1.5), "restitution is 1.5: from 0"),
        (lambda m: m.impact(STOP, 2.0, 1.0, restitution=math.nan), "restitution"),
        (lambda m: m.impact(STOP, 2.0, 1.0, restitution=[0.1, 0.2]), "they do not fit"),
        (lambda m: m.impact(STOP, 2.0, math.inf), "speed is inf"),
        (lambda m: m.impact(STOP, 2.0, 1.0, impulse=math.nan), "impulse"),
        (lambda m: Machine(m.mechanism).impact(STOP, 2.0, 1.0), "no inertia"),
    ],
)
def test_refusals(call: Any, said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        call(linkage())


def ball() -> Machine:
    """A weight that falls along a vertical guide."""
    one = assur.Mechanism(
        joints={"O": (0, 0), "B": (0, 2.0)},
        links={"ground": "O", "ball": "B"},
        slides={"way": assur.Slide("ball", "ground", angle=math.pi / 2, origin="O")},
        driver="way",
    )
    return Machine(one, bodies={"ball": Body(mass=3.0)}, loads=[assur.Gravity()])


def test_a_ball_bounces() -> None:
    """From 2 m, e = 0.5: hits at √(2h/g), then after 2 e^k √(2h/g) each, to the end at Σ."""
    floor = assur.events.Obstacle(assur.events.Position(0.0, direction="falling"), 0.5)
    fall = math.sqrt(4.0 / 9.81)
    run = ball().run(t_end=1.85, q0=2.0, events=[floor])
    times = [fall * (1 + 2 * sum(0.5**k for k in range(1, n))) for n in range(1, 5)]
    assert [one.event for one in run.events[:4]] == [floor] * 4
    np.testing.assert_allclose([one.t for one in run.events[:2]], times[:2], rtol=0, atol=1e-9)
    np.testing.assert_allclose([one.t for one in run.events[:4]], times, rtol=0, atol=1e-8)
    np.testing.assert_allclose(run.events[1].speed, -0.5 * math.sqrt(4.0 * 9.81), rtol=1e-9)
    assert run.energy.error < 1e-9
    # It lies still after three times the fall.
    rest = ball().run(t_end=5.0, q0=2.0, events=[floor])
    assert rest.end == "event"
    np.testing.assert_allclose(rest.t[-1], 3 * fall, rtol=2e-3)
    stays = ball().run(t_end=5.0, q0=2.0, events=[assur.events.Obstacle(floor.at, 0.0)])
    assert (stays.end, len(stays.events)) == ("event", 1)


@pytest.mark.parametrize("e", [0.1, 0.3, 0.6, 0.8, 0.9, 0.95])
def test_a_ball_never_falls_through(e: float) -> None:
    floor = assur.events.Obstacle(assur.events.Position(0.0, direction="falling"), e)
    for height in (1e-3, 1.0, 50.0):
        run = ball().run(t_end=1000.0, q0=height, events=[floor])
        assert run.end == "event"
        assert run.q.min() >= -1e-9 * height
        speeds = np.array([one.speed for one in run.events])
        np.testing.assert_allclose(speeds[1:] / speeds[:-1], e, rtol=1e-6)


def test_an_elastic_stop_of_a_linkage() -> None:
    """Energy stays, the way back is the way there, and `impact` gives the same speed."""
    mechanism: Any = linkage().mechanism
    machine = Machine(mechanism, bodies=linkage().bodies)
    stop = assur.events.Obstacle(
        assur.events.Crossing(lambda _t, q, _v: 2.0 - q, direction="falling"), 1.0
    )
    run = machine.run(t_end=0.3, q0=0.5, speed0=20.0, events=[stop])
    hit = run.events[0]
    np.testing.assert_allclose(hit.q, 2.0, atol=1e-12)
    back = run.at(2 * hit.t)
    np.testing.assert_allclose([back.q, back.speed], [0.5, -20.0], rtol=1e-8)
    assert run.energy.error < 1e-9
    push = Force("C", (-1.0, 0.0))
    way = float(machine.impact(push, hit.q, hit.speed, restitution=1.0).speed)
    other = float(machine.impact(Force("C", (1.0, 0.0)), hit.q, hit.speed, restitution=1.0).speed)
    assert min(way, other) == pytest.approx(-hit.speed, rel=1e-12)


@pytest.mark.parametrize(
    ("obstacle", "said"),
    [
        (assur.events.Obstacle(assur.events.Position(1.0), 0.5), "from which side"),
        (assur.events.Obstacle(assur.events.Position(1.0, direction="rising"), 1.5), "is 1.5"),
        (assur.events.Obstacle(assur.events.Rest(), 0.5), "is not a Position"),  # type: ignore[arg-type]
    ],
)
def test_obstacles_that_are_refused(obstacle: Any, said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        linkage().run(t_end=1.0, q0=0.0, speed0=1.0, events=[obstacle])


def test_an_obstacle_over_q_is_refused() -> None:
    stop = assur.events.Obstacle(assur.events.Position(1.0, direction="rising"), 0.5)
    with pytest.raises(assur.InputError, match="does not turn back"):
        linkage().run(q_end=2.0, q0=0.0, speed0=1.0, events=[stop])
