"""Metrics: one number of the motion of a design, for `assur.sweep`.

A coordinate is named ``"B.x"`` or ``"B.y"`` (a joint, m), ``"rocker"`` (a link's angle, rad) or
``"bore"`` (a slide's value, m); ``order=1`` means its derivative by the driver's coordinate. A
metric uses the positions of q alone, nothing is interpolated: the value of an extreme is off by up
to the square of a step, its place by up to half a step. `Mechanism.extremes` gives both exactly,
for one design.

Metrics add, multiply and compare, with numbers and with each other:

>>> from assur import metric
>>> quality = metric.span("B.x") - 0.1 * metric.rms("rocker", order=2)
>>> metric.min_transmission_angle("C") > 0.7
min_transmission_angle('C') > 0.7
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from assur._arrays import flag, short
from assur._other_names import refuse_attribute
from assur._validate import checked_name, checked_order, one_of, real_number
from assur.errors import InputError
from assur.sweeps.machine_metrics import (
    flywheel_inertia,
    max_inertia,
    peak_effort,
    peak_reaction,
    rms_effort,
    rms_reaction,
)
from assur.sweeps.target_metrics import function_error, path_error, pose_error
from assur.sweeps.terms import Condition, FullRotation, Function, Leaf, Metric, Part

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from assur.kinematics.motion import Motion

__all__ = [
    "Condition",
    "Metric",
    "argmax",
    "argmin",
    "deviation",
    "flywheel_inertia",
    "full_rotation",
    "function",
    "function_error",
    "max",
    "max_inertia",
    "mean",
    "min",
    "min_transmission_angle",
    "path_error",
    "peak_effort",
    "peak_reaction",
    "pose_error",
    "reachable",
    "rms",
    "rms_effort",
    "rms_reaction",
    "span",
    "time_ratio",
]


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
        message = (
            f"over=({first!r}, {last!r}): the last coordinate is below the first; for a part of a "
            f"turn that passes its end write ({first!r}, {last + 2 * np.pi!r})"
        )
        raise InputError(message)
    return first, last


def span(of: str, *, order: int = 0, over: Part = None) -> Metric:
    """The greatest value of a coordinate less the least.

    That of a link that turns fully is about a turn, not a swing: ``where=[metric.span("rocker") <
    np.pi]`` keeps the rockers.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate; NaN if a position is ``SINGULAR``.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m, ends
        included; (6.0, 7.0) passes the end of the turn.

    Returns
    -------
    Metric
        m or rad; a derivative per rad or m of the driver.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5]}
    >>> asked = {"a": assur.metric.span("bore")}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"]
    array([2., 3.])
    """
    return _leaf("span", of, order, over)


def min(  # noqa: A001
    of: str, *, order: int = 0, over: Part = None
) -> Metric:
    """The least value of a coordinate.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate; NaN if a position is ``SINGULAR``.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m, ends
        included; (6.0, 7.0) passes the end of the turn.

    Returns
    -------
    Metric
        m or rad; a derivative per rad or m of the driver.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5]}
    >>> asked = {"a": assur.metric.min("bore")}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"]
    array([2. , 1.5])
    """
    return _leaf("min", of, order, over)


def max(  # noqa: A001
    of: str, *, order: int = 0, over: Part = None
) -> Metric:
    """The greatest value of a coordinate.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate; NaN if a position is ``SINGULAR``.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m, ends
        included; (6.0, 7.0) passes the end of the turn.

    Returns
    -------
    Metric
        m or rad; a derivative per rad or m of the driver.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5]}
    >>> asked = {"a": assur.metric.max("bore")}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"]
    array([4. , 4.5])
    """
    return _leaf("max", of, order, over)


def argmin(of: str, *, order: int = 0, over: Part = None) -> Metric:
    """The position of q where a coordinate is least; the first of several.

    It is one of the positions, not interpolated: off by up to half a step.
    `Mechanism.extremes` gives the exact place, for one design.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate; NaN if a position is ``SINGULAR``.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m, ends
        included; (6.0, 7.0) passes the end of the turn.

    Returns
    -------
    Metric
        One of q, rad or m.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`, as a
        place is then several numbers.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5]}
    >>> asked = {"a": assur.metric.argmin("bore")}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"] * 180 / np.pi
    array([180., 180.])
    """
    return _leaf("argmin", of, order, over)


def argmax(of: str, *, order: int = 0, over: Part = None) -> Metric:
    """The position of q where a coordinate is greatest; the first of several.

    It is one of the positions, not interpolated: off by up to half a step.
    `Mechanism.extremes` gives the exact place, for one design.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate; NaN if a position is ``SINGULAR``.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m, ends
        included; (6.0, 7.0) passes the end of the turn.

    Returns
    -------
    Metric
        One of q, rad or m.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`, as a
        place is then several numbers.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5]}
    >>> asked = {"a": assur.metric.argmax("bore", over=(1.0, 2.0))}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"] * 180 / np.pi
    array([60., 60.])
    """
    return _leaf("argmax", of, order, over)


def mean(of: str, *, order: int = 0, over: Part = None) -> Metric:
    """The arithmetic mean of a coordinate over the positions.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate; NaN if a position is ``SINGULAR``.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m, ends
        included; (6.0, 7.0) passes the end of the turn.

    Returns
    -------
    Metric
        m or rad; a derivative per rad or m of the driver; over one turn in even steps it is the
        mean of the turn.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5]}
    >>> asked = {"a": assur.metric.mean("A.x")}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"].round(12) + 0.0
    array([0., 0.])
    """
    return _leaf("mean", of, order, over)


def rms(of: str, *, order: int = 0, over: Part = None) -> Metric:
    """The root of the mean square of a coordinate.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    order : {0, 1, 2, 3}
        Which derivative by the driver's coordinate; NaN if a position is ``SINGULAR``.
    over : (float, float), optional
        Only positions between these driver coordinates, rad (modulo a turn) or m, ends
        included; (6.0, 7.0) passes the end of the turn.

    Returns
    -------
    Metric
        m or rad; a derivative per rad or m of the driver.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5]}
    >>> asked = {"a": assur.metric.rms("A.x")}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"].round(3)
    array([0.707, 1.061])
    """
    return _leaf("rms", of, order, over)


def time_ratio(of: str) -> Metric:
    """The time of a coordinate's slower stroke over that of its quicker one.

    The driver turns at a constant speed, and q goes over one turn in even steps:
    ``np.linspace(0, 2 * np.pi, n, endpoint=False)`` (Uicker, Pennock and Shigley, *Theory of
    Machines and Mechanisms*: advance-to-return ratio). Strokes begin and end at positions of q,
    nothing is interpolated: with N positions a turn a ratio near 1 is off by up to about 4/N (0.06
    of 72 positions), a greater one by (1 + ratio)²/N. `Mechanism.extremes` gives the exact ratio,
    for one design.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.

    Returns
    -------
    Metric
        At least 1. NaN for a coordinate that does not return to its first value after the turn: the
        angle of a link that turns, or a motion that takes two turns.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, several drivers, or
        other coordinates.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> engine, offsets = assur.SliderCrank(1.0, 3.0), {"bore.offset": [0.0, 0.8]}
    >>> asked = {"a": assur.metric.time_ratio("bore")}
    >>> assur.sweep(engine, offsets, q, metrics=asked)["a"].round(2)
    array([1.  , 1.18])
    """
    return _leaf("time_ratio", of, 0, None)


def min_transmission_angle(
    at: str, *, between: tuple[str, str] | None = None, over: Part = None
) -> Metric:
    """The least transmission angle, as `Motion.transmission_angle` defines it.

    Parameters
    ----------
    at : str
        A joint or a slide, as for `Motion.transmission_angle`.
    between : (str, str), optional
        Two other joints, which end the two lines.
    over : (float, float), optional
        As of `span`.

    Returns
    -------
    Metric
        rad, from 0 to π/2.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `order` and `over`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> four_bar, couplers = assur.FourBar(1.0, 3.0, 2.5, 3.0), {"coupler.length": [2.0, 3.0]}
    >>> asked = {"a": assur.metric.min_transmission_angle("C")}
    >>> np.degrees(assur.sweep(four_bar, couplers, q, metrics=asked)["a"]).round(1)
    array([51.3, 41.4])
    """
    pair = None if between is None else _checked_pair(between)
    return _leaf("min_transmission_angle", at, 0, over, pair)


def _checked_pair(between: Any) -> tuple[str, ...]:
    if not (isinstance(between, tuple | list) and len(between) == 2):
        message = f"between={short(between)}: two joints are needed"
        raise InputError(message)
    return tuple(checked_name(joint, "between") for joint in between)


def deviation(
    of: str,
    shape: Literal["line", "circle"] = "line",
    *,
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
        Fitted by least squares to each stretch of the path (a circle by Kåsa's method; that of
        points on a line is infinitely large).
    part : float
        The fraction of the positions that counts, of those of `over` if given: the stretch of this
        length with the least greatest distance. Where q goes once round in even steps, without its
        end, stretches pass the end of the turn of every design whose path is closed then; others
        take two turns.
    relative : bool
        Divide by the length along the line, or by the radius.
    over : (float, float), optional
        As of `span`. NaN for a design whose path is not closed, if it passes the end of q.

    Returns
    -------
    Metric
        The greatest distance from the line or circle, m; relative, none. NaN for a point that
        stands still if it is relative.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and with several
        drivers for `over`; if a stretch has less than 3 positions (a circle: 4), or those of
        `over` do not follow each other.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> chebyshev = assur.Mechanism(
    ...     joints={"A": (0, 0), "B": (-1, 0), "C": (0.5, 2), "D": (2, 0), "P": (2, 4)},
    ...     links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
    ...     driver="crank",
    ... )
    >>> asked = {"a": assur.metric.deviation("P", shape="line", relative=True)}
    >>> bool(assur.sweep(chebyshev, {}, q, metrics=asked)["a"] < 0.01)
    True
    """
    one_of(shape, ("line", "circle"), "shape")
    share = real_number(part, "part")
    if not 0.0 < share <= 1.0:
        message = f"part={share!r}: more than 0 and at most 1 is needed"
        raise InputError(message)
    return _leaf("deviation", of, 0, over, shape, share, flag(relative, "relative"))


