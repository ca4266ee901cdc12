"""Motions as tables and as xarray's Datasets."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import flag
from assur._table import Column, coordinate_columns, design_columns
from assur._validate import refuse_without_speed
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel
    from assur.kinematics.motion_model import MotionModel
    from assur.kinematics.quantity import Analogues

# Columns of a joint's components, an angle and a slide: value, velocity, acceleration, jerk.
POINT = ("{}.{}", "{}.v{}", "{}.a{}", "{}.j{}")
ANGLE = ("{}", "{}.omega", "{}.alpha", "{}.jerk")
SLIDE = ("{}", "{}.v", "{}.a", "{}.j")


class Options(NamedTuple):
    """What a table of a motion shows."""

    speed: npt.ArrayLike | None = None
    acceleration: npt.ArrayLike = 0.0
    jerk: npt.ArrayLike = 0.0
    degrees: bool = False
    moving: bool = False


class _Quantity(NamedTuple):
    kind: str
    name: str
    shown: str
    analogues: Analogues


def motion_columns(motion: MotionModel, options: Options) -> list[Column]:
    """Return the columns of a motion's table, rows over designs and positions."""
    flag(options.degrees, "degrees")
    flag(options.moving, "moving")
    refuse_without_speed(
        options.speed, "speed", acceleration=options.acceleration, jerk=options.jerk
    )
    columns = _rows(motion, options.degrees)
    taken = {column.name for column in columns}
    for quantity in _quantities(motion, taken):
        if options.moving and not _moves(quantity.analogues):
            continue
        if options.speed is None:
            columns.extend(_analogues(motion, quantity, options.degrees))
        else:
            columns.extend(_velocities(motion, quantity, options))
    return columns


def _rows(motion: MotionModel, degrees: bool) -> list[Column]:
    """Designs, coordinates and statuses."""
    angles = driven_angles(motion.mechanism)
    return [
        *design_columns(motion.shape, len(motion.mechanism.shape), motion.kept),
        *coordinate_columns(motion.q, angles, motion.shape, degrees),
        Column("status", motion.status.reshape(-1), "", None),
    ]


def driven_angles(mechanism: MechanismModel) -> list[bool]:
    """Whether each driver is an angle, not a slide."""
    slides = mechanism.slides
    drivers = mechanism.description.drivers
    return [not isinstance(driver, str) or driver not in slides for driver in drivers]


def _quantities(motion: MotionModel, taken: set[str]) -> Iterator[_Quantity]:
    """Joints, links, slides; a link or slide whose name is taken is shown with its kind."""
    results = motion._results
    for name in results.joints:
        yield _Quantity("joint", name, name, motion.joint(name))
    for kind, held, of in (
        ("link", results.links, motion.link),
        ("slide", results.slides, motion.slide),
    ):
        for name in held:
            # Names have no blanks, so "link q" cannot clash.
            yield _Quantity(kind, name, f"{kind} {name}" if name in taken else name, of(name))


def _moves(analogues: Analogues) -> bool:
    """Whether a quantity changes from position to position, or has a velocity."""
    value = analogues.value
    point = 1 if analogues._point else 0
    if value.ndim > point and value.shape[-1 - point] > 1:
        first = np.take(value, [0], axis=-1 - point)
        if bool(((value != first) & ~np.isnan(value) & ~np.isnan(first)).any()):
            return True
    elif len(analogues.arrays) == 1:
        # A single position without analogues does not show it.
        return True
    rates = analogues.arrays[1:2]
    return any(bool((np.nan_to_num(rate) != 0.0).any()) for rate in rates)


def _components(kind: str) -> list[str]:
    return ["x", "y"] if kind == "joint" else [""]


