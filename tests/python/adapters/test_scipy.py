"""Functions for SciPy: found mechanisms and motions, and derivatives against differences."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import approx_fprime, least_squares

import assur
from assur.adapters.scipy import Residuals, StateEquations

Q = np.linspace(0.1, 6.1, 15)
# Of forward differences with a step of 1.5e-8, relative to the greatest entry.
CLOSE = 1e-6
TARGETS: dict[str, tuple[Any, Any, dict[str, Any], Any]] = {
    "a joint and a link": (
        assur.examples.crank_rocker,
        Q,
        {"P": np.ones((15, 2)), "rocker": np.ones(15)},
        "*",
    ),
    "a slide": (assur.examples.engine, Q, {"bore": np.zeros(15)}, ["crank.length", "rod.length"]),
    "two drivers": (
        assur.examples.five_bar,
        np.array([[1.85, 1.29], [1.9, 1.2]]),
        {"P": np.ones((2, 2))},
        "*.length",
    ),
    "class IV": (assur.examples.loom, np.linspace(0.2, 1.4, 4), {"6": np.ones((4, 2))}, "l48.*"),
}


@pytest.mark.parametrize("name", TARGETS)
def test_jacobians_are_differences(name: str) -> None:
    make, q, targets, by = TARGETS[name]
    missed = Residuals(make(), targets, q, by=by)
    found = missed.jac(missed.x0)
    wanted = approx_fprime(missed.x0, missed.fun)
    assert found.shape == wanted.shape == (len(missed.fun(missed.x0)), len(missed.names))
    assert np.abs(found - wanted).max() <= CLOSE * np.abs(found).max()


def test_least_squares_finds_the_mechanism() -> None:
    true = assur.examples.crank_rocker()
    points = true.solve(Q).joint("P").value
    start = {name: 1.03 * float(true.dimensions[name]) for name in ("coupler.P.x", "rocker.length")}
    missed = Residuals(
        true.with_dimensions(start), {"P": points}, Q, by=["*.length", "coupler.P.*"]
    )
    found = least_squares(missed.fun, missed.x0, jac=missed.jac, xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert found.cost < 1e-25
    wanted = [float(true.dimensions[name]) for name in missed.names]
    assert found.x == pytest.approx(wanted, rel=1e-9)
    assert (
        float(missed.mechanism(found.x).dimensions["rocker.length"])
        == found.x[missed.names.index("rocker.length")]
    )
    assert "1 output by 5 dimensions" in repr(missed)


def test_positions_that_do_not_exist_shorten_the_step() -> None:
    """A start from which the first full step breaks the mechanism."""
    true = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    angles = true.solve(Q).link("rocker").value
    start = true.with_dimensions({"rocker.length": 1.7, "coupler.length": 3.6})
    missed = Residuals(start, {"rocker": angles}, Q, by=["rocker.length", "coupler.length"])
    assert np.isnan(missed.fun([0.5, 5.0])).any()
    found = least_squares(missed.fun, missed.x0, jac=missed.jac)
    assert found.x == pytest.approx([2.5, 3.0], rel=1e-6)


def machine(**parts: Any) -> assur.Machine:
    bodies = {"piston": assur.Body(mass=2.0), "crank": assur.Body(inertia=0.05)}
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies=bodies, loads=[assur.Gravity()], **parts
    )


@pytest.mark.parametrize("effort", [None, 0.4])
def test_an_implicit_method_moves_as_run(effort: float | None) -> None:
    motor = assur.ConstantTorque(0.4) if effort is None else None
    state = StateEquations(machine(motor=motor), effort)
    every = solve_ivp(
        state.fun, (0.0, 1.0), [0.3, 2.0], "Radau", jac=state.jac, rtol=1e-10, atol=1e-12
    )
    wanted = machine(motor=assur.ConstantTorque(0.4)).run(1.0, q0=0.3, speed0=2.0)
    assert every.success
    assert every.y[:, -1] == pytest.approx([wanted.q[-1], wanted.speed[-1]], rel=1e-8)


def test_state_equations_of_several_drivers() -> None:
    mechanism = assur.examples.five_bar()
    bodies = {name: assur.Body(mass=1.0, inertia=0.1) for name in list(mechanism.links)[1:]}
    state = StateEquations(assur.Machine(mechanism, bodies=bodies), [0.3, -0.2])
    y = np.array([*mechanism.q0, 0.4, -0.6])
    found = state.jac(0.0, y)
    beside = [state.fun(0.0, y + step) - state.fun(0.0, y - step) for step in 1e-6 * np.eye(4)]
    wanted = np.stack(beside, axis=1) / 2e-6
    assert found.shape == (4, 4)
    assert np.abs(found - wanted).max() <= CLOSE * max(1.0, np.abs(found).max())
    assert "state equations of 2 drivers" in repr(state)


FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.0)
REFUSED: dict[str, tuple[Any, str]] = {
    "a batch": (
        lambda: Residuals(assur.FourBar(1.0, [3.0, 3.1], 2.5, 3.0), {"C": [[1, 1]]}, [0.5]),
        "of one design",
    ),
    "no targets": (lambda: Residuals(FOUR_BAR, {}, [0.5]), "targets is {}"),
    "points for an angle": (
        lambda: Residuals(FOUR_BAR, {"rocker": [[1.0, 2.0]]}, [0.5]),
        r"targets\['rocker'\] has the shape \(1, 2\), and at these q it is \(1,\)",
    ),
    "an unknown joint": (lambda: Residuals(FOUR_BAR, {"Z": [[1.0, 2.0]]}, [0.5]), "Z"),
    "a dimension twice": (
        lambda: Residuals(FOUR_BAR, {"rocker": [1.0]}, [0.5], by=["*.length", "crank.length"]),
        "'crank.length' is named twice",
    ),
    "another number of values": (
        lambda: Residuals(FOUR_BAR, {"rocker": [1.0]}, [0.5]).fun([1.0]),
        "3 values are needed",
    ),
    "friction": (
        lambda: StateEquations(machine(friction={"A": assur.JointFriction(0.1, 0.02)})),
        "friction",
    ),
    "a state of three": (lambda: StateEquations(machine()).fun(0.0, [1.0, 2.0, 3.0]), "2 numbers"),
    "many designs": (
        lambda: StateEquations(assur.Machine(assur.SliderCrank([0.1, 0.2], 0.5))),
        "of one design",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name: str) -> None:
    call, message = REFUSED[name]
    with pytest.raises(assur.InputError, match=message):
        call()


def test_what_no_design_can_be_shortens_the_step() -> None:
    missed = Residuals(FOUR_BAR, {"rocker": FOUR_BAR.solve(Q).link("rocker").value}, Q)
    assert np.isnan(missed.fun([-1.0, 3.0, 2.5])).all()
    assert np.isnan(missed.jac([np.nan, 3.0, 2.5])).all()
    with pytest.raises(assur.DimensionError):
        missed.mechanism([-1.0, 3.0, 2.5])


def test_loads_that_act_on_the_way_are_taken() -> None:
    pressing = assur.Torque("crank", -1.0, while_="backward", over="bore")
    bodies = {"piston": assur.Body(mass=2.0), "crank": assur.Body(inertia=0.05)}
    machine = assur.Machine(assur.SliderCrank(0.1, 0.4), bodies=bodies, loads=[pressing])
    assert np.isfinite(StateEquations(machine).fun(0.0, [0.3, 2.0])).all()
