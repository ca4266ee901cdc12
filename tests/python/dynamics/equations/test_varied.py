"""Machines whose bodies, loads and motors have arrays: each row has its own numbers."""

from __future__ import annotations

import copy
import pickle
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

E = 37
RNG = np.random.default_rng(20)


def spread(least: Any, greatest: Any, shape: Any = E) -> Any:
    return RNG.uniform(least, greatest, shape)


def pick(value: Any, index: Any) -> Any:
    return float(value[index]) if isinstance(value, np.ndarray) else value


# The parts below are functions of how numbers are read: all of them, or those of one machine.
NUMBERS = {
    name: spread(*ends)
    for name, ends in {
        "mass": (0.5, 3.0),
        "inertia": (0.01, 0.2),
        "fx": (-30.0, 30.0),
        "torque": (-5.0, 5.0),
        "pressure": (1e5, 4e5),
        "ambient": (0.0, 1e5),
        "stiffness": (100.0, 900.0),
        "length": (0.1, 0.3),
        "preload": (-5.0, 5.0),
        "twist": (1.0, 9.0),
        "angle": (-1.0, 1.0),
        "damping": (1.0, 30.0),
        "turning": (0.1, 0.9),
        "motor": (5.0, 20.0),
        "fast": (50.0, 90.0),
        "slip": (0.1, 0.4),
        "ratio": (1.0, 4.0),
        "rotor": (0.0, 0.01),
    }.items()
}
CUT = assur.Table([0.0, 2.0, 4.0, 2 * np.pi], [0.0, 30.0, -10.0, 0.0])
MOTORS: dict[str, Callable[[Any], Any]] = {
    "constant": lambda n: assur.ConstantTorque(
        n("motor"), ratio=n("ratio"), rotor_inertia=n("rotor")
    ),
    "linear": lambda n: assur.LinearMotor(n("motor"), n("fast"), ratio=n("ratio")),
    "induction": lambda n: assur.InductionMotor(n("motor"), n("slip"), n("fast"), ratio=2.0),
    "table": lambda _: assur.Table([-90.0, 0.0, 90.0], [9.0, 8.0, 1.0], rotor_inertia=0.01),
    "none": lambda _: None,
}


def slider_crank(n: Any, motor: Any = "linear", mechanism: Any = None) -> Any:
    return assur.Machine(
        mechanism or assur.SliderCrank(crank=0.1, rod=0.4, offset=0.02),
        bodies={
            "crank": assur.Body(mass=2.0, inertia=n("inertia")),
            "rod": assur.Body(mass=n("mass"), inertia=0.03, at=(0.2, 0.01)),
            "piston": assur.Body(mass=n("mass"), at="B"),
        },
        loads=[
            assur.Gravity(),
            assur.Force("B", (n("fx"), CUT)),
            assur.Force("A", (2.0, n("fx")), axes="rod"),
            assur.Torque("crank", n("torque")),
            assur.Pressure("bore", 0.002, n("pressure"), expands="forward", ambient=n("ambient")),
            assur.Spring("O", "B", n("stiffness"), n("length"), preload=n("preload")),
            assur.TorsionSpring("rod", n("twist"), angle=n("angle"), preload=n("preload")),
            assur.Damper("O", "B", n("damping")),
            assur.TorsionDamper("rod", n("turning"), on="crank"),
        ],
        motor=MOTORS[motor](n),
    )


def five_bar(n: Any, motor: Any = "linear", mechanism: Any = None) -> Any:
    return assur.Machine(
        mechanism or assur.examples.five_bar(),
        bodies={
            "left_rod": assur.Body(mass=n("mass"), inertia=n("inertia"), at=(0.3, 0.0)),
            "right_rod": assur.Body(mass=1.2, inertia=0.02, at=(0.3, 0.0)),
        },
        loads=[assur.Gravity(), assur.Spring(("left_rod", (0.1, 0.1)), "P", n("stiffness"), 0.2)],
        motor=[None, MOTORS[motor](n)],
    )


def all_of(name: Any) -> Any:
    return NUMBERS[name]


def one_of(index: Any) -> Any:
    return lambda name: pick(NUMBERS[name], index)


