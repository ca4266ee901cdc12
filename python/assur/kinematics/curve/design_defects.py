"""Defects of designs in a batch that are to go through given positions."""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntFlag
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._validate import checked_name, real_array
from assur.errors import InputError
from assur.kinematics.assemblies import assemblies
from assur.kinematics.configuration import place_of, size_of
from assur.kinematics.curve.search import curve_through, require_one_driver
from assur.kinematics.model import with_values

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.model import MechanismModel

__all__ = ["Defect"]

# How near (relative to the size) the joints of an assembly must be to the given ones.
THERE = 1e-6
# How far apart assemblies are that such joints should distinguish.
APART = 1e-3


class Defect(IntFlag):
    """What keeps a design from going through given positions; flags combine.

    Examples
    --------
    >>> import assur
    >>> found = assur.Defect.BRANCH | assur.Defect.ORDER
    >>> bool(found & assur.Defect.BRANCH), bool(found & assur.Defect.CIRCUIT)
    (True, False)
    """

    NONE = 0
    """It goes through all of them, in their order."""
    CIRCUIT = 1
    """They lie on different circuits: it would have to be taken apart."""
    BRANCH = 2
    """They lie on different branches: the driver cannot lead from one to another."""
    ORDER = 4
    """One circuit goes through all of them, but in another order, whichever way round."""
    MISSING = 8
    """At one of them no assembly has the joints where they are wanted."""


def design_defects(
    mechanism: MechanismModel, q: npt.ArrayLike, joints: Mapping[str, npt.ArrayLike]
) -> Defect | npt.NDArray[np.uint8]:
    """See `Mechanism.defects`."""
    require_one_driver(mechanism, "defects")
    mapping: Any = joints
    if not isinstance(mapping, Mapping) or not mapping:
        message = f"joints is {short(joints)}: names of joints with their positions are needed"
        raise InputError(message)
    coordinates = real_array(q, "q")
    for name in joints:
        mechanism.core.index_of("joint", checked_name(name, "joints"))
    places_of = {name: real_array(places, name) for name, places in joints.items()}
    unknown = next((name for name, at in places_of.items() if not np.isfinite(at).all()), None)
    if unknown is not None:
        message = f"joint {unknown!r}: finite positions are needed"
        raise InputError(message, joint=unknown)
    try:
        shape = np.broadcast_shapes(
            (*mechanism.shape, 1), coordinates.shape, *(at.shape[:-1] for at in places_of.values())
        )
        rows = np.broadcast_to(coordinates, shape)
        there = {name: np.broadcast_to(at, (*shape, 2)) for name, at in places_of.items()}
    except ValueError as error:
        shapes = ", ".join(f"{name} {at.shape}" for name, at in places_of.items())
        message = f"q {coordinates.shape}, {shapes} do not broadcast to {mechanism.shape} + (K, 2)"
        raise InputError(message) from error
    if len(shape) != len(mechanism.shape) + 1 or shape[:-1] != mechanism.shape:
        message = f"q and joints have shape {shape}: {mechanism.shape} + (K,) is needed"
        raise InputError(message)
    if not np.isfinite(rows).all():
        message = "q: finite coordinates are needed"
        raise InputError(message)
    defects = np.empty(mechanism.shape, dtype=np.uint8)
    for index in np.ndindex(mechanism.shape):
        design = with_values(mechanism, mechanism.values[(slice(None), *index)])
        places = {name: at[index] for name, at in there.items()}
        defects[index] = _of_one(design, rows[index].tolist(), places)
    return defects if mechanism.shape else Defect(int(defects))


def _of_one(mechanism: MechanismModel, q: list[float], targets: dict[str, Float]) -> Defect:
    places = []
    for k, at in enumerate(q):
        assembly = _nearest(mechanism, at, {name: points[k] for name, points in targets.items()})
        if assembly is None:
            return Defect.MISSING
        places.append((at, assembly))
    defects = curve_through(mechanism, places).defects(places)
    defect = Defect.CIRCUIT if defects.circuit else Defect.NONE
    defect |= Defect.BRANCH if defects.branch else Defect.NONE
    return defect | (Defect.ORDER if defects.order else Defect.NONE)


def _nearest(mechanism: MechanismModel, q: float, targets: dict[str, Float]) -> Assembly | None:
    """Return the assembly whose joints are at the given places."""
    size = size_of(mechanism)
    fitting: list[tuple[float, Assembly]] = []
    for assembly in assemblies(mechanism, q):
        joints = assembly.joints
        assert joints is not None
        apart = max(
            float(np.abs(np.array(joints[name]) - at).max()) for name, at in targets.items()
        )
        if apart <= THERE * size:
            fitting.append((apart, assembly))
    places = [
        place_of(assembly.place.numbers, size)
        for _, assembly in fitting
        if assembly.place is not None
    ]
    if any(np.abs(place - places[0]).max() > APART for place in places[1:]):
        message = f"joints: {', '.join(targets)} do not determine the assembly: add others"
        raise InputError(message, value=q)
    return min(fitting, key=lambda pair: pair[0])[1] if fitting else None