def _analogues(motion: MotionModel, quantity: _Quantity, degrees: bool) -> Iterator[Column]:
    drivers, size = motion.driver_count, motion.status.size
    unit = "rad" if quantity.kind == "link" else "m"
    parts = _components(quantity.kind)
    angles = driven_angles(motion.mechanism)
    for order, array in enumerate(quantity.analogues.arrays):
        indices = list(product(range(drivers), repeat=order))
        flat = array.reshape(size, len(parts), len(indices))
        for c, part in enumerate(parts):
            name = f"{quantity.shown}.{part}" if part else quantity.shown
            for k, index in enumerate(indices):
                per = "".join("/rad" if angles[driver] else "/m" for driver in index)
                tail = "" if order == 0 else f".d{order}"
                if order and drivers > 1:
                    tail += f"[{','.join(map(str, index))}]"
                values = flat[:, c, k]
                if degrees and order == 0 and unit == "rad":
                    yield Column(name, np.degrees(values), "deg", quantity.shown)
                else:
                    yield Column(name + tail, values, unit + per, quantity.shown)


def _velocities(motion: MotionModel, quantity: _Quantity, options: Options) -> Iterator[Column]:
    forms = {"joint": POINT, "link": ANGLE, "slide": SLIDE}[quantity.kind]
    unit = "rad" if quantity.kind == "link" else "m"
    parts = _components(quantity.kind)
    of, speed, acceleration = quantity.analogues, options.speed, options.acceleration
    assert speed is not None
    rates: list[Float] = [of.value]
    if motion.order >= 1:
        rates.append(of.velocity(speed))
    if motion.order >= 2:
        rates.append(of.acceleration(speed, acceleration))
    if motion.order >= 3:
        rates.append(of.jerk(speed, acceleration, options.jerk))
    for order, rate in enumerate(rates):
        if rate.shape != of.value.shape:
            message = (
                f"speed and acceleration give the shape {rate.shape}: a table has one speed at "
                f"each position {motion.shape}"
            )
            raise InputError(message)
        per = ["", "/s", "/s2", "/s3"][order]
        flat = rate.reshape(motion.status.size, len(parts))
        for c, part in enumerate(parts):
            name = forms[order].format(quantity.shown, part)
            if options.degrees and order == 0 and unit == "rad":
                yield Column(name, np.degrees(flat[:, c]), "deg", quantity.shown)
            else:
                yield Column(name, flat[:, c], unit + per, quantity.shown)


def dataset(motion: MotionModel) -> Any:
    """See `Motion.to_xarray`."""
    try:
        import xarray as xr
    except ImportError as error:  # pragma: no cover
        message = "to_xarray needs xarray: pip install assur[xarray]"
        raise ImportError(message) from error
    designs, drivers = len(motion.mechanism.shape), motion.driver_count
    rows = ["design"] if designs == 1 else [f"design{axis}" for axis in range(designs)]
    rows += ["position"] * (len(motion.shape) - designs)
    angles = driven_angles(motion.mechanism)
    named: dict[str, Any] = {}
    units = ["rad" if angle else "m" for angle in angles]
    taken = {"q", "status", *rows, "component"}
    for quantity in _quantities(motion, taken):
        unit = "rad" if quantity.kind == "link" else "m"
        point = ["component"] if quantity.kind == "joint" else []
        for order, array in enumerate(quantity.analogues.arrays):
            by = [f"driver{k}" for k in range(order)] if drivers > 1 else []
            clashes = quantity.kind == "joint" and quantity.shown in taken
            shown = f"joint {quantity.shown}" if clashes else quantity.shown
            name = f"{shown}.d{order}" if order else shown
            per = f"/{units[0]}" * order if drivers == 1 else "/unit of the driver" * order
            named[name] = ([*rows, *point, *by], array, {"units": unit + per})
    q_rows = rows if motion.request.per_design else rows[designs:]
    q_units = {"units": units[0] if drivers == 1 else ", ".join(units)}
    coordinates: dict[str, Any] = {
        "q": ([*q_rows, *(["driver"] if drivers > 1 else [])], motion.q, q_units),
        "status": (rows, motion.status),
        "component": ("component", ["x", "y"]),
    }
    if motion.kept is not None and designs:
        coordinates["design"] = ("design", motion.kept)
    names, values = motion.mechanism.core.dimension_names, motion.mechanism.values
    for name, value in zip(names, values, strict=True):
        if designs and (value != value.flat[:1]).any():
            coordinates[name] = (rows[:designs], value)
    return xr.Dataset(named, coordinates, {"mechanism": motion.mechanism.core.formula})