CASES: list[tuple[Any, str]] = [(slider_crank, motor) for motor in MOTORS] + [
    (five_bar, "linear"),
    (five_bar, "constant"),
]


def state(make: Any) -> Any:
    q0 = np.asarray(make(one_of(0)).mechanism.q0)
    rng = np.random.default_rng(7)
    shape = (E, *q0.shape)
    width = 3.0 if make is slider_crank else 0.1
    return (
        q0 + rng.uniform(-width, width, shape),
        rng.uniform(-4.0, 4.0, shape),
        rng.uniform(-3.0, 3.0, shape),
    )


def calls(machine: Any, q: Any, speed: Any, effort: Any) -> Any:
    """All results of the calls that take arrays, by name."""
    now = machine.dynamics(q, speed)
    driven = machine.step(q, speed, None, dt=1e-3, n=3)
    pushed = machine.step(q, speed, effort, dt=1e-3, n=3)
    beside = machine.linearize(q, speed, effort)
    stepped = machine.linearize(q, speed, effort, dt=1e-3)
    link = "rod" if "rod" in machine.mechanism.links else "left_rod"
    by = ["q", "speed", f"{link}.length", f"{link}.mass", f"{link}.inertia"]
    joint = "A" if "A" in machine.mechanism.joint_names else "P"
    return {
        "mass matrix": now.mass_matrix,
        "its rates": now.d_mass_matrix,
        "bias": now.bias,
        "gravity": now.gravity,
        "jacobian": now.jacobian(joint),
        "free": machine.acceleration(q, speed, None),
        "driven": machine.acceleration(q, speed, effort),
        "d_effort": machine.d_effort(q, speed, effort, by=by),
        "d_acceleration": machine.d_acceleration(q, speed, effort, by=by),
        "A": beside.A,
        "B": beside.B,
        "A of steps": stepped.A,
        "step q": driven.q,
        "step speed": driven.speed,
        "step status": driven.status,
        "pushed": pushed.speed,
    }


@pytest.mark.parametrize(("make", "motor"), CASES)
def test_each_row_is_the_machine_with_its_numbers(make: Any, motor: Any) -> None:
    machine = make(all_of, motor)
    assert machine.shape == (E,)
    q, speed, effort = state(make)
    found = calls(machine, q, speed, effort)
    for i in range(E):
        alone = calls(make(one_of(i), motor), q[i], speed[i], effort[i])
        for name, values in alone.items():
            np.testing.assert_array_equal(found[name][i], values, err_msg=f"{name} of {i}")
        assert np.isfinite(alone["driven"]).all()


@pytest.mark.parametrize("make", [slider_crank, five_bar])
def test_a_machine_of_the_batch_is_made_by_hand(make: Any) -> None:
    machine = make(all_of)
    for i in (0, 5, -1):
        assert machine.design(i) == make(one_of(i))
        assert machine.design(i).shape == ()
    with pytest.raises(assur.InputError, match=r"outside the shape \(37,\)"):
        machine.design(E)


def test_masses_of_a_pendulum_by_its_formula() -> None:
    arm = assur.Mechanism({"O": (0, 0), "A": (0.8, 0)}, {"ground": "O", "arm": "OA"}, "arm")
    mass, inertia = spread(0.5, 3.0), spread(0.01, 0.2)
    stiffness = spread(1.0, 9.0)
    machine = assur.Machine(
        arm,
        bodies={"arm": assur.Body(mass=mass, inertia=inertia, at=(0.5, 0.0))},
        loads=[assur.Gravity(), assur.TorsionSpring("arm", stiffness)],
        motor=assur.LinearMotor(stall=2 * mass, no_load=40.0, ratio=3.0, rotor_inertia=0.1 * mass),
    )
    q, speed = spread(-2.0, 2.0), spread(-5.0, 5.0)
    motor = 3.0 * 2 * mass * (1.0 - 3.0 * speed / 40.0)
    moment = motor - 9.81 * mass * 0.5 * np.cos(q) - stiffness * q
    total = mass * 0.25 + inertia + 9.0 * 0.1 * mass
    expected = moment / total
    np.testing.assert_allclose(machine.acceleration(q, speed, None), expected, rtol=1e-12)
    np.testing.assert_allclose(machine.dynamics(q).mass_matrix[:, 0, 0], total, rtol=1e-12)


