"""What `Mechanism.find` returns."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._arrays import as_number
from assur._summary import summary
from assur._validate import checked_index
from assur.kinematics.model import with_values

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy.typing as npt

    from assur._arrays import Float, Number
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.model import MechanismModel

__all__ = ["InversePath", "InverseSolution", "InverseSolutions"]


class InverseSolution(NamedTuple):
    """A position at which a coordinate of the motion has a value, by `Mechanism.find`.

    Attributes
    ----------
    q : float or ndarray
        The driver's coordinate, rad or m; an array of n with n drivers.
    assembly : Assembly
        The assembly, for ``m.solve(q, assembly=assembly)``.

    Examples
    --------
    >>> import assur
    >>> _, second = assur.SliderCrank(1.0, 3.0).find("bore", 3.0)
    >>> round(second.q, 6), dict(second.assembly)
    (1.403348, {'B': 1})
    """

    q: Number
    assembly: Assembly

    def __repr__(self) -> str:
        return summary(self)


@dataclass(frozen=True, slots=True, eq=False)
class InverseSolutions:
    """Every position for each of many values, or designs, by `Mechanism.find`.

    ``found[i]`` is the list of the i-th value, those of designs in a row, as `Mechanism.find` has
    it for one: each entry with ``.q`` and ``.assembly``.

    Attributes
    ----------
    q : ndarray
        Coordinates, shape S + (N, K), or S + (N, K, n) with n drivers: by q, NaN where a value has
        fewer than K positions, rad or m.
    count : ndarray of int
        The number of positions, shape S + (N,).
    status : ndarray of uint8
        `Status` of each value: OK, UNREACHABLE without a position, NOT_CONVERGED where some may be
        missing, LOST where one is too far from the drawing to be followed, BAD_INPUT,
        BAD_DIMENSION.

    Examples
    --------
    >>> import assur
    >>> found = assur.SliderCrank(1.0, 3.0).find("bore", [3.0, 4.5])
    >>> found.q.round(6), found.count
    (array([[-1.403348,  1.403348],
           [      nan,       nan]]), array([2, 0]))
    >>> [dict(solution.assembly) for solution in found[0]]
    [{'B': 1}, {'B': 1}]
    """

    __repr__ = summary

    q: Float
    count: npt.NDArray[np.int64]
    status: npt.NDArray[np.uint8]
    _of: MechanismModel = field(repr=False)
    # Values of the coordinates, shape S + (N, n).
    _values: Float = field(repr=False)
    _find_one: Callable[[MechanismModel, Float], list[InverseSolution]] = field(repr=False)

    def __len__(self) -> int:
        """Return the number of values, of all designs."""
        return self.count.size

    def __iter__(self) -> Iterator[list[InverseSolution]]:
        """Yield the positions for each value, those of designs one after another."""
        return (self[index] for index in np.ndindex(self.count.shape))

    def __getitem__(self, index: int | tuple[int, ...]) -> list[InverseSolution]:
        """Return the positions for one value."""
        entry = _entry(index, self.count.shape)
        design = self._of
        if design.shape:
            flat = design.values.reshape(len(design.values), -1)
            which = np.ravel_multi_index(entry[: len(design.shape)], design.shape)
            design = with_values(design, flat[:, which].copy())
        return self._find_one(design, self._values[entry]) if self.count[entry] else []


@dataclass(frozen=True, slots=True, eq=False)
class InversePath:
    """Positions followed along values, in one assembly, by ``Mechanism.find(near=…)``.

    ``path[i]`` is the i-th one, those of designs in a row, with ``.q`` and ``.assembly``.

    Attributes
    ----------
    q : ndarray
        Coordinates, shape S + (N,), or S + (N, n) with n drivers, rad or m: angles without jumps,
        NaN where the branch that is followed has no position.
    status : ndarray of uint8
        `Status` of each value, shape S + (N,): OK, UNREACHABLE where no assembly has a position,
        LOST where others have, BAD_INPUT, BAD_DIMENSION.
    assembly : Assembly
        The assembly, for ``m.solve(path.q, assembly=path.assembly)``.

    Examples
    --------
    >>> import numpy as np, assur
    >>> engine = assur.SliderCrank(1.0, 3.0)
    >>> path = engine.find("bore", np.linspace(3.0, 3.9, 4), near=1.4)
    >>> path.q.round(4)
    array([1.4033, 1.1176, 0.8108, 0.3914])
    """

    __repr__ = summary

    q: Float
    status: npt.NDArray[np.uint8]
    assembly: Assembly

    def __len__(self) -> int:
        """Return the number of values, of all designs."""
        return self.status.size

    def __iter__(self) -> Iterator[InverseSolution]:
        """Yield the position for each value, those of designs one after another."""
        return (self[index] for index in np.ndindex(self.status.shape))

    def __getitem__(self, index: int | tuple[int, ...]) -> InverseSolution:
        """Return the position for one value."""
        entry = _entry(index, self.status.shape)
        q = self.q[entry]
        return InverseSolution(as_number(q if np.ndim(q) else float(q)), self.assembly)


def _entry(index: int | tuple[int, ...], shape: tuple[int, ...]) -> tuple[int, ...]:
    """Return an index by axes: one number counts all values in a row."""
    if isinstance(index, tuple):
        return checked_index(index, shape, "find")
    (flat,) = checked_index((index,), (math.prod(shape),), "find")
    return tuple(int(i) for i in np.unravel_index(flat, shape))
