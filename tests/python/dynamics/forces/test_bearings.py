"""Pins as bearings: polar data in links' frames and pressure times velocity, beside the oracle."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Gravity, Torque
from oracles.dynamics.reaction_view import View

Q = np.linspace(0.2, 6.0, 9)


def four_bar(rocker: tuple[str, str] = ("D", "C")) -> assur.Machine:
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (0.03, 0.04), "C": (0.15, 0.11), "D": (0.16, 0)},
        links={"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": rocker},
        driver="crank",
    )
    bodies = {
        "coupler": Body(mass=1.2, inertia=3e-3, at=(0.08, 0.01)),
        "rocker": Body(mass=0.8, inertia=1.5e-3, at="D"),
    }
    return assur.Machine(m, bodies=bodies, loads=[Gravity(), Torque("rocker", -20.0)])


@pytest.mark.parametrize(
    ("joint", "on", "other"),
    [
        ("C", "rocker", "coupler"),
        ("C", "coupler", "rocker"),
        ("B", "crank", "coupler"),
        ("D", "rocker", "ground"),
        ("A", "ground", "crank"),
    ],
)
@pytest.mark.parametrize("frame", [None, "ground", "other"])
def test_polar_data(joint: str, on: str, other: str, frame: str | None) -> None:
    machine = four_bar()
    frame = other if frame == "other" else frame
    pin = machine.reactions(Q, 30.0, 5.0).bearing(joint, on=on, frame=frame)
    known = View(machine, Q, 30.0, 5.0)
    for k, one in enumerate(known.all):
        force = one.joint(joint, on) / complex(one.places.frame[frame or on])
        assert pin.size[k] == pytest.approx(abs(force), rel=1e-11)
        turned = pin.angle[k] - math.atan2(force.imag, force.real)
        assert math.remainder(turned, math.tau) == pytest.approx(0.0, abs=1e-11)
        assert complex(*pin.force[k]) == pytest.approx(force, rel=1e-11)
        spin = float(one.spin[on] - one.spin[other])
        assert pin.relative_speed is not None
        assert pin.relative_speed[k] == pytest.approx(spin, rel=1e-11)
        # p v by hand: of a bearing of 20 mm and 15 mm
        pv = abs(force) / (0.02 * 0.015) * abs(spin) * 0.01
        assert pin.pv(0.02, 0.015)[k] == pytest.approx(pv, rel=1e-11)
        assert pin.pressure(0.02, 0.015)[k] == pytest.approx(abs(force) / 3e-4, rel=1e-11)
    assert pin.mean == pytest.approx(np.mean(pin.size))
    assert (pin.max.value, pin.max.q) == (pin.size.max(), Q[np.argmax(pin.size)])
    assert (pin.min.value, pin.min.q) == (pin.size.min(), Q[np.argmin(pin.size)])


def test_frame_follows_the_order_of_joints() -> None:
    """A rocker listed C, D looks the other way."""
    one, other = (four_bar(order).reactions(Q, 30.0) for order in (("D", "C"), ("C", "D")))
    turned = one.bearing("C", on="rocker").angle - other.bearing("C", on="rocker").angle
    np.testing.assert_allclose(np.abs(turned), math.pi, rtol=1e-9)


def test_a_static_pin() -> None:
    """A strut at 90° of the crank: the force runs along it, whatever the drawing's axes."""
    machine = assur.Machine(
        assur.SliderCrank(0.3, 0.5), loads=[Force("B", (-100.0, 0.0), on="piston")]
    )
    found = machine.reactions(math.pi / 2)
    pin = found.bearing("A", on="rod")
    assert pin.size == pytest.approx(125.0)
    assert pin.angle == pytest.approx(0.0, abs=1e-12)
    assert found.bearing("B", on="rod").angle == pytest.approx(math.pi)
    assert found.bearing("B", on="piston", frame="ground").force == pytest.approx([100.0, -75.0])
    assert (pin.mean, pin.min, pin.max) == (
        pin.size,
        (pin.size, math.pi / 2),
        (pin.size, math.pi / 2),
    )
    assert pin.pv(0.02, 0.01) == 0.0


def test_three_links_at_a_pin() -> None:
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 1), "C": (3, 2), "D": (4, 0), "E": (2, 4), "F": (5, 3)},
        links={"ground": "ADF", "crank": "AB", "l2": "BC", "l3": "DC", "l4": "CE", "l5": "FE"},
        driver="crank",
    )
    machine = assur.Machine(
        m, bodies={"l4": Body(mass=1.0, inertia=0.3, at="E")}, loads=[Gravity()]
    )
    q = float(m.q0) + np.array([0.0, 0.1])
    found = machine.reactions(q, 3.0)
    pin = found.bearing("C", on="l3")
    assert pin.relative_speed is None
    with pytest.raises(assur.InputError, match="against"):
        pin.pv(0.02, 0.01)
    known = View(machine, q, 3.0)
    for against in ("l2", "l4"):
        spins = [float(one.spin["l3"] - one.spin[against]) for one in known.all]
        own = found.bearing("C", on="l3", against=against)
        assert own.relative_speed is not None
        np.testing.assert_allclose(own.relative_speed, spins, rtol=1e-11)
    with pytest.raises(assur.InputError, match="against is 'l5': at joint 'C'"):
        found.bearing("C", on="l3", against="l5")