def test_shapes_go_together() -> None:
    mass, stiffness = spread(1.0, 2.0, (4, 1)), spread(100.0, 200.0, 3)
    press = assur.SliderCrank(0.1, 0.4)

    def machine(mass: Any, stiffness: Any, mechanism: Any = press) -> Any:
        return assur.Machine(
            mechanism,
            bodies={"piston": assur.Body(mass=mass), "crank": assur.Body(inertia=0.1)},
            loads=[assur.Spring("O", "B", stiffness, 0.3)],
        )

    grid = machine(mass, stiffness)
    assert grid.shape == (4, 3)
    assert grid.acceleration(0.3, 1.0, 0.0).shape == (4, 3)
    assert grid.dynamics(np.full((4, 3), 0.3)).mass_matrix.shape == (4, 3, 1, 1)
    many = grid.acceleration(np.linspace(0, 1, 5).reshape(1, 1, 5), 1.0, 0.0)
    assert many.shape == (4, 3, 5)
    alone = machine(float(mass[2, 0]), float(stiffness[1]))
    np.testing.assert_array_equal(many[2, 1], alone.acceleration(np.linspace(0, 1, 5), 1.0, 0.0))
    # Designs, too.
    rods = np.array([0.3, 0.4, 0.5])
    designs = machine(mass, stiffness, press.with_dimensions({"rod.length": rods}))
    assert designs.shape == (4, 3)
    found = designs.step(np.full((4, 3, 2), [0.3, 0.7]), 1.0, 0.0, 1e-3)
    assert found.q.shape == (4, 3, 2)
    for j in range(3):
        of_rod = machine(
            float(mass[3, 0]), float(stiffness[j]), press.with_dimensions({"rod.length": rods[j]})
        )
        assert designs.design((3, j)) == of_rod
        alone = of_rod.step([0.3, 0.7], 1.0, 0.0, 1e-3)
        np.testing.assert_array_equal(found.speed[3, j], alone.speed)
    assert designs.of(press).shape == (4, 3)
    assert machine(np.ones(0), 100.0).acceleration(0.3, 1.0, 0.0).shape == (0,)


def test_a_loop_goes_on_in_the_shape_of_its_states() -> None:
    machine = slider_crank(all_of)
    q: Any = 0.0
    speed: Any = 1.0
    for _ in range(3):
        q, speed, status = machine.step(q, speed, None, dt=1e-3)
    assert q.shape == speed.shape == status.shape == (E,)
    alone = slider_crank(one_of(4)).step(0.0, 1.0, None, dt=1e-3, n=3)
    assert q[4] == alone.q


def test_zero_masses_among_others() -> None:
    mass = np.array([0.0, 2.0, 0.0])

    def machine(mass: Any) -> Any:
        return assur.Machine(
            assur.SliderCrank(0.1, 0.4),
            bodies={
                "rod": assur.Body(mass=mass, inertia=0.1 * mass, at=(0.1, 0)),
                "crank": assur.Body(inertia=0.1),
            },
            loads=[assur.Gravity()],
        )

    found = machine(mass).acceleration(0.7, 2.0, 1.0)
    assert [machine(float(m)).acceleration(0.7, 2.0, 1.0) for m in mass] == found.tolist()
    assert machine(np.zeros(2)).acceleration(0.7, 2.0, 1.0).tolist() == [found[0]] * 2


@pytest.mark.parametrize("make", [slider_crank, five_bar])
def test_reduction_and_effort_of_each_row(make: Any) -> None:
    machine = make(all_of)
    q, speed, acceleration = state(make)
    found = [
        machine.reduced_inertia(q).value,
        machine.reduced_inertia(q).d1,
        machine.reduced_moment(q, speed),
        machine.potential(q),
        machine.effort(q, speed, acceleration),
    ]
    for i in range(E):
        one = make(one_of(i))
        alone = [
            one.reduced_inertia(q[i]).value,
            one.reduced_inertia(q[i]).d1,
            one.reduced_moment(q[i], speed[i]),
            one.potential(q[i]),
            one.effort(q[i], speed[i], acceleration[i]),
        ]
        for values, expected in zip(found, alone, strict=True):
            np.testing.assert_array_equal(values[i], expected)


