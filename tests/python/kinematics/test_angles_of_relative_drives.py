"""Both links of a relative drive move across a gap: which steps least depends on no order."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import assur
from oracles.kinematics import gap_steps

LINKS = {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"}
PAIRS = [
    ("coupler", "crank"),
    ("rocker", "coupler"),
    ("crank", "rocker"),
    ("crank", "coupler"),
    ("rocker", "crank"),
]


def drawn(rng: np.random.Generator, names: str) -> dict[str, tuple[float, float]]:
    """Joints anywhere."""
    return {name: (float(x), float(y)) for name, (x, y) in zip(
        names, rng.uniform(-2.0, 2.0, (len(names), 2)), strict=True)}  # fmt: skip


@pytest.mark.parametrize("pair", PAIRS, ids="-".join)
def test_four_bars_with_a_relative_drive(pair: tuple[str, str]) -> None:
    rng = np.random.default_rng(7)
    driver = assur.Drive(pair[0], relative_to=pair[1])
    across = 0
    for _ in range(15):
        joints = drawn(rng, "ABCD")
        known: list[gap_steps.Array] = []
        for order in list(itertools.permutations(LINKS))[::5]:
            m = assur.Mechanism(joints, {name: LINKS[name] for name in order}, driver)
            q = m.q0 + np.linspace(-8.0, 8.0, 401)
            motion = m.solve(q, order=0, on_error="nan")
            known.append(np.stack([motion.link(name).value for name in LINKS]))
            np.testing.assert_allclose(known[-1], known[0], rtol=0.0, atol=1e-7)
        base = list(m.links).index(pair[1])
        for gap in gap_steps.gaps(m, m.q0 + np.linspace(0.0, 2.0 * np.pi, 2001)):
            across += 1
            assert gap_steps.is_nearest(gap.steps)[base]
    assert across > 2


def test_two_drivers_one_on_the_other() -> None:
    """The whole chain hangs on the link that no driver turns."""
    rng = np.random.default_rng(3)
    links = {"ground": "AE", "one": "AB", "two": "BC", "three": "CD", "four": "ED"}
    drivers = [assur.Drive("two", relative_to="three"), assur.Drive("three", relative_to="four")]
    stepped = 0
    for _ in range(8):
        joints = drawn(rng, "ABCDE")
        known: list[gap_steps.Array] = []
        for order in (list(links), list(links)[::-1], ["two", "four", "ground", "three", "one"]):
            m = assur.Mechanism(joints, {name: links[name] for name in order}, drivers)
            way = np.linspace(-7.0, 7.0, 141)[:, np.newaxis]
            motion = m.solve(m.q0 + way * np.array([1.0, 0.6]), order=0, on_error="nan")
            known.append(np.stack([motion.link(name).value for name in links]))
            np.testing.assert_allclose(known[-1], known[0], rtol=0.0, atol=1e-7)
        stepped += int(np.isnan(known[0]).any())
    assert stepped > 3
