"""Limits where a group above class II turns fully and a dyad behind it does not."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

import assur
from assur import Status
from models.mechanisms import dyad_models
from models.mechanisms.mechanism_data import Description, arguments
from models.mechanisms.mixed_models import REGULAR, Builder
from oracles.kinematics.pair_jacobian import regularity

# Dead points are promised to this.
DEAD_POINT = 1e-10
# Positions to either side of the drawing, over more than a turn, then between two of them.
SCANNED = 400
BEYOND = 1.05 * math.tau
ROUNDS = 5
GROUPS = ("triad", "quadrilateral", "four ternaries")
TRIES = 400


def chain(seed: int) -> Description:
    """A crank, sometimes a dyad, a group above class II, then one or two dyads."""
    rng = random.Random(f"chain {seed}")
    for _ in range(TRIES):
        builder = Builder(rng)
        builder.driver(rng.choice(["crank", "coupler", "elbow", "crank"]))
        group = rng.choice(["triad", "triad", *GROUPS])
        behind = [rng.choice(dyad_models.KINDS) for _ in range(rng.choice([1, 1, 2]))]
        before = [rng.choice(dyad_models.KINDS)] if rng.random() < 0.4 else []
        for kind in (*before, group, *behind):
            (builder.group if kind == group else builder.dyad)(kind)
        drawn = builder.finish()
        if regularity(drawn) > REGULAR:
            return drawn
    message = f"no chain for seed {seed}"
    raise ValueError(message)


def end_of_solve(mechanism: assur.Mechanism, side: int) -> float:
    """Where `solve` ends to one side of the drawing; infinite if it goes on for a turn."""
    inside = float(mechanism.q0)
    outside = inside + side * BEYOND
    for _ in range(ROUNDS):
        q = np.linspace(inside, outside, SCANNED)
        found = mechanism.solve(q, order=0, on_error="nan", threads=1)
        missing = np.flatnonzero(np.asarray(found.status) > Status.SINGULAR)
        if not len(missing):
            return side * math.inf
        inside, outside = float(q[missing[0] - 1]), float(q[missing[0]])
    return inside


def check(mechanism: assur.Mechanism) -> None:
    limits = mechanism.limits()
    expected = [end_of_solve(mechanism, side) for side in (-1, 1)]
    assert limits.intervals.tolist() == [pytest.approx(expected, rel=0.0, abs=DEAD_POINT)]
    assert all(math.isfinite(end) for end in expected)
    assert not limits.full_rotation


def test_a_dyad_behind_a_triad_that_turns_fully() -> None:
    """The drawing is 0.02 rad from the dead point, and the interval goes beyond half a turn."""
    joints = {
        "J1": (-0.9, 0.6),
        "J2": (-0.5, 0.3),
        "J3": (-0.2, 0.2),
        "J4": (-1.4, 0.6),
        "J5": (1.1, 1.9),
        "J6": (-5.4, 1.6),
        "J7": (1.4, 1.4),
        "J8": (2.4, 1.6),
    }
    links = {
        "old": ["J1", "J3"],
        "crank": ["J1", "J2", "J4"],
        "X0": ["J3", "J5"],
        "Y0": ["J4"],
        "ground": ["J5", "J6"],
        "Y1": ["J6", "J7"],
        "X2": ["J7", "J8"],
        "Y2": ["J4", "J8"],
    }
    slides = {
        "s0": assur.Slide("Y0", on="X0", angle=2.8),
        "s1": assur.Slide("Y1", on="Y0", angle=-1.4),
    }
    drive = assur.Drive("crank", relative_to="old")
    mechanism = assur.Mechanism(joints, links, drive, slides=slides)
    check(mechanism)
    assert [point.group for point in mechanism.limits().dead_points] == ["II(X2, Y2)"] * 2
    assert mechanism.limits().intervals.ravel() == pytest.approx([-0.14481460, 5.14099769])


@pytest.mark.parametrize("seed", [634, 830, 910, 924, 968, 1141, 1158])
def test_dyads_behind_groups_that_turn_fully(seed: int) -> None:
    check(assur.Mechanism(**arguments(chain(seed))))
