"""Exceptions and warnings."""

from __future__ import annotations

from typing import Any

__all__ = [
    "AssurError",
    "AssurWarning",
    "DimensionError",
    "InputError",
    "MotionError",
    "PositionError",
    "StructureError",
]


class AssurError(Exception):
    """Base of all errors of this package.

    Attributes
    ----------
    kind : str or None
        What failed, in a word: ``"not_closed"``, ``"bad_dimension"``. docs/errors.md lists all
        kinds that the core raises; None for arguments that Python refuses.
    hint : str or None
        What to do about it, the end of the message.
    joint, link, slide, driver, dimension : str or None
        Name of the first item concerned, if any.
    group : str or None
        The Assur group concerned: a dyad by its inner joint or slide, a higher group by class and
        links.
    design : tuple of int or None
        Index of the design in a batch.
    q : float or tuple of float or None
        The coordinate.
    t : float or None
        The time, s.
    value : float or None
        The wrong number, or by how much something fails.
    """

    def __init__(
        self,
        message: str = "",
        *,
        kind: str | None = None,
        hint: str | None = None,
        joint: str | None = None,
        link: str | None = None,
        slide: str | None = None,
        driver: str | None = None,
        dimension: str | None = None,
        group: str | None = None,
        design: tuple[int, ...] | None = None,
        q: float | tuple[float, ...] | None = None,
        t: float | None = None,
        value: float | None = None,
    ) -> None:
        super().__init__(message)
        self.kind = kind
        self.hint = hint
        self.joint = joint
        self.link = link
        self.slide = slide
        self.driver = driver
        self.dimension = dimension
        self.group = group
        self.design = design
        self.q = q
        self.t = t
        self.value = value

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), self.args, self.__dict__)


class StructureError(AssurError, ValueError):
    """An invalid linkage, or one whose mobility differs from its number of drivers."""


class DimensionError(AssurError, ValueError):
    """A dimension that is not finite or out of range, or a length that is not positive."""


class InputError(AssurError, ValueError):
    """A wrong argument: an unknown name, a shape, an order, a NaN."""


class PositionError(AssurError, ArithmeticError):
    """A position that this assembly cannot reach, or without the analogues needed."""


class MotionError(AssurError, ArithmeticError):
    """A motion in time that does not exist: a stall, a runaway, no balance, no periodic motion."""


class AssurWarning(UserWarning):
    """Worth knowing; the computation continues."""
