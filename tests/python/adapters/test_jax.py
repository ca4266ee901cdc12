"""Functions of JAX against the package's numbers, and derivatives against differences."""

from __future__ import annotations

import builtins
from typing import Any

import numpy as np
import pytest

import assur
from assur.adapters import jax as ours
from dynamics.equations.test_equations import five_bar, press

jax = pytest.importorskip("jax")
jnp = jax.numpy
jax.config.update("jax_enable_x64", True)

Q = np.linspace(0.1, 6.1, 7)
STEP, CLOSE = 1e-6, 1e-7
PLACES: dict[str, tuple[Any, Any, str, str]] = {
    "a joint": (assur.examples.crank_rocker, Q, "P", "joint"),
    "a link": (assur.examples.crank_rocker, Q, "rocker", "link"),
    "a slide": (assur.examples.engine, Q, "bore", "slide"),
    "two drivers": (
        assur.examples.five_bar,
        np.array([[1.85, 1.29], [1.9, 1.2], [1.8, 1.3]]),
        "P",
        "joint",
    ),
}


@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("name", PLACES)
def test_places_are_those_of_the_package(name: str, order: int) -> None:
    make, q, of, kind = PLACES[name]
    m = make()
    f = ours.place(m, of, by="*.length", order=order)
    names = [one for one in m.dimensions if one.endswith(".length")]
    x = np.array([float(m.dimensions[one]) for one in names])
    motion = m.solve(q, order=order + 1)
    wanted = getattr(motion, kind)(of).arrays[order]
    assert (np.asarray(f(x, q)) == wanted).all()
    assert (np.asarray(jax.jit(f)(x, q[1])) == wanted[1]).all()
    assert (np.asarray(jax.vmap(f, (None, 0))(x, q)) == wanted).all()
    by_x = np.asarray(jax.jacobian(f)(x, q[2]))
    assert by_x == pytest.approx(
        motion.jacobian(of, by=names, order=order)[2], rel=1e-12, abs=1e-14
    )
    by_q = np.asarray(jax.jacobian(f, argnums=1)(x, q[2]))
    exact = motion.jacobian(of, by="q", order=order)[2]
    assert by_q.ravel() == pytest.approx(exact.ravel(), rel=1e-12, abs=1e-14)
    # Designs in rows, each at all places.
    many = np.stack([x, 1.01 * x, 0.99 * x])
    found = np.asarray(jax.jit(jax.vmap(f, (0, None)))(many, q))
    for design, rows in zip(many, found, strict=True):
        changed = m.with_dimensions(dict(zip(names, design.tolist(), strict=True)))
        alone = getattr(changed.solve(q, order=order), kind)(of).arrays[order]
        assert (rows == alone).all()


def test_gradients_are_differences() -> None:
    """A loss over many positions, forward and backward, under jit."""
    m = assur.examples.crank_rocker()
    f = ours.place(m, "P", by="*.length")
    x = np.array([float(m.dimensions[name]) for name in m.dimensions if name.endswith(".length")])

    def loss(x: Any) -> Any:
        return ((f(x, Q) - 0.3) ** 2).sum()

    gradient = np.asarray(jax.jit(jax.grad(loss))(x))
    for index in range(len(x)):
        up, down = (x + way * STEP * np.eye(len(x))[index] for way in (1.0, -1.0))
        wanted = (loss(up) - loss(down)) / (2.0 * STEP)
        assert gradient[index] == pytest.approx(float(wanted), rel=CLOSE)
    along = np.array([0.3, -0.2, 0.5])
    _, rate = jax.jvp(loss, (jnp.asarray(x),), (jnp.asarray(along),))
    assert float(rate) == pytest.approx(float(gradient @ along), rel=1e-12)


def test_the_core_is_reached_once_a_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    calls: list[Any] = []
    solve = assur.Mechanism.solve

    def counted(self: Any, *args: Any, **options: Any) -> Any:
        calls.append(self.shape)
        return solve(self, *args, **options)

    f = ours.place(m, "C", by="*.length")
    x = jnp.array([1.0, 3.0, 2.5])
    monkeypatch.setattr(assur.Mechanism, "solve", counted)
    jax.block_until_ready(jax.jit(jax.vmap(f, (None, 0)))(x, Q))
    assert calls == [(1,)]
    jax.block_until_ready(
        jax.jit(jax.vmap(jax.vmap(f, (None, 0)), (0, None)))(jnp.tile(x, (5, 1)), Q)
    )
    assert len(calls) == 2


