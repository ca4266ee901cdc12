"""A dyad without masses and loads hangs on a loaded machine: it has no friction."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import assur
from campaigns.campaign_cases import random_case
from models.machines.resting_models import resting_case
from models.mechanisms.mechanism_data import arguments
from support.samples import sample

CHUNK = 20
POSITIONS = 12
# The drive's effort, to this part of the greatest and of the condition.
CLOSE = 1e-12


def check(seed: int) -> bool:
    """Compare with the machine without friction; False where the last dyad is loaded."""
    m = assur.Mechanism(**arguments(random_case(seed).description))
    last = m.structure.groups[-1]
    bodies = {
        link: assur.Body(mass=1.0, inertia=0.1)
        for link in m.links
        if link not in (*last.links, "ground") and m.links[link]
    }
    # In a joint of more links others rub, too, and they have loads.
    if not bodies or any(sum(at in own for own in m.links.values()) > 2 for at in last.joints):
        return False
    machine = assur.Machine(m, bodies=bodies, loads=[assur.Gravity((2.0, -9.0))])
    friction: dict[str, assur.JointFriction | assur.SlideFriction] = {}
    friction |= {joint: assur.JointFriction(3.0, radius=0.7) for joint in last.joints}
    friction |= {slide: assur.SlideFriction(4.0, length=0.5) for slide in last.slides}
    strong = assur.Machine(m, bodies=bodies, loads=[assur.Gravity((2.0, -9.0))], friction=friction)
    q = float(m.q0) + np.linspace(-0.3, 0.3, POSITIONS)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", assur.AssurWarning)
        bare = machine.reactions(q, speed=1.5, on_error="nan")
        found = strong.reactions(q, speed=1.5, on_error="nan")
    condition = m.solve(q, order=0, on_error="nan").condition
    known = (np.asarray(found.status) == 0) & (condition < 1e4)
    assert not np.asarray(found.locked)[known].any(), seed
    close = CLOSE * condition * np.abs(np.nan_to_num(bare.driver)).max()
    assert (np.abs(np.asarray(found.driver) - bare.driver) <= close)[known].all(), seed
    return True


@pytest.mark.parametrize("first", range(0, sample(60, 1000), CHUNK))
def test_strong_friction_without_load_takes_nothing(first: int) -> None:
    checked = sum(check(seed) for seed in range(first, first + CHUNK))
    assert checked > CHUNK // 2


def test_rounding_locks_nothing() -> None:
    """A chain past self-locking: only the rounding of a moment passes through it."""
    case = resting_case(1182)
    m = case.machine.mechanism
    assert m is not None
    q = float(m.q0) + np.linspace(-3.0, 3.0, 41)
    found = case.machine.reactions(q, speed=case.speed0, on_error="nan")
    assert not np.asarray(found.locked).any()
    assert (np.asarray(found.safety) >= 1.0).all()
    bare = assur.Machine(m, bodies=case.machine.bodies, loads=case.machine.loads)
    np.testing.assert_allclose(
        found.driver, bare.reactions(q, speed=case.speed0).driver, rtol=1e-12
    )
