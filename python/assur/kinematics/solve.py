"""The implementation of ``Mechanism.solve``: checks arguments, calls the core, raises errors."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur._validate import checked_order, checked_signs, checked_threads, one_of, real_array
from assur.description.words import Status
from assur.errors import AssurError, DimensionError, InputError, PositionError
from assur.kinematics.motion import Motion
from assur.kinematics.request import SolveRequest

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from assur.kinematics.mechanism import Mechanism

Float: TypeAlias = npt.NDArray[np.float64]
# Names and indices of joints, links, slides.
Names: TypeAlias = tuple[dict[str, int], dict[str, int], dict[str, int]]


def solve(
    mechanism: Mechanism,
    q: npt.ArrayLike,
    order: Any,
    outputs: Iterable[str] | None,
    assembly: Mapping[str, int] | None,
    on_error: str,
    threads: Any,
    out: Motion | None,
) -> Motion:
    """See `Mechanism.solve`."""
    one_of(on_error, ("raise", "nan"), "on_error")
    order = checked_order(order)
    coordinates, positions, per_design = _coordinates(mechanism, q)
    coordinates.flags.writeable = False
    request = SolveRequest(
        mechanism=mechanism,
        q=coordinates,
        positions=positions,
        per_design=per_design,
        order=order,
        signs=_signs(mechanism, assembly),
        threads=checked_threads(threads),
    )
    wanted = _outputs(mechanism, outputs)
    fresh = out is None
    motion = (
        Motion(request, *request.arrays(*wanted)) if fresh else _overwritten(out, request, wanted)
    )
    if on_error == "raise":
        _raise_first(motion)
    return motion


def _overwritten(motion: Any, request: SolveRequest, wanted: Names) -> Motion:
    """Solve into the arrays of an existing motion, which takes over the request."""
    if not isinstance(motion, Motion):
        message = f"out is {short(motion)}: a motion is needed"
        raise InputError(message)
    held = motion._stored
    names = [list(of) for of in (held.joints, held.links, held.slides)]
    drivers = request.mechanism._driver_count
    given = (motion._status.shape, motion.order, motion._drivers, *names)
    needed = (request.shape, request.order, drivers, *(list(of) for of in wanted))
    what = ("shape", "order", "number of drivers", "joints", "links", "slides")
    for of, one, other in zip(what, given, needed, strict=True):
        if one != other:
            message = f"out: its {of} is {one}, this call needs {other}"
            raise InputError(message)
    if held.buffers is None:
        message = "out: a copy cannot be overwritten, only a motion as solve returned it"
        raise InputError(message)
    # If interrupted, the arrays mix both motions: the buffers stay marked incomplete.
    motion._replace_with(request, *request.arrays(*wanted, held.buffers))
    return motion


def _coordinates(mechanism: Mechanism, q: npt.ArrayLike) -> tuple[Float, tuple[int, ...], bool]:
    """Return coordinates, the shape of positions, and whether each design has its own."""
    array = np.array(real_array(q, "q"), order="C")
    drivers = mechanism._driver_count
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
    message = f"q has shape {shape}: for designs {designs} a scalar, (N,) or {(*designs, 'N')}"
    raise InputError(message)


def _signs(mechanism: Mechanism, assembly: Mapping[str, int] | None) -> list[int]:
    signs = dict(mechanism._core.assembly)
    for name, sign in checked_signs(assembly):
        if name not in signs:
            message = f"assembly: no dyad has the inner pair {name!r}; there are {list(signs)}"
            raise InputError(message, joint=name)
        signs[name] = sign
    return list(signs.values())


def _outputs(mechanism: Mechanism, names: Iterable[str] | None) -> Names:
    joints = {name: i for i, (name, _, _) in enumerate(mechanism._description[0])}
    links = {name: i for i, (name, _) in enumerate(mechanism._description[1])}
    slides = {name: i for i, (name, _) in enumerate(mechanism._description[2])}
    if names is None:
        return joints, links, slides
    if isinstance(names, str):
        message = f"outputs={names!r}: a list of names is needed, [{names!r}]"
        raise InputError(message)
    everything = {**joints, **links, **slides}
    try:
        wanted: list[Any] = list(names)
    except TypeError as error:
        message = f"outputs is {short(names)}: a list of names is needed"
        raise InputError(message) from error
    for name in wanted:
        if not isinstance(name, str) or name not in everything:
            known = ", ".join(repr(n) for n in (*joints, *links, *slides))
            message = f"outputs: nothing is called {name!r}; there are {known}"
            raise InputError(message)
    return (
        {n: joints[n] for n in wanted if n in joints},
        {n: links[n] for n in wanted if n in links},
        {n: slides[n] for n in wanted if n in slides},
    )


def _raise_first(motion: Motion) -> None:
    if motion.status.max(initial=0) < Status.SINGULAR:
        return
    bad = motion.status > Status.SINGULAR
    singular = motion.status == Status.SINGULAR
    if motion.order > 0 and singular.any():
        bad |= singular & _no_analogues(motion, singular)
    if not bad.any():
        return
    index = tuple(int(i) for i in np.argwhere(bad)[0])
    q = motion.coordinate(index)
    status, name, sentence = motion._explain(index)
    more = int(bad.sum()) - 1
    designs = len(motion.mechanism.shape)
    design = index[:designs] if designs else None
    where = f"design {design}: " if design is not None else ""
    rest = f" (and {more} more of {bad.size}; on_error='nan' keeps the others)" if more else ""
    message = f"{where}{sentence}{rest}"
    kinds: dict[int, type[AssurError]] = {
        Status.BAD_DIMENSION: DimensionError,
        Status.BAD_INPUT: InputError,
    }
    kind = kinds.get(status, PositionError)
    is_dimension = status == Status.BAD_DIMENSION
    joints, links, slides = _outputs(motion.mechanism, None)
    raise kind(
        message,
        joint=name if name in joints else None,
        link=name if name in links else None,
        slide=name if name in slides else None,
        dimension=name if is_dimension else None,
        design=design,
        q=q,
        value=_value(motion, index, name) if is_dimension else None,
    )


def _no_analogues(motion: Motion, singular: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Singular positions with NaN analogues: all but change points."""
    held = motion._results
    missing = np.zeros(motion.shape, dtype=np.bool_)
    for arrays in (a for kind in (held.joints, held.links, held.slides) for a in kind.values()):
        rows = arrays[1][singular]
        missing[singular] |= np.isnan(rows).reshape(len(rows), -1).any(axis=1)
    return missing


def _value(motion: Motion, index: tuple[int, ...], name: str | None) -> float:
    if name is None:
        return math.nan
    value = motion.mechanism.dimensions[name]
    return float(value[index[: len(motion.mechanism.shape)]] if motion.mechanism.shape else value)
