"""Whole turns of angles of two drivers: along the straight path, against dense samples of it.

The oracle intersects two circles at 20 001 positions of a path; where they do not meet, the angle
takes the shorter way from one end of the gap to the other.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

import assur

Complex = npt.NDArray[np.complex128]
Float = npt.NDArray[np.float64]

SAMPLES = 20_001
FIVE_BAR = {"ground": "AE", "first": "AB", "left": "BC", "right": "DC", "second": "ED"}
# The second link hangs on the first one; E is fixed.
ARM = {"ground": "AE", "first": "AB", "second": "BD", "left": "DC", "right": "EC"}


def at(length: float, angle: Float) -> Complex:
    turned: Complex = length * np.exp(1j * angle)
    return turned


def drawn(rng: np.random.Generator, links: dict[str, str]) -> assur.Mechanism:
    """Joints anywhere: most cannot turn fully."""
    joints = {name: (float(x), float(y)) for name, (x, y) in zip(
        "ABCDE", rng.uniform(-1.0, 1.0, (5, 2)), strict=True)}  # fmt: skip
    return assur.Mechanism(joints, links, driver=["first", "second"])


def ends(m: assur.Mechanism, q: Float) -> tuple[Complex, Complex]:
    """The outer joints of left and right."""
    joint = {name: complex(x, y) for name, (x, y) in m.joints.items()}
    first, second = (
        at(abs(joint[tip] - joint[root]), q[..., driver])
        for driver, (root, tip) in enumerate(m.links[name] for name in ("first", "second"))
    )
    if m.links["second"][0] == "B":
        return joint["A"] + first + second, np.broadcast_to(joint["E"], first.shape)
    return joint["A"] + first, joint["E"] + second


def sampled(m: assur.Mechanism, q: Float) -> tuple[Float, bool] | None:
    """Angles of left and right at the end of a path, and whether it crosses gaps.

    None if both ways across one are about as short.
    """
    joint = {name: complex(x, y) for name, (x, y) in m.joints.items()}
    path = m.q0 + np.linspace(0.0, 1.0, SAMPLES)[:, np.newaxis] * (q - m.q0)
    start, end = ends(m, path)
    links = ("left", "right")
    a, b = (abs(joint["C"] - joint[m.links[name][0]]) for name in links)
    chord = end - start
    length = np.abs(chord)
    closed = (abs(a - b) < length) & (length < a + b)
    if not (closed[0] and closed[-1]):
        return None
    side = np.sign(((joint["C"] - start[0]) / chord[0]).imag)
    start, chord, length = start[closed], chord[closed], length[closed]
    inner = np.arccos((length**2 + a**2 - b**2) / (2 * a * length))
    left = at(a, np.angle(chord) + side * inner)
    angles = np.angle(np.array([left, left - chord]))
    steps = np.diff(angles)
    steps -= 2 * np.pi * np.round(steps / (2 * np.pi))
    is_jump = np.diff(np.flatnonzero(closed)) > 1
    if (np.abs(steps) > np.where(is_jump, np.pi - 0.4, 0.5)).any():
        return None
    drawn = [m.solve(m.q0, order=0).link(name).value for name in links]
    return np.array(drawn) + steps.sum(axis=1), bool(is_jump.any())


@pytest.mark.parametrize("links", [FIVE_BAR, ARM], ids=["five-bar", "arm"])
def test_angles_follow_the_straight_path(links: dict[str, str]) -> None:
    rng = np.random.default_rng(11)
    compared = crossed = turned = 0
    for _ in range(30):
        m = drawn(rng, links)
        q = m.q0 + rng.uniform(-7.0, 7.0, (12, 2))
        motion = m.solve(q, order=0, on_error="nan")
        found = np.stack([motion.link(name).value for name in ("left", "right")], axis=-1)
        for row in np.flatnonzero(motion.status == assur.Status.OK):
            expected = sampled(m, q[row])
            if expected is None:
                continue
            np.testing.assert_allclose(found[row], expected[0], rtol=0.0, atol=1e-9)
            compared += 1
            crossed += expected[1]
            turned += bool((np.abs(expected[0]) > np.pi).any())
    assert compared > 100
    assert crossed > 20
    assert turned > 20


@pytest.mark.parametrize("links", [FIVE_BAR, ARM], ids=["five-bar", "arm"])
def test_angles_do_not_depend_on_other_positions(links: dict[str, str]) -> None:
    rng = np.random.default_rng(5)
    m = drawn(rng, links)
    q = m.q0 + rng.uniform(-9.0, 9.0, (300, 2))
    together = m.solve(q, on_error="nan")
    for row in range(0, 300, 7):
        alone = m.solve(q[row], on_error="nan")
        for name in links:
            own, shared = alone.link(name), together.link(name)
            assert np.asarray(own.value).tobytes() == shared.value[row].tobytes()
            assert np.asarray(own.d2).tobytes() == shared.d2[row].tobytes()
