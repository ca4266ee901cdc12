"""Counterweights of any linkage by least squares, within given places and masses."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from assur._arrays import not_negative, real_array, real_number, short, two_numbers
from assur._validate import checked_name
from assur.balance.bounded import bounded_least_squares
from assur.balance.weights import checked_mechanism
from assur.dynamics.forces.counterweight import Counterweight, counterweight
from assur.dynamics.forces.joint_places import joint_place
from assur.dynamics.loads.loads import Body
from assur.dynamics.loads.table import replace_fields
from assur.dynamics.machine import Machine
from assur.errors import InputError, MotionError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism

__all__ = ["MomentBounds", "fit"]


@dataclass(frozen=True)
class MomentBounds:
    """Bounds of a counterweight's mass moment, in its link's frame; the place is left open.

    Parameters
    ----------
    x, y : (float, float)
        Least and greatest mass × coordinate from the link's first joint, kg·m; infinite: no bound.

    Examples
    --------
    At most 0.5 kg·m opposite the crank's pin:

    >>> import assur
    >>> assur.balance.MomentBounds(x=(-0.5, 0.0))
    MomentBounds(x=(-0.5, 0.0), y=(-inf, inf))
    """

    _: KW_ONLY
    x: tuple[float, float] = (-math.inf, math.inf)
    y: tuple[float, float] = (-math.inf, math.inf)

    def __post_init__(self) -> None:
        replace_fields(self, x=_bounds(self.x, "x"), y=_bounds(self.y, "y"))


# A joint or coordinates in the link's frame.
Point: TypeAlias = "str | tuple[float, float]"
Place: TypeAlias = "Point | Sequence[Point] | Float | MomentBounds"


class _Unknown(NamedTuple):
    """A mass at a point of a link, or a coordinate of a mass moment (`about` 0 or 1)."""

    link: str
    place: tuple[float, float]
    lower: float
    upper: float
    axis: int | None = None


def fit(
    machine: Machine,
    q: npt.ArrayLike,
    places: Mapping[str, Place],
    speed: npt.ArrayLike = 1.0,
    acceleration: npt.ArrayLike = 0.0,
    *,
    most: float | Mapping[str, float] = math.inf,
    moment_weight: float = 0.0,
) -> tuple[Counterweight, ...]:
    """Return the counterweights that leave the least mean square of shaking force.

    Parameters
    ----------
    machine : Machine
        Of one design, of any class and number of drivers.
    q, speed, acceleration : array_like
        The motion over which to balance, as in `Machine.reactions`.
    places : mapping of str to a place
        By link: a joint or (x, y) in the link's frame, m, where a weight goes; or a list of them,
        one for each weight (at the corners of a region they have any centre within it together).
        Or, for a link whose first joint rests, `MomentBounds`: a weight anywhere, its mass moment
        within bounds.
    most : float or mapping of str to float
        Greatest mass of each weight, kg: one for all, or by link. Does not hold for `MomentBounds`.
    moment_weight : float
        How many newtons a newton metre of shaking moment (about the origin) counts as, 1/m, not
        negative. More than 0 needs places: a weight's moment of inertia depends on them.

    Returns
    -------
    tuple of Counterweight
        One for each place, in their order, about the link's first joint; a mass may be 0. Weights
        of `MomentBounds` have no mass yet.

    Raises
    ------
    InputError
        Unknown links, invalid places, bounds for a link whose first joint moves, a batch, a
        machine of a table, wrong numbers.
    PositionError
        No position at some q.
    MotionError
        Inertia forces that are not finite.

    Notes
    -----
    The shaking force is linear in masses at given points, and in mass moments about points at rest.
    Where weights can replace each other, one of the solutions is returned.

    References
    ----------
    P. B. Stark and R. L. Parker, *Bounded-variable least-squares: an algorithm and applications*,
    Computational Statistics 10 (1995) 129.

    Examples
    --------
    A four-bar with room for weights of at most 1 kg behind its pivots:

    >>> import assur
    >>> import numpy as np
    >>> linkage = assur.FourBar(0.05, 0.15, 0.12, 0.16)
    >>> machine = assur.Machine(
    ...     linkage, bodies={"coupler": assur.Body(mass=1.2, inertia=3e-3, at=(0.08, 0.01))}
    ... )
    >>> q = np.linspace(0.0, 2 * np.pi, 60, endpoint=False)
    >>> weights = assur.balance.fit(
    ...     machine, q, {"crank": (-0.04, 0.0), "rocker": (-0.06, 0.0)}, most=1.0
    ... )
    >>> [(w.link, round(w.mass, 4)) for w in weights]
    [('crank', 0.8035), ('rocker', 1.0)]
    >>> balanced = machine.with_counterweights(weights)
    >>> forces = [one.reactions(q, 20.0).shaking_force for one in (machine, balanced)]
    >>> [float(np.sqrt(np.mean(force**2)).round(2)) for force in forces]
    [14.53, 1.94]
    """
    mechanism = checked_mechanism(machine, "balance.fit")
    mapping: Any = places
    if not isinstance(mapping, Mapping) or not mapping:
        message = f"places is {short(mapping)}: a mapping of links to places is needed"
        raise InputError(message)
    unplaced = [link for link in most if link not in mapping] if isinstance(most, Mapping) else []
    if unplaced:
        message = (
            f"most has {short(unplaced[0])}, which has no place: {', '.join(map(repr, mapping))}"
        )
        raise InputError(message)
    weight = not_negative(moment_weight, "moment_weight")
    unknowns = [
        unknown for link in mapping for unknown in _unknowns(mechanism, link, mapping[link], most)
    ]
    motion = q, speed, acceleration
    right = _shaking(machine, motion, weight)
    if not right.size:
        message = "q has no coordinates: positions over which to balance are needed"
        raise InputError(message)
    matrix = np.empty((right.size, len(unknowns)))
    resting: set[str] = set()
    for k, unknown in enumerate(unknowns):
        if unknown.axis is not None and unknown.link not in resting:
            _require_rest(mechanism, unknown.link, motion, weight)
            resting.add(unknown.link)
        alone = Machine(
            mechanism, bodies={unknown.link: Body(mass=1.0, inertia=0.0, at=unknown.place)}
        )
        matrix[:, k] = _shaking(alone, motion, weight)
    lower, upper = (
        np.array([getattr(unknown, at) for unknown in unknowns]) for at in ("lower", "upper")
    )
    masses = bounded_least_squares(matrix, -right, lower, upper)
    return tuple(_weights(unknowns, masses.tolist()))


def _shaking(machine: Machine, motion: tuple[Any, ...], weight: float) -> Float:
    """Return the components of the shaking force, and the moment as it counts, in one row."""
    reactions = machine.reactions(*motion)
    parts = [reactions.shaking_force.reshape(-1)]
    if weight > 0.0:
        parts.append(weight * np.reshape(reactions.shaking_moment, -1))
    row: Float = np.concatenate(parts)
    if not np.isfinite(row).all():
        message = "the shaking force is not finite: a speed or a mass is too great"
        raise MotionError(message, kind="not_finite")
    return row


def _unknowns(mechanism: Mechanism, link: Any, place: Any, most: Any) -> Iterator[_Unknown]:
    mechanism.core.index_of("link", checked_name(link, "places"))
    if link == "ground":
        message = "places has the ground, which rests: name a link that moves"
        raise InputError(message, link=link)
    if isinstance(place, MomentBounds):
        yield _Unknown(link, (1.0, 0.0), *place.x, axis=0)
        yield _Unknown(link, (0.0, 1.0), *place.y, axis=1)
        return
    limit = most.get(link, math.inf) if isinstance(most, Mapping) else most
    greatest = real_number(limit, f"most of {link!r}", finite=False)
    if greatest < 0.0:
        message = f"most of {link!r} is {greatest:g}: a mass is not negative"
        raise InputError(message, link=link, value=greatest)
    for point in _points(place):
        yield _Unknown(link, _coordinates(mechanism, link, point), 0.0, greatest)


def _points(place: Any) -> list[Any]:
    """Return the points of a place; two numbers are one point."""
    if isinstance(place, str):
        return [place]
    if isinstance(place, np.ndarray) and place.ndim:
        place = list(place)
    if not isinstance(place, list | tuple) or not place:
        message = (
            f"{short(place)} is not a place: give a joint, (x, y), a list of them, or MomentBounds"
        )
        raise InputError(message)
    several = any(isinstance(entry, str | list | tuple) or np.shape(entry) for entry in place)
    return list(place) if several else [place]


def _coordinates(mechanism: Mechanism, link: str, point: Any) -> tuple[float, float]:
    if not isinstance(point, str):
        return two_numbers(point, f"places[{link!r}]")
    joints = mechanism.links[link]
    if point not in joints:
        message = (
            f"places[{link!r}]: joint {short(point)} is not one of its joints {', '.join(joints)}"
        )
        raise InputError(message, joint=point, link=link)
    place = joint_place(mechanism, link, point)
    return place.real, place.imag


def _require_rest(mechanism: Mechanism, link: str, motion: tuple[Any, ...], weight: float) -> None:
    """Raise InputError unless a mass moment alone gives the force of a weight on this link."""
    if weight > 0.0:
        message = f"places[{link!r}]: with moment_weight its mass moment is not enough: give points"
        raise InputError(message, link=link)
    if _shaking(Machine(mechanism, bodies={link: Body(mass=1.0)}), motion, 0.0).any():
        message = (
            f"places[{link!r}]: its first joint moves, so the mass counts too and not only its "
            "moment: give points"
        )
        raise InputError(message, link=link)


def _weights(unknowns: list[_Unknown], numbers: list[float]) -> Iterator[Counterweight]:
    for k, (unknown, value) in enumerate(zip(unknowns, numbers, strict=True)):
        if unknown.axis == 1:
            yield counterweight(unknown.link, None, complex(numbers[k - 1], value))
        elif unknown.axis is None:
            x, y = unknown.place
            placed = counterweight(unknown.link, None, complex(value * x, value * y))
            yield Counterweight(
                unknown.link, placed.moment, angle=placed.angle, about=None, mass=value
            )


def _bounds(value: Any, what: str) -> tuple[float, float]:
    array = real_array(value, f"MomentBounds: {what}")
    if array.shape != (2,) or not array[0] < array[1]:
        message = f"MomentBounds: {what} is {short(value)}: a least and a greater number are needed"
        raise InputError(message)
    return float(array[0]), float(array[1])
