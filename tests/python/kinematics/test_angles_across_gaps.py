"""Angles of designs that do not turn fully, against a dense sample without knots."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

import assur
from models.mechanisms import named_drawings
from net import bits, design_spaces
from support.samples import sample

# Positions of a turn: an island of a hundredth of a degree shows.
SAMPLES = 36_001


def followed(angles: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """The angles, each continued from the one before by less than half a turn.

    About half a turn, which is the case where a joint went through infinity, counts as more.
    """
    steps = np.diff(angles)
    turns = np.floor(0.5 - 1 / 1024 - steps / (2 * np.pi))
    whole: npt.NDArray[np.float64] = np.cumsum(steps + 2 * np.pi * turns)
    return np.append(angles[0], angles[0] + whole)


def designs(name: str) -> assur.Mechanism:
    kind, seed = name.split()
    if kind == "crank":
        return design_spaces.crank_space(int(seed))
    m = bits.random(int(seed)) if kind == "seed" else named_drawings.CLASS_II[kind]()
    return design_spaces.space(m, np.random.default_rng(int(seed)))


# The random ones have islands of a seventieth of a cell between the tracer's knots.
@pytest.mark.parametrize(
    "name",
    [
        "crank_rocker 0",
        "watt_six_bar 3",
        "jansen_leg 4",
        "klann_leg 2",
        "seed 28",
        "seed 29",
        "crank 0",
        "crank 1",
        "crank 2",
        "crank 3",
    ],
)
def test_angles_continue_across_gaps(name: str) -> None:
    batch = designs(name)
    q = batch.q0 + np.linspace(0.0, 2 * np.pi, SAMPLES)
    motion = batch.solve(q, order=0, on_error="nan")
    reached = motion.status <= assur.Status.NEAR_SINGULAR
    assert not reached.all()
    for link in batch.links:
        angles = motion.link(link).value
        for design in np.flatnonzero(reached.sum(axis=1) > 1):
            own, at = angles[design][reached[design]], q[reached[design]]
            if np.ptp(own - at) < 1e-9:
                continue  # it turns with the driver, in a gap too
            np.testing.assert_allclose(own, followed(own), rtol=0, atol=1e-6, err_msg=f"{design}")


@pytest.mark.parametrize(
    "name", ["crank_rocker 1", "jansen_leg 2", "seed 96", "crank 4", "crank 5"]
)
def test_angles_continue_into_the_next_turn(name: str) -> None:
    batch = designs(name)
    q = batch.q0 + np.linspace(-2 * np.pi, 2 * np.pi, 2 * SAMPLES - 1)
    motion = batch.solve(q, order=0, on_error="nan")
    reached = motion.status <= assur.Status.NEAR_SINGULAR
    compared = 0
    for link in batch.links:
        angles = motion.link(link).value
        for design in np.flatnonzero(reached.sum(axis=1) > 1):
            own, at = angles[design][reached[design]], q[reached[design]]
            steps = np.abs(np.diff(own)) % (2 * np.pi)
            if np.ptp(own - at) < 1e-9 or (np.abs(steps - np.pi) < 0.1).any():
                continue  # half a turn is as near in either direction
            np.testing.assert_allclose(own, followed(own), rtol=0, atol=1e-6, err_msg=f"{design}")
            compared += 1
    assert compared > len(batch.links)


def test_angles_of_driven_slides_continue_from_the_drawing() -> None:
    """Down and up, beyond gaps too: a cylinder passes length 0, a rod reaches the other side."""
    behind_gaps = 0
    for seed in range(sample(16, 40)):
        batch = design_spaces.slide_space(seed)
        assert isinstance(batch.q0, float)
        for end in (-3.0, 3.0):
            q = batch.q0 + np.linspace(0.0, end, SAMPLES)
            motion = batch.solve(q, order=0, on_error="nan")
            reached = motion.status <= assur.Status.NEAR_SINGULAR
            few = batch.solve(q[::-400], order=0, on_error="nan")
            for link in batch.links:
                angles = motion.link(link).value
                assert np.array_equal(few.link(link).value, angles[:, ::-400], equal_nan=True)
                for design in np.flatnonzero(reached.sum(axis=1) > 1):
                    at = np.flatnonzero(reached[design])
                    own = angles[design][at]
                    steps = np.abs(np.diff(own))
                    if (np.abs(steps - np.pi) < 0.1).any():
                        continue  # a cylinder is reversed: either half turn is right
                    behind_gaps += bool((np.diff(at) > 1).any())
                    np.testing.assert_allclose(
                        own, followed(own), rtol=0, atol=1e-6, err_msg=f"{seed} {link} {design}"
                    )
    assert behind_gaps > 20
