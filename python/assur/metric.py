"""Metrics: one number of the motion of a design, for `assur.sweep`.

A coordinate is named ``"B.x"`` or ``"B.y"`` (a joint, m), ``"rocker"`` (a link's angle, rad) or
``"bore"`` (a slide's value, m); ``order=1`` means its derivative by the driver's coordinate.
Metrics add, multiply and compare:

>>> from assur import metric
>>> quality = metric.span("B.x") - 0.1 * metric.rms("rocker", order=2)
>>> metric.least_transmission("C") > 0.7
least_transmission('C') > 0.7
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur._validate import checked_name, checked_order, one_of, real_number
from assur.errors import InputError
from assur.kinematics import transmission

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

__all__ = [
    "Condition",
    "Metric",
    "deviation",
    "full_rotation",
    "function",
    "greatest",
    "least",
    "least_transmission",
    "mean",
    "place_of_greatest",
    "place_of_least",
    "rms",
    "span",
    "time_ratio",
]

Float: TypeAlias = npt.NDArray[np.float64]
Part: TypeAlias = tuple[float, float] | None


@dataclass(frozen=True)
class Condition:
    """A metric compared with a limit: ``where=`` drops designs for which it is false."""

    metric: Metric
    relation: str
    limit: float

    def __repr__(self) -> str:
        return f"{self.metric!r} {self.relation} {self.limit!r}"

    def __bool__(self) -> bool:
        message = f"{self!r} is a condition, which has no value by itself: pass it in where=[...]"
        raise InputError(message)

    def holds(self, values: Float) -> npt.NDArray[np.bool_]:
        """Whether values meet it; NaN does not."""
        compare = {
            "<": np.less,
            "<=": np.less_equal,
            ">": np.greater,
            ">=": np.greater_equal,
        }[self.relation]
        met: npt.NDArray[np.bool_] = compare(values, self.limit)
        return met


class Metric:
    """One number of a motion; metrics add, subtract, multiply, divide and compare."""

    def leaves(self) -> Iterator[Leaf | Function]:
        """The metrics that it is made of."""
        raise NotImplementedError

    def value(self, of: Callable[[Leaf | Function], Float]) -> Float:
        """Its values, given those of its leaves."""
        raise NotImplementedError

    def __add__(self, other: object) -> Metric:
        return _combined("+", self, other)

    def __radd__(self, other: object) -> Metric:
        return _combined("+", other, self)

    def __sub__(self, other: object) -> Metric:
        return _combined("-", self, other)

    def __rsub__(self, other: object) -> Metric:
        return _combined("-", other, self)

    def __mul__(self, other: object) -> Metric:
        return _combined("*", self, other)

    def __rmul__(self, other: object) -> Metric:
        return _combined("*", other, self)

    def __truediv__(self, other: object) -> Metric:
        return _combined("/", self, other)

    def __rtruediv__(self, other: object) -> Metric:
        return _combined("/", other, self)

    def __neg__(self) -> Metric:
        return _combined("*", -1.0, self)

    def __lt__(self, limit: object) -> Condition:
        return Condition(self, "<", real_number(limit, "the limit of a condition"))

    def __le__(self, limit: object) -> Condition:
        return Condition(self, "<=", real_number(limit, "the limit of a condition"))

    def __gt__(self, limit: object) -> Condition:
        return Condition(self, ">", real_number(limit, "the limit of a condition"))

    def __ge__(self, limit: object) -> Condition:
        return Condition(self, ">=", real_number(limit, "the limit of a condition"))


@dataclass(frozen=True, repr=False)
class Combination(Metric):
    """Two metrics, or a metric and a number."""

    sign: str
    left: Metric | float
    right: Metric | float

    def leaves(self) -> Iterator[Leaf | Function]:
        for side in (self.left, self.right):
            if isinstance(side, Metric):
                yield from side.leaves()

    def value(self, of: Callable[[Leaf | Function], Float]) -> Float:
        left, right = (
            side.value(of) if isinstance(side, Metric) else side for side in (self.left, self.right)
        )
        combine = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide}[self.sign]
        with np.errstate(divide="ignore", invalid="ignore"):
            values: Float = combine(left, right)
        return values

    def __repr__(self) -> str:
        return f"({self.left!r} {self.sign} {self.right!r})"


def _combined(sign: str, left: object, right: object) -> Combination:
    sides = [
        side if isinstance(side, Metric) else real_number(side, "a number beside a metric")
        for side in (left, right)
    ]
    return Combination(sign, *sides)


@dataclass(frozen=True, repr=False)
class Leaf(Metric):
    """A metric of the core."""

    kind: str
    of: str | None = None
    order: int = 0
    options: tuple[Any, ...] = ()
    over: Part = None

    def leaves(self) -> Iterator[Leaf | Function]:
        yield self

    def value(self, of: Callable[[Leaf | Function], Float]) -> Float:
        return of(self)

    def __repr__(self) -> str:
        name = {"moves": "full_rotation"}.get(self.kind, self.kind)
        words = [] if self.of is None else [repr(self.of)]
        words += [f"order={self.order}"] if self.order else []
        words += [repr(option) for option in self.options if option is not None]
        words += [f"over={self.over!r}"] if self.over else []
        return f"{name}({', '.join(words)})"


@dataclass(frozen=True, repr=False)
class Function(Metric):
    """A function of motions, in Python."""

    function: Callable[[Motion], npt.ArrayLike]
    outputs: tuple[str, ...] | None
    order: int

    def leaves(self) -> Iterator[Leaf | Function]:
        yield self

    def value(self, of: Callable[[Leaf | Function], Float]) -> Float:
        return of(self)

    def __repr__(self) -> str:
        return f"function({getattr(self.function, '__name__', self.function)!s})"


def _leaf(kind: str, of: str, order: int, over: Part, *options: Any) -> Leaf:
    return Leaf(kind, checked_name(of, kind), checked_order(order), options, _checked_part(over))


def _checked_part(over: Any) -> Part:
    if over is None:
        return None
    if not (isinstance(over, tuple | list) and len(over) == 2):
        message = f"over={short(over)}: the first and the last coordinate are needed, (from, to)"
        raise InputError(message)
    first, last = (real_number(end, "over") for end in over)
    if not first <= last:
        message = f"over=({first!r}, {last!r}): the last coordinate is below the first"
        raise InputError(message)
    return first, last


def span(of: str, order: int = 0, over: Part = None) -> Metric:
    """The greatest value of a coordinate less the least.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine = assur.SliderCrank(1.0, 3.0)
    >>> crank = {"crank.length": [1.0, 1.5]}
    >>> found = assur.sweep(engine, crank, q, metrics={"stroke": assur.metric.span("bore")})
    >>> found["stroke"]
    array([2., 3.])
    """
    return _leaf("span", of, order, over)


def least(of: str, order: int = 0, over: Part = None) -> Metric:
    """The least value of a coordinate; parameters as of `span`."""
    return _leaf("least", of, order, over)


def greatest(of: str, order: int = 0, over: Part = None) -> Metric:
    """The greatest value of a coordinate; parameters as of `span`."""
    return _leaf("greatest", of, order, over)


def place_of_least(of: str, order: int = 0, over: Part = None) -> Metric:
    """The driver's coordinate where a coordinate is least; parameters as of `span`."""
    return _leaf("place_of_least", of, order, over)


