"""Imported linkages against formulas."""

from __future__ import annotations

import numpy as np

from assur import importers
from importers.foreign import PMKS, PMKS_PLUS
from importers.foreign_more import LINKAGE, PYLINKAGE, PYSLVS

TURN = np.linspace(0.0, 2.0 * np.pi, 97)


def rocker_joint(crank: np.ndarray, side: float) -> np.ndarray:
    """Freudenstein's four-bar: crank 1 at (0, 0), coupler and rocker as drawn, frame 4."""
    pin = np.exp(1j * crank)
    coupler, rocker = abs(3.0 + 1.5j), abs(-1.0 + 2.5j)
    diagonal = 4.0 - pin
    d = abs(diagonal)
    cosine = (coupler**2 + d**2 - rocker**2) / (2.0 * coupler * d)
    return pin + coupler * diagonal / d * (cosine + side * 1j * np.sqrt(1.0 - cosine**2))


def test_the_same_four_bar_of_four_programs() -> None:
    """Each has pins at (0, 0), (0, 1), (3, 2.5), (4, 0); a coupler point in three of them."""
    wanted = rocker_joint(TURN, +1.0)
    pin = np.exp(1j * TURN)
    along = (wanted - pin) / abs(3.0 + 1.5j)
    drawn = (3.0 + 1.5j) / abs(3.0 + 1.5j)
    angle = np.exp(0.7j)
    cases = (
        (PMKS["four-bar, commas, tracer, rpm"], "J3", "J5", (1.5 + 3j - 1j) / drawn),
        (PYLINKAGE["four-bar, tracker, steps"], "B", "T", 2.0 * angle),
        (PYSLVS["four-bar, comments"], "P2", "P4", (-1.5 + 3j - 1j) / drawn),
        (LINKAGE["four-bar, names, a label, a frame"], "c2", None, 0.0),
    )
    for case, joint, tracer, local in cases:
        mechanism = importers.read(case.text, drivers=case.drivers, scale=1.0).mechanism
        motion = mechanism.solve(TURN, order=0)
        found = motion.joint(joint).value @ np.array([1, 1j])
        assert np.allclose(found, wanted, rtol=0, atol=2e-13)
        if tracer is not None:
            point = motion.joint(tracer).value @ np.array([1, 1j])
            assert np.allclose(point, pin + local * along, rtol=0, atol=2e-13)


def test_slider_crank() -> None:
    """Crank 1, guide through (3, 0.25) at 5°, as PMKS and as PMKS+ have it."""
    case = PMKS["slider-crank, joints at one place"]
    pin = np.exp(1j * TURN)
    guide, foot = np.exp(1j * np.radians(5)), 3.0 + 0.25j
    along, across = ((pin - foot) / guide).real, ((pin - foot) / guide).imag
    rod = abs(3.0 + 0.25j - 1j)
    wanted = foot + guide * (along + np.sqrt(rod**2 - across**2))
    motion = importers.read(case.text).mechanism.solve(TURN, order=0)
    assert np.allclose(motion.joint("J3").value @ np.array([1, 1j]), wanted, rtol=0, atol=2e-13)


def test_yoke_is_a_cosine() -> None:
    motion = importers.read(PMKS["yoke"].text).mechanism.solve(TURN, order=1)
    yoke = motion.joint("J3")
    assert np.allclose(yoke.value[:, 0], np.sqrt(2) * np.cos(TURN), rtol=0, atol=1e-14)
    assert np.allclose(yoke.d1[:, 0], -np.sqrt(2) * np.sin(TURN), rtol=0, atol=1e-14)
    assert np.allclose(yoke.value[:, 1], 3.0, rtol=0, atol=1e-14)


def test_cylinder_by_the_law_of_cosines() -> None:
    """The actuator of Linkage: its length is q."""
    case = LINKAGE["actuator, fastened links"]
    mechanism = importers.read(case.text, scale=1.0).mechanism
    q = np.linspace(1.5, 3.0, 40)
    pin = mechanism.solve(q, order=0).joint("c1").value @ np.array([1, 1j])
    base, arm = 1.0 - 1j, np.sqrt(5.0)
    angle = np.arccos((arm**2 + abs(base) ** 2 - q**2) / (2.0 * arm * abs(base)))
    assert np.allclose(pin, arm * base / abs(base) * np.exp(1j * angle), rtol=0, atol=2e-13)


def test_numbers_of_pmks_plus() -> None:
    """Each joint is at its thousandths; the slider's direction is in rad."""
    case = PMKS_PLUS["slider-crank, block, as it was copied"]
    mechanism = importers.read(case.text).mechanism
    assert mechanism.joints["C"] == (3.006, 2.0)
    assert mechanism.slides["C_slide"].angle == -0.032
