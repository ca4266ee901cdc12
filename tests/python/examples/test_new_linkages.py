"""Examples outside the net: coupling, locomotive, six-bars, several drivers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt
import pytest

from assur import examples
from oracles.kinematics.example_checks import EXACT, STRAIGHT, TURN, distance, over_range

if TYPE_CHECKING:
    import assur

Float: TypeAlias = npt.NDArray[np.float64]

CROSSED = 1e-7  # near a change point analogues lose half of the digits


def test_oldham() -> None:
    """Equal angles; the disc's centre on the circle over both shafts, twice round in a turn."""
    apart = 0.02
    q = np.linspace(0.0, 2 * math.tau, 721)
    motion = examples.oldham().solve(q, order=2)
    first, second = motion.link("shaft1"), motion.link("shaft2")
    assert second.value - first.value == pytest.approx(second.value[0] - first.value[0], abs=EXACT)
    assert np.max(np.abs(second.d1 - 1.0)) <= EXACT
    assert np.max(np.abs(second.d2)) <= EXACT
    # The centre from both grooves: s cos q along the first, the rest along the second.
    one, other = motion.slide("tongue1").value, motion.slide("tongue2").value
    assert np.max(np.abs(one - apart * np.cos(q))) <= EXACT * apart
    assert np.max(np.abs(other - apart * np.sin(q))) <= EXACT * apart
    centre = np.stack([one * np.cos(q), one * np.sin(q)], axis=-1) - [apart / 2, 0.0]
    round_ = np.unwrap(np.arctan2(*centre.T[::-1]))
    assert np.hypot(*centre.T) == pytest.approx(apart / 2, abs=EXACT)
    assert round_[-1] - round_[0] == pytest.approx(2 * (q[-1] - q[0]), abs=1e-12)


def test_locomotive() -> None:
    """All wheels turn alike, also through the change points; the rod only translates."""
    m = examples.locomotive()
    assert m.structure.mobility_counted == 0
    q = np.linspace(-2 * math.tau, 2 * math.tau, 1441)
    motion = m.solve(q, order=1)
    crank = 0.33 * np.stack([np.cos(q), np.sin(q)], axis=-1)
    for i, pin in enumerate(("A1", "A2", "A3")):
        assert np.max(np.abs(motion.joint(pin).value - crank - [2.2 * i, 0.0])) <= STRAIGHT * 5
    assert np.max(np.abs(motion.link("coupling_rod").value)) <= STRAIGHT
    for wheel in ("wheel1", "wheel3"):
        assert np.max(np.abs(motion.link(wheel).d1 - 1.0)) <= CROSSED
    stroke = m.extremes("guide").stroke
    assert stroke == pytest.approx(0.66, abs=STRAIGHT)
    assert np.max(motion.residual) <= STRAIGHT
    # Without the third wheel it is an ordinary four-bar, and moves the same.
    links = {n: on for n, on in m.links.items() if n != "wheel3"}
    links["ground"] = ("O1", "O2")
    joints = {n: place for n, place in m.joints.items() if n != "O3"}
    two = type(m)(joints, links, m.driver, slides=m.slides)
    assert two.structure.redundant == ()
    np.testing.assert_array_equal(two.solve(q).slide("guide").value, motion.slide("guide").value)


def corner(a: Float, from_a: float, b: Float, from_b: float, side: int) -> Float:
    """Where two circles meet, left (+1) or right (−1) of a → b; complex numbers."""
    s = np.abs(b - a)
    angle = np.arccos((s * s + from_a**2 - from_b**2) / (2 * s * from_a))
    found: Float = a + from_a * (b - a) / s * np.exp(1j * side * angle)
    return found


def at(motion: assur.Motion, joint: str) -> Float:
    found: Float = motion.joint(joint).value @ np.array([1.0, 1j])
    return found


def carried(a: Float, b: Float, drawn: list[complex]) -> Float:
    """A further joint of a link drawn with `drawn` = a, b and it."""
    found: Float = a + (drawn[2] - drawn[0]) / (drawn[1] - drawn[0]) * (b - a)
    return found


@pytest.mark.parametrize("name", ["watt_2", "stephenson_1"])
def test_six_bars(name: str) -> None:
    """Both dyads by the law of cosines."""
    m = examples.ALL[name]()
    assert not hasattr(m, "mechanism")
    drawn = {n: complex(*place) for n, place in m.joints.items()}
    motion = m.solve(TURN, order=0)
    b = 0.04 * np.exp(1j * TURN)
    c = corner(b, 0.12, np.full_like(b, 0.1), 0.08, +1)
    far = carried(
        np.full_like(b, 0.1), c, [drawn[n] for n in "DC" + ("E" if name == "watt_2" else "F")]
    )
    if name == "watt_2":
        root = math.sqrt(0.02**2 + 0.06**2)
        want = {"C": c, "E": far, "F": corner(far, root, np.full_like(b, 0.24), root, +1)}
    else:
        pin = carried(np.zeros_like(b), b, [drawn[n] for n in "ABE"])
        lengths = abs(drawn["S"] - drawn["E"]), abs(drawn["S"] - drawn["F"])
        want = {"C": c, "E": pin, "F": far, "S": corner(pin, lengths[0], far, lengths[1], +1)}
    for joint, place in want.items():
        assert np.max(np.abs(at(motion, joint) - place)) <= 10 * EXACT, joint