def place_of_greatest(of: str, order: int = 0, over: Part = None) -> Metric:
    """The driver's coordinate where a coordinate is greatest; parameters as of `span`."""
    return _leaf("place_of_greatest", of, order, over)


def mean(of: str, order: int = 0, over: Part = None) -> Metric:
    """The arithmetic mean of a coordinate over the positions; parameters as of `span`."""
    return _leaf("mean", of, order, over)


def rms(of: str, order: int = 0, over: Part = None) -> Metric:
    """The root of the mean square of a coordinate; parameters as of `span`."""
    return _leaf("rms", of, order, over)


def time_ratio(of: str) -> Metric:
    """The time of the slower stroke of a coordinate, per that of the quicker; at least 1.

    The driver turns at a constant speed; q covers one turn evenly.
    """
    return _leaf("time_ratio", of, 0, None)


def least_transmission(
    at: str, between: tuple[str, str] | None = None, over: Part = None
) -> Metric:
    """The least transmission angle, rad, as `Motion.transmission_angle` defines it.

    Parameters
    ----------
    at : str
        A joint at which two links meet, or a slide.
    between : (str, str), optional
        Two other joints: the lines to these are meant.
    over : (float, float), optional
        As of `span`.
    """
    pair = None if between is None else tuple(between)
    return _leaf("least_transmission", at, 0, over, pair)


def deviation(
    of: str,
    shape: Literal["line", "circle"] = "line",
    part: float = 0.5,
    relative: bool = False,
    over: Part = None,
) -> Metric:
    """How far the best part of a joint's path is from a straight line or a circle.

    Parameters
    ----------
    of : str
        A joint.
    shape : {"line", "circle"}
        Fitted by least squares to each stretch of the path (a circle by Kåsa's method).
    part : float
        The part of the positions that counts: of all such stretches that with the least
        of the greatest distances. Where q goes once round, they pass its end.
    relative : bool
        Divide by the length along the line, or by the radius.
    over : (float, float), optional
        As of `span`.

    Returns
    -------
    Metric
        The greatest distance from the line or circle, m (or none).
    """
    one_of(shape, ("line", "circle"), "shape")
    share = real_number(part, "part")
    if not 0.0 < share <= 1.0:
        message = f"part={share!r}: more than 0 and at most 1 is needed"
        raise InputError(message)
    return _leaf("deviation", of, 0, over, shape, share, bool(relative))


