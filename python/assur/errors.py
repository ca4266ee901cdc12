"""Exceptions and warnings."""

from __future__ import annotations

from typing import Any

__all__ = [
    "AssurError",
    "AssurWarning",
    "DimensionError",
    "InputError",
    "PositionError",
    "StructureError",
]


class AssurError(Exception):
    """Base of all errors of this package.

    Attributes
    ----------
    joint, link, slide, driver, dimension : str or None
        Name of the first item concerned, if any.
    design : tuple of int or None
        Index of the design in a batch.
    q : float or tuple of float or None
        The coordinate.
    value : float or None
        The wrong number.
    """

    def __init__(
        self,
        message: str = "",
        *,
        joint: str | None = None,
        link: str | None = None,
        slide: str | None = None,
        driver: str | None = None,
        dimension: str | None = None,
        design: tuple[int, ...] | None = None,
        q: float | tuple[float, ...] | None = None,
        value: float | None = None,
    ) -> None:
        super().__init__(message)
        self.joint = joint
        self.link = link
        self.slide = slide
        self.driver = driver
        self.dimension = dimension
        self.design = design
        self.q = q
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


class AssurWarning(UserWarning):
    """Worth knowing; the computation continues."""
