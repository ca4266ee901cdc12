"""The implementation of ``Mechanism.solve``: checks arguments, calls the core, raises errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from assur._arrays import short
from assur._validate import checked_order, checked_threads, one_of
from assur.errors import AssurError, InputError
from assur.kinematics.assembly import Assembly, drawn_in
from assur.kinematics.limits import limits
from assur.kinematics.motion import Motion
from assur.kinematics.motion_model import overwrite
from assur.kinematics.request import SolveRequest
from assur.kinematics.solve_arguments import (
    checked_assembly,
    checked_coordinates,
    warn_if_degrees,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import numpy.typing as npt

    from assur.kinematics.model import MechanismModel
    from assur.kinematics.result_columns import Buffers

# Names and indices of joints, links, slides.
Names: TypeAlias = tuple[dict[str, int], dict[str, int], dict[str, int]]

# Advice by kind of error: how to find the motion up to a dead point of the driver, and past it.
PAST_DEAD_POINTS = {
    "beyond_dead_point": "configuration_curve().motion() goes past it",
    "not_closed": "see limits() and configuration_curve().motion()",
}


def solve(
    mechanism: MechanismModel,
    q: npt.ArrayLike,
    order: Any = 2,
    outputs: Iterable[str] | None = None,
    assembly: Mapping[str, int] | None = None,
    on_error: str = "raise",
    threads: Any = None,
    out: Motion | None = None,
    from_user: bool = False,
) -> Motion:
    """See `Mechanism.solve`; `from_user`: whether a user wrote the coordinates, in rad."""
    policy: object = on_error
    if isinstance(policy, str) and policy == "drop":
        message = 'on_error is "drop": that is for assur.sweep; one of "raise", "nan" is needed'
        raise InputError(message)
    one_of(on_error, ("raise", "nan"), "on_error")
    order = checked_order(order)
    if isinstance(assembly, Assembly):
        drawn = drawn_in(mechanism, assembly)
        mechanism, assembly = (drawn, None) if drawn is not mechanism else (mechanism, assembly)
    coordinates, positions, per_design = checked_coordinates(mechanism, q)
    coordinates.flags.writeable = False
    if from_user:
        warn_if_degrees(mechanism, coordinates)
    own_signs = assembly is None
    signs = mechanism.signs if own_signs else checked_assembly(mechanism, assembly)
    threads = checked_threads(threads)
    request = SolveRequest(
        mechanism, coordinates, positions, per_design, order, signs, own_signs, threads
    )
    chosen = _outputs(mechanism, outputs)
    report = on_error == "raise"
    if out is None:
        results, status, failure = request.arrays(*chosen, report=report)
        motion = Motion(request, results, status)
    else:
        buffers = buffers_of(out, request, chosen)
        # If interrupted, the arrays mix both motions: the buffers stay marked incomplete.
        results, status, failure = request.arrays(*chosen, buffers, report=report)
        motion = out
        overwrite(motion, request, results, status)
    if failure is not None:
        raise _with_advice(mechanism, assembly, failure)
    return motion


def _with_advice(
    mechanism: MechanismModel, assembly: Mapping[str, int] | None, failure: AssurError
) -> AssurError:
    """Add what goes past a dead point, or where to look, to the error of a position beyond it."""
    advice = PAST_DEAD_POINTS.get(failure.kind or "")
    # A configuration curve is for one design.
    if advice is None or mechanism.driver_count > 1 or mechanism.shape:
        return failure
    if failure.kind == "not_closed" and not _moves_somewhere(mechanism, assembly):
        return failure
    link = "; " if failure.hint is None else ", and "
    failure.args = (f"{failure}{link}{advice}",)
    failure.hint = advice if failure.hint is None else f"{failure.hint}{link}{advice}"
    return failure


def _moves_somewhere(mechanism: MechanismModel, assembly: Mapping[str, int] | None) -> bool:
    """Whether a design of dyads can be assembled at other coordinates."""
    try:
        return mechanism.core.cls <= 2 and len(limits(mechanism, assembly).intervals) > 0
    except AssurError:
        return False


def buffers_of(motion: Any, request: SolveRequest, chosen: Names) -> Buffers:
    """Return the arrays of a motion that the request may overwrite."""
    if not isinstance(motion, Motion):
        message = f"out is {short(motion)}: a motion is needed"
        raise InputError(message)
    held = motion.stored
    names = [list(of) for of in (held.joints, held.links, held.slides)]
    drivers = request.mechanism.driver_count
    there = (motion._status.shape, motion.order, motion.driver_count, *names)
    needed = (request.shape, request.order, drivers, *(list(of) for of in chosen))
    what = ("shape", "order", "number of drivers", "joints", "links", "slides")
    for of, held_value, needed_value in zip(what, there, needed, strict=True):
        if held_value != needed_value:
            message = f"out has {of} {held_value}, this call needs {needed_value}"
            raise InputError(message)
    if held.buffers is None:
        message = "out: a copy cannot be overwritten; pass a motion as solve returned it"
        raise InputError(message)
    return held.buffers


def _outputs(mechanism: MechanismModel, names: Iterable[str] | None) -> Names:
    joints, links, slides = mechanism.indices
    if names is None:
        return joints, links, slides
    if isinstance(names, str):
        message = f"outputs={short(names)}: a list of names is needed, [{short(names)}]"
        raise InputError(message)
    try:
        listed: list[Any] = list(names)
    except TypeError as error:
        message = f"outputs is {short(names)}: a list of names is needed"
        raise InputError(message) from error
    chosen: Names = ({}, {}, {})
    for name in listed:
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
            message = f"outputs: no joint, link or slide is called {short(name)}; there are {known}"
            raise InputError(message)
    return chosen