@pytest.mark.parametrize("q", [0.7, Q, np.stack([Q[:3], Q[:3] + 0.1])])
def test_designs(q: Any) -> None:
    """A batch of designs (2,): each as by itself; also at one coordinate."""
    machine = four_bar()
    m = machine.mechanism
    assert m is not None
    batch = assur.Machine(
        m.with_dimensions({"coupler.length": [0.139, 0.15]}),
        bodies=machine.bodies,
        loads=machine.loads,
    )
    many = batch.reactions(q, 30.0).bearing("C", on="rocker")
    for k in range(2):
        own = q[k] if np.ndim(q) == 2 else q
        one = batch.design(k).reactions(own, 30.0).bearing("C", on="rocker")
        np.testing.assert_array_equal(many.size[k], one.size)
        np.testing.assert_array_equal(many.angle[k], one.angle)
        np.testing.assert_array_equal(many.pv(0.02, 0.015)[k], one.pv(0.02, 0.015))
        assert many.mean[k] == one.mean
        assert (many.max.value[k], many.max.q[k]) == tuple(one.max)


def test_several_drivers() -> None:
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (1.0, 0.5), "E": (1.9, 0.1)},
        links={"ground": "A", "upper": "AB", "fore": "BE"},
        driver=["upper", assur.Drive("fore", relative_to="upper")],
    )
    machine = assur.Machine(
        m, bodies={"fore": Body(mass=2.0, inertia=0.1, at="E")}, loads=[Gravity()]
    )
    q = np.asarray(m.q0) + np.array([[0.0, 0.0], [0.2, -0.4], [0.1, 0.3]])
    pin = machine.reactions(q, (3.0, -2.0)).bearing("B", on="fore")
    assert pin.relative_speed is not None
    np.testing.assert_allclose(pin.relative_speed, -2.0)
    assert pin.max.q.tolist() == q[np.argmax(pin.size)].tolist()


def test_positions_without_a_motion_count_for_no_extreme() -> None:
    m = assur.FourBar(1.0, 2.0, 1.5, 3.6)
    machine = assur.Machine(
        m, bodies={"rocker": Body(mass=1.0, inertia=0.1, at=(0.7, 0.0))}, loads=[Gravity()]
    )
    pin = machine.reactions([3.0, 0.2], on_error="nan").bearing("C", on="rocker")
    assert np.isnan([pin.size[0], pin.angle[0], pin.pv(0.1, 0.1)[0], pin.mean]).all()
    assert pin.max.q == pin.min.q == 0.2
    nowhere = machine.reactions([3.0], on_error="nan").bearing("C", on="rocker")
    assert np.isnan(nowhere.max.value)
    empty = machine.reactions([]).bearing("C", on="rocker")
    assert empty.pv(0.1, 0.1).shape == (0,)
    for ask in ("mean", "max", "min"):
        with pytest.raises(assur.InputError, match="no positions"):
            getattr(empty, ask)


FOUND = four_bar().reactions(Q, 30.0)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: FOUND.bearing("Z", on="rocker"), "Z"),
        (lambda: FOUND.bearing("C", on="rockers"), "rockers"),
        (lambda: FOUND.bearing("C", on="crank"), "crank"),
        (lambda: FOUND.bearing("C", on="rocker", frame="crank"), "frame is 'crank'"),
        (lambda: FOUND.bearing("C", on="rocker", frame=3), "frame is 3"),  # type: ignore[arg-type]
        (lambda: FOUND.bearing("C", on="rocker", against="rocker"), "against is 'rocker'"),
        (lambda: FOUND.bearing("C", on="rocker").pv(0.0, 0.1), "diameter"),
        (lambda: FOUND.bearing("C", on="rocker").pv(0.1, -0.1), "width"),
        (lambda: FOUND.bearing("C", on="rocker").pv(math.nan, 0.1), "diameter"),
        (lambda: FOUND.bearing("C", on="rocker").pressure(0.1, math.inf), "width"),
        (lambda: FOUND.bearing("C", on="rocker").pressure(1e-200, 1e-200), "greatest number"),
    ],
)
def test_refusals(call: Any, said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        call()


def test_a_traced_point_is_no_bearing() -> None:
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (1.0, 0.5)}, links={"ground": "A", "crank": "AB"}, driver="crank"
    )
    with pytest.raises(assur.InputError, match="nothing bears on it"):
        assur.Machine(m).reactions(0.5).bearing("B", on="crank")
