"""Steps of ten thousand environments: a slider-crank with three bodies, and a five-bar."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from rivals import stepping
from subject import OURS, Case, Contender, Subject, installed

if TYPE_CHECKING:
    from collections.abc import Callable

DT = 1e-3


def case(quick: bool) -> Case:
    environments, steps = (100, 3) if quick else (10_000, 10)
    subjects: dict[str | int, Callable[[], Subject]] = {
        "slider-crank": lambda: slider_crank(environments, steps),
        "five-bar": lambda: five_bar(environments, steps),
    }
    return Case("steps", "step", subjects, plotted=False)


def slider_crank(environments: int, steps: int) -> Subject:
    r, rod, wheel, mass, inertia, at, piston = stepping.SLIDER
    bodies = {
        "crank": assur.Body(inertia=wheel),
        "rod": assur.Body(mass=mass, inertia=inertia, at=at),
        "piston": assur.Body(mass=piston),
    }
    gravity = assur.Gravity((stepping.GRAVITY, 0.0))
    machine = assur.Machine(assur.SliderCrank(r, rod), bodies=bodies, loads=[gravity])
    rng = np.random.default_rng(1)
    q, speed = rng.uniform(0.0, 2.0 * np.pi, environments), rng.normal(size=environments)
    return _subject(machine, q, speed, steps, 0.0)


def five_bar(environments: int, steps: int) -> Subject:
    machine, q0 = five_bar_machine()
    rng = np.random.default_rng(2)
    q = q0 + rng.uniform(-0.3, 0.3, (environments, 2))
    return _subject(machine, q, rng.normal(size=q.shape), steps, [0.0, 0.0])


def five_bar_machine() -> tuple[assur.Machine, Any]:
    """The five-bar of `stepping`, and where its cranks are drawn."""
    ground, left, right, rod, arm = stepping.FIVE
    q0 = np.array([2.0, 1.1])
    b = left * np.array([np.cos(q0[0]), np.sin(q0[0])])
    d = np.array([ground, 0.0]) + right * np.array([np.cos(q0[1]), np.sin(q0[1])])
    span = d - b
    along = (span @ span + rod**2 - arm**2) / (2.0 * span @ span)
    across = np.sqrt(rod**2 / (span @ span) - along**2)
    p = b + along * span + across * np.array([-span[1], span[0]])
    mechanism = assur.Mechanism(
        joints={"A": (0, 0), "B": tuple(b), "P": tuple(p), "D": tuple(d), "E": (ground, 0)},
        links={"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"},
        driver=("left", "right"),
    )
    mass, inertia, at = stepping.BODY
    body = assur.Body(mass=mass, inertia=inertia, at=at)
    bodies = dict.fromkeys(("left", "rod", "arm", "right"), body)
    return assur.Machine(mechanism, bodies=bodies, loads=[assur.Gravity()]), q0


def _subject(machine: assur.Machine, q: Any, speed: Any, steps: int, effort: Any) -> Subject:
    two = q.ndim == 2
    rows, rates = np.ascontiguousarray(q.T), np.ascontiguousarray(speed.T)
    contenders = {
        OURS: Contender(
            lambda: machine.step(q, speed, effort, DT, n=steps),
            lambda after: [after.q.T, after.speed.T],
        )
    }
    if installed("numba"):
        from rivals.stepping_numba import by_numba

        contenders["numba by hand, in parallel"] = Contender(
            lambda: by_numba(two, rows, rates, DT, steps), list
        )
    if installed("jax"):
        from rivals.stepping_jax import by_jax

        contenders["JAX by hand, jit"] = Contender(
            lambda: by_jax(two, rows, rates, DT, steps), list
        )
    contenders["NumPy by hand"] = Contender(
        lambda: stepping.by_numpy(two, rows, rates, DT, steps), list
    )
    return Subject(len(q), steps, contenders, units=len(q) * steps)
