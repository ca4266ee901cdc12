"""Random machines with friction in some of their pairs."""

from __future__ import annotations

import random
import warnings
from typing import TYPE_CHECKING, Any

import assur
from models.machines.reaction_machines import reaction_case

if TYPE_CHECKING:
    from models.machines.reaction_machines import Case


MOST = 6


def rubbing_case(seed: int) -> tuple[Case, assur.Machine]:
    """A machine of `reaction_machines`, and the same with friction: of all sizes, up to locking.

    At most six links rub: a search for all solutions takes twice as long for each more.
    """
    case, rng = reaction_case(seed), random.Random(f"friction {seed}")
    mechanism, part = case.mechanism, 10.0 ** rng.uniform(-2.5, 0.0)
    size = max(abs(x) for x in (*mechanism.dimensions.values(), 1e-3))
    friction: dict[str, Any] = {}
    names, rubs = [*mechanism.joint_names, *mechanism.slides], 0
    for name in rng.sample(names, len(names)):
        links = [link for link, joints in mechanism.links.items() if name in joints]
        own = 1 if name in mechanism.slides else len(links) - 1
        if rubs + own > MOST or own == 0:
            continue
        rubs += own
        if name not in mechanism.slides:
            radius = size * rng.uniform(0.05, 0.3)
            friction[name] = assur.JointFriction(part * rng.uniform(0.3, 1.0), radius)
        else:
            length = size * rng.uniform(0.2, 1.0)
            friction[name] = assur.SlideFriction(part * rng.uniform(0.3, 1.0), length)
    return case, with_friction(case.machine, friction)


def with_friction(plain: assur.Machine, friction: dict[str, Any]) -> assur.Machine:
    """The machine with friction; loads at its joints are on the links that the library chooses."""
    assert plain.mechanism is not None
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*the friction depends on which", assur.AssurWarning)
        return assur.Machine(
            plain.mechanism, bodies=plain.bodies, loads=plain.loads, friction=friction
        )