def full_rotation() -> Metric:
    """1 for designs that move over all of q; the others have NaN, as of every metric."""
    return Leaf("moves")


def function(
    of_motion: Callable[[Motion], npt.ArrayLike] | Any,
    outputs: Iterable[str] | None = None,
    order: int = 0,
) -> Metric:
    """A metric of one's own, in NumPy.

    Parameters
    ----------
    of_motion : callable
        Takes a `Motion` of n designs that move over all of q; returns n numbers.
    outputs : iterable of str, optional
        Names of joints, links and slides that it reads; all by default.
    order : {0, 1, 2, 3}
        Highest order of the analogues that it reads.

    Examples
    --------
    >>> import assur
    >>> def height(motion):
    ...     return motion.joint("C").value[..., 1].max(axis=-1)
    >>> highest = assur.metric.function(height, outputs=["C"])
    """
    if not callable(of_motion):
        message = f"function is {short(of_motion)}: a function of a motion is needed"
        raise InputError(message)
    names = None if outputs is None else tuple(outputs)
    return Function(of_motion, names, checked_order(order))


# -- for the core -----------------------------------------------------------


def encoded(leaf: Leaf, mechanism: Mechanism, q: Float) -> tuple[Any, ...]:
    """A metric of the core as the core takes it; names are looked up."""
    spec = _encoded_whole(leaf, mechanism, q)
    if leaf.over is None:
        return spec
    return ("part", (*leaf.over, _is_angle(mechanism)), spec)


def _encoded_whole(leaf: Leaf, mechanism: Mechanism, q: Float) -> tuple[Any, ...]:
    if leaf.kind == "moves":
        return ("moves",)
    assert leaf.of is not None
    if leaf.kind == "least_transmission":
        pair, complement = transmission.lines(mechanism, leaf.of, leaf.options[0])
        return (leaf.kind, *(_line(mechanism, line) for line in pair), complement)
    if leaf.kind == "deviation":
        shape, part, relative = leaf.options
        joint = mechanism._core.require("joint", leaf.of)
        closed = _goes_round(mechanism, q) and leaf.over is None
        count = int(part * (len(q) if closed else len(q) - 1) + 1e-9) + 1
        count = min(count, len(q))
        if count < (3 if shape == "line" else 4):
            message = f"deviation: part={part} of {len(q)} positions are {count}: too few"
            raise InputError(message)
        return (leaf.kind, (joint, shape, count, closed, relative))
    if leaf.kind == "time_ratio" and not _goes_round(mechanism, q):
        message = "time_ratio needs q evenly over one turn: np.linspace(0, 2 * np.pi, n, False)"
        raise InputError(message)
    return (leaf.kind, _coordinate(mechanism, leaf.of, leaf.order))


def _coordinate(mechanism: Mechanism, name: str, order: int) -> tuple[str, int, int, int]:
    joint, dot, axis = name.rpartition(".")
    if dot:
        if axis not in ("x", "y"):
            message = f'coordinate {name!r}: "{joint}.x" or "{joint}.y" is needed'
            raise InputError(message)
        return "joint", mechanism._core.require("joint", joint), "xy".index(axis), order
    if name in mechanism.joints:
        message = f'coordinate {name!r} is a joint: "{name}.x" or "{name}.y" is needed'
        raise InputError(message, joint=name)
    kind = "slide" if name in mechanism.slides else "link"
    return kind, mechanism._core.require(kind, name), 0, order


def _line(mechanism: Mechanism, line: transmission.Line) -> tuple[Any, ...]:
    if isinstance(line, transmission.JointLine):
        return ("joints", *(mechanism._core.require("joint", joint) for joint in line))
    names, angle = mechanism._core.dimension_names, f"{line.slide}.angle"
    index = names.index(angle) if angle in names else None
    return ("guide", mechanism._core.require("link", line.link), index)


def _is_angle(mechanism: Mechanism) -> bool:
    driver = mechanism._description[3]
    return not any(name in mechanism.slides for name in driver if isinstance(name, str))


def _goes_round(mechanism: Mechanism, q: Float) -> bool:
    """Whether q goes once round in even steps, without its end repeated."""
    if len(q) < 3 or not _is_angle(mechanism):
        return False
    steps = np.diff(q, append=q[0] + np.copysign(2.0 * np.pi, q[1] - q[0]))
    return bool(np.ptp(steps) <= 1e-9 * abs(steps[0]))
