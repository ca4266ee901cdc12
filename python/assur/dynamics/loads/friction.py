"""Friction in the pairs of a machine: the user's values, checked.

The core reads the fields of these classes by name (rust/py/src/convert).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from assur._arrays import not_negative, short
from assur._validate import checked_name
from assur.dynamics.loads.table import replace_fields
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

__all__ = ["JointFriction", "PairFriction", "SlideFriction"]


@dataclass(frozen=True)
class JointFriction:
    """Friction of the journals at a joint.

    The pin is fixed to the first link of the description that has the joint; each other one rubs on
    it with the whole force F on it: the moment is coefficient · radius · ``|F|`` against the
    turning, tangent to the friction circle.

    Parameters
    ----------
    coefficient : float
        Of the journal. A pin that touches its bore in one point, with dry friction f, has
        f/√(1 + f²).
    radius : float
        Of the pin, m.
    viscous : float
        Moment per relative speed, N·m·s/rad, besides.
    static_coefficient : float, optional
        At rest, not below `coefficient`, which it is by default.

    Examples
    --------
    >>> import assur
    >>> assur.JointFriction(coefficient=0.08, radius=0.02)
    JointFriction(coefficient=0.08, radius=0.02, viscous=0.0, static_coefficient=None)
    """

    coefficient: float
    radius: float
    _: KW_ONLY
    viscous: float = 0.0
    static_coefficient: float | None = None

    def __post_init__(self) -> None:
        numbers = {
            name: not_negative(getattr(self, name), f"JointFriction: {name}")
            for name in ("coefficient", "radius", "viscous")
        }
        replace_fields(self, **numbers, static_coefficient=_static(self))


@dataclass(frozen=True)
class SlideFriction:
    """Friction of what slides on a guide.

    It touches the guide at both ends of a length that is centred on the sliding point and moves
    with the sliding link. With the normal force N and the moment M about that point the ends bear
    N/2 ± M/length, so the force of friction is coefficient · ``max(|N|, 2 |M|/length)``: the link
    lies on one side of the guide, or tilts and touches both.

    Parameters
    ----------
    coefficient : float
        Of friction.
    length : float
        Of the bearing, m: more than 0.
    viscous : float
        Force per speed, N·s/m, besides.
    static_coefficient : float, optional
        At rest, not below `coefficient`, which it is by default.

    Examples
    --------
    >>> import assur
    >>> assur.SlideFriction(coefficient=0.1, length=0.06)
    SlideFriction(coefficient=0.1, length=0.06, viscous=0.0, static_coefficient=None)
    """

    coefficient: float
    length: float
    _: KW_ONLY
    viscous: float = 0.0
    static_coefficient: float | None = None

    def __post_init__(self) -> None:
        numbers = {
            name: not_negative(getattr(self, name), f"SlideFriction: {name}")
            for name in ("coefficient", "length", "viscous")
        }
        if numbers["length"] == 0.0:
            message = "SlideFriction: length is 0: the length of the bearing is needed, m"
            raise InputError(message)
        replace_fields(self, **numbers, static_coefficient=_static(self))


PairFriction: TypeAlias = JointFriction | SlideFriction


def _static(friction: PairFriction) -> float | None:
    """Return the coefficient at rest, if it is not below that of sliding."""
    if friction.static_coefficient is None:
        return None
    what = f"{type(friction).__name__}: static_coefficient"
    at_rest = not_negative(friction.static_coefficient, what)
    if at_rest < friction.coefficient:
        message = f"{what} is {at_rest:g}, below the coefficient {friction.coefficient:g}"
        raise InputError(message, value=at_rest)
    return at_rest


def checked_friction(mechanism: Mechanism, friction: Any) -> dict[str, PairFriction]:
    """Return the friction of pairs, if it fits the mechanism."""
    if not isinstance(friction, Mapping):
        message = (
            f"friction is {short(friction)}: a mapping of joints to assur.JointFriction and slides "
            "to assur.SlideFriction is needed"
        )
        raise InputError(message)
    named = ((checked_name(name, "friction"), pair) for name, pair in friction.items())
    return {name: _of_pair(mechanism, name, pair) for name, pair in named}


def _of_pair(mechanism: Mechanism, name: str, friction: Any) -> PairFriction:
    if isinstance(friction, SlideFriction):
        mechanism.core.index_of("slide", name)
        return friction
    if not isinstance(friction, JointFriction):
        message = (
            f"friction[{name!r}] is {short(friction)}: an assur.JointFriction or SlideFriction is "
            "needed"
        )
        raise InputError(message)
    mechanism.core.index_of("joint", name)
    links = [link for link, joints in mechanism.links.items() if name in joints]
    if len(links) < 2:
        message = f'friction[{name!r}]: the joint belongs to "{links[0]}" alone, so nothing rubs'
        raise InputError(message, joint=name)
    return friction