def test_effort_where_only_motors_differ() -> None:
    def machine(stall: Any) -> assur.Machine:
        return assur.Machine(
            assur.SliderCrank(0.1, [0.3, 0.4]),
            bodies={"piston": assur.Body(mass=2.0)},
            motor=assur.LinearMotor(stall, 30.0, rotor_inertia=0.01),
        )

    efforts = machine(np.array([[1.0], [2.0], [3.0]])).effort(0.3, 2.0, 1.0)
    assert efforts.shape == (3, 2)
    np.testing.assert_array_equal(efforts, np.tile(machine(2.0).effort(0.3, 2.0, 1.0), (3, 1)))


@pytest.mark.parametrize(
    ("make", "motor"), [(slider_crank, "linear"), (slider_crank, "none"), (five_bar, "linear")]
)
def test_runs_of_each_machine(make: Any, motor: str) -> None:
    machine = make(all_of, motor)
    q, speed, _ = state(make)
    runs = machine.run(0.05, q0=q, speed0=speed)
    assert runs.shape == (E,)
    for i in range(0, E, 5):
        alone = make(one_of(i), motor).run(0.05, q0=q[i], speed0=speed[i])
        np.testing.assert_array_equal(runs.q_end[i], alone.q[-1])
        np.testing.assert_array_equal(runs.speed_end[i], alone.speed[-1])
        np.testing.assert_array_equal(runs[i].t, alone.t)


def test_runs_of_weights_in_lanes() -> None:
    arm = assur.Mechanism({"O": (0, 0), "A": (0.8, 0)}, {"ground": "O", "arm": "OA"}, "arm")
    mass = np.array([1.0, 2.0, 3.0])

    def pendulum(mass: Any) -> assur.Machine:
        body = assur.Body(mass=mass, inertia=0.1, at=(0.5, 0.0))
        return assur.Machine(arm, bodies={"arm": body}, loads=[assur.Gravity()])

    q0 = np.linspace(-1.0, 1.0, 12).reshape(3, 4)
    runs = pendulum(mass).run(0.3, q0=q0)
    assert runs.shape == (3, 4)
    for i in range(3):
        np.testing.assert_array_equal(
            runs.q_end[i], pendulum(float(mass[i])).run(0.3, q0=q0[i]).q_end
        )
    assert len(set(runs.q_end[:, 0].tolist())) == 3


OTHERS: dict[str, Callable[[Any], Any]] = {
    "reactions": lambda m: m.reactions(0.3, 1.0),
    "internal_loads": lambda m: m.internal_loads("rod", 0.3, 1.0),
    "duty": lambda m: m.duty(deg=np.linspace(0, 360, 9), speed=1.0),
    "equilibria": lambda m: m.equilibria(),
    "self_locking": lambda m: m.self_locking(),
    "impact": lambda m: m.impact(0.3, 1.0),
    "flywheel": lambda m: m.flywheel(0.1, mean_speed=10.0),
    "steady_state": lambda m: m.steady_state(),
    "explore": lambda m: m.explore(),
}


@pytest.mark.parametrize("name", OTHERS)
def test_calls_without_arrays_refuse_them(name: Any) -> None:
    machine = assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"piston": assur.Body(mass=np.array([1.0, 2.0])), "crank": assur.Body(inertia=1.0)},
        motor=assur.LinearMotor(10.0, 20.0),
    )
    with pytest.raises(assur.InputError, match=r"design|bodies\['piston'\]"):
        OTHERS[name](machine)


def test_files_refuse_arrays(tmp_path: Path) -> None:
    machine = slider_crank(all_of)
    with pytest.raises(assur.InputError):
        machine.save(tmp_path / "press.toml")
    assert not (tmp_path / "press.toml").exists()


