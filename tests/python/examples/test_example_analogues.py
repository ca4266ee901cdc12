"""First analogues of every example against central differences of the positions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from assur import examples
from oracles.kinematics.example_checks import mechanism_of, over_range, span

POSITION = 8 * 2.220446049250313e-16  # of size times condition: what conventions.md promises
STEP = 1e-5  # rad or m: differences then err by about as much by truncation as by rounding
BESIDE = 0.03  # rad: the locomotive has change points at 0 and π


@pytest.mark.parametrize("name", examples.ALL)
def test_analogues_against_differences(name: str) -> None:
    mechanism = mechanism_of(examples.ALL[name]())
    q = over_range(name, 61) + (BESIDE if name == "locomotive" else 0.0)
    motion = mechanism.solve(q, order=3)
    drivers = np.size(mechanism.q0)
    shortest = min(
        math.dist(mechanism.joints[on[0]], mechanism.joints[on[1]])
        for on in mechanism.links.values()
        if len(on) > 1
    )
    noise = POSITION * float(np.max(motion.condition)) * span(mechanism) / STEP
    for driver, step in enumerate(STEP * np.eye(drivers)):
        move = step if drivers > 1 else STEP
        after, before = (mechanism.solve(x, order=0) for x in (q + move, q - move))
        parts: list[tuple[str, str, float]] = [("joint", n, noise) for n in mechanism.joints]
        parts += [("slide", n, noise) for n in mechanism.slides]
        parts += [("link", n, noise / shortest) for n in mechanism.links]
        for kind, part, rounding in parts:
            here, plus, minus = (getattr(m, kind)(part) for m in (motion, after, before))
            # |third derivative| h²/6, doubled because it is greater nearby
            truncation = 2 * float(np.max(np.abs(here.d3))) * STEP**2 / 6
            along = here.d1[..., driver] if drivers > 1 else here.d1
            difference = (plus.value - minus.value) / (2 * STEP)
            assert np.max(np.abs(along - difference)) <= truncation + rounding, part
