"""Impacts against closed forms and worked numbers; momentum and energy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Machine, Torque
from reaction_machines import reaction_case


def linkage() -> Machine:
    """The four-bar of the balance of forces, without counterweights."""

    def body(mass: float, radius: float, angle: float, inertia: float) -> Body:
        return Body(mass, inertia, (radius * math.cos(angle), radius * math.sin(angle)))

    return Machine(
        assur.FourBar(0.05, 0.15, 0.12, 0.16),
        {
            "crank": body(0.5, 0.02, 0.3, 2e-4),
            "coupler": body(1.2, 0.08, 0.15, 3e-3),
            "rocker": body(0.8, 0.06, -0.2, 1.5e-3),
        },
        [assur.Gravity()],
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
    machine = Machine(rod, {"rod": Body(mass, inertia, (centre, 0.0))})
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
    machine = Machine(disc, {"disc": Body(inertia=own)})
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
        sizes = [np.abs(x).max() for x in hit.reactions._found.values() if np.isfinite(x).all()]
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
    wide = Machine(mechanism.with_dimensions({"rocker.length": [0.12, 0.13]}), machine.bodies)
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