def of_masses(mass: Any, **more: Any) -> Any:
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=mass)}, **more
    )


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: assur.Body(mass=[1.0, np.nan]), r"Body: mass\[1\] is nan: a finite number"),
        (lambda: assur.Body(inertia=[[1.0], [-2.0]]), r"Body: inertia\[1, 0\] is -2: .* negative"),
        (lambda: assur.Spring("A", "B", [1.0, np.inf], 0.1), r"Spring stiffness\[1\] is inf"),
        (lambda: assur.Torque("a", np.array([np.nan])), r"Torque on 'a': torque\[0\] is nan"),
        (lambda: assur.Force("A", (np.array([1, np.nan]), 0)), r"Force at 'A': fx\[1\] is nan"),
        (lambda: assur.LinearMotor([1.0, 0.0], 5.0), r"LinearMotor stall\[1\] is 0: .* positive"),
        (
            lambda: assur.InductionMotor(1, [0.1, 1.5], 9),
            r"InductionMotor slip\[1\] is 1.5: a",
        ),
        (lambda: assur.LinearMotor(1.0, 5.0, ratio=[1, 0]), r"ratio\[1\] is 0: the motor would"),
        (
            lambda: of_masses([1, 2], loads=[assur.Torque("crank", np.ones(3))]),
            r"loads\[0\], Torque: torque has the shape \(3,\), .* bodies\['piston'\]: mass \(2,\)",
        ),
        (
            lambda: of_masses([1.0, 2.0]).of(assur.SliderCrank(0.1, [0.3, 0.4, 0.5])),
            r"bodies\['piston'\]: mass has the shape \(2,\), .* designs \(3,\)",
        ),
        (
            lambda: of_masses([1.0, 2.0]).step([0.1, 0.2, 0.3], 0.0, 0.0, 0.1),
            r"q has the shape \(3,\): with machines \(2,\) it is a number, \(2,\) or \(2, N\)",
        ),
        (
            lambda: of_masses([1.0, 2.0]).acceleration(0.1, [0.1, 0.2, 0.3], 0.0),
            r"speed has the shape \(3,\)",
        ),
        (lambda: assur.Body(mass="heavy"), r"Body: mass"),
    ],
)
def test_what_is_wrong_is_named(make: Any, message: Any) -> None:
    with pytest.raises(assur.InputError, match=message):
        make()


def test_no_inertia_and_tables_that_end_are_named() -> None:
    machine = assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=np.array([1.0, 0.0]))}
    )
    with pytest.raises(assur.InputError, match="the mass matrix is singular"):
        machine.acceleration(0.5, 1.0, 1.0)
    short = assur.Table([0.0, 1.0], [0.0, 1.0], periodic=False)
    machine = of_masses([1.0, 2.0], loads=[assur.Torque("crank", short)])
    with pytest.raises(assur.InputError, match="Torque"):
        machine.acceleration([0.5, 1.5], 1.0, 1.0)


def test_parts_are_values() -> None:
    machine = slider_crank(all_of)
    for twin in (copy.copy(machine), copy.deepcopy(machine), pickle.loads(pickle.dumps(machine))):
        assert twin == machine
        assert hash(twin) == hash(machine)
        assert twin.shape == (E,)
        np.testing.assert_array_equal(
            twin.acceleration(0.3, 1.0, None), machine.acceleration(0.3, 1.0, None)
        )
        mass = twin.bodies["rod"].mass
        with pytest.raises(ValueError, match="read-only"):
            mass[0] = 2.0
    assert machine != slider_crank(one_of(0))
    given = np.array([1.0, 2.0])
    body = assur.Body(mass=given, at="B")
    given[0] = 5.0
    assert body == assur.Body(mass=[1.0, 2.0], at="B") != assur.Body(mass=[5.0, 2.0], at="B")
    assert repr(body) == "Body(mass=array([1.0, 2.0]), inertia=0.0, at='B')"
    assert repr(assur.Damper("A", "B", [1, 2])) == (
        "Damper(first='A', second='B', damping=array([1.0, 2.0]))"
    )
    force = assur.Force("A", (np.array([1.0, 2.0]), 0.0))
    assert force == pickle.loads(pickle.dumps(force))
    assert {force: 1}[assur.Force("A", (np.array([1.0, 2.0]), 0.0))] == 1
