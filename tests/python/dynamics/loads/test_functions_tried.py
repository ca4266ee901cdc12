"""Functions of loads and motors are tried when the machine is made."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import ConstantTorque, Force, Machine, Pressure, Torque
from models.machines.shapers import slider


def test_each_is_called_once_at_the_drawing_and_at_rest() -> None:
    called: list[Any] = []

    def moment(t: float, q: float, speed: float) -> float:
        called.append((t, q, speed))
        return 1.0

    mechanism = slider()
    Machine(mechanism, loads=[Torque("crank", moment)])
    assert called == [(0.0, float(mechanism.q0), 0.0)]


def test_a_constant_power_has_no_value_at_rest() -> None:
    machine = Machine(slider(), loads=[Torque("crank", lambda *given: -90.0 / given[2])])
    assert machine.reduced_moment(1.0, 3.0) == -30.0
    quiet = Torque("crank", lambda *given: 90.0 if given[2] else math.nan)
    assert Machine(slider(), loads=[quiet]).reduced_moment(1.0, 3.0) == 90.0


@pytest.mark.parametrize(
    ("load", "message"),
    [
        (
            lambda f: Force("B", (f, 0.0)),
            r"Force at 'B': fx",
        ),
        (lambda f: Force(("rod", (0.1, 0.0)), (0.0, f)), r"Force at \('rod', \(0.1, 0.0\)\): fy"),
        (lambda f: Torque("crank", f), r"Torque on 'crank': torque"),
        (lambda f: Pressure("bore", 1e-3, f, "forward"), r"Pressure in 'bore': pressure"),
    ],
)
def test_the_load_is_named(load: Any, message: str) -> None:
    with pytest.raises(
        assur.InputError, match=message + r" is a function with the arguments \(q\)"
    ):
        Machine(slider(), loads=[load(lambda q: 1.0 + q)])
    with pytest.raises(assur.InputError, match=message + r"\(t, q, speed\) gives \[1.0, 2.0\]"):
        Machine(slider(), loads=[load(lambda *_: [1.0, 2.0])])
    with pytest.raises(assur.InputError, match=message + r"\(t, q, speed\) raises KeyError"):
        Machine(slider(), loads=[load(lambda *_: {"y": 1}["x"])])


@pytest.mark.parametrize("value", [None, "3", 1j, np.zeros(2)])
def test_only_real_numbers_pass(value: Any) -> None:
    with pytest.raises(assur.InputError, match=r"a number is needed"):
        Machine(slider(), loads=[Torque("crank", lambda *_: value)])


@pytest.mark.parametrize("value", [math.inf, math.nan, np.float64(-math.inf)])
def test_never_finite(value: Any) -> None:
    with pytest.raises(assur.InputError, match=r"no finite value at rest either"):
        Machine(slider(), loads=[Torque("crank", lambda *_: value)])


def test_motors_too() -> None:
    with pytest.raises(assur.InputError, match=r"ConstantTorque: torque is a function with"):
        Machine(slider(), motor=ConstantTorque(lambda: 1.0))  # type: ignore[arg-type]
    phi = np.linspace(0.0, math.tau, 9)
    with pytest.raises(assur.InputError, match=r"ConstantTorque: torque\(t, q, speed\) gives None"):
        Machine.from_table(phi, np.zeros(9), 1.0, motor=ConstantTorque(lambda *_: None))  # type: ignore[arg-type]


def test_several_drivers_give_tuples() -> None:
    seen: list[Any] = []

    def moment(_: float, q: Any, speed: Any) -> float:
        seen.append((q, speed))
        return 0.0

    joints = {"A": (0, 0), "B": (1, 0.3), "C": (2.2, 0.9), "E": (3.4, 0.2), "F": (4.0, 0.0)}
    links = {
        "ground": ["A", "F"],
        "a": ["A", "B"],
        "b": ["B", "C"],
        "c": ["C", "E"],
        "d": ["F", "E"],
    }
    Machine(assur.Mechanism(joints, links, driver=["a", "d"]), loads=[Torque("a", moment)])
    assert [len(part) for part in seen[0]] == [2, 2]
    assert seen[0][1] == (0.0, 0.0)
