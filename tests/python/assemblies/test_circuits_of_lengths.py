"""Circuits where a slide's value is a length, which ends at 0: against arcs in closed form."""

from __future__ import annotations

import cmath
import math
import random
from itertools import pairwise

import numpy as np
import pytest

import assur

# Ends of arcs are dead points, promised to this.
DEAD_POINT = 1e-9
Arc = tuple[int, float, float]


def slider_crank(
    crank: complex, pin: complex, angle: float, length: bool, driver: str = "crank"
) -> assur.Mechanism:
    """A crank at the origin, and a block whose value is measured from there."""
    return assur.Mechanism(
        {"O": (0, 0), "A": (crank.real, crank.imag), "B": (pin.real, pin.imag)},
        {"ground": ["O"], "crank": ["O", "A"], "coupler": ["A", "B"], "piston": ["B"]},
        driver,
        slides={"way": assur.Slide("piston", "ground", angle=angle, origin="O", length=length)},
    )


def arcs(radius: float, rod: float, offset: float, length: bool) -> list[Arc]:
    """Crank angles from the guide over which the block is there, on either side of the pin's foot.

    The square root vanishes where the pin is a rod's length from the guide, the value where the pin
    is that far from the point of the guide at which it is measured.
    """
    ends = [
        side
        for sine in ((offset + rod) / radius, (offset - rod) / radius)
        if abs(sine) < 1.0
        for side in (math.asin(sine), math.pi - math.asin(sine))
    ]
    cosine = (radius**2 + offset**2 - rod**2) / (2.0 * radius * abs(offset)) if offset else 2.0
    if length and abs(cosine) < 1.0:
        middle = math.copysign(math.pi / 2.0, offset)
        ends += [middle + side * math.acos(cosine) for side in (-1, 1)]
    ends = sorted(end % math.tau for end in ends) or [0.0]
    found = []
    for sign in (1, -1):
        own: list[list[float]] = []
        for low, high in pairwise([*ends, ends[0] + math.tau]):
            middle = 0.5 * (low + high)
            square = rod**2 - (radius * math.sin(middle) - offset) ** 2
            if square <= 0.0:
                continue
            value = radius * math.cos(middle) + sign * math.sqrt(square)
            if length and value < 0.0:
                continue
            if own and own[-1][1] == low:
                own[-1][1] = high
            else:
                own.append([low, high])
        if len(own) > 1 and own[-1][1] == own[0][0] + math.tau:
            own[0][0] = own.pop()[0] - math.tau
        found += [(sign, low, high) for low, high in own]
    return found


def circuits(found: list[Arc], radius: float, rod: float, offset: float) -> int:
    """Arcs of either side that meet where the square root vanishes are one."""
    homes = list(range(len(found)))
    for i, (sign, *one) in enumerate(found):
        for j, (other_sign, *other) in enumerate(found):
            for own in one if sign > other_sign else ():
                near = min(abs(cmath.exp(1j * own) - cmath.exp(1j * end)) for end in other)
                if near < DEAD_POINT and abs(radius * math.sin(own) - offset) > 0.999 * rod:
                    homes = [homes[i] if home == homes[j] else home for home in homes]
    return len(set(homes))


def drawn(seed: int) -> tuple[complex, complex, float, tuple[float, float, float]]:
    """A crank, a pin at a value above 0, the guide's angle; radius, rod and offset."""
    rng = random.Random(seed)
    while True:
        angle, turned = rng.uniform(-math.pi, math.pi), rng.uniform(-math.pi, math.pi)
        radius, rod, offset = rng.uniform(0.3, 2), rng.uniform(0.3, 2), rng.uniform(-1.5, 1.5)
        square = rod**2 - (radius * math.sin(turned) - offset) ** 2
        if square < 0.02:
            continue
        value = radius * math.cos(turned) + rng.choice((1, -1)) * math.sqrt(square)
        if value > 0.05:
            way = cmath.exp(1j * angle)
            return (
                radius * cmath.exp(1j * turned) * way,
                (value + 1j * offset) * way,
                angle,
                (
                    radius,
                    rod,
                    offset,
                ),
            )


@pytest.mark.parametrize("length", [True, False])
def test_one_circuit_of_a_slider_crank_that_a_length_ends(length: bool) -> None:
    """With a length it is open at both ends, the fold between them; without, closed."""
    mechanism = slider_crank(1.0 + 0.1j, 1.8 + 0.3j, 0.0, length)
    curve = mechanism.configuration_curve()
    assert (len(curve.branches), len(curve.circuits)) == (2, 1)
    (circuit,) = curve.circuits
    assert circuit.is_closed is not length
    assert len(curve.folds) == (1 if length else 2)
    motion = curve.motion()
    assert np.hypot(*np.diff(motion.joints["B"], axis=0).T).max() < 0.1
    if length:
        assert motion.slides["way"][[0, -1]] == pytest.approx(0.0, abs=1e-6)
        assert motion.slides["way"].min() > -1e-9


@pytest.mark.parametrize("length", [True, False])
def test_positions_on_either_side_of_the_fold_are_on_one_circuit(length: bool) -> None:
    mechanism = slider_crank(1.0 + 0.1j, 1.8 + 0.3j, 0.0, length)
    one, other = mechanism.assemblies(0.5)
    places = [(0.5, one), (0.5, other), (0.2, other)]
    found = mechanism.configuration_curve().defects(places)
    # Round a closed circuit any three positions are in order, one way or the other.
    assert (found.circuit, found.branch, found.order) == (False, True, length)
    joints = {"B": [dict(each.joints or {})["B"] for each in (one, other)]}
    assert mechanism.defects([0.5, 0.5], joints) == assur.Defect.BRANCH


@pytest.mark.parametrize("length", [True, False])
@pytest.mark.parametrize("seed", range(25))
def test_circuits_of_slider_cranks(seed: int, length: bool) -> None:
    crank, pin, angle, sizes = drawn(seed)
    expected = arcs(*sizes, length)
    curve = slider_crank(crank, pin, angle, length).configuration_curve()
    assert len(curve.branches) == len(expected)
    assert len(curve.circuits) == circuits(expected, *sizes)
    # Whatever drives it.
    driven = slider_crank(crank, pin, angle, length, "way").configuration_curve()
    assert len(driven.circuits) == len(curve.circuits)


@pytest.mark.parametrize("least", [0.3, 0.02, 0.002, 2e-4, 2e-5, 2e-6])
def test_a_driven_cylinder_that_nearly_reaches_length_0(least: float) -> None:
    """Near its foot the eye turns the cylinder fast; both folds are those of one oval."""
    mechanism = assur.Mechanism(
        {"foot": (0, 0), "eye": (0.6, 0.8), "base": (1.0 + least, 0)},
        {"ground": ["foot", "base"], "boom": ["foot", "eye"]},
        "lift",
        slides={"lift": assur.Cylinder("base", "eye")},
    )
    curve = mechanism.configuration_curve()
    assert len(curve.branches) == 2
    assert sorted(fold.q for fold in curve.folds) == pytest.approx([least, 2.0 + least])
    (circuit,) = curve.circuits
    assert circuit.is_closed
