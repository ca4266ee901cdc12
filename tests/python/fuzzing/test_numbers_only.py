"""Where one number is expected, text, times, masks and the like are refused, not converted."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Body, Machine, crank_rocker, flywheel, slider_crank
from assur._arrays import short

if TYPE_CHECKING:
    from collections.abc import Callable

PRESS = assur.SliderCrank(0.1, 0.4)
MACHINE = Machine(PRESS, bodies={"crank": Body(inertia=0.5), "piston": Body(mass=20.0)})
ROCKER = {"l1": 1.0, "l2": 9.0, "l3": 6.0}


def drawn(**changed: Any) -> assur.Mechanism:
    joints: dict[str, Any] = {"O": (0, 0), "A": (0.05, 0), "B": (0.25, 0), **changed}
    return assur.Mechanism(joints, PRESS.links, "crank", slides=PRESS.slides)


def guided(angle: Any) -> assur.Mechanism:
    bore = assur.Slide("piston", on="ground", angle=angle, origin="O")
    joints = {"O": (0, 0), "A": (0.05, 0), "B": (0.25, 0)}
    return assur.Mechanism(joints, PRESS.links, "crank", slides={"bore": bore})


def stopped(event: Any) -> assur.Run:
    return MACHINE.run(0.1, speed0=1.0, events=[event])


ASKS: dict[str, Callable[[Any], object]] = {
    "joint": lambda x: drawn(A=(x, 0.0)),
    "both of a joint": lambda x: drawn(A=x),
    "guide": guided,
    "mass": lambda x: Body(mass=x),
    "inertia": lambda x: Body(inertia=x),
    "centre of mass": lambda x: Body(mass=1.0, at=(x, 0.0)),
    "gravity": lambda x: assur.Gravity((0.0, x)),
    "force": lambda x: assur.Force("B", (x, 0.0)),
    "place": lambda x: assur.Force(("rod", (x, 0.0)), (1.0, 0.0)),
    "torque": lambda x: assur.Torque("crank", x),
    "stiffness": lambda x: assur.Spring("A", "O", x, 0.1),
    "length": lambda x: assur.Spring("A", "O", 1.0, x),
    "preload": lambda x: assur.Spring("A", "O", 1.0, 0.1, preload=x),
    "torsion": lambda x: assur.TorsionSpring("crank", x),
    "angle": lambda x: assur.TorsionSpring("crank", 1.0, angle=x),
    "damping": lambda x: assur.Damper("A", "O", x),
    "torsion damping": lambda x: assur.TorsionDamper("crank", x),
    "motor": assur.ConstantTorque,
    "ratio": lambda x: assur.ConstantTorque(1.0, ratio=x),
    "rotor": lambda x: assur.ConstantTorque(1.0, ratio=1.0, rotor_inertia=x),
    "stall": lambda x: assur.LinearMotor(x, 10.0),
    "no_load": lambda x: assur.LinearMotor(10.0, x),
    "breakdown": lambda x: assur.InductionMotor(x, 0.1, 10.0),
    "slip": lambda x: assur.InductionMotor(1.0, x, 10.0),
    "synchronous": lambda x: assur.InductionMotor(1.0, 0.1, x),
    "table's ratio": lambda x: assur.Table([0, 1], [1, 1], ratio=x),
    "table's rotor": lambda x: assur.Table([0, 1], [1, 1], rotor_inertia=x),
    "t_end": lambda x: MACHINE.run(x, speed0=1.0),
    "q_end": lambda x: MACHINE.run(q_end=x, speed0=1.0),
    "t0": lambda x: MACHINE.run(2.0, t0=x),
    "rtol": lambda x: MACHINE.run(1.0, rtol=x),
    "max_step": lambda x: MACHINE.run(1.0, max_step=x),
    "max_seconds": lambda x: MACHINE.run(1.0, max_seconds=x),
    "speed": MACHINE.steady_state,
    "steady q0": lambda x: MACHINE.steady_state(5.0, q0=x),
    "steady flywheel": lambda x: MACHINE.steady_state(5.0, flywheel=x),
    "steady rtol": lambda x: MACHINE.steady_state(5.0, rtol=x),
    "value of a function": lambda x: Machine(
        PRESS, loads=[assur.Torque("crank", lambda *_: x)]
    ).reduced_moment(1.0),
    "event q": lambda x: stopped(assur.events.Position(x)),
    "event speed": lambda x: stopped(assur.events.Speed(x)),
    "event limit": lambda x: stopped(assur.events.TransmissionAngle("A", x)),
    "contour": lambda x: slider_crank.contour(x, 1.0, 3.0),
    "contour's crank": lambda x: slider_crank.contour(0.5, x, 3.0),
    "contour's rod": lambda x: slider_crank.contour(0.5, 0.125, x),
    "tolerance": lambda x: crank_rocker.grashof(1, 4.5, 1.5, 4.8, tolerance=x),
    "margin": lambda x: crank_rocker.ground_range(9.0, 6.0, margin=x),
    "blocked": lambda x: crank_rocker.blocked(x, 9.0, 6.0, 10.0, 0.5),
    "ground": lambda x: crank_rocker.run(**ROCKER, ground=x, gamma_min=0.5),
    "crank": lambda x: crank_rocker.run(x, 9.0, 6.0, 10.0, 0.5),
    "sign": lambda x: PRESS.solve(1.0, assembly={"bore": x}),
}
NOT_NUMBERS: dict[str, Any] = {
    "text": "1.0",
    "bytes": b"1",
    "a buffer": bytearray(b"1"),
    "an array of text": np.array("1.0"),
    "a date": np.datetime64(1, "s"),
    "a time": np.timedelta64(1, "s"),
    "masked": np.ma.masked,
    "a masked array": np.ma.array(1.0, mask=True),
    "complex": 1.0 + 0.0j,
    "NumPy's complex": np.complex128(1.0),
    "a record": np.array((1.0,), [("x", "f8")])[()],
    "an object of text": np.array("1.0", object),
    "a dictionary": {"x": 1.0},
    "too great": 10**400,
    "far too great": 10**5000,
}


# All that ask share one check: each is given a text and a mask, one of them everything.
EVERYTHING = next(iter(ASKS))
GIVEN = [(name, what) for name in ASKS for what in ("text", "masked")]
GIVEN += [(EVERYTHING, what) for what in NOT_NUMBERS if what not in ("text", "masked")]


@pytest.mark.parametrize(("name", "what"), GIVEN)
def test_non_numbers_are_refused(name: str, what: str) -> None:
    value = NOT_NUMBERS[what]
    with pytest.raises(assur.InputError) as caught:
        ASKS[name](value)
    # The message shows it, or how it begins.
    shown = "masked" if "mask" in what else short(value).rstrip(".")[:20]
    if what == "far too great":
        shown = "very many digits"  # Python does not print them
    assert shown in str(caught.value)


@pytest.mark.parametrize("what", ["text", "bytes", "a buffer", "masked", "complex", "a dictionary"])
def test_a_run_refuses_a_function_that_gives_no_number(what: str) -> None:
    value = NOT_NUMBERS[what]
    with pytest.raises(assur.InputError, match=r"gives .* at t = 0"):
        Machine(PRESS, bodies={}, loads=[assur.Torque("crank", lambda *_: value)])
    # At rest, where the machine tries it, it is one.
    load = assur.Torque("crank", lambda *given: value if given[2] else 0.0)
    with pytest.raises(assur.InputError, match=r"gave .* at t = 0"):
        Machine(PRESS, bodies={"crank": Body(inertia=1.0)}, loads=[load]).run(0.1, speed0=1.0)


def made(name: str, value: Any) -> type:
    """The outcome for a number: a value, or the error that refuses it."""
    try:
        return type(ASKS[name]((value, value) if name == "both of a joint" else value))
    except assur.AssurError as error:
        return type(error)


@pytest.mark.parametrize("name", list(ASKS))
def test_a_number_of_numpy_is_a_number(name: str) -> None:
    """A number of no axes, and a mask of nothing, are what they hold."""
    values = [1.0] if name in ("sign", "ratio") else [0.25, 2.0]
    for value in values:
        plain = made(name, value)
        for number in (np.float64(value), np.array(value), np.ma.array(value, mask=False)):
            assert made(name, number) is plain


def test_a_sign_of_any_size_is_refused_by_this_package() -> None:
    for sign in (2**70, -(2**63), 0, 2, math.inf, 1.5):
        with pytest.raises((assur.InputError, assur.StructureError)) as caught:
            drawn_flat(sign)
        # The core quotes what it can count to.
        own = (assur.StructureError, "bad_sign") if sign in (0, 2) else (assur.InputError, None)
        assert (type(caught.value), caught.value.kind, caught.value.joint) == (*own, "C")
        with pytest.raises(assur.InputError, match="must be"):
            PRESS.solve(1.0, assembly={"bore": sign})  # type: ignore[dict-item]


def drawn_flat(sign: Any) -> assur.Mechanism:
    joints = {"A": (0, 0), "B": (1, 0), "C": (3, 0), "D": (4, 0)}
    links = {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"}
    return assur.Mechanism(joints, links, "crank", assembly={"C": sign})


LONG = assur.SliderCrank(100.0, 400.0).solve([0.0, 1.0, 2.0], order=3).joint("B")
PIN = PRESS.solve([0.0, 1.0, 2.0], order=3).joint("B")
TOO_GREAT: dict[str, Callable[[], object]] = {
    "velocity": lambda: LONG.velocity(1e308),
    "acceleration": lambda: LONG.acceleration(1e200),
    "jerk": lambda: LONG.jerk(1e120),
    "rod / crank": lambda: slider_crank.stroke(0.5, 1e-10, [1.0, 1e300]),
    "place / crank": lambda: slider_crank.rod_point(0.5, 1e-10, 1.0, 1e300),
    "coordinate": lambda: slider_crank.coordinate(0.0, 1e308, 1.5e308),
}


@pytest.mark.parametrize("name", list(TOO_GREAT))
@pytest.mark.filterwarnings("error")
def test_overflow_is_refused_by_name(name: str) -> None:
    with pytest.raises(assur.InputError, match=f"^{name} is beyond the greatest number"):
        TOO_GREAT[name]()


@pytest.mark.filterwarnings("error")
def test_infinite_speeds_are_the_callers_own() -> None:
    assert np.isinf(PIN.velocity(np.inf)[..., 0]).sum() == 2  # the first is a dead point: NaN


@pytest.mark.filterwarnings("error", "ignore::assur.AssurWarning")
def test_a_run_of_infinite_energy_is_refused() -> None:
    linkage = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    machine = Machine(linkage, bodies={"crank": Body(mass=4.0), "coupler": Body(mass=0.05)})
    with pytest.raises(assur.MotionError, match="energies of the run are infinite") as caught:
        machine.run(0.2, speed0=1e200, rtol=1e-6, max_steps=300)
    assert (caught.value.kind, caught.value.t) == ("not_finite", 0.0)


@pytest.mark.filterwarnings("error")
def test_a_flywheel_of_infinite_energy_is_refused() -> None:
    table = np.linspace(0.0, 2.0 * np.pi, 9), np.zeros(9), 0.05
    with pytest.raises(assur.InputError) as caught:
        flywheel.evaluate(*table, flywheel=1.0, speed0=1e200)
    assert (caught.value.kind, caught.value.value) == ("infinite", 1e200)
    some = flywheel.evaluate(*table, flywheel=1.0, speed0=[1e200, 2.0], on_error="nan")
    assert np.isnan(some.delta).tolist() == [True, False]


@pytest.mark.filterwarnings("error")
def test_a_flywheel_whose_period_is_rounding_is_refused_soon() -> None:
    # One moment of 1e16 N·m: the remaining energies have no correct digit.
    moment = np.r_[-0.75, -0.75, 1e16, np.full(13, 3.8)]
    table = np.linspace(0.0, 2.0 * np.pi, 16), moment, 1.8
    with pytest.raises(assur.MotionError) as caught:
        flywheel.evaluate(*table, flywheel=1.7, mean_speed=1.8, mean="period", spline="natural")
    assert (caught.value.kind, caught.value.value) == ("no_mean", 1.8)


def test_a_message_does_not_repeat_a_long_argument() -> None:
    with pytest.raises(assur.InputError) as caught:
        Machine({"crank": "x" * 5000}, bodies={})  # type: ignore[arg-type]
    assert len(str(caught.value)) < 500
