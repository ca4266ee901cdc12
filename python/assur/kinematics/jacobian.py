"""Jacobians: derivatives of an output of a motion by the drivers or by dimensions, by name."""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from assur._arrays import short
from assur._validate import checked_name, whole_number
from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.motion_model import MotionModel

Kind: TypeAlias = Literal["joint", "link", "slide"]
# Letters that make a name of a dimension a pattern.
WILD = "*?["


def jacobian(motion: MotionModel, of: str, by: Any, order: int) -> Float:
    """See `Motion.jacobian`."""
    kind = _kind(motion, checked_name(of, "jacobian"))
    order = whole_number(order, "order", 0, 3)
    if isinstance(by, str) and by == "q":
        analogues = getattr(motion, kind)(of)._order(order + 1)
        # One driver has no axis of its own.
        result: Float = analogues[..., np.newaxis] if motion.driver_count == 1 else analogues
        return result
    getattr(motion, kind)(of)._order(order)
    names = _dimensions(motion, by)
    columns = [_derivative(motion, kind, of, name)[order] for name in names]
    shape = getattr(motion, kind)(of).arrays[order].shape
    return np.stack(columns, axis=-1) if columns else np.empty((*shape, 0))


def _kind(motion: MotionModel, of: str) -> Kind:
    """Return what has this name among the outputs of the motion: a joint, a link or a slide."""
    results = motion._results
    if of in results.joints:
        return "joint"
    if of in results.links:
        return "link"
    if of in results.slides:
        return "slide"
    names = [*results.joints, *results.links, *results.slides]
    message = (
        f"jacobian of {of!r}: there is no such output of this motion; there are "
        f"{', '.join(map(repr, names))}"
    )
    raise InputError(message)


def _dimensions(motion: MotionModel, by: Any) -> list[str]:
    """Return the names that are given, with those that patterns stand for, in their order."""
    given = [by] if isinstance(by, str) else by
    if not isinstance(given, list | tuple):
        message = f'by is {short(by)}: "q", or names of dimensions such as ["coupler.length"]'
        raise InputError(message)
    known = motion.request.mechanism.core.dimension_names
    names: list[str] = []
    for name in given:
        if isinstance(name, str) and any(letter in name for letter in WILD):
            fitting = [dimension for dimension in known if fnmatchcase(dimension, name)]
            if not fitting:
                message = f"by: no dimension is like {name!r}; there are {', '.join(known)}"
                raise InputError(message)
            names += fitting
        else:
            checked = checked_name(name, "by")
            motion.request.mechanism.core.dimension(checked)
            names.append(checked)
    return names


def _derivative(motion: MotionModel, kind: Kind, of: str, dimension: str) -> tuple[Float, ...]:
    """Return the derivatives of the output's value and analogues by a dimension."""
    core = motion.request.mechanism.core
    index = {of: core.index_of(kind, of)}
    joints, links, slides = (index if kind == each else {} for each in ("joint", "link", "slide"))
    by = core.dimension(dimension)
    results, _, _ = motion.request.arrays(joints, links, slides, dimension=by)
    held = {"joint": results.joints, "link": results.links, "slide": results.slides}[kind]
    arrays: tuple[Float, ...] = held[of]
    return arrays
