"""The implementation of ``Mechanism.solve``: checks arguments, calls the core, raises errors."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur._callers import level_of_caller
from assur._validate import checked_order, checked_signs, checked_threads, one_of, real_array
from assur.errors import AssurError, AssurWarning, InputError
from assur.kinematics.assembly import Assembly, drawn_in
from assur.kinematics.motion import Motion
from assur.kinematics.request import SolveRequest

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from assur.kinematics.held import Buffers
    from assur.kinematics.mechanism import Mechanism

Float: TypeAlias = npt.NDArray[np.float64]
# Names and indices of joints, links, slides.
Names: TypeAlias = tuple[dict[str, int], dict[str, int], dict[str, int]]

# Whole numbers, the greatest of them between two turns and those of a hundred in degrees, look like
# degrees.
LIKE_DEGREES = (4.0 * np.pi, 36_000.5)

# Advice by kind of error: how to find the motion up to a dead point of the driver, and past it.
PAST_DEAD_POINTS = {
    "beyond_dead_point": "configuration_curve().motion() goes past it",
    "not_closed": "see limits() and configuration_curve().motion()",
}


def solve(
    mechanism: Mechanism,
    q: npt.ArrayLike,
    order: Any,
    outputs: Iterable[str] | None,
    assembly: Mapping[str, int] | None,
    on_error: str,
    threads: Any,
    out: Motion | None,
    is_typed: bool = False,
) -> Motion:
    """See `Mechanism.solve`; `is_typed`: whether a user wrote the coordinates, in rad."""
    given: object = on_error
    if isinstance(given, str) and given == "drop":
        message = 'on_error is "drop": that is for assur.sweep; one of "raise", "nan" is needed'
        raise InputError(message)
    one_of(on_error, ("raise", "nan"), "on_error")
    order = checked_order(order)
    if isinstance(assembly, Assembly):
        drawn = drawn_in(mechanism, assembly)
        mechanism, assembly = (drawn, None) if drawn is not mechanism else (mechanism, assembly)
    coordinates, positions, per_design = checked_coordinates(mechanism, q)
    coordinates.flags.writeable = False
    if is_typed:
        warn_if_degrees(mechanism, coordinates)
    own_signs = assembly is None
    signs = mechanism.signs if own_signs else checked_assembly(mechanism, assembly)
    threads = checked_threads(threads)
    request = SolveRequest(
        mechanism, coordinates, positions, per_design, order, signs, own_signs, threads
    )
    wanted = _outputs(mechanism, outputs)
    report = on_error == "raise"
    if out is None:
        results, status, failure = request.arrays(*wanted, report=report)
        motion = Motion(request, results, status)
    else:
        buffers = _buffers(out, request, wanted)
        # If interrupted, the arrays mix both motions: the buffers stay marked incomplete.
        results, status, failure = request.arrays(*wanted, buffers, report=report)
        motion = out
        motion._replace_with(request, results, status)
    if failure is not None:
        raise _with_advice(mechanism, assembly, failure)
    return motion


def _with_advice(
    mechanism: Mechanism, assembly: Mapping[str, int] | None, failure: AssurError
) -> AssurError:
    """Say of a position beyond a dead point what goes past it, or where to look."""
    advice = PAST_DEAD_POINTS.get(failure.kind or "")
    # A configuration curve is of one design.
    if advice is None or mechanism.driver_count > 1 or mechanism.shape:
        return failure
    if failure.kind == "not_closed" and not _moves_somewhere(mechanism, assembly):
        return failure
    link = "; " if failure.hint is None else ", and "
    failure.args = (f"{failure}{link}{advice}",)
    failure.hint = advice if failure.hint is None else f"{failure.hint}{link}{advice}"
    return failure


def _moves_somewhere(mechanism: Mechanism, assembly: Mapping[str, int] | None) -> bool:
    """Whether a design of dyads can be assembled at other coordinates."""
    try:
        return mechanism.core.cls <= 2 and len(mechanism.limits(assembly).intervals) > 0
    except AssurError:
        return False


def in_radians(mechanism: Mechanism, q: Any, deg: npt.ArrayLike | None) -> Float:
    """Return the coordinates that are given in degrees."""
    if q is not None or deg is None:
        both = "both q and deg are" if q is not None else "neither q nor deg is"
        message = f"solve(): {both} given: pass q in rad (or m), or deg in degrees"
        raise InputError(message)
    for driver in mechanism.description.drivers:
        if isinstance(driver, str) and driver in mechanism.slides:
            message = f"deg: the driver {driver!r} is a slide; its coordinate q is a length, m"
            raise InputError(message)
    return real_array(deg, "deg") * (np.pi / 180.0)


def warn_if_degrees(mechanism: Mechanism, q: Float) -> None:
    """Warn if the coordinates of a driven angle look like degrees."""
    # Quickly, because every call comes here: few coordinates are whole numbers.
    last = q.item(-1) if q.size else 0.5
    if not last.is_integer():
        return
    most = float(np.abs(q).max()) if q.ndim else abs(last)
    if not LIKE_DEGREES[0] < most < LIKE_DEGREES[1]:
        return
    drivers = mechanism.description.drivers
    if len(drivers) > 1 or (isinstance(drivers[0], str) and drivers[0] in mechanism.slides):
        return
    if bool((q == np.floor(q)).all()):
        turns = most / (2.0 * np.pi)
        message = (
            f"q = {most:g} is {most:g} rad, {turns:.3g} turns; for degrees: solve(deg=...), or "
            "np.radians(q)"
        )
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())


def _buffers(motion: Any, request: SolveRequest, wanted: Names) -> Buffers:
    """Return the arrays of a motion that the request may overwrite."""
    if not isinstance(motion, Motion):
        message = f"out is {short(motion)}: a motion is needed"
        raise InputError(message)
    held = motion.stored
    names = [list(of) for of in (held.joints, held.links, held.slides)]
    drivers = request.mechanism.driver_count
    given = (motion._status.shape, motion.order, motion.driver_count, *names)
    needed = (request.shape, request.order, drivers, *(list(of) for of in wanted))
    what = ("shape", "order", "number of drivers", "joints", "links", "slides")
    for of, one, other in zip(what, given, needed, strict=True):
        if one != other:
            message = f"out has {of} {one}, this call needs {other}"
            raise InputError(message)
    if held.buffers is None:
        message = "out: a copy cannot be overwritten; pass a motion as solve returned it"
        raise InputError(message)
    return held.buffers


def checked_coordinates(
    mechanism: Mechanism, q: npt.ArrayLike
) -> tuple[Float, tuple[int, ...], bool]:
    """Return coordinates, the shape of positions, and whether each design has its own."""
    array = real_array(q, "q")
    drivers = mechanism.driver_count
    shape = array.shape
    if drivers > 1:
        if not shape or shape[-1] != drivers:
            message = f"q has shape {shape}: the last axis must hold the {drivers} drivers"
            raise InputError(message)
        shape = shape[:-1]
    designs = mechanism.shape
    if len(shape) <= 1 or not designs:
        return array, shape, False
    if shape[:-1] == designs:
        return array, shape[-1:], True
    batch = ", ".join(map(str, designs))
    message = f"q has shape {shape}: for designs {designs} pass a scalar, (N,) or ({batch}, N)"
    raise InputError(message)


def checked_assembly(mechanism: Mechanism, assembly: Mapping[str, int] | None) -> list[int]:
    """Return the signs of all dyads, of the drawing where the assembly says nothing."""
    if assembly is None:
        return mechanism.signs
    signs = dict(mechanism.core.assembly)
    for name, sign in checked_signs(assembly):
        if name not in signs:
            message = f"assembly: no dyad has the inner pair {name!r}; there are {list(signs)}"
            raise InputError(message, joint=name)
        if sign < 0 and name in mechanism.core.lengths:
            message = f"assembly[{name!r}] is -1: the length of {name!r} is never negative"
            raise InputError(message, slide=name)
        signs[name] = sign
    return list(signs.values())


def _outputs(mechanism: Mechanism, names: Iterable[str] | None) -> Names:
    joints, links, slides = mechanism.indices
    if names is None:
        return joints, links, slides
    if isinstance(names, str):
        message = f"outputs={short(names)}: a list of names is needed, [{short(names)}]"
        raise InputError(message)
    try:
        wanted: list[Any] = list(names)
    except TypeError as error:
        message = f"outputs is {short(names)}: a list of names is needed"
        raise InputError(message) from error
    chosen: Names = ({}, {}, {})
    for name in wanted:
        is_known = False
        if isinstance(name, str):
            if name in joints:
                chosen[0][name] = joints[name]
                is_known = True
            if name in links:
                chosen[1][name] = links[name]
                is_known = True
            if name in slides:
                chosen[2][name] = slides[name]
                is_known = True
        if not is_known:
            known = ", ".join(repr(n) for n in (*joints, *links, *slides))
            message = f"outputs: nothing is called {short(name)}; there are {known}"
            raise InputError(message)
    return chosen
