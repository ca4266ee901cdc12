"""Value objects are equal by value: built twice, copied, pickled, saved and loaded."""

from __future__ import annotations

import copy
import inspect
import pickle
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import events, laws, metric
from models.machines.file_machines import one_part_machines, whole_machines

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

JOINTS = {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)}
CLASS_IV = {
    "1": (0, 0),
    "2": (0.35, 0),
    "3": (1.24, 0.99),
    "4": (0.75, 1.91),
    "5": (3.02, -0.73),
    "6": (2.45, 1.02),
    "7": (3.2, 2.24),
    "8": (1.85, 2.35),
    "9": (1.62, -1.11),
    "10": (4.28, 1.52),
}
LINKS = {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"}


def row(*values: float) -> Any:
    return np.array(values)


def load(t: float, q: float, speed: float) -> float:
    return t + q + speed


def other(t: float, q: float, speed: float) -> float:
    return t - q - speed


def table(**options: Any) -> assur.Table:
    return assur.Table(**{"q": [0.0, np.pi, 2.0 * np.pi], "value": row(1.0, 2.0, 1.0), **options})


def gas(**options: Any) -> assur.Gas:
    return assur.Gas(**{"pressure": 2e5, "volume": 0.003, "at": 1.0, **options})


def rise() -> dict[str, Any]:
    return {"start": (0.0, 0.5), "end": (1.0, 2.0), "duration": (0.5, 0.7), "begin": (0.0, 0.1)}


FORCE = {"at": ("C", "B"), "force": ((1.0, -2.0), (1.0, table())), "axes": (None, "crank")}
SHAFT = {"ratio": (1.0, 2.0), "rotor_inertia": (0.0, 0.1)}
SPRING = {"first": ("C", ("coupler", (0.1, 0.2))), "second": ("A", "D")}
WAY = {"while_": ("forward", "backward"), "over": ("rocker", "coupler")}
# A class, and for each argument two values that differ: the first makes the object, the second
# another one.
CLASSES: dict[Any, dict[str, tuple[Any, Any]]] = {
    assur.Body: {"mass": (1.0, 2.0), "inertia": (0.1, 0.2), "at": ((0.1, 0.2), "C")},
    assur.Gravity: {"acceleration": ((0.0, -9.8), (1.0, 0.0))},
    assur.Force: {**FORCE, "on": ("coupler", "rocker"), **WAY},
    assur.Torque: {
        "link": ("rocker", "crank"),
        "torque": (table(), load),
        "on": ("ground", "coupler"),
        **WAY,
    },
    assur.Pressure: {
        "slide": ("bore", "ram"),
        "area": (0.1, 0.2),
        "pressure": (gas(), 1e5),
        "expands": ("forward", "backward"),
        "ambient": (101_325.0, 0.0),
        **WAY,
    },
    assur.Gas: {
        "pressure": (2e5, 1e5),
        "volume": (0.003, 0.002),
        "at": (1.0, 0.9),
        "exponent": (1.4, 1.3),
    },
    assur.Spring: {**SPRING, "stiffness": (3.0, 4.0), "length": (0.1, 0.2), "preload": (0.0, 1.0)},
    assur.Damper: {**SPRING, "damping": (3.0, 4.0)},
    assur.TorsionSpring: {
        "link": ("rocker", "crank"),
        "stiffness": (3.0, 4.0),
        "angle": (0.1, 0.2),
        "on": ("ground", "coupler"),
        "preload": (0.0, 1.0),
    },
    assur.TorsionDamper: {
        "link": ("rocker", "crank"),
        "damping": (3.0, 4.0),
        "on": ("ground", "coupler"),
    },
    assur.Table: {
        "q": ([0.0, 1.0, 3.0], row(0.0, 1.0, 4.0)),
        "value": (row(1.0, 2.0, 1.0), (1.0, 3.0, 1.0)),
        "spline": ("linear", "pchip"),
        "periodic": (True, False),
        "ratio": (1.0, 2.0),
        "rotor_inertia": (0.0, 0.1),
        "over": (None, "bore"),
    },
    assur.ConstantTorque: {"torque": (table(), table(spline="linear")), **SHAFT},
    assur.LinearMotor: {"stall": (40.0, 30.0), "no_load": (150.0, 100.0), **SHAFT},
    assur.InductionMotor: {
        "breakdown": (60.0, 50.0),
        "slip": (0.1, 0.2),
        "synchronous": (157.0, 100.0),
        **SHAFT,
    },
    assur.JointFriction: {
        "coefficient": (0.1, 0.2),
        "radius": (0.01, 0.02),
        "viscous": (0.0, 1.0),
        "static_coefficient": (0.3, 0.4),
    },
    assur.SlideFriction: {
        "coefficient": (0.1, 0.2),
        "length": (0.01, 0.02),
        "viscous": (0.0, 1.0),
        "static_coefficient": (0.3, 0.4),
    },
    assur.Slide: {
        "link": ("a", "b"),
        "on": ("ground", "c"),
        "angle": (0.1, 0.2),
        "origin": ("O", None),
        "along": (("A", "B"), ("A", "C")),
    },
    assur.Cylinder: {
        "base": ("A", "B"),
        "end": ("C", "D"),
        "barrel": ("x", "y"),
        "rod": ("z", None),
    },
    assur.Drive: {"link": ("a", "b"), "relative_to": ("ground", "c")},
    assur.Grid: {"dimensions": ({"a.length": [1.0, 2.0]}, {"a.length": row(1.0, 3.0)})},
    assur.Mechanism: {
        "joints": (JOINTS, {**JOINTS, "C": (4.1, 3.3)}),
        "links": (LINKS, {**LINKS, "rocker": "CD"}),
        "driver": ("crank", "rocker"),
        "assembly": (None, {"C": -1}),
    },
    assur.Assembly: {"signs": ({"C": 1}, {"C": -1})},
    assur.ClassIV: {"joints": (CLASS_IV, {**CLASS_IV, "6": (2.45, 1.03)})},
    assur.FourBar: {
        "crank": (1.0, 1.1),
        "coupler": (3.0, 3.1),
        "rocker": (2.5, 2.6),
        "ground": (3.0, [3.0, 3.1]),
        "mode": ("open", "crossed"),
    },
    assur.SliderCrank: {"crank": (0.1, 0.11), "rod": (0.4, 0.41), "offset": (0.0, 0.02)},
    assur.Machine: {
        "mechanism": (assur.FourBar(1.0, 3.0, 2.5, 3.0), assur.FourBar(1.0, 3.1, 2.5, 3.0)),
        "bodies": ({"rocker": assur.Body(mass=2.0)}, {"rocker": assur.Body(mass=2.1)}),
        "loads": ([assur.Torque("rocker", table())], [assur.Torque("rocker", load)]),
        "motor": (assur.ConstantTorque(table()), None),
        "friction": ({"C": assur.JointFriction(0.1, 0.2)}, {}),
    },
    laws.Uniform: rise(),
    laws.Harmonic: rise(),
    laws.Cycloidal: rise(),
    laws.Polynomial345: rise(),
    laws.Polynomial4567: rise(),
    laws.ModifiedSine: rise(),
    laws.Trapezoidal: {**rise(), "ramp": (0.25, 0.3)},
    laws.Tabulated: {
        "t": ([0.0, 1.0, 2.0], [0.0, 1.0, 3.0]),
        "value": (row(0.0, 1.0, 0.0), row(0.0, 2.0, 0.0)),
        "spline": ("clamped", "pchip"),
    },
    laws.Sequence: {
        "laws": ((laws.Uniform(0.0, 1.0, 2.0),), [laws.Tabulated([0.0, 1.0], [0.0, 2.0])])
    },
    events.Crossing: {
        "function": (load, other),
        "stop": (False, True),
        "direction": ("either", "rising"),
    },
    events.Obstacle: {
        "at": (
            events.Position(1.0, direction="rising"),
            events.Crossing(load, direction="falling"),
        ),
        "restitution": (0.5, 0.6),
    },
    events.Position: {
        "q": (1.0, 2.0),
        "stop": (False, True),
        "direction": ("either", "rising"),
    },
    events.Rest: {"stop": (True, False), "driver": (0, 1)},
    events.Speed: {"speed": (1.0, 2.0), "stop": (False, True), "direction": ("either", "rising")},
    events.TransmissionAngle: {
        "name": ("C", "B"),
        "limit": (0.7, 0.8),
        "stop": (True, False),
        "direction": ("falling", "either"),
    },
    metric.span: {"of": ("C.x", "C.y"), "order": (0, 1), "over": (None, (0.0, 1.0))},
    metric.time_ratio: {"of": ("rocker", "coupler")},
    metric.min_transmission_angle: {"at": ("C", "B")},
    metric.deviation: {"of": ("C", "P"), "shape": ("line", "circle"), "relative": (True, False)},
    metric.path_error: {
        "of": ("C", "P"),
        "points": ([(0.0, 0.0), (1.0, 1.0)], [(0.0, 0.0), (1.0, 2.0)]),
        "kind": ("chamfer", "ordered"),
        "closed": (None, False),
    },
    metric.function_error: {
        "of": ("rocker", "coupler"),
        "theta": (row(0.0, 1.0), row(0.0, 2.0)),
        "value": (row(1.0, 1.0), row(2.0, 2.0)),
        "offset": ("free", "fixed"),
    },
    metric.pose_error: {
        "link": ("coupler", "rocker"),
        "poses": ([(0.0, 0.0, 0.0)], [(0.0, 0.0, 1.0)]),
        "length": (1.0, 2.0),
    },
    metric.function: {"of_motion": (load, other), "outputs": (["C"], None), "order": (0, 1)},
    metric.peak_reaction: {
        "joint": ("A", "B"),
        "on": (None, "rod"),
        "speed": (row(1.0, 2.0), row(1.0, 3.0)),
        "acceleration": (0.0, 1.0),
    },
    metric.peak_effort: {"speed": (row(1.0, 2.0), 1.0), "acceleration": (0.0, 1.0)},
    metric.flywheel_inertia: {
        "fluctuation": (0.1, 0.2),
        "mean_speed": (10.0, 11.0),
        "mean": ("extremes", "period"),
    },
    assur.flywheel.ReducedTable: {
        "phi": (row(0.0, 1.0), row(0.0, 2.0)),
        "moment": (row(1.0, 1.0), row(2.0, 2.0)),
        "inertia": (row(1.0, 1.0), row(2.0, 2.0)),
    },
}
# Results, answers and batches of one's own: not made by a user, or equal by identity.
RESULTS = {
    "Analogues",
    "Assemblies",
    "ConfigurationCurve",
    "DeadPoint",
    "DesignMap",
    "DesignFit",
    "Fit",
    "Fits",
    "Group",
    "Limits",
    "LinkageFit",
    "Measures",
    "Motion",
    "ParetoFront",
    "Remedy",
    "Run",
    "Runs",
    "Sensitivity",
    "SingularLocus",
    "SteadyState",
    "Structure",
    "Workspace",
}
ABSTRACT = {laws.Law}


def made(cls: Callable[..., Any], **changed: Any) -> Any:
    """The object of the first values: each time of new lists and arrays."""
    given = {name: copy.deepcopy(pair[0]) for name, pair in CLASSES[cls].items()}
    return cls(**{**given, **changed})


def pairs() -> list[tuple[Any, str]]:
    return [(cls, name) for cls, arguments in CLASSES.items() for name in arguments]


def test_every_class_that_a_user_makes_is_here() -> None:
    public = {getattr(assur, name) for name in assur.__all__}
    for module in (laws, events):
        public |= {getattr(module, name) for name in module.__all__}
    classes = {one for one in public if inspect.isclass(one)}
    own = {c for c in classes if not issubclass(c, (BaseException, int)) and c not in ABSTRACT}
    assert {c.__name__ for c in own if c not in CLASSES} <= RESULTS


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_built_twice_is_equal(cls: Any) -> None:
    one, two = made(cls), made(cls)
    assert one == two
    assert not one != two  # noqa: SIM202
    assert hash(one) == hash(two)
    assert one != object()
    assert len({one, two}) == 1


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_copies_are_equal(cls: Any) -> None:
    one = made(cls)
    for twin in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
        assert twin == one
        assert hash(twin) == hash(one)


@pytest.mark.parametrize(("cls", "name"), pairs(), ids=lambda one: getattr(one, "__name__", one))
def test_another_argument_is_unequal(cls: Any, name: str) -> None:
    changed = {name: CLASSES[cls][name][1]}
    one, two = made(cls), made(cls, **changed)
    assert one != two
    assert two == made(cls, **copy.deepcopy(changed))


@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_zero_has_no_sign(zero: float) -> None:
    assert assur.Table([0.0, 1.0], [zero, 1.0], periodic=False) == assur.Table(
        [0.0, 1.0], [0.0, 1.0], periodic=False
    )


def test_classes_with_the_same_fields_differ() -> None:
    one: object = laws.Uniform(0.0, 1.0, 2.0)
    assert one != laws.Harmonic(0.0, 1.0, 2.0)
    assert metric.peak_effort() != metric.rms_effort()
    assert metric.peak_reaction("A") != metric.rms_reaction("A")


def test_machines_of_tables() -> None:
    phi, moment = [0.0, np.pi, 2.0 * np.pi], [1.0, 2.0, 1.0]
    one, two = (assur.Machine.from_table(np.array(phi), moment, 2.0) for _ in range(2))
    assert one == two
    assert hash(one) == hash(two)
    assert one != assur.Machine.from_table(phi, moment, 2.0, spline="linear")
    assert pickle.loads(pickle.dumps(one)) == one


@pytest.mark.parametrize("name", [*one_part_machines(), *whole_machines()])
def test_a_machine_that_is_loaded_is_equal(name: str, tmp_path: Path) -> None:
    machine = {**one_part_machines(), **whole_machines()}[name]
    path = tmp_path / "machine.toml"
    machine.save(path)
    assert assur.load(path) == machine
    assert hash(assur.load(path)) == hash(machine)
    assert assur.load(path) != machine.mechanism


def test_batches_and_designs() -> None:
    batch = assur.Machine(assur.SliderCrank(0.1, [0.4, 0.5]), bodies={"rod": assur.Body(mass=1.0)})
    assert batch.design(0) == batch.design(0)
    assert batch.design(0) != batch.design(1)
    assert batch.mechanism is not None
    assert batch.of(batch.mechanism) == batch