def test_stephenson_2() -> None:
    """Class IV by a one-dimensional search: the plate's angle at which the last bar fits."""
    m = examples.stephenson_2()
    drawn = {n: complex(*place) for n, place in m.joints.items()}
    motion = m.solve(TURN[::30], order=0)
    length = {pair: abs(drawn[pair[0]] - drawn[pair[1]]) for pair in ("CE", "DE", "FG")}

    def others(b: complex, turned: complex) -> tuple[complex, ...]:
        """C, F, E and G where the plate has turned: E on two circles, G with the rocker."""
        c, f = (b + turned * (drawn[n] - drawn["B"]) for n in "CF")
        c_, d = np.array([c]), np.array([drawn["D"]])
        side = (
            1 if np.imag((drawn["E"] - drawn["C"]) * np.conj(drawn["D"] - drawn["C"])) > 0 else -1
        )
        e = complex(corner(c_, length["CE"], d, length["DE"], side)[0])
        return c, f, e, complex(carried(d, np.array([e]), [drawn[n] for n in "DEG"])[0])

    for i, q in enumerate(motion.q):
        b = complex(0.04 * np.exp(1j * q))
        found = {n: complex(at(motion, n)[i]) for n in "CFEG"}
        angle = np.angle((found["C"] - b) / (drawn["C"] - drawn["B"]))

        def misfit(by: float, b: complex = b) -> float:
            _, f, _, g = others(b, complex(np.exp(1j * by)))
            return abs(g - f) - length["FG"]

        low, high = angle - 0.01, angle + 0.01
        assert misfit(low) * misfit(high) < 0.0
        for _ in range(60):  # bisection to the last bit
            middle = (low + high) / 2
            low, high = (middle, high) if misfit(low) * misfit(middle) > 0.0 else (low, middle)
        for n, place in zip("CFEG", others(b, complex(np.exp(1j * low))), strict=True):
            assert abs(found[n] - place) <= 10 * EXACT, n


def test_pantograph() -> None:
    """The pen is three times as far from the pole, everywhere and in all derivatives."""
    m = examples.pantograph()
    q = over_range("pantograph", 61)
    motion = m.solve(q, order=2)
    pen, tracer = motion.joint("P"), motion.joint("T")
    assert np.max(np.abs(tracer.value - q)) <= EXACT
    assert np.max(np.abs(pen.value - 3.0 * q)) <= STRAIGHT
    assert np.max(np.abs(pen.d1 - 3.0 * np.eye(2))) <= STRAIGHT
    assert np.max(np.abs(pen.d2)) <= 100 * STRAIGHT  # of 1/0.15 m, squared condition
    # A circle of the tracer becomes a circle of the pen.
    circle = np.array([0.16, 0.0]) + 0.05 * np.stack([np.cos(TURN), np.sin(TURN)], axis=-1)
    drawn = m.solve(circle, order=0).joint("P").value - [0.48, 0.0]
    assert np.hypot(*drawn.T) == pytest.approx(0.15, abs=STRAIGHT)


def test_five_bar() -> None:
    """The point where two circles meet, ahead of the cranks; held nowhere less in the range."""
    q = over_range("five_bar", 61)
    motion = examples.five_bar().solve(q, order=1)
    b, d = 0.25 * np.exp(1j * q[:, 0]), 0.22 + 0.25 * np.exp(1j * q[:, 1])
    assert np.max(np.abs(at(motion, "P") - corner(b, 0.3, d, 0.3, +1))) <= EXACT
    # Both drivers alike, mirrored: P stays in the middle.
    even = examples.five_bar().solve(np.stack([math.pi - q[:61, 1], q[:61, 1]], axis=-1))
    assert np.max(np.abs(even.joint("P").value[:, 0] - 0.11)) <= EXACT


def test_platforms() -> None:
    """Legs as long as q; cranks at the angles q; up to six ways to put both together."""
    legs, cranks = examples.platform_on_cylinders(), examples.platform_on_cranks()
    q = over_range("platform_on_cylinders", 31)
    motion = legs.solve(q, order=0)
    for i, ends in enumerate(("AD", "BE", "CF")):
        assert np.max(np.abs(distance(motion, *ends) - q[:, i])) <= STRAIGHT
    turned = over_range("platform_on_cranks", 31)
    motion = cranks.solve(turned, order=0)
    for i, (pivot, pin) in enumerate([("A", "a"), ("B", "b"), ("C", "c")]):
        arm = at(motion, pin) - complex(*cranks.joints[pivot])
        reach = math.dist(cranks.joints[pivot], cranks.joints[pin])
        assert np.max(np.abs(arm - reach * np.exp(1j * turned[:, i]))) <= STRAIGHT
    for m in (legs, cranks):
        found = m.assemblies(m.q0)
        assert found.complex_count == (6,)  # Gosselin and Sefrioui (1991)
        assert len(found) in (2, 4, 6)
