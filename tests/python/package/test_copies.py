"""Copies of machines stay the same, whatever the caller does to its arrays and lists."""

from __future__ import annotations

import copy
import dataclasses
import pickle
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Gravity, Machine, Spring, Table, Torque
from models.errors.refusals import refused

if TYPE_CHECKING:
    from collections.abc import Callable

TURN = 2.0 * np.pi
Q = np.linspace(0.0, 6.0, 7)
ANY: Any = "cubic"  # what types would not let pass
COPIERS: list[Callable[[Any], Any]] = [
    copy.copy,
    copy.deepcopy,
    lambda x: pickle.loads(pickle.dumps(x)),
]


def rows() -> tuple[Any, Any]:
    q = np.linspace(0.0, TURN, 9)
    return q, np.array([0.0, 1.0, 2.0, 3.0, 4.0, 3.0, 2.0, 1.0, 0.0])


def answers(machine: Machine) -> list[Any]:
    return [
        machine.reduced_inertia(Q).value,
        machine.reduced_moment(Q, 3.0),
        machine.potential(Q),
        machine.run(0.3, 0.1, 5.0).q,
    ]


def spoil(*given: Any) -> None:
    """Overwrite everything that can be overwritten."""
    for one in given:
        if isinstance(one, np.ndarray):
            one[...] = 77.0
        elif isinstance(one, list):
            one[:] = [77.0] * len(one)
        elif isinstance(one, dict):
            one.clear()


def loaded() -> tuple[Machine, list[Any]]:
    """A machine of the caller's arrays and lists, and these."""
    q, value = rows()
    at, force, place = [0.2, 0.1], [3.0, -4.0], [1.0, 2.0]
    gravity, mass, torque = [0.0, -9.81], np.array(2.0), np.array(40.0)
    ends: list[Any] = ["ground", [3.0, 1.0]]
    bodies = {"crank": Body(inertia=0.5), "coupler": Body(mass=mass, inertia=0.1, at=at)}  # type: ignore[arg-type]
    loads: list[Any] = [
        Gravity(gravity),  # type: ignore[arg-type]
        Torque("crank", Table(q, value)),
        Force(("coupler", place), force),  # type: ignore[arg-type]
        Spring("C", ends, np.array(30.0), 0.5),  # type: ignore[arg-type]
    ]
    motor = assur.LinearMotor(torque, 20.0)
    machine = Machine(assur.FourBar(1.0, 3.0, 2.5, 3.0), bodies=bodies, loads=loads, motor=motor)
    given = [q, value, at, force, place, gravity, mass, torque, ends, bodies]
    return machine, given


@pytest.mark.parametrize("copier", COPIERS, ids=["copy", "deepcopy", "pickle"])
def test_a_copy_is_the_same_machine_after_the_arrays_changed(copier: Callable[[Any], Any]) -> None:
    machine, given = loaded()
    before = answers(machine)
    spoil(*given)
    for own in (machine, copier(machine)):
        for one, other in zip(before, answers(own), strict=True):
            assert one.tobytes() == other.tobytes()


@pytest.mark.parametrize("copier", COPIERS, ids=["copy", "deepcopy", "pickle"])
def test_a_copied_machine_of_tables_is_the_same(copier: Callable[[Any], Any]) -> None:
    q, value = rows()
    inertia = np.full(9, 2.0)
    over = np.array([0.0, 10.0, 20.0]), np.array([30.0, 25.0, 0.0])
    machine = Machine.from_table(q, value - 2.0, inertia, motor=Table(*over, spline="linear"))
    before = answers(machine)
    spoil(q, value, inertia, *over)
    for own in (machine, copier(machine)):
        for one, other in zip(before, answers(own), strict=True):
            assert one.tobytes() == other.tobytes()


def test_a_design_of_a_batch_has_the_batchs_loads() -> None:
    q, value = rows()
    lengths = np.array([3.0, 3.1])
    batch = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"coupler.length": lengths})
    machine = Machine(
        batch, bodies={"crank": Body(inertia=0.5)}, loads=[Torque("crank", Table(q, value))]
    )
    before = machine.reduced_moment(Q)
    spoil(q, value, lengths)
    assert machine.design(1).reduced_moment(Q).tobytes() == before[1].tobytes()


def test_a_list_of_motors_may_change() -> None:
    joints = {"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)}
    links = {"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"}
    m = assur.Mechanism(joints=joints, links=links, driver=["left", "right"])
    motors: list[Any] = [assur.ConstantTorque(2.0, rotor_inertia=0.5), None]
    machine = Machine(
        m,
        bodies={name: Body(mass=1.0, inertia=0.1) for name in ("l2", "l3")},
        loads=[],
        motor=motors,
    )
    before = machine.run(0.2).q
    motors[0] = None
    assert copy.copy(machine).run(0.2).q.tobytes() == before.tobytes()


def test_a_table_has_its_own_rows_and_they_do_not_change() -> None:
    q, value = rows()
    table = Table(q, value)
    spoil(q, value)
    for own in (table, *(copier(table) for copier in COPIERS)):
        assert own.q.tolist() == rows()[0].tolist()
        assert own.value.tolist() == rows()[1].tolist()
        for column in (own.q, own.value):
            assert column.dtype == np.float64
            with pytest.raises(ValueError, match="read-only"):
                column[0] = 1.0
        with pytest.raises(dataclasses.FrozenInstanceError):
            own.value = value
    assert dataclasses.replace(table, spline="linear").value.tolist() == rows()[1].tolist()


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Table([0.0, 1.0, 0.5], [0, 1, 0]), "Table q[2] = 0.5 1.0 must ascend given twice"),
        (lambda: Table([0.0, 2.0, 1.0], [0, 1, 0]), "Table q[2] = 1.0 2.0 ascend"),
        (lambda: Table([0.0, np.nan], [0, 1]), "Table q[1] nan finite"),
        (lambda: Table([0.0, 1.0], [np.inf, 1]), "Table value[0] inf finite"),
        (lambda: Table([0.0, 1.0], [1.0]), "Table (2,) (1,)"),
        (lambda: Table([[0.0], [1.0]], [[1.0], [1.0]]), "Table (2, 1)"),
        (lambda: Table([0.0], [1.0]), "Table 1 row 2"),
        (lambda: Table([0.0, 1.0], [1.0, 1.0], spline="periodic"), "Table 2 rows 3"),
        (lambda: Table([0.0, 1.0], [1.0, 1.0], spline=ANY), "Table spline 'cubic' 'natural'"),
        (lambda: Table([0.0, 1.0], [1.0, 1.0], ratio=0.0), "Table ratio 0"),
        (lambda: Table([0.0, 1.0], [1.0, 1.0], rotor_inertia=-1.0), "Table rotor_inertia -1"),
        (lambda: Table(["0", "1"], [1.0, 1.0]), "Table q real numbers"),
    ],
)
def test_a_table_refuses_unusable_numbers(make: Any, said: str) -> None:
    refused(assur.InputError, said, make)
