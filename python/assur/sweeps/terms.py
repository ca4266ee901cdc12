"""Terms of metrics: those of the core, functions in Python, combinations and conditions."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._by_value import ByValue
from assur._summary import shortened
from assur._validate import real_array, real_number
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from assur.dynamics.machine import Machine
    from assur.errors import AssurError
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

Float: TypeAlias = npt.NDArray[np.float64]
Part: TypeAlias = tuple[float, float] | None

# Of a metric that is a long sum.
MOST_LETTERS = 90


@dataclass(frozen=True)
class Condition:
    """A metric compared with a limit: ``where=`` drops designs for which it is false.

    Parameters
    ----------
    metric : Metric
        What is compared.
    relation : {"<", "<=", ">", ">="}
        How.
    limit : float
        With what, in the metric's unit.

    Examples
    --------
    >>> from assur import metric
    >>> metric.min_transmission_angle("C") > 0.7
    min_transmission_angle('C') > 0.7
    """

    metric: Metric
    relation: str
    limit: float

    def __repr__(self) -> str:
        return f"{shortened(repr(self.metric), MOST_LETTERS)} {self.relation} {self.limit!r}"

    def __bool__(self) -> bool:
        message = (
            f"{self!r} is a condition, which has no value by itself: pass it in where=[...], "
            "two of them for a range"
        )
        raise InputError(message)

    def holds(self, values: Float) -> npt.NDArray[np.bool_]:
        """Whether values meet it; NaN does not.

        Parameters
        ----------
        values : ndarray
            Values of the metric, of any shape.

        Returns
        -------
        ndarray of bool
            Of the same shape.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import metric
        >>> (metric.span("C.x") < 2.0).holds(np.array([1.0, 3.0, np.nan]))
        array([ True, False, False])
        """
        compare = {
            "<": np.less,
            "<=": np.less_equal,
            ">": np.greater,
            ">=": np.greater_equal,
        }[self.relation]
        met: npt.NDArray[np.bool_] = compare(real_array(values, "values", copy=False), self.limit)
        return met


class Metric:
    """One number of a motion; metrics add, subtract, multiply, divide and compare.

    Examples
    --------
    >>> from assur import metric
    >>> metric.span("C.x") / metric.span("C.y")
    (span('C.x') / span('C.y'))
    """

    # An array on the left would make an array of metrics.
    __array_ufunc__ = None

    def leaves(self) -> Iterator[Single]:
        """The metrics that it is made of.

        Examples
        --------
        >>> from assur import metric
        >>> list((metric.span("C.x") / metric.span("C.y")).leaves())
        [span('C.x'), span('C.y')]
        """
        raise NotImplementedError

    def value(self, of: Callable[[Single], Float]) -> Float:
        """Its values, given those of its leaves.

        Parameters
        ----------
        of : callable
            Gives the values of a leaf.

        Returns
        -------
        ndarray
            Of the shape of the leaves' values.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import metric
        >>> (2.0 * metric.span("C.x")).value(lambda leaf: np.array([1.0, 3.0]))
        array([2., 6.])
        """
        raise NotImplementedError

    def __add__(self, other: Metric | float) -> Metric:
        return _combined("+", self, other)

    def __radd__(self, other: Metric | float) -> Metric:
        return _combined("+", other, self)

    def __sub__(self, other: Metric | float) -> Metric:
        return _combined("-", self, other)

    def __rsub__(self, other: Metric | float) -> Metric:
        return _combined("-", other, self)

    def __mul__(self, other: Metric | float) -> Metric:
        return _combined("*", self, other)

    def __rmul__(self, other: Metric | float) -> Metric:
        return _combined("*", other, self)

    def __truediv__(self, other: Metric | float) -> Metric:
        return _combined("/", self, other)

    def __rtruediv__(self, other: Metric | float) -> Metric:
        return _combined("/", other, self)

    def __neg__(self) -> Metric:
        return _combined("*", -1.0, self)

    def __lt__(self, limit: Metric | float) -> Condition:
        return _compared(self, "<", limit)

    def __le__(self, limit: Metric | float) -> Condition:
        return _compared(self, "<=", limit)

    def __gt__(self, limit: Metric | float) -> Condition:
        return _compared(self, ">", limit)

    def __ge__(self, limit: Metric | float) -> Condition:
        return _compared(self, ">=", limit)


def _compared(metric: Metric, relation: str, limit: object) -> Condition:
    # The difference of two numbers is above zero where one is above the other, also when rounded.
    if isinstance(limit, Metric):
        return Condition(metric - limit, relation, 0.0)
    return Condition(metric, relation, real_number(limit, "the limit of a condition"))


@dataclass(frozen=True, repr=False)
class Combination(Metric):
    """Two metrics, or a metric and a number."""

    sign: str
    left: Metric | float
    right: Metric | float

    def leaves(self) -> Iterator[Single]:
        """Those of both sides."""
        for side in (self.left, self.right):
            if isinstance(side, Metric):
                yield from side.leaves()

    def value(self, of: Callable[[Single], Float]) -> Float:
        """The values of both sides, combined."""
        left, right = (
            side.value(of) if isinstance(side, Metric) else side for side in (self.left, self.right)
        )
        combine = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide}[self.sign]
        with np.errstate(divide="ignore", invalid="ignore"):
            values: Float = combine(left, right)
        return values

    def __repr__(self) -> str:
        return shortened(f"({self.left!r} {self.sign} {self.right!r})", MOST_LETTERS)


def _combined(sign: str, left: object, right: object) -> Combination:
    sides = [
        side if isinstance(side, Metric) else real_number(side, "a number beside a metric")
        for side in (left, right)
    ]
    return Combination(sign, *sides)


# What a function of a metric takes besides: numbers, flags, names of joints, lines, targets.
Option: TypeAlias = float | bool | str | tuple[str, ...] | tuple[int, ...] | ByValue | None


@dataclass(frozen=True, repr=False)
class Leaf(Metric):
    """A metric of the core."""

    kind: str
    of: str | None = None
    order: int = 0
    options: tuple[Option, ...] = ()
    over: Part = None

    def leaves(self) -> Iterator[Single]:
        """Itself."""
        yield self

    def value(self, of: Callable[[Single], Float]) -> Float:
        """Its values."""
        return of(self)

    def __repr__(self) -> str:
        name = {"moves": "reachable"}.get(self.kind, self.kind)
        words = [] if self.of is None else [repr(self.of)]
        words += [f"order={self.order}"] if self.order else []
        words += [repr(option) for option in self.options if option is not None]
        words += [f"over={self.over!r}"] if self.over else []
        return f"{name}({', '.join(words)})"


@dataclass(frozen=True, repr=False, eq=False)
class Function(ByValue, Metric):
    """A function of motions, in Python."""

    function: Callable[[Motion], npt.ArrayLike]
    outputs: tuple[str, ...] | None
    order: int

    def _key(self) -> tuple[Any, ...]:
        # A callable object may have no hash.
        function: Any = self.function
        same = function if isinstance(function, Hashable) else id(function)
        return same, self.outputs, self.order

    def leaves(self) -> Iterator[Single]:
        """Itself."""
        yield self

    def value(self, of: Callable[[Single], Float]) -> Float:
        """Its values."""
        return of(self)

    def __repr__(self) -> str:
        return f"function({getattr(self.function, '__name__', self.function)!s})"


class OfMachine(Metric):
    """A metric of machines, in Python."""

    def check(self, machine: Machine) -> None:
        """Raise InputError if it has no meaning for a machine."""

    def values(self, machine: Machine, q: Float, threads: int | None) -> Float:
        """Its values for the designs (n,) of a machine, which all move over q."""
        raise NotImplementedError

    def why(self, machine: Machine, q: Float) -> AssurError | str:
        """Why it has no value for one design."""
        raise NotImplementedError

    def leaves(self) -> Iterator[Single]:
        """Itself."""
        yield self

    def value(self, of: Callable[[Single], Float]) -> Float:
        """Its values."""
        return of(self)


@dataclass(frozen=True, repr=False)
class FullRotation(Metric):
    """Whether the driver goes round, by the limits of a design."""

    def check(self, mechanism: Mechanism) -> None:
        """Raise InputError for several drivers."""
        if mechanism.driver_count > 1:
            message = f"{self!r}: it is for one driver; this mechanism has {mechanism.driver_count}"
            raise InputError(message)

    def values(self, designs: Mechanism, threads: int | None) -> Float:
        """Its values for designs (n,)."""
        return np.asarray(designs.limits(threads=threads).full_rotation, dtype=np.float64)

    def leaves(self) -> Iterator[Single]:
        """Itself."""
        yield self

    def value(self, of: Callable[[Single], Float]) -> Float:
        """Its values."""
        return of(self)

    def __repr__(self) -> str:
        return "full_rotation()"


# What metrics are combined of.
Single: TypeAlias = Leaf | Function | OfMachine | FullRotation
