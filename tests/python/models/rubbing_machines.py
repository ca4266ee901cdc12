"""Random machines with friction in all of their pairs."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

import assur
from reaction_machines import reaction_case

if TYPE_CHECKING:
    from reaction_machines import Case


def rubbing_case(seed: int) -> tuple[Case, assur.Machine]:
    """A machine of `reaction_machines`, and the same with friction: of all sizes, up to locking."""
    case, rng = reaction_case(seed), random.Random(f"friction {seed}")
    mechanism, part = case.mechanism, 10.0 ** rng.uniform(-2.5, 0.0)
    size = max(abs(x) for x in (*mechanism.dimensions.values(), 1e-3))
    friction: dict[str, Any] = {}
    for joint in mechanism._joint_names:
        links = [link for link, joints in mechanism.links.items() if joint in joints]
        if len(links) > 1:
            radius = size * rng.uniform(0.05, 0.3)
            friction[joint] = assur.JointFriction(part * rng.uniform(0.3, 1.0), radius)
    for slide in mechanism.slides:
        length = size * rng.uniform(0.2, 1.0)
        friction[slide] = assur.SlideFriction(part * rng.uniform(0.3, 1.0), length)
    plain = case.machine
    return case, assur.Machine(mechanism, plain.bodies, plain.loads, friction=friction)
