"""What is passed to ``Mechanism.solve``, and to others that take coordinates and assemblies."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._callers import level_of_caller
from assur._validate import checked_signs, real_array
from assur.errors import AssurWarning, InputError

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel

# Whole numbers, the greatest of them between two turns and those of a hundred in degrees, look like
# degrees.
LIKE_DEGREES = (4.0 * np.pi, 36_000.5)


def checked_coordinates(
    mechanism: MechanismModel, q: npt.ArrayLike
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


def checked_assembly(mechanism: MechanismModel, assembly: Mapping[str, int] | None) -> list[int]:
    """Return the signs of all dyads, those of the drawing where the assembly says nothing."""
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


def in_radians(
    mechanism: MechanismModel | None,
    q: Any,
    deg: npt.ArrayLike | None,
    call: str = "solve",
    name: str = "q",
) -> Float:
    """Return the coordinates that are given in degrees; without a mechanism those of a crank."""
    in_deg = name.replace("q", "deg")
    if q is not None or deg is None:
        both = (
            f"both {name} and {in_deg} are" if q is not None else f"neither {name} nor {in_deg} is"
        )
        message = f"{call}(): {both} given: pass {name} in rad (or m), or {in_deg} in degrees"
        raise InputError(message)
    slides = mechanism.slides if mechanism is not None else {}
    for driver in mechanism.description.drivers if mechanism is not None else ():
        if isinstance(driver, str) and driver in slides:
            message = f"{in_deg}: the driver {driver!r} is a slide; its coordinate q is a length, m"
            raise InputError(message)
    return real_array(deg, in_deg) * (np.pi / 180.0)


def q_or_deg(mechanism: MechanismModel | None, q: Any, deg: Any, call: str) -> Any:
    """Return the coordinates of a call that needs some: in rad or m, or in degrees."""
    return q if q is not None and deg is None else in_radians(mechanism, q, deg, call)


def warn_if_degrees(mechanism: MechanismModel, q: Float) -> None:
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
            f"q = {most:g} is {most:g} rad, {turns:.3g} turns; for degrees: deg=..., or "
            "np.radians(q)"
        )
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
