"""Slides, drives and assemblies of a description, and the statuses of positions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import IntEnum

from assur._validate import checked_signs

__all__ = ["Assembly", "Drive", "Slide", "Status"]


class Status(IntEnum):
    """Result of solving one position; the codes of ``Motion.status``."""

    OK = 0
    """Solved."""
    NEAR_SINGULAR = 1
    """Solved; fewer than six digits of the analogues may remain."""
    SINGULAR = 2
    """The position is given; its analogues are NaN, except at a change point."""
    UNREACHABLE = 3
    """This assembly does not exist at this coordinate (NaN)."""
    LOST = 4
    """The assembly cannot be followed from the drawing to this q (NaN).

    A group above class II folds before, or a joint passes through infinity; or the assembly of a
    driven angle does not repeat within 64 turns.
    """
    NOT_CONVERGED = 5
    """The iteration of a group above class II did not converge (NaN)."""
    BAD_DIMENSION = 6
    """A dimension is not finite, not positive, or outside 1e-153 to 1e153 m (NaN)."""
    BAD_INPUT = 7
    """The coordinate is not finite, or several drivers are too far from the drawing (NaN)."""


@dataclass(frozen=True)
class Slide:
    """A sliding pair: `link` slides along a guide that is fixed to `on`.

    Parameters
    ----------
    link : str
        The sliding link. The slide's value is the distance of its first joint
        along the guide (of its reference point if it has no joint).
    on : str
        The link that carries the guide; the guide turns with it.
    angle : float
        Direction of the guide in the drawing, rad.
    origin : str, optional
        The joint of `on` from which the value is measured; without it the value
        is 0 in the drawing.

    Examples
    --------
    >>> import assur
    >>> assur.Slide("piston", on="ground", angle=0.0, origin="O")
    Slide(link='piston', on='ground', angle=0.0, origin='O')
    """

    link: str
    on: str
    angle: float
    origin: str | None = None


@dataclass(frozen=True)
class Drive:
    """A driven angle between any two links: q is the difference of their angles.

    Parameters
    ----------
    link : str
        The driven link.
    relative_to : str, optional
        The link relative to which the angle is measured; they need not share a joint.

    Examples
    --------
    >>> import assur
    >>> assur.Drive("forearm", relative_to="upper_arm")
    Drive(link='forearm', relative_to='upper_arm')
    """

    link: str
    relative_to: str = "ground"


class Assembly(Mapping[str, int]):
    """The sign (+1 or −1) of every dyad with two solutions, by inner joint or slide.

    Examples
    --------
    >>> import assur
    >>> a = assur.Assembly({"C": 1})
    >>> a
    Assembly({'C': 1})
    >>> a["C"], -a
    (1, Assembly({'C': -1}))
    """

    __slots__ = ("_signs",)

    def __init__(self, signs: Mapping[str, int]) -> None:
        self._signs = checked_signs(signs)

    def __getitem__(self, name: str) -> int:
        for key, sign in self._signs:
            if key == name:
                return sign
        raise KeyError(name)

    def __iter__(self) -> Iterator[str]:
        return (name for name, _ in self._signs)

    def __len__(self) -> int:
        return len(self._signs)

    def __hash__(self) -> int:
        return hash(frozenset(self._signs))

    def __neg__(self) -> Assembly:
        """Return the assembly with every sign reversed."""
        return Assembly({name: -sign for name, sign in self._signs})

    def __repr__(self) -> str:
        return f"Assembly({dict(self._signs)!r})"