@pytest.mark.parametrize("make", [press, five_bar])
def test_machines(make: Any) -> None:
    machine = make()
    n, q0 = machine.driver_count, np.asarray(machine.mechanism.q0)
    rng = np.random.default_rng(3)
    state = [q0 + 0.1, *rng.normal(size=(2, *q0.shape))]
    f = ours.acceleration(machine)
    assert (np.asarray(f(*state)) == machine.acceleration(*state)).all()
    slopes = jax.jacobian(f, argnums=(0, 1, 2))(*map(jnp.asarray, state))
    exact = machine.d_acceleration(*state, by=["q", "speed", "effort"]).reshape(n, 3 * n)
    found = np.concatenate([np.asarray(slope).reshape(n, n) for slope in slopes], axis=1)
    assert found == pytest.approx(exact, rel=1e-12)
    g = ours.step(machine, 0.002, n=2)
    after = machine.step(*state, dt=0.002, n=2)
    q, speed = g(*state)
    assert (np.asarray(q) == after.q).all()
    assert (np.asarray(speed) == after.speed).all()
    beside = machine.linearize(*state, dt=0.002, n=2)
    of_q, of_speed = jax.jacobian(g, argnums=(0, 1, 2))(*map(jnp.asarray, state))
    rows = [
        np.concatenate([np.asarray(slope).reshape(n, n) for slope in slopes], axis=1)
        for slopes in (of_q, of_speed)
    ]
    wanted = np.concatenate([beside.A, beside.B], axis=1)
    assert np.concatenate(rows) == pytest.approx(wanted, rel=1e-12, abs=1e-14)
    many = [np.stack([each, each + 0.01, each + 0.02]) for each in state]
    assert (np.asarray(jax.vmap(f)(*many)) == machine.acceleration(*many)).all()
    assert (np.asarray(f(*many)) == machine.acceleration(*many)).all()


def test_a_trajectory_is_differentiated_through_its_steps() -> None:
    """By `lax.scan`: the gradient of where a press ends, by its initial speed."""
    machine = press()
    step = ours.step(machine, 0.001, n=5)

    def end(speed: Any) -> Any:
        def body(state: Any, _: Any) -> Any:
            return step(state[0], state[1], 1.0), None

        (q, _), _ = jax.lax.scan(body, (jnp.asarray(0.3), speed), None, length=10)
        return q

    found = float(jax.jit(jax.grad(end))(2.0))
    wanted = (float(end(2.0 + STEP)) - float(end(2.0 - STEP))) / (2.0 * STEP)
    assert found == pytest.approx(wanted, rel=CLOSE)


def test_what_does_not_exist_is_nan() -> None:
    f = ours.place(assur.FourBar(3.0, 2.5, 2.0, 4.0), "C", by="*.length")
    x = jnp.array([3.0, 2.5, 2.0])
    places = np.asarray(f(x, jnp.array([0.5, 2.0])))
    assert np.isfinite(places[0]).all()
    assert np.isnan(places[1]).all()


REFUSED: dict[str, tuple[Any, str]] = {
    "a batch": (lambda: ours.place(assur.FourBar(1.0, [3.0, 3.1], 2.5, 3.0), "C"), "one design"),
    "an unknown name": (lambda: ours.place(assur.FourBar(1.0, 3.0, 2.5, 3.0), "Z"), "Z"),
    "other dimensions": (
        lambda: ours.place(assur.FourBar(1.0, 3.0, 2.5, 3.0), "C", by="*.length")(np.ones(1), 0.5),
        "3 dimensions are needed",
    ),
    "one number for two drivers": (
        lambda: ours.acceleration(five_bar())(0.5, 0.1, 0.2),
        "with 2 drivers its last axis is 2",
    ),
    "friction": (
        lambda: ours.acceleration(press(friction={"A": assur.JointFriction(0.1, 0.02)})),
        "friction",
    ),
    "no time": (lambda: ours.step(press(), 0.0), "dt is 0"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name: str) -> None:
    call, message = REFUSED[name]
    with pytest.raises(assur.InputError, match=message):
        call()


def test_without_jax_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def missing(name: str, *args: Any, **options: Any) -> Any:
        if name == "jax":
            raise ImportError(name)
        return real(name, *args, **options)

    monkeypatch.setattr(builtins, "__import__", missing)
    with pytest.raises(assur.InputError, match=r"pip install assur\[jax\]"):
        ours.place(assur.FourBar(1.0, 3.0, 2.5, 3.0), "C")


def test_what_no_design_can_be_is_nan_in_any_company() -> None:
    f = ours.place(assur.FourBar(1.0, 3.0, 2.5, 3.0), "C", by="*.length")
    x = jnp.array([1.0, 3.0, 2.5])
    assert np.isnan(np.asarray(f(-x, 0.5))).all()
    found = np.asarray(jax.vmap(f, (0, None))(jnp.stack([-x, x]), 0.5))
    assert np.isnan(found[0]).all()
    assert (found[1] == np.asarray(f(x, 0.5))).all()
    with pytest.raises(assur.InputError, match=r"'crank\.length' is named twice"):
        ours.place(assur.FourBar(1.0, 3.0, 2.5, 3.0), "C", by=["crank.length", "*.length"])


def test_a_step_without_a_state_leaves_the_others_alone() -> None:
    bodies = {"crank": assur.Body(inertia=1.0), "rocker": assur.Body(inertia=1.0)}
    machine = assur.Machine(assur.FourBar(1.0, 2.0, 1.5, 3.2), bodies=bodies)
    step = ours.step(machine, 0.01)
    slopes = jax.jacobian(lambda q: step(q, 1.0, 0.0)[0])(jnp.array([0.5, 3.0]))
    assert np.isfinite(slopes[0, 0])
    assert np.isnan(slopes[1, 1])
