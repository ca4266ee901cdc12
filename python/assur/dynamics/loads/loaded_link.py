"""Which link takes a load that acts at a joint of several links."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from assur._callers import level_of_caller
from assur.dynamics.loads.loads import (
    Damper,
    Force,
    Gravity,
    Pressure,
    Spring,
    Torque,
    TorsionDamper,
    TorsionSpring,
)
from assur.errors import AssurWarning

if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Iterator

    from assur.dynamics.loads.loads import Load, PointLike
    from assur.kinematics.mechanism import Mechanism


def warn_of_ambiguous_loads(
    mechanism: Mechanism, loads: Iterable[Load], friction: Container[str]
) -> None:
    """Warn of loads at joints with friction whose link is a guess that affects the friction."""
    for load in loads:
        for joint in _joints_without_a_link(load):
            if joint not in friction:
                continue
            link, is_open = mechanism.core.loaded_link(joint)
            # An end of a spring at a fixed joint is fastened to the ground.
            is_anchor = link == "ground" and not isinstance(load, Force)
            if is_open and not is_anchor:
                warnings.warn(_message(load, joint, link), AssurWarning, level_of_caller())


def _joints_without_a_link(load: Load) -> Iterator[str]:
    return (point for point in _points_without_a_link(load) if isinstance(point, str))


def _points_without_a_link(load: Load) -> tuple[PointLike, ...]:
    match load:
        case Force():
            return (load.at,) if load.on is None else ()
        case Spring() | Damper():
            return load.first, load.second
        case Gravity() | Torque() | Pressure() | TorsionSpring() | TorsionDamper():
            return ()


def _message(load: Load, joint: str, link: str) -> str:
    remedy = (
        f'on="{link}" or another one'
        if isinstance(load, Force)
        else "as a point (link, (x, y)) of it instead of a joint"
    )
    return (
        f'a {type(load).__name__} acts at joint "{joint}", which has friction: "{link}" takes it, '
        f"and the friction depends on which link does; name the link, {remedy}"
    )
