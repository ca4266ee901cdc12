"""Worked reactions without friction: drives, shaking forces, balance, loads inside a rod.

Every number was found twice before: in body coordinates with multipliers, and in closed form or
link by link.  Here both the library and the oracle must give all of its digits.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Torque
from oracles.dynamics.reaction_view import View


def library(machine: Any, *where: Any) -> Any:
    return machine.reactions(*where)


both = pytest.mark.parametrize("solve", [View, library])
Solver = Any
# Numbers are given to ten digits.
LAST = 6e-10
OMEGA = 60.0


def same(found: Any, *wanted: float) -> None:
    for value, other in zip(np.ravel(found), wanted, strict=True):
        assert abs(value - other) <= LAST * abs(other), (value, other)


def engine(length: float = 0.35, **loads: Any) -> assur.Machine:
    """Crank 0.1, rod 1.2 kg with its centre 0.12 from A, piston 2 kg."""
    bodies = {
        "rod": Body(mass=1.2, inertia=0.015, at=(0.12, 0.0)),
        "piston": Body(mass=2.0, at="B"),
    }
    return assur.Machine(assur.SliderCrank(0.1, length), bodies=bodies, **loads)


@both
def test_slider_crank_drive(solve: Solver) -> None:
    """800 N on the piston, no masses."""
    machine = assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[Force("B", (-800.0, 0.0))])
    q = np.radians([60.0, 150.0, 250.0])
    same(solve(machine, q, 0.0, 0.0).driver, -79.49711067, -30.0, 67.549266)


@both
def test_engine_drive(solve: Solver) -> None:
    """With masses, the load beside the pin: the guide carries its moment."""
    machine = engine(loads=[Force(("piston", (0.03, 0.02)), (-800.0, 0.0))])
    found = solve(machine, np.radians([30.0, 120.0, 300.0]), OMEGA, 0.0)
    same(found.driver, 7.270878542, -102.6600835, 46.26587741)
    bore = found.slide("bore")
    np.testing.assert_allclose(bore.moment, [-16.0] * 3, rtol=1e-12)  # −(0.02 · 800)


@both
def test_four_bar_drive(solve: Solver) -> None:
    """A torque of 100 on the rocker of l = 1, 4.5, 1.5, 4.9."""
    m = assur.FourBar(1.0, 4.5, 1.5, 4.9)
    q = np.radians([60.0, 160.0, 300.0])
    machine = assur.Machine(m, loads=[Torque("rocker", -100.0)])
    same(solve(machine, q[:2], 0.0, 0.0).driver, 53.31463093, 54.53861477)
    machine = assur.Machine(m, loads=[Torque("rocker", 100.0)])
    same(solve(machine, q[2:], 0.0, 0.0).driver, 67.73531715)
    # near its least transmission angle, where coupler and rocker are nearly in line
    near = assur.Machine(assur.FourBar(1.0, 4.5, 1.5, 4.985), loads=[Torque("rocker", 100.0)])
    beside = math.pi - 1.5 * 0.0825900520399
    same(solve(near, beside, 0.0, 0.0).driver, -52.02169498)


@both
def test_shaking_force_of_an_engine(solve: Solver) -> None:
    """The rod as two masses and a moment of inertia (exact), the crank balanced.

    X = ω² r [(m_p + m s/l) x″ + m (1 − s/l) cos φ], Y = ω² r m (1 − s/l) sin φ, and about O
    −(I − m s (l − s)) φ2″ ω², with −x″ the piston's second analogue over r.
    """
    r, length, rod, centre, inertia, piston = 0.1, 0.35, 1.2, 0.12, 0.015, 2.0
    machine = engine()
    phi = np.radians([30.0, 75.0, 200.0, 301.0])
    found = solve(machine, phi, OMEGA, 0.0)
    motion = machine.mechanism.solve(phi, order=2)  # type: ignore[union-attr]
    at_pin, at_piston = rod * (1 - centre / length), rod * centre / length
    x = -(OMEGA**2) * (motion.slide("bore").d2 * (piston + at_piston) - r * at_pin * np.cos(phi))
    y = OMEGA**2 * r * at_pin * np.sin(phi)
    couple = -(inertia - rod * centre * (length - centre)) * motion.link("rod").d2 * OMEGA**2
    np.testing.assert_allclose(found.shaking_force, np.stack([x, y], axis=-1), rtol=1e-12)
    np.testing.assert_allclose(found.shaking_moment, couple, rtol=1e-11)
    same(found.shaking_force[0], 1126.878441, 141.9428571)
    same(found.shaking_moment[0], 8.826963928)


@both
def test_harmonics_of_an_engine(solve: Solver) -> None:
    """Of a piston alone, k = 3: cos φ and the even harmonics, nothing else."""
    machine = assur.Machine(assur.SliderCrank(1.0, 3.0), bodies={"piston": Body(mass=1.0)})
    count = 64
    force = solve(machine, np.arange(count) * (math.tau / count), 1.0, 0.0).shaking_force[:, 0]
    harmonics = np.fft.rfft(force) * 2 / count
    same(harmonics.real[[1, 2, 4, 6]], 1.0, 0.343108577285, -0.0100990791524, 3.34432153297e-4)
    assert np.abs(harmonics.imag).max() < 1e-14
    assert np.abs(harmonics.real[[0, 3, 5, 7]]).max() < 1e-14


@both
@pytest.mark.parametrize(
    ("fraction", "greatest"),
    [(0.0, 4 / 3), (0.5, 5 / 6), (2 / 3, 0.7644043564), (0.611449341, 0.7218839918)],
)
def test_partly_balanced_engine(fraction: float, greatest: float, solve: Solver) -> None:
    """A counterweight for a part of the piston: the greatest force of a turn, k = 3."""
    machine = assur.Machine(
        assur.SliderCrank(1.0, 3.0),
        bodies={
            "piston": Body(mass=1.0),
            "crank": Body(mass=1.0, inertia=0.0, at=(-fraction, 0.0)),
        },
    )
    force = solve(machine, np.linspace(0.0, math.tau, 721), 1.0, 0.0).shaking_force
    size = np.hypot(force[:, 0], force[:, 1])
    assert abs(size.max() - greatest) <= 1e-4 * greatest  # of the grid: half a step of curvature
    rms = float(np.sqrt(np.mean(size[:-1] ** 2)))
    half = math.sqrt(0.25 + (0.343108577285**2 + 0.0100990791524**2 + 3.34432153297e-4**2) / 2)
    assert rms >= half - 1e-9
    if fraction == 0.5:
        assert abs(rms - half) <= 1e-6 * half


# -- balance of a four-bar ------------------------------------------------------------------------

LENGTHS = 0.05, 0.15, 0.12, 0.16
MASSES = {"crank": (0.5, 2e-4), "coupler": (1.2, 3e-3), "rocker": (0.8, 1.5e-3)}
CENTRES = {"crank": (0.02, 0.3), "coupler": (0.08, 0.15), "rocker": (0.06, -0.2)}
RADII = {"crank": 0.04, "rocker": 0.05}


def polar(radius: float, angle: float) -> complex:
    return complex(radius * math.cos(angle), radius * math.sin(angle))


def counterweights() -> dict[str, complex]:
    """R. S. Berkof and G. G. Lowen, J. Eng. Ind. 91 (1969) 21: mass times place in the link.

    With m3 shared between its pins the linkage is force-balanced if crank and rocker, each with
    its share, have their centres on the fixed pivots: m2 r2 + m3 l1 (1 − p) = 0 and
    m4 r4 + m3 l3 p = 0, p = (r3/l2) e^{iα3}; l1 crank, l2 coupler, l3 rocker.
    """
    l1, l2, l3, _ = LENGTHS
    share = polar(*CENTRES["coupler"]) / l2
    coupler = MASSES["coupler"][0]
    return {
        "crank": -coupler * l1 * (1 - share) - MASSES["crank"][0] * polar(*CENTRES["crank"]),
        "rocker": -coupler * l3 * share - MASSES["rocker"][0] * polar(*CENTRES["rocker"]),
    }


def four_bar(balanced: bool) -> assur.Machine:
    bodies = {}
    for link, (mass, inertia) in MASSES.items():
        centre, own, turning = polar(*CENTRES[link]), mass, inertia
        if balanced and link in RADII:
            weight = counterweights()[link]
            place = weight / abs(weight) * RADII[link]
            added = abs(weight) / RADII[link]
            own = mass + added
            middle = (mass * centre + added * place) / own
            turning += mass * abs(centre - middle) ** 2 + added * abs(place - middle) ** 2
            centre = middle
        bodies[link] = Body(mass=own, inertia=turning, at=(centre.real, centre.imag))
    return assur.Machine(assur.FourBar(*LENGTHS), bodies=bodies)


def test_counterweights() -> None:
    found = counterweights()
    for link, size, angle in (
        ("crank", 0.03795667738, 3.0934450203),
        ("rocker", 0.1229961265, -3.1258132848),
    ):
        same(abs(found[link]), size)
        same(math.atan2(found[link].imag, found[link].real), angle)


@both
def test_four_bar_balance(solve: Solver) -> None:
    """No shaking force at all; the shaking moment is the same about any point."""
    q = np.radians([40.0, 130.0])
    before = solve(four_bar(False), q, 20.0, 0.0)
    same(before.shaking_force, 44.76706932, 9.8051065, -16.85645429, 17.02057997)
    same(before.shaking_moment, -3.764080967, 1.655479811)
    after = solve(four_bar(True), q, 20.0, 0.0)
    same(after.shaking_moment, -5.49709331, 1.076717832)
    turn = np.linspace(0.0, math.tau, 37)
    unbalanced = np.abs(solve(four_bar(False), turn, 20.0, 5.0).shaking_force).max()
    balanced = np.abs(solve(four_bar(True), turn, 20.0, 5.0).shaking_force).max()
    assert balanced <= 1e-12 * unbalanced


# -- loads inside a rod ---------------------------------------------------------------------------


def bending(machine: assur.Machine, q: float, omega: float, solve: Solver) -> tuple[float, float]:
    """Greatest bending moment of the uniform rod of 1.2 kg, and its distance from A.

    Of the part beyond a cut at x: N′ = μ (a − g)·e, V′ = μ (a − g)·n, M′ = −V, at A the pin's
    force reversed; a grows linearly along the rod, so V is a parabola and M a cubic.
    """
    m = machine.mechanism
    assert m is not None
    motion = m.solve(q, order=2)
    length = 0.35
    density = 1.2 / length
    side = (motion.joint("B").value - motion.joint("A").value) / length
    normal = np.array([-side[1], side[0]])
    ends = [float(normal @ motion.joint(j).acceleration(omega)) for j in "AB"]
    force = solve(machine, q, omega, 0.0).joint("A", on="rod")
    slope = density * (ends[1] - ends[0]) / length
    shear = np.polynomial.Polynomial([-float(normal @ force), density * ends[0], slope / 2])
    moment = -shear.integ()
    assert abs(moment(length)) <= 1e-9 * abs(shear(0.0)) * length  # no moment at the other pin
    roots = np.asarray(shear.roots(), np.complex128)
    places = [float(x.real) for x in roots if abs(x.imag) < 1e-12 and 0 < x.real < length]
    return max((abs(float(moment(x))), x) for x in places)


@both
def test_bending_moment_of_a_rod(solve: Solver) -> None:
    """Of the engine's rod at ω = 300: with the crank across the rod, and over the turn."""
    bodies = {
        "rod": Body(mass=1.2, inertia=1.2 * 0.35**2 / 12, at=(0.175, 0.0)),
        "piston": Body(mass=2.0),
    }
    machine = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies=bodies)
    across = math.atan2(0.35, 0.1)
    same(math.degrees(across), 74.0546041)
    greatest, place = bending(machine, across, 300.0, solve)
    same(greatest, 243.9454044)
    same(place, 0.1482386029)
    peak, _ = bending(machine, math.radians(61.355654), 300.0, solve)
    same(peak, 253.0759225)
    beside = [bending(machine, math.radians(61.355654 + d), 300.0, solve)[0] for d in (-0.01, 0.01)]
    assert max(beside) < peak
    classical = 1.2 * 300.0**2 * 0.1 * 0.35 / (9 * math.sqrt(3.0))  # leaves out the piston's
    same(classical, 242.4871131)