def reachable() -> Metric:
    """Whether a design reaches all positions of q.

    It says what the positions of q show. A gap between two of them is not seen: `full_rotation`
    proves that there is none.

    Returns
    -------
    Metric
        1, or 0 for a design with a position that cannot be solved; NaN, as all metrics, for one
        that misses a condition of ``where=``, which is not solved further.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> four_bar, couplers = assur.FourBar(1.0, 3.0, 2.5, 3.0), {"coupler.length": [3.0, 9.0]}
    >>> asked = {"a": assur.metric.reachable()}
    >>> assur.sweep(four_bar, couplers, q, metrics=asked)["a"]
    array([1., 0.])
    """
    return Leaf("moves")


def full_rotation() -> Metric:
    """Whether the driver goes round and the motion closes, proved for each design.

    It is ``full_rotation`` of `Mechanism.limits`, and does not depend on the positions of q.

    Returns
    -------
    Metric
        1 or 0, also for a design with a position that cannot be reached; NaN for one with a bad
        dimension, or that misses a condition of ``where=``.

    Raises
    ------
    InputError
        By `assur.sweep` with several drivers.

    Examples
    --------
    A gap of 5° lies between positions of 30°:

    >>> import assur, numpy as np
    >>> from assur import metric
    >>> q = np.radians(np.arange(15, 360, 30))
    >>> asked = {"samples": metric.reachable(), "proof": metric.full_rotation()}
    >>> found = assur.sweep(assur.FourBar(1.0, 2.0, 2.0, 3.0), {"ground.D.x": [2.9, 3.003]}, q,
    ...                     metrics=asked)
    >>> found["samples"], found["proof"]
    (array([1., 1.]), array([1., 0.]))
    """
    return FullRotation()


