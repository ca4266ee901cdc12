"""What `Machine.reactions` gives and refuses: shapes, designs, loads at pins, names."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Gravity
from models.machines import machines
from oracles.dynamics.reaction_view import View

Q = np.array([0.3, 1.1, 2.9, 4.0])


def machine(m: assur.Mechanism | None = None, *loads: Any) -> Any:
    bodies = {
        "crank": Body(mass=0.7, inertia=0.002, at=(0.04, 0.01)),
        "rod": Body(mass=1.2, inertia=0.015, at=(0.12, -0.02)),
        "piston": Body(mass=2.0, inertia=0.0, at=(0.01, 0.03)),
    }
    return assur.Machine(
        m or assur.SliderCrank(0.1, 0.35), bodies=bodies, loads=[Gravity(), *loads]
    )


def numbers(found: Any) -> list[Any]:
    bore = found.slide("bore")
    joints = (("O", "crank"), ("O", "ground"), ("A", "rod"), ("B", "piston"))
    return [
        *(found.joint(name, on=link) for name, link in joints),
        *(bore.normal, bore.moment, bore.along),
        *(found.driver, found.shaking_force, found.shaking_moment),
    ]


def test_speeds_broadcast() -> None:
    """One speed for all positions, or one for each; the same bits."""
    each = machine().reactions(Q, np.full(4, 20.0), np.full(4, -3.0))
    for one, other in zip(numbers(machine().reactions(Q, 20.0, -3.0)), numbers(each), strict=True):
        np.testing.assert_array_equal(one, other)
    assert each.joint("A", on="rod").shape == (4, 2)
    assert each.driver.shape == each.slide("bore").normal.shape == (4,)
    assert each.shaking_force.shape == (4, 2)
    assert each.shaking_moment.shape == (4,)


@pytest.mark.parametrize("speed", [2.0, (2.0, -3.0), ((2.0,), (-3.0,)), ((2.0, -3.0),)])
def test_speeds_of_two_drivers_broadcast(speed: Any) -> None:
    """Two numbers are of the drivers, or of two positions: as NumPy has it."""
    two = assur.Machine(
        machines.five_bar(), bodies={"b1": Body(mass=2.0, inertia=0.1)}, loads=[Gravity()]
    )
    q = np.add(machines.five_bar().q0, [[0.0, 0.0], [0.1, -0.05]])
    found, exact = (two.reactions(q, v) for v in (speed, np.broadcast_to(speed, (2, 2))))
    assert np.array_equal(found.driver, exact.driver)


def test_designs() -> None:
    """A batch of designs (3,) at positions (4,): each as by itself."""
    m = assur.SliderCrank(0.1, 0.35).with_dimensions({"rod.length": [0.3, 0.35, 0.5]})
    batch = machine(m)
    many = batch.reactions(Q, 20.0, -3.0)
    assert many.joint("A", on="rod").shape == (3, 4, 2)
    assert many.driver.shape == (3, 4)
    effort = batch.effort(Q, 20.0, -3.0)
    assert effort.shape == (3, 4)
    for k in range(3):
        single = batch.design(k)
        alone = single.reactions(Q, 20.0, -3.0)
        for one, other in zip(numbers(alone), numbers(many), strict=True):
            np.testing.assert_array_equal(one, other[k])
        np.testing.assert_array_equal(single.effort(Q, 20.0, -3.0), effort[k])
        known = View(single, Q, 20.0, -3.0)
        largest = max(r.largest() for r in known.all)
        for one, other in zip(numbers(alone), numbers(known), strict=True):
            np.testing.assert_allclose(one, other, rtol=1e-11, atol=1e-13 * largest)


def test_loads_at_a_pin() -> None:
    """It acts on the link named, or on the piston: without friction only the pin's force tells."""
    push = np.array([-800.0, 35.0])
    found = {
        on: machine(None, Force("B", tuple(push), on=on)).reactions(Q, 9.0, 0.0)
        for on in ("rod", "piston", None)
    }
    on_piston = {on: one.joint("B", on="piston") for on, one in found.items()}
    np.testing.assert_allclose(on_piston["rod"] - on_piston["piston"], [push] * 4, rtol=1e-12)
    np.testing.assert_array_equal(on_piston[None], on_piston["piston"])
    for one in found.values():
        total = one.joint("B", on="piston") + one.joint("B", on="rod")
        assert np.abs(total).max() <= 1e-12 * 800.0
        np.testing.assert_allclose(one.driver, found["rod"].driver, rtol=1e-11)


def test_a_motor_is_not_a_load() -> None:
    """The drive is what the driven link needs, whatever turns it; a rotor is the motor's part."""
    bare = machine()
    driven = assur.Machine(
        bare.mechanism,
        bodies=bare.bodies,
        loads=bare.loads,
        motor=assur.ConstantTorque(50.0, ratio=3.0, rotor_inertia=0.4),
    )
    one, other = bare.reactions(Q, 9.0, 2.0), driven.reactions(Q, 9.0, 2.0)
    np.testing.assert_array_equal(one.driver, other.driver)
    np.testing.assert_array_equal(bare.effort(Q, 9.0, 2.0), driven.effort(Q, 9.0, 2.0))


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (lambda found: found.joint("Z", on="rod"), "Z"),
        (lambda found: found.joint("A", on="piston"), "piston"),
        (lambda found: found.joint("A", on="rods"), "rods"),
        (lambda found: found.slide("barrel"), "barrel"),
    ],
)
def test_unknown_names(asked: Any, said: str) -> None:
    found = machine().reactions(Q, 9.0, 0.0)
    with pytest.raises(assur.InputError, match=said):
        asked(found)


