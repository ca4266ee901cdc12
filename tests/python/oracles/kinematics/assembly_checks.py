"""What is true of all assemblies of a mechanism: their number, and where they lead."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import assur
from models.mechanisms.assembly_models import CASES, Case
from oracles.kinematics.scan import count

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Float = NDArray[np.float64]

# Positions of one assembly, relative to the size, times its condition.
SAME = 1e-9


def expected(case: Case) -> int:
    """The number that two scans agree on."""
    samples = 1500
    last = count(case.misfit, case.dyads, samples)
    while samples < 200_000:
        samples = 2 * samples + 1
        found = count(case.misfit, case.dyads, samples)
        if found == last and samples > 6000:
            return found
        last = found
    raise AssertionError("the scans do not agree")


@dataclass
class Followed:
    """How many assemblies were followed to another coordinate, and which arrived at none.

    `refused` counts mechanisms of which the assemblies are not found at all.
    """

    cases: int = 0
    lost: int = 0
    wrong: int = 0
    refused: int = 0


def places(mechanism: assur.Mechanism, found: assur.Assemblies) -> Float:
    return np.array(
        [[one.joints[name] for name in mechanism.joints] for one in found if one.joints]
    )


def follow(mechanism: assur.Mechanism, q: float, other: float, followed: Followed) -> None:
    """Follow every assembly at one coordinate to another."""
    try:
        here, there = mechanism.assemblies(q), mechanism.assemblies(other)
    except assur.InputError:
        followed.refused += 1
        return
    known = places(mechanism, there)
    for assembly in here:
        followed.cases += 1
        motion = mechanism.solve(other, order=0, assembly=assembly, on_error="nan")
        if motion.status > assur.Status.SINGULAR:
            followed.lost += 1
            continue
        at = np.array([motion.joint(name).value for name in mechanism.joints])
        size = float(np.ptp(at, axis=0).max())
        errors = np.abs(known - at).max(axis=(1, 2)) if len(known) else np.array([np.inf])
        bound = SAME * size * max(float(motion.condition), 1.0)
        followed.wrong += not errors.min() <= bound


def random_cases(seed: int) -> Iterator[tuple[assur.Mechanism, float, float]]:
    rng = np.random.default_rng(seed)
    makers = [make for make, _ in CASES.values()]
    while True:
        mechanism = makers[rng.integers(len(makers))](rng).mechanism
        q = float(mechanism.q0) + float(rng.uniform(-0.5, 0.5))
        yield mechanism, q, q + float(rng.uniform(-2.0, 2.0))
