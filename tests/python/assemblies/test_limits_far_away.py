"""Limits of driven slides that nearly parallel guides carry away, beyond gaps of later dyads."""

from __future__ import annotations

import itertools
import math
import random
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq

import assur
from models.mechanisms import mixed_models
from models.mechanisms.mechanism_data import arguments

if TYPE_CHECKING:
    from collections.abc import Callable

Array: TypeAlias = NDArray[np.float64]

LINKS = {"ground": "OG", "carriage": "AP", "rod": "AB", "block": "B", "front": "BC", "rear": "PC"}
SAMPLES = 40_001
# Of the distance from the drawing.
RTOL = 1e-9


def drawn(seed: int) -> tuple[dict[str, complex], float]:
    """Joints, and the small angle between the guides."""
    rng = random.Random(seed)

    def place(size: float) -> complex:
        return complex(rng.uniform(-size, size), rng.uniform(-size, size))

    angle = 10.0 ** rng.uniform(-2.0, -0.7) * rng.choice([-1, 1])
    joints = {"O": 0j, "G": place(1.0), "A": complex(rng.uniform(-1.0, 1.0), 0.0)}
    joints |= {"P": joints["A"] + place(0.5)}
    joints |= {"B": joints["G"] + rng.uniform(-2.0, 2.0) * np.exp(1j * angle)}
    # Nearly straight at the drawing: gaps are near.
    straight = joints["B"] + rng.uniform(0.1, 0.9) * (joints["P"] - joints["B"])
    return {**joints, "C": straight + place(0.2)}, angle


def mechanism(joints: dict[str, complex], angle: float, order: tuple[str, ...]) -> assur.Mechanism:
    slides = {
        "drive": assur.Slide("carriage", on="ground", angle=0.0, origin="O"),
        "bore": assur.Slide("block", on="ground", angle=angle, origin="G"),
    }
    places = {name: (joints[name].real, joints[name].imag) for name in order}
    links = {name: LINKS[name] for name in (*order_of_links(order), "block")}
    return assur.Mechanism(places, links, "drive", slides=slides)


def order_of_links(order: tuple[str, ...]) -> list[str]:
    """Some order of the links for each order of the joints."""
    names = [name for name in LINKS if name != "block"]
    return sorted(names, key=lambda name: [order.index(joint) for joint in LINKS[name]])


def closing(joints: dict[str, complex], angle: float) -> list[list[float]]:
    """Where the rod reaches the guide and the two links meet: intervals of the carriage's way."""
    a, p, b, c, g = (joints[name] for name in "APBCG")
    along = np.exp(1j * angle)
    rod, front, rear = abs(b - a), abs(c - b), abs(c - p)
    # In the frame of the second guide the rod's foot and its reach along the guide.
    sign = math.copysign(1.0, ((b - a) / along).real)

    def height(x: float) -> float:
        return float(((a + x - g) / along).imag)

    def apart(x: float) -> float:
        """Square of the distance of B from P."""
        h = height(x)
        pin = (a + x - g) / along + sign * math.sqrt(max(rod**2 - h**2, 0.0)) - 1j * h
        return float(abs(g + pin * along - (p + x)) ** 2)

    inner: list[Callable[[float], float]] = [
        lambda x: apart(x) - (front - rear) ** 2,
        lambda x: (front + rear) ** 2 - apart(x),
    ]
    ends = sorted(((h - ((a - g) / along).imag) / -math.sin(angle)) for h in (-rod, rod))
    x = 0.5 * (ends[0] + ends[1]) - 0.5 * (ends[1] - ends[0]) * np.cos(
        np.linspace(0.0, math.pi, SAMPLES)
    )
    closes = np.array([all(f(one) >= 0.0 for f in inner) for one in x])
    edges = np.flatnonzero(np.diff(closes.astype(int)))
    places = []
    for edge in edges:
        pair = (x[edge], x[edge + 1])
        (crossed,) = (f for f in inner if f(pair[0]) * f(pair[1]) < 0.0)
        places.append(float(brentq(crossed, *pair, xtol=1e-14, rtol=1e-15)))
    places = [*ends[: int(closes[0])], *places, *ends[2 - int(closes[-1]) :]]
    return [list(pair) for pair in zip(places[::2], places[1::2], strict=True)]


# In the last ten the search ended in a gap of the two links.
@pytest.mark.parametrize("seed", [*range(8), 32, 57, 97, 126, 137, 252, 274, 331, 350, 370])
def test_nothing_behind_a_gap_is_missed(seed: int) -> None:
    joints, angle = drawn(seed)
    wanted = closing(joints, angle)
    orders = list(itertools.permutations(joints))[seed % 97 :: 239]
    for order in orders:
        m = mechanism(joints, angle, order)
        found = m.limits().intervals - float(m.q0)
        assert len(found) == len(wanted), (order, found, wanted)
        np.testing.assert_allclose(found, wanted, rtol=RTOL, atol=RTOL)


def test_a_group_is_followed_as_far_as_its_slide_goes() -> None:
    """A driven slide carries a class IV group along for ever; beyond all lengths it was lost."""
    m = assur.Mechanism(**arguments(mixed_models.mixed_case(15366).description))
    assert m.limits().intervals.tolist() == [[-math.inf, math.inf]]
    far = np.array([1e3, 1e4, 1e6, 1e8])
    for way in (-1.0, 1.0):
        moved = m.solve(way * far, order=1)
        assert (np.asarray(moved.status) == 0).all()
        # The links come to rest as the inverse square of the distance.
        rates = moved.link("L4").d1 * far**2
        np.testing.assert_allclose(rates, rates[-1], rtol=2e-4)
    found, at_rest = m.extremes("L4"), m.solve([-1e10, 1e10], order=0).link("L4").value
    ends = sorted([(at_rest[0], -math.inf), (at_rest[1], math.inf)])
    for one, (value, q) in zip((found.min, found.max), ends, strict=True):
        assert one.value == pytest.approx(value, abs=1e-8)
        assert one.q == q
