"""Andrews' squeezer against the printed numbers and the equations of the multibody literature."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt
import pytest
from scipy.integrate import solve_ivp

import assur
from assur import examples
from oracles.dynamics import squeezer_equations
from oracles.kinematics.example_checks import mechanism_of

Float: TypeAlias = npt.NDArray[np.float64]

# Test Set for IVP solvers: β, Θ, γ, Φ, δ, Ω, ε at the start, their accelerations and multipliers.
START = np.array(
    [
        -0.0617138900142764496358948458001,
        0.0,
        0.455279819163070380255912382449,
        0.222668390165885884674473185609,
        0.487364979543842550225598953530,
        -0.222668390165885884674473185609,
        1.23054744454982119249735015568,
    ]
)
FIRST = np.array([14222.4439199541138705911625887, -10666.8329399655854029433719415, 0, 0, 0, 0, 0])
MULTIPLIERS = (98.5668703962410896057654982170, -6.12268834425566265503114393122)
# Its reference solution at 0.03 s: angles, rates, accelerations.
END = np.array(
    [
        [15.81077119629904, 1139.920302151208, -24631.76316945196],
        [-15.75637105984298, -1424.379294994111, 51850.37701610329],
        [0.04082224013073101, 11.03291221937134, 324102.5686413781],
        [-0.5347301163226948, 19.29337464421385, 566749.3645176213],
        [0.5244099658805304, 0.5735699284790808, 16743.62929479361],
        [0.5347301163226948, -19.29337464421385, -566749.3645176222],
        [1.048080741042263, 0.3231791658026955, 9826.520791458422],
    ]
)
# Relative to the greatest of angles, rates and accelerations: the reference is off by so much from
# our motion and from that of the literature's equations alike, which agree to SAME.
PRINTED = (1e-10, 1e-9, 2e-7)
SAME = (2e-12, 1e-11, 1e-10)
ROUNDING = 1e-15  # m or rad: printed to 30 digits


def as_printed(motion: assur.Motion, speed: float, acceleration: float) -> Float:
    """The source's seven angles, their rates and accelerations, (7, 3)."""
    rows = {}
    for name in [f"K{i}" for i in range(1, 8)]:
        angle = motion.link(name)
        rate, change = angle.velocity(speed), angle.acceleration(speed, acceleration)
        rows[name] = np.array([float(angle.value), float(rate), float(change)])
    half, right = np.array([np.pi, 0.0, 0.0]), np.array([np.pi / 2, 0.0, 0.0])
    gamma, epsilon = rows["K3"] + right, rows["K7"] + right
    found = [
        rows["K1"],
        rows["K2"] - half - rows["K1"],
        gamma,
        rows["K4"] + right - rows["K5"],
        rows["K5"],
        rows["K6"] - epsilon,
        epsilon,
    ]
    return np.array(found)


def whole_turns(found: Float, want: Float) -> Float:
    """The found angles, by as many turns away as fits."""
    out = found.copy()
    out[:, 0] -= 2 * np.pi * np.round((found - want)[:, 0] / (2 * np.pi))
    return out


def test_initial_position() -> None:
    m = mechanism_of(examples.andrews_squeezer())
    assert np.max(np.abs(squeezer_equations.constraints(START))) <= ROUNDING
    motion = m.solve(m.q0, order=2)
    start = whole_turns(as_printed(motion, 0.0, 0.0), np.stack([START] * 3, axis=-1))
    assert np.max(np.abs(start[:, 0] - START)) <= ROUNDING
    lengths = {"K2": 28e-3, "K4": 20e-3, "K6": 20e-3}  # not given: they follow from the angles
    for link, length in lengths.items():
        assert m.dimensions[f"{link}.length"] == pytest.approx(length, abs=ROUNDING)


def test_initial_acceleration_and_force() -> None:
    """Accelerations and the two multipliers that are not 0: the force between K2 and K3 at E."""
    machine = examples.andrews_squeezer()
    q0 = float(mechanism_of(machine).q0)
    run = machine.run(t_end=1e-6, q0=q0, speed0=0.0)
    assert run.acceleration[0] == pytest.approx(FIRST[0], rel=1e-14)
    motion = mechanism_of(machine).solve(q0, order=2)
    found = as_printed(motion, 0.0, float(run.acceleration[0]))[:, 2]
    assert np.max(np.abs(found - FIRST)) <= 1e-13 * FIRST[0]
    force = machine.reactions(q0, 0.0, run.acceleration[0]).joint("E", on="K3")
    assert force == pytest.approx(MULTIPLIERS, rel=1e-12)


def test_reference_solution() -> None:
    """At 0.03 s, two and a half turns later, all angles, rates and accelerations."""
    machine = examples.andrews_squeezer()
    run = machine.run(t_end=0.03, q0=mechanism_of(machine).q0, speed0=0.0, rtol=1e-13)
    motion = mechanism_of(machine).solve(run.q[-1], order=2)
    found = whole_turns(as_printed(motion, run.speed[-1], run.acceleration[-1]), END)
    size = np.max(np.abs(END), axis=0)
    assert np.all(np.max(np.abs(found - END), axis=0) <= PRINTED * size)
    # The literature's own equations, integrated by another program.
    start = np.concatenate([START, np.zeros(7)])
    other = solve_ivp(
        squeezer_equations.rhs, (0.0, 0.03), start, method="DOP853", rtol=1e-13, atol=1e-13
    ).y[:, -1]
    angles, rates = other[:7], other[7:]
    want = np.stack([angles, rates, squeezer_equations.accelerations(angles, rates)[0]], axis=-1)
    assert np.all(np.max(np.abs(found - want), axis=0) <= SAME * size)
    assert np.abs(run.energy.balance).max() <= 1e-12 * run.energy.kinetic.max()