@pytest.mark.parametrize(
    "where",
    [
        (Q, np.ones(3), 0.0),
        (Q, 1.0, np.ones(3)),
        ([0.1, math.nan], 1.0, 0.0),
        (Q, math.inf, 0.0),
        ("now", 1.0, 0.0),
    ],
)
@pytest.mark.parametrize("method", ["reactions", "effort"])
def test_bad_numbers(where: tuple[Any, ...], method: str) -> None:
    with pytest.raises(assur.AssurError):
        getattr(machine(), method)(*where)


def test_unreachable_positions() -> None:
    """A dead point beyond which nothing is: an error, or NaN where asked for."""
    m = assur.FourBar(1.0, 2.0, 1.5, 3.6)  # opens only near q = 0
    rocking: Any = assur.Machine(m, bodies={"rocker": Body(mass=1.0, inertia=0.1, at=(0.7, 0.0))})
    q = [0.2, 3.0]
    with pytest.raises(assur.PositionError):
        rocking.reactions(q, 1.0, 0.0)
    found = rocking.reactions(q, 1.0, 0.0, on_error="nan")
    assert np.isfinite(found.driver[0])
    assert np.isnan(found.driver[1])
    assert np.isnan(found.joint("C", on="rocker")[1]).all()


@pytest.mark.parametrize(
    ("at", "on", "joint"),
    [("B", "crank", "B"), ("B", "ground", "B"), (("rod", (0.1, 0.0)), "piston", None)],
)
def test_a_force_is_taken_by_a_link_that_has_its_point(at: Any, on: str, joint: str | None) -> None:
    with pytest.raises(assur.InputError) as caught:
        assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[assur.Force(at, (1.0, 0.0), on=on)])
    assert (caught.value.link, caught.value.joint) == (on, joint)


def test_moments_too_great_are_refused() -> None:
    """1e308 N·m·s at 1e10 rad/s: once moment and effort were infinite without a word."""
    crank = assur.SliderCrank(crank=0.1, rod=0.35)
    machine = assur.Machine(
        crank, bodies={"piston": Body(mass=5.0)}, loads=[assur.TorsionDamper("crank", 1e308)]
    )
    assert math.isfinite(machine.reduced_moment(1.0, 0.0))
    for call in (machine.reduced_moment, machine.effort, machine.reactions):
        with pytest.raises(assur.MotionError) as caught:
            call(1.0, 1e10)
        assert (caught.value.kind, caught.value.q) == ("not_finite", 1.0)


@pytest.mark.filterwarnings("error")
def test_an_effort_too_great_is_refused() -> None:
    """Inertia forces at 1e200 rad/s, without loads."""
    machine = assur.Machine(
        assur.SliderCrank(crank=0.1, rod=0.35), bodies={"piston": Body(mass=5.0)}
    )
    with pytest.raises(assur.MotionError) as caught:
        machine.effort([0.5, 1.0], 1e200)
    assert (caught.value.kind, caught.value.q) == ("not_finite", 0.5)
    assert not np.isfinite(machine.effort(0.5, 1e200, on_error="nan"))


def test_an_infinite_load_leaves_nan_in_its_place() -> None:
    press = assur.SliderCrank(crank=0.1, rod=0.35)
    load = assur.Force("B", (lambda _t, q, _speed: math.inf if q > 1.0 else 1.0, 0.0))
    machine = assur.Machine(press, bodies={"piston": assur.Body(mass=2.0)}, loads=[load])
    found = machine.reactions([0.5, 1.5, 0.7], 3.0, on_error="nan")
    for array in (
        found.driver,
        found.joint("A", "rod")[:, 0],
        found.slide("bore").along,
        machine.effort([0.5, 1.5, 0.7], 3.0, on_error="nan"),
    ):
        assert np.isnan(array).tolist() == [False, True, False]
    assert found.status.tolist() == [0, assur.Status.NO_VALUE, 0]


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_load_that_is_not_finite_is_named(value: float) -> None:
    """Once it gave NaN with the status OK, errors or not."""
    load = assur.Force("B", (lambda *given: value if given[1] else 0.0, 0.0), on="piston")
    machine = assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[load])
    for ask in (machine.reactions, machine.effort, machine.reduced_moment):
        with pytest.raises(assur.InputError, match=r"^loads\[0\], the Force at 'B': ") as caught:
            ask([1.0, 2.0])
        assert (caught.value.kind, caught.value.q) == ("not_finite", 1.0)
    assert not np.isfinite(machine.reactions(1.0, on_error="nan").driver)