def function(
    of_motion: Callable[[Motion], npt.ArrayLike],
    *,
    outputs: Iterable[str] | None = None,
    order: int = 0,
) -> Metric:
    """Your own metric, in NumPy.

    Its conditions come last: they drop a design after all of its positions are solved.

    Parameters
    ----------
    of_motion : callable
        Takes a `Motion` of n designs that move over all of q and meet all conditions without
        functions; returns n numbers.
    outputs : iterable of str, optional
        Names of joints, links and slides that it reads; all by default.
    order : {0, 1, 2, 3}
        Highest order of the analogues that it reads.

    Returns
    -------
    Metric
        What the function returns.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` if the function returns other than n numbers.

    Examples
    --------
    >>> import assur, numpy as np
    >>> def height(motion):
    ...     return motion.joint("C").value[..., 1].max(axis=-1)
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> four_bar, couplers = assur.FourBar(1.0, 3.0, 2.5, 3.0), {"coupler.length": [2.0, 3.0]}
    >>> asked = {"a": assur.metric.function(height, outputs=["C"])}
    >>> assur.sweep(four_bar, couplers, q, metrics=asked)["a"].round(2)
    array([2.27, 2.5 ])
    """
    given: object = of_motion
    if not callable(given):
        message = f"function is {short(of_motion)}: a function of a motion is needed"
        raise InputError(message)
    if isinstance(outputs, str):
        message = f"outputs={short(outputs)}: a list of names is needed, [{short(outputs)}]"
        raise InputError(message)
    try:
        names = None if outputs is None else tuple(outputs)
    except TypeError as error:
        message = f"outputs is {short(outputs)}: a list of names is needed"
        raise InputError(message) from error
    return Function(of_motion, names, checked_order(order))


if not TYPE_CHECKING:
    _OTHER_NAMES = {
        "value": "sweep(m, dimensions, q, outputs=[name]) has the values themselves",
        "stroke": "it is metric.span",
        "swing": "it is metric.span",
        "range": "it is metric.span",
        "transmission_angle": "it is metric.min_transmission_angle",
        "torque": "it is metric.peak_effort or metric.rms_effort",
        "least": "it is metric.min",
        "greatest": "it is metric.max",
        "place_of_least": "it is metric.argmin",
        "place_of_greatest": "it is metric.argmax",
        "least_transmission": "it is metric.min_transmission_angle",
        "greatest_inertia": "it is metric.max_inertia",
    }

    def __getattr__(name):
        refuse_attribute(None, "'assur.metric'", name, _OTHER_NAMES)

    def __dir__():
        return sorted(__all__)
