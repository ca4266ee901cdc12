"""Grashof's law: which links of a four-bar turn fully."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur import _core
from assur.errors import DimensionError, InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur._arrays import Float, Number
    from assur.kinematics.model import MechanismModel

__all__ = ["CHANGE_TOLERANCE", "Grashof", "grashof", "types_of"]

# Sums of lengths that agree to this fraction of the longest make a change point.
CHANGE_TOLERANCE = 1e-12
# NumPy hears no signal within an operation.
NAMES_AT_ONCE = 1 << 16


class Grashof(NamedTuple):
    """Grashof's type of a four-bar, with the sums of lengths that decide it.

    Attributes
    ----------
    type : str or ndarray of str
        ``"crank-rocker"``, ``"rocker-crank"`` (the rocker turns), ``"double-crank"``,
        ``"double-rocker"`` (the coupler turns), ``"triple-rocker"`` (none turns) or
        ``"change-point"``; in a batch ``""`` for a design that cannot be assembled.
    s_plus_l : float or ndarray
        Shortest and longest length together, m.
    p_plus_q : float or ndarray
        The other two together, m: a link turns fully if s + l ≤ p + q.

    References
    ----------
    F. Grashof, *Theoretische Maschinenlehre*, vol. 2 (Leipzig, 1883).

    Examples
    --------
    >>> import assur
    >>> assur.FourBar(1.0, 3.0, 2.5, 3.2).grashof
    crank-rocker: s + l = 4.2 < p + q = 5.5
    >>> assur.examples.chebyshev_lambda().grashof.type
    'crank-rocker'
    """

    type: str | npt.NDArray[np.str_]
    s_plus_l: Number
    p_plus_q: Number

    def __repr__(self) -> str:
        if np.ndim(self.s_plus_l):
            return f"<Grashof types of {np.size(self.s_plus_l)} four-bars>"
        sums = f"s + l = {self.s_plus_l:.6g}", f"p + q = {self.p_plus_q:.6g}"
        sign = {"triple-rocker": ">", "change-point": "="}.get(str(self.type), "<")
        return f"{self.type}: {sums[0]} {sign} {sums[1]}"


def types_of(
    lengths: Sequence[npt.NDArray[np.float64]], shape: tuple[int, ...], tolerance: float
) -> str | npt.NDArray[np.str_]:
    """Return the types of four-bars by crank, coupler, rocker and ground, flat."""
    names = _core.crank_rocker_grashof(list(lengths), tolerance)
    if not shape:
        return names[0]
    starts = range(0, max(len(names), 1), NAMES_AT_ONCE)
    return np.concatenate([np.array(names[i : i + NAMES_AT_ONCE]) for i in starts]).reshape(shape)


def grashof(mechanism: MechanismModel) -> Grashof:
    """See `Mechanism.grashof`."""
    shape = mechanism.shape
    lengths = [
        np.broadcast_to(_length(mechanism, *side), shape).reshape(-1) for side in _ring(mechanism)
    ]
    ordered = np.sort(np.stack(lengths), axis=0)
    outer, inner = ordered[0] + ordered[3], ordered[1] + ordered[2]
    types = types_of(lengths, shape, CHANGE_TOLERANCE)
    rest = ordered[0] + inner
    # NaN, the mark of an invalid length, is sorted last.
    closes = (ordered[0] > 0.0) & (ordered[3] <= rest)
    if not shape and not closes[0]:
        message = (
            f"grashof: the longest link, {ordered[3, 0]:g} m, is longer than the others together, "
            f"{rest[0]:g} m: this four-bar cannot be assembled"
        )
        raise DimensionError(message, value=float(ordered[3, 0]))
    if shape:
        types = np.where(closes.reshape(shape), types, "")
    return Grashof(types, outer.reshape(shape)[()], inner.reshape(shape)[()])


def _ring(mechanism: MechanismModel) -> list[tuple[str, str, str]]:
    """Return crank, coupler, rocker and ground, each with its two pins.

    The crank is the link on the ground that the driver turns, or else the first of the two.
    """
    links = {name: set(joints) for name, joints in mechanism.links.items()}
    joints = set().union(*links.values())
    pins = {joint: [name for name in links if joint in links[name]] for joint in joints}
    pins = {joint: on for joint, on in pins.items() if len(on) > 1}
    between = {frozenset(on): joint for joint, on in pins.items()}
    on_ground = [
        name for name in links if name != "ground" and frozenset((name, "ground")) in between
    ]
    is_ring = len(links) == len(pins) == len(between) == 4 and all(
        sum(name in on for on in pins.values()) == 2 for name in links
    )
    if not is_ring or mechanism.slides or len(on_ground) != 2:
        message = (
            f"grashof is for four-bars, four links in a ring of four turning pairs; this mechanism "
            f"is {mechanism.core.formula}: limits().full_rotation says whether its driver turns"
        )
        raise InputError(message)
    drivers = mechanism.description.drivers
    driven = getattr(drivers[0], "link", drivers[0])
    crank, rocker = sorted(on_ground, key=lambda name: name != driven)
    (coupler,) = links.keys() - {crank, rocker, "ground"}
    ring = [crank, coupler, rocker, "ground"]
    joined = [between[frozenset((ring[i - 1], ring[i]))] for i in range(4)]
    return [(ring[i], joined[i], joined[(i + 1) % 4]) for i in range(4)]


def _length(mechanism: MechanismModel, link: str, first: str, second: str) -> Float:
    """Return the distance of two joints of a link."""
    values = dict(zip(mechanism.core.dimension_names, mechanism.values, strict=True))

    def place(joint: str) -> tuple[Float, Float]:
        zero = np.zeros(mechanism.shape)
        x, y = (values.get(f"{link}.{joint}.{axis}", zero) for axis in "xy")
        is_second = link != "ground" and joint == mechanism.links[link][1]
        return (values[f"{link}.length"], zero) if is_second else (x, y)

    (x, y), (u, v) = place(first), place(second)
    distance: Float = np.sqrt(np.square(u - x) + np.square(v - y))
    return distance
