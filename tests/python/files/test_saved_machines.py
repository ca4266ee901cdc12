"""Machines that are saved come back with the same parts and the same numbers."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.dynamics.loads import friction, loads, motors, pressure
from assur.files.parts import PARTS, ROWS, SHAFT
from assur.files.write import text_of
from models.machines.every_load import missing
from models.machines.file_machines import one_part_machines, whole_machines
from models.machines.machines import four_bar, press

if TYPE_CHECKING:
    from pathlib import Path

MACHINES = {**one_part_machines(), **whole_machines(), "press": press(motors.ConstantTorque(9.0))}


def bits(thing: Any) -> Any:
    """All that a part holds, with the sign of zero."""
    if dataclasses.is_dataclass(thing):
        own = {f.name: bits(getattr(thing, f.name)) for f in dataclasses.fields(thing)}
        return type(thing).__name__, own
    if isinstance(thing, np.ndarray):
        return thing.shape, thing.tobytes()
    return [bits(one) for one in thing] if isinstance(thing, tuple | list) else repr(thing)


def numbers(machine: assur.Machine) -> list[Any]:
    """What all parts enter into, at one position."""
    assert machine.mechanism is not None
    q = machine.mechanism.q0
    speed, acceleration = np.full_like(q, 0.7), np.full_like(q, -0.3)
    return [
        machine.reduced_inertia(q, on_error="nan").value,
        machine.reduced_moment(q, speed, on_error="nan"),
        machine.effort(q, speed, acceleration, on_error="nan"),
    ]


def test_every_kind_of_load_is_saved() -> None:
    assert not missing(load for machine in MACHINES.values() for load in machine.loads)


@pytest.mark.parametrize("name", list(MACHINES))
def test_machines(name: str, tmp_path: Path) -> None:
    path, machine = tmp_path / "m.toml", MACHINES[name]
    machine.save(path)
    loaded = assur.load(path)
    assert isinstance(loaded, assur.Machine)
    assert loaded.mechanism == machine.mechanism
    for part in ("bodies", "friction"):
        one, other = getattr(machine, part), getattr(loaded, part)
        assert list(one) == list(other)
        assert bits(list(one.values())) == bits(list(other.values()))
    assert bits(machine.loads) == bits(loaded.loads)
    assert bits(machine.motor) == bits(loaded.motor)
    assert text_of(loaded) == path.read_text(encoding="utf-8")
    assert [a.tobytes() for a in numbers(machine)] == [a.tobytes() for a in numbers(loaded)]


def test_a_run_has_the_same_bits(tmp_path: Path) -> None:
    machine = press(assur.LinearMotor(50.0, 15.0))
    machine.save(tmp_path / "m.toml")
    loaded = assur.load(tmp_path / "m.toml")
    assert isinstance(loaded, assur.Machine)
    one, other = (m.run(t_end=0.3, q0=0.0) for m in (machine, loaded))
    assert one.q.tobytes() == other.q.tobytes()
    assert one.speed.tobytes() == other.speed.tobytes()


def test_every_class_of_parts_has_its_words() -> None:
    modules = (loads, motors, friction, pressure)
    public = {getattr(module, name) for module in modules for name in module.__all__}
    classes = {one for one in public if dataclasses.is_dataclass(one)}
    assert set(PARTS) == classes
    for cls, words in PARTS.items():
        # A table is over a coordinate, or a motor.
        own = {**ROWS, **SHAFT} if cls is assur.Table else words
        assert set(own) == {one.name for one in dataclasses.fields(cls)}


def torque(t: float, q: float, speed: float) -> float:
    return t + q + speed


@pytest.mark.parametrize(
    ("parts", "what"),
    [
        (
            {"loads": [assur.Gravity(), assur.Torque("rocker", torque)]},
            "loads[1], the Torque",
        ),
        ({"loads": [assur.Force("C", (0.0, torque))]}, "loads[0], the Force: force"),
        ({"motor": assur.ConstantTorque(torque)}, "motor, the ConstantTorque: torque"),
    ],
    ids=["torque", "force", "motor"],
)
def test_functions_are_refused(parts: Any, what: str, tmp_path: Path) -> None:
    machine = assur.Machine(four_bar(), **parts)
    with pytest.raises(assur.InputError, match="is a function") as caught:
        machine.save(tmp_path / "m.toml")
    assert what in str(caught.value)
    assert not (tmp_path / "m.toml").exists()


def test_other_classes_are_refused(tmp_path: Path) -> None:
    class Weight(assur.Gravity):
        pass

    with pytest.raises(assur.InputError, match=r"loads\[0\], the Weight is of a class"):
        assur.Machine(four_bar(), loads=[Weight()]).save(tmp_path / "m.toml")


def test_a_machine_of_a_table_is_refused(tmp_path: Path) -> None:
    phi = np.linspace(0.0, math.tau, 9)
    machine = assur.Machine.from_table(phi, np.sin(phi), 2.0)
    with pytest.raises(assur.InputError, match="machine of a table"):
        machine.save(tmp_path / "m.toml")


def test_a_file_that_cannot_be_written(tmp_path: Path) -> None:
    for path in (tmp_path / "none" / "m.toml", tmp_path, f"{tmp_path}/a\0b"):
        with pytest.raises(assur.files.FileError, match="cannot be written") as caught:
            four_bar().save(path)
        assert (caught.value.path, caught.value.line) == (str(path), None)
    with pytest.raises(assur.InputError, match="not a Mechanism"):
        assur.files.save(3, tmp_path / "m.toml")  # type: ignore[arg-type]
