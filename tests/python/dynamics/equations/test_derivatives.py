"""Derivatives of efforts and accelerations against polynomials through evaluations.

The evaluations are those of other code: `effort` follows Lagrange's equations of the reduced
machine, position by position.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from dynamics.equations.test_equations import TURN, five_bar, press
from models.machines.machine_models import machine_case
from support.samples import sample
from support.spectral import WIDTHS, derivative

# Of the greatest entry of a matrix of derivatives.
CLOSE = 1e-10
# Machines without friction and without functions are about a third: a thousand of the many.
SEEDS = range(sample(60, 3000))
# Above it a derivative of this order may lose more digits (docs/reference/conventions.md).
WELL_CONDITIONED = 100.0


def compare(found: Any, columns: list[tuple[Any, Any]], close: float = CLOSE) -> None:
    wanted, known = (np.stack(parts, axis=-1) for parts in zip(*columns, strict=True))
    size = np.abs(found).max()
    assert (known <= close * size).all()
    assert (np.abs(found - wanted) <= close * size).all()


def moved(machine: assur.Machine, name: str, by: Any) -> assur.Machine:
    """The machine of as many designs as places of a dimension."""
    assert machine.mechanism is not None
    value = float(machine.mechanism.dimensions[name])
    return machine.of(machine.mechanism.with_dimensions({name: value + by}))


@pytest.mark.parametrize("seed", SEEDS)
def test_efforts_of_random_machines(seed: int) -> None:
    machine = machine_case(seed).machine
    mechanism = machine.mechanism
    assert mechanism is not None
    if machine.friction or machine.core.functions:
        with pytest.raises(assur.InputError, match=r"friction|function"):
            machine.d_effort(mechanism.q0)
        return
    rng = np.random.default_rng(seed)
    n, q0 = machine.driver_count, np.asarray(mechanism.q0)
    state = [q0 + rng.uniform(-0.2, 0.2, q0.shape), *rng.normal(size=(2, *q0.shape))]
    names = [str(name) for name in rng.permutation(list(mechanism.dimensions))[:4]]
    if mechanism.solve(state[0], on_error="nan").status > 1:
        with pytest.raises(assur.PositionError):
            machine.d_effort(state[0], by=names[0])
        return
    ways = ["q", "speed", "acceleration"]
    try:
        found = machine.d_effort(*state, by=[*ways, *names])
    except assur.InputError as error:
        assert "redundant" in str(error)  # noqa: PT017
        names = []
        found = machine.d_effort(*state, by=ways)

    def along(way: int, driver: int) -> Any:
        def values(x: Any) -> Any:
            args = [np.tile(a, (len(x), *(1,) * q0.ndim)) for a in state]
            args[way][(..., driver) if q0.ndim else ...] += x
            return machine.effort(*args, on_error="nan").reshape(len(x), n)

        return derivative(values, 1.0 if way == 0 else 10.0)

    def by_dimension(name: str) -> Any:
        def values(x: Any) -> Any:
            q = state[0][np.newaxis] if n == 1 else np.tile(state[0], (len(x), 1, 1))
            efforts = moved(machine, name, x).effort(q, *state[1:], on_error="nan")
            return efforts.reshape(len(x), n)

        return derivative(values, max(abs(float(mechanism.dimensions[name])), 0.1))

    columns = [along(way, driver) for way in range(3) for driver in range(n)]
    columns += [by_dimension(name) for name in names]
    kappa = float(mechanism.solve(state[0]).condition)
    close = CLOSE * max(1.0, kappa / WELL_CONDITIONED) ** 4
    compare(found.reshape(n, -1), columns, close)


WAVE = [0.0, 3.0, 1.0, -2.0, -4.0, 1.0, 2.0, 0.5, 0.0]
MACHINES: dict[str, Any] = {
    "a press": press,
    "a five-bar": five_bar,
    "a five-bar with springs and dampers": lambda: five_bar(
        loads=[assur.Gravity(), assur.Spring("P", "A", 80.0, 0.1), assur.Damper("P", "E", 3.0)]
    ),
    "an induction motor": lambda: press(
        motor=assur.InductionMotor(breakdown=90.0, slip=0.2, synchronous=12.0, rotor_inertia=0.1)
    ),
    "a motor by a table": lambda: press(
        motor=assur.Table(np.linspace(-7.0, 7.0, 9), np.linspace(20.0, 4.0, 9)),
        loads=[assur.Torque("crank", assur.Table(TURN / 8 * np.arange(9), WAVE))],
    ),
    "class IV": lambda: assur.Machine(
        assur.examples.loom(),
        bodies={
            name: assur.Body(mass=1.0, inertia=0.1)
            for name in assur.examples.loom().links
            if name != "ground"
        },
        loads=[assur.Gravity()],
    ),
}


@pytest.mark.parametrize("name", MACHINES)
def test_accelerations(name: str) -> None:
    machine = MACHINES[name]()
    mechanism = machine.mechanism
    rng = np.random.default_rng(4)
    n, q0 = machine.driver_count, np.asarray(mechanism.q0)
    q, speed = q0 + rng.uniform(-0.1, 0.1, q0.shape), rng.normal(size=q0.shape)
    efforts = None if machine.motor is not None else rng.normal(size=q0.shape)
    state = [q, speed] + ([] if efforts is None else [efforts])
    ways = ["q", "speed", "effort"][: len(state)]
    dimensions = list(mechanism.dimensions)[:6]
    masses = [
        f"{link}.{what}"
        for link, body in list(machine.bodies.items())[:2]
        for what in ("mass", "inertia")
        if getattr(body, what) > 0.0
    ]
    found = machine.d_acceleration(q, speed, efforts, by=[*ways, *dimensions, *masses])

    def along(way: int, driver: int) -> Any:
        def values(x: Any) -> Any:
            args = [np.tile(a, (len(x), *(1,) * q0.ndim)) for a in state]
            args[way][(..., driver) if q0.ndim else ...] += x
            return machine.acceleration(*args, on_error="nan").reshape(len(x), n)

        return derivative(values)

    def by_dimension(one: str) -> Any:
        def values(x: Any) -> Any:
            places = q[np.newaxis] if n == 1 else np.tile(q, (len(x), 1, 1))
            many = moved(machine, one, x).acceleration(places, speed, efforts, on_error="nan")
            return many.reshape(len(x), n)

        return derivative(values)

    def by_mass(one: str) -> Any:
        link, _, what = one.rpartition(".")
        body = machine.bodies[link]

        def values(x: Any) -> Any:
            every = []
            for each in x:
                mass, inertia = body.mass, body.inertia
                mass, inertia = (mass + each, inertia) if what == "mass" else (mass, inertia + each)
                changed = assur.Body(mass=mass, inertia=inertia, at=body.at)
                bodies = {**machine.bodies, link: changed}
                other = assur.Machine(
                    mechanism, bodies=bodies, loads=machine.loads, motor=machine.motor
                )
                every.append(np.atleast_1d(other.acceleration(q, speed, efforts)))
            return np.array(every)

        # No mass is negative: the longest interval reaches half way to zero.
        return derivative(values, min(1.0, 0.5 * getattr(body, what) / max(WIDTHS)))

    columns = [along(way, driver) for way in range(len(state)) for driver in range(n)]
    columns += [by_dimension(one) for one in dimensions] + [by_mass(one) for one in masses]
    compare(found.reshape(n, -1), columns)


@pytest.mark.parametrize("steps", [None, 1, 3])
@pytest.mark.parametrize("name", ["a press", "a five-bar", "an induction motor"])
def test_the_state_equations(name: str, steps: int | None) -> None:
    machine = MACHINES[name]()
    rng = np.random.default_rng(8)
    n, q0 = machine.driver_count, np.asarray(machine.mechanism.q0)
    q, speed = q0 + rng.uniform(-0.1, 0.1, q0.shape), rng.normal(size=q0.shape)
    effort = rng.normal(size=q0.shape)
    dt = 0.01
    found = (
        machine.linearize(q, speed, effort)
        if steps is None
        else machine.linearize(q, speed, effort, dt=dt, n=steps)
    )
    assert found.A.shape, found.B.shape == ((2 * n, 2 * n), (2 * n, n))
    assert found.status == 0

    def along(way: int, driver: int) -> Any:
        def values(x: Any) -> Any:
            args = [np.tile(a, (len(x), *(1,) * q0.ndim)) for a in (q, speed, effort)]
            args[way][(..., driver) if q0.ndim else ...] += x
            if steps is None:
                rates = args[1], machine.acceleration(*args)
            else:
                after = machine.step(*args, dt=dt, n=steps)
                rates = after.q, after.speed
            return np.concatenate([rate.reshape(len(x), n) for rate in rates], axis=1)

        return derivative(values)

    columns = [along(way, driver) for way in range(3) for driver in range(n)]
    compare(np.concatenate([found.A, found.B], axis=1), columns)


def test_states_and_designs_in_rows() -> None:
    mechanism = assur.SliderCrank([0.1, 0.12, 0.15], 0.4)
    machine = assur.Machine(
        mechanism, bodies={"piston": assur.Body(mass=2.0)}, loads=[assur.Gravity()]
    )
    q = np.array([0.3, 0.7, 1.2, 2.0])
    by = ["q", "*.length", "piston.mass"]
    found = machine.d_acceleration(q, 3.0, 1.0, by=by)
    assert found.shape == (3, 4, 4)
    for threads in (1, 2):
        again = machine.d_acceleration(q, 3.0, 1.0, by=by, threads=threads)
        assert (again == found).all()
    alone = machine.of(mechanism.design(1)).d_acceleration(q[2], 3.0, 1.0, by=by)
    assert (alone == found[1, 2]).all()
    beside = machine.linearize(q, 3.0, 1.0, dt=0.001)
    one = machine.of(mechanism.design(1)).linearize(q[2], 3.0, 1.0, dt=0.001)
    assert (beside.A[1, 2] == one.A).all()
    assert (beside.B[1, 2] == one.B).all()
    assert machine.d_effort(q, by=[]).shape == (3, 4, 0)


def test_what_has_no_derivative_is_nan() -> None:
    machine = assur.Machine(
        assur.FourBar(3.0, 2.5, 2.0, 4.0), bodies={"rocker": assur.Body(mass=1.0, at=(1.0, 0.0))}
    )
    found = machine.d_effort([0.5, 2.0], 1.0, by=["q", "*.length"], on_error="nan")
    assert np.isfinite(found[0]).all()
    assert np.isnan(found[1]).all()
    with pytest.raises(assur.PositionError):
        machine.d_effort([0.5, 2.0], 1.0)
    beside = machine.linearize([0.5, 2.0], 1.0, 0.0, on_error="nan")
    assert beside.status.tolist() == [0, 3]
    assert np.isnan(beside.A[1]).all()
    assert np.isfinite(beside.B[0]).all()


REFUSED: dict[str, tuple[str, dict[str, Any], str]] = {
    "an unknown name": ("d_effort", {"by": "foo"}, "by is also 'q', 'speed', 'acceleration'"),
    "effort of an effort": ("d_effort", {"by": "effort"}, "by is also"),
    "a number": ("d_acceleration", {"by": 3}, 'by is 3: "q", "speed" or names'),
    "an unknown link": ("d_effort", {"by": "foo.mass"}, "foo.mass"),
    "steps without their time": ("linearize", {"n": 3}, "n = 3 steps need dt"),
    "no time": ("linearize", {"dt": 0.0}, "dt is 0"),
    "half a step": ("linearize", {"dt": 0.1, "n": 0.5}, "n is 0.5"),
    "another shape": ("d_effort", {"speed": [1.0, 2.0, 3.0]}, "speed has the shape"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name: str) -> None:
    call, options, message = REFUSED[name]
    with pytest.raises(assur.InputError, match=message):
        getattr(press(), call)([0.5, 1.0], **options)


def test_functions_and_singular_masses_are_refused() -> None:
    def wind(t: float, q: float, speed: float) -> float:
        return t + q - speed

    blowing = press(loads=[assur.Torque("crank", wind)])
    for call in ("d_effort", "d_acceleration", "linearize"):
        with pytest.raises(assur.InputError, match=f"{call}.* is a Python function"):
            getattr(blowing, call)(0.5, 1.0)
    bare = assur.Machine(assur.SliderCrank(0.1, 0.4))
    with pytest.raises(assur.InputError, match="no acceleration"):
        bare.linearize(0.5)
    assert np.isnan(bare.linearize(0.5, on_error="nan").A).all()


def test_a_step_that_cannot_be_made_leaves_the_others_alone() -> None:
    bodies = {"crank": assur.Body(inertia=1.0), "rocker": assur.Body(inertia=1.0)}
    machine = assur.Machine(assur.FourBar(1.0, 2.0, 1.5, 3.2), bodies=bodies)
    found = machine.linearize([0.5, 3.0], 1.0, 0.0, dt=0.01, on_error="nan")
    assert found.status.tolist() == [0, 3]
    assert (found.A[0] == machine.linearize(0.5, 1.0, 0.0, dt=0.01).A).all()
    assert np.isnan(found.A[1]).all()
    # The second is lost on the way.
    far = machine.linearize([0.5, 1.0], [1.0, 100.0], 0.0, dt=0.01, n=100, on_error="nan")
    assert np.isnan(far.A[1]).all()
    assert far.status[1] > 1


def test_no_inertia_is_no_value() -> None:
    piston = assur.Machine(assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=2.0)})
    found = piston.linearize([0.0, 0.5], 1.0, 0.0, on_error="nan")
    assert found.status.tolist() == [assur.Status.NO_VALUE, assur.Status.OK]


def test_invalid_designs_have_no_numbers() -> None:
    lengths = [1.0, -1.0, np.nan, 0.0]
    batch = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"crank.length": lengths})
    bodies = {"crank": assur.Body(inertia=0.05), "rocker": assur.Body(inertia=1.0)}
    machine = assur.Machine(batch, bodies=bodies, loads=[assur.Gravity()])
    runs = machine.run(t_end=0.1, q0=[0.5], speed0=1.0, on_error="nan")
    assert runs.status.ravel().tolist() == [0, 6, 6, 6]
    assert np.isnan(runs.q_end[1:]).all()
    many = machine.run(t_end=0.01, q0=np.full(40, 0.5), speed0=1.0, on_error="nan")
    assert many.status.tolist() == [[0] * 40, *[[6] * 40] * 3]
    for numbers in (
        machine.effort(0.5, 1.0, on_error="nan"),
        machine.reduced_inertia(0.5, on_error="nan").value,
        machine.reduced_moment(0.5, on_error="nan"),
    ):
        assert np.isfinite(numbers[0])
        assert np.isnan(numbers[1:]).all()
