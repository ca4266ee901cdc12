"""The equations of motion against the reduced machine, virtual power, and forces in the pairs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from models.machines.machine_models import machine_case

TURN = 2.0 * np.pi


def five_bar(**parts: Any) -> assur.Machine:
    mechanism = assur.examples.five_bar()
    bodies = {
        name: assur.Body(mass=1.0 + 0.3 * i, inertia=0.02 * (i + 1), at=(0.1 * i, -0.05))
        for i, name in enumerate(name for name in mechanism.links if name != "ground")
    }
    return assur.Machine(mechanism, **({"bodies": bodies, "loads": [assur.Gravity()]} | parts))


def press(**parts: Any) -> assur.Machine:
    bodies = {
        "crank": assur.Body(inertia=0.5),
        "rod": assur.Body(mass=4.0, inertia=0.06, at=(0.15, 0.02)),
        "piston": assur.Body(mass=20.0),
    }
    return assur.Machine(assur.SliderCrank(0.1, 0.4), **({"bodies": bodies} | parts))


def places(machine: assur.Machine, count: int, seed: int) -> tuple[Any, Any, Any]:
    """Coordinates beside the drawing, speeds and accelerations."""
    assert machine.mechanism is not None
    rng = np.random.default_rng(seed)
    q0 = np.asarray(machine.mechanism.q0)
    shape = (count, *q0.shape)
    return q0 + rng.uniform(-0.2, 0.2, shape), rng.normal(size=shape), rng.normal(size=shape)


@pytest.mark.parametrize("make", [five_bar, press])
def test_the_terms_are_those_of_the_reduced_machine(make: Any) -> None:
    """`reduced_inertia` sums over single positions; `effort` follows Lagrange's equations."""
    machine = make()
    q, speed, acceleration = places(machine, 200, 1)
    now = machine.dynamics(q, speed)
    n = now.bias.shape[-1]
    reduced = machine.reduced_inertia(q)
    assert now.mass_matrix.reshape(-1) == pytest.approx(reduced.value.reshape(-1), rel=1e-12)
    scale = float(np.abs(reduced.d1).max())
    assert now.d_mass_matrix.reshape(-1) == pytest.approx(
        reduced.d1.reshape(-1), abs=1e-12 * scale, rel=0.0
    )
    given = acceleration.reshape(-1, n)
    effort = np.einsum("kab,kb->ka", now.mass_matrix, given) + now.bias
    wanted = machine.effort(q, speed, acceleration)
    assert effort.reshape(wanted.shape) == pytest.approx(wanted, rel=1e-10, abs=1e-10)
    again = machine.acceleration(q, speed, wanted)
    assert again == pytest.approx(acceleration, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("seed", range(25))
def test_random_machines(seed: int) -> None:
    """Every load that there is: what reactions need of the drive accelerates it as it should."""
    machine = machine_case(seed).machine
    assert machine.mechanism is not None
    q, speed, acceleration = places(machine, 20, seed)
    found = machine.reactions(q, speed, acceleration, on_error="nan")
    now = machine.dynamics(q, speed, on_error="nan")
    n = now.bias.shape[-1]
    given = acceleration.reshape(-1, n)
    effort = np.einsum("kab,kb->ka", now.mass_matrix, given) + now.bias
    rotors = (
        now.mass_matrix
        - assur.Machine(machine.mechanism, bodies=machine.bodies)
        .dynamics(q, on_error="nan")
        .mass_matrix
    )
    wanted = found.driver.reshape(-1, n) + np.einsum("kab,kb->ka", rotors, given)
    known = np.isfinite(wanted).all(axis=1)
    assert (np.isfinite(effort).all(axis=1) >= known).all()
    condition = np.ravel(machine.mechanism.solve(q, on_error="nan").condition)
    error = np.abs(effort - wanted).max(axis=1)
    size = np.abs(wanted[known]).max(initial=1.0)
    assert known.any()
    assert (error <= 1e-13 * condition**2 * size)[known].all()


def test_jacobians_are_analogues() -> None:
    machine = five_bar()
    q, speed, _ = places(machine, 50, 3)
    now = machine.dynamics(q, speed)
    assert machine.mechanism is not None
    motion = machine.mechanism.solve(q, order=1)
    for joint in machine.mechanism.joints:
        assert (now.jacobian(joint) == motion.joint(joint).d1).all()
    assert now.gravity == pytest.approx(machine.dynamics(q, 0.0).bias, rel=1e-12, abs=1e-12)
    assert now.status.tolist() == [0] * 50


def test_one_position_is_one_of_many() -> None:
    """A row has the bits that it has alone, on any number of threads."""
    machine = five_bar(loads=[assur.Gravity(), assur.Damper("P", "A", 3.0)])
    q, speed, effort = places(machine, 37, 5)
    every = machine.dynamics(q, speed, threads=2)
    accelerations = machine.acceleration(q, speed, effort, threads=1)
    for row in (0, 17, 36):
        one = machine.dynamics(q[row], speed[row])
        for name in ("mass_matrix", "d_mass_matrix", "bias", "gravity"):
            assert (getattr(one, name) == getattr(every, name)[row]).all()
        alone = machine.acceleration(q[row], speed[row], effort[row])
        assert (alone == accelerations[row]).all()


def test_designs_and_positions() -> None:
    mechanism = assur.SliderCrank([0.1, 0.12, 0.15], 0.4)
    machine = assur.Machine(mechanism, bodies={"piston": assur.Body(mass=2.0)})
    q = np.linspace(0.3, 1.2, 5)
    now = machine.dynamics(q, speed=3.0)
    assert now.mass_matrix.shape == (3, 5, 1, 1)
    for index in range(3):
        alone = machine.of(mechanism.design(index)).dynamics(q, speed=3.0)
        assert (now.bias[index] == alone.bias).all()
    own = np.stack([q, q + 0.1, q + 0.2])
    assert machine.acceleration(own, 1.0, 2.0).shape == (3, 5)
    assert machine.acceleration(0.5, 1.0, 2.0).shape == (3,)
    # One row of positions may stand for all designs.
    assert (machine.dynamics(q[None], speed=3.0).bias == now.bias).all()


def test_motors_act_where_no_effort_is_given() -> None:
    motor = assur.LinearMotor(stall=50.0, no_load=15.0, ratio=2.0, rotor_inertia=0.01)
    machine = press(motor=motor)
    q, speed = np.linspace(0.2, 2.8, 7), 4.0
    given = 2.0 * 50.0 * (1.0 - 2.0 * speed / 15.0)
    assert (machine.acceleration(q, speed) == machine.acceleration(q, speed, given)).all()
    bare = press()
    inertia = bare.dynamics(q).mass_matrix[:, 0, 0] + 4.0 * 0.01
    assert machine.dynamics(q).mass_matrix[:, 0, 0] == pytest.approx(inertia, rel=1e-14)
    # The motion in time starts with this acceleration.
    run = machine.run(0.1, q0=float(q[3]), speed0=speed)
    assert run.at(0.0).acceleration == pytest.approx(machine.acceleration(q[3], speed), rel=1e-12)


def test_functions_of_time_and_speed() -> None:
    load = assur.Torque("crank", lambda t, q, speed: 3.0 * t - 2.0 * q + speed)
    machine = press(loads=[load])
    for t, q, speed in ((0.0, 0.5, 2.0), (1.5, 1.0, -1.0)):
        free = press().dynamics(q, speed).bias[0]
        wanted = free - (3.0 * t - 2.0 * q + speed)
        assert machine.dynamics(q, speed, t=t).bias[0] == pytest.approx(wanted, rel=1e-13)


def test_no_path_is_followed_for_angles_that_no_load_reads() -> None:
    """Two turns from the drawing a path would leave the workspace; the position itself is there."""
    machine = five_bar()
    assert machine.mechanism is not None
    q0 = np.asarray(machine.mechanism.q0)
    far = np.add(q0, [TURN, 0.0])
    assert (machine.dynamics(far).mass_matrix.shape) == (2, 2)
    near, beyond = machine.dynamics(q0).mass_matrix, machine.dynamics(far).mass_matrix
    assert beyond == pytest.approx(near, rel=1e-12)


REFUSED: dict[str, tuple[Any, str]] = {
    "no bodies": (
        lambda: assur.Machine(assur.examples.five_bar()).acceleration([1.6, 1.2], 0.0, [1.0, 1.0]),
        r"the mass matrix is singular at q = 1\.6, 1\.2",
    ),
    "no bodies of one driver": (
        lambda: assur.Machine(assur.SliderCrank(0.1, 0.4)).acceleration(0.5, 0.0, 1.0),
        r"singular at q = 0\.5: \[\[0\.0\]\]: give bodies .*'crank'",
    ),
    "a table": (
        lambda: assur.Machine.from_table([0.0, 3.0, TURN], [1.0, 2.0, 1.0], 2.0).dynamics(0.5),
        "reduced_inertia and run",
    ),
    "friction": (
        lambda: press(friction={"B": assur.JointFriction(0.1, radius=0.01)}).dynamics(0.5),
        r"without friction, which this machine has in 'B'",
    ),
    "the shape of q": (lambda: five_bar().dynamics(1.0), r"its last axis must be 2"),
    "the shape of an effort": (
        lambda: five_bar().acceleration(np.ones((3, 2)), 0.0, np.ones((4, 2))),
        r"effort has the shape \(4, 2\), q \(3, 2\): they do not fit",
    ),
    "an effort for some machines": (
        lambda: press(bodies={"piston": assur.Body(mass=np.array([1.0, 2.0, 3.0]))}).acceleration(
            0.5, 0.0, np.ones(2)
        ),
        r"effort has the shape \(2,\), q \(\) \(with its designs \(3,\)\): they do not fit",
    ),
    "an effort that is NaN": (
        lambda: press().acceleration(0.5, 0.0, float("nan")),
        "effort is nan: finite numbers are needed",
    ),
    "both q and deg": (lambda: press().dynamics(0.5, deg=30.0), r"both q and deg"),
    "an unknown joint": (lambda: press().dynamics(0.5).jacobian("X"), 'there is no joint "X"'),
    "a load without a value": (
        lambda: press(
            loads=[assur.Torque("crank", assur.Table([0.0, 1.0], [1.0, 2.0], periodic=False))]
        ).acceleration([0.5, 2.0], 1.0, 0.0),
        "a table over q covers 0 to 1",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name: str) -> None:
    call, message = REFUSED[name]
    with pytest.raises(assur.InputError, match=message):
        call()


def test_positions_that_do_not_exist() -> None:
    machine = assur.Machine(
        assur.FourBar(3.0, 2.5, 2.0, 4.0), bodies={"rocker": assur.Body(mass=1.0, inertia=0.1)}
    )
    with pytest.raises(assur.PositionError, match="q = 2"):
        machine.acceleration([0.5, 2.0], 1.0, 0.0)
    found = machine.dynamics([0.5, 2.0, 1.0], 1.0, on_error="nan")
    assert found.status.tolist() == [0, 3, 0]
    assert np.isfinite(found.bias[:, 0]).tolist() == [True, False, True]
    values = machine.acceleration([0.5, 2.0, 1.0], 1.0, 0.0, on_error="nan")
    assert np.isfinite(values).tolist() == [True, False, True]


def test_positions_without_a_bias_say_so() -> None:
    torque = assur.Torque("crank", assur.Table([0.0, 1.0], [1.0, 2.0], periodic=False))
    found = press(loads=[torque]).dynamics([0.5, 2.0, 1.0], 1.0, on_error="nan")
    assert found.status.tolist() == [0, assur.Status.BAD_INPUT, 0]
    assert np.isfinite(found.bias[:, 0]).tolist() == [True, False, True]
    # The square of the speed is too great for a number.
    fast = press().dynamics([0.5, 0.5], [1.0, 1e300], on_error="nan")
    assert fast.status.tolist() == [0, assur.Status.BAD_INPUT]
    assert np.isfinite(fast.mass_matrix).all()


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("which", ["q", "speed", "effort"])
def test_a_state_that_is_not_finite_fails_alone(which: str, wrong: float) -> None:
    machine = five_bar()
    rows = dict(zip(("q", "speed", "effort"), places(machine, 20, 1), strict=True))
    expected = machine.acceleration(**rows)
    rows[which] = rows[which].copy()
    rows[which][7, 1] = wrong
    with pytest.raises(assur.AssurError):
        machine.acceleration(**rows)
    found = machine.acceleration(**rows, on_error="nan")
    assert np.isnan(found[7]).all()
    others = np.arange(20) != 7
    assert np.array_equal(found[others], expected[others])
