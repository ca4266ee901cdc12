"""Motions as tables and as xarray's Datasets."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import flag
from assur._table import Column, angle_column, coordinate_columns, design_columns, in_degrees
from assur._validate import refuse_without_speed
from assur.description.dotted_names import unit_of
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt
    import xarray as xr

    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel
    from assur.kinematics.motion_model import MotionModel
    from assur.kinematics.quantity import Analogues

# Names of a joint's components, a joint, an angle and a slide: value, velocity, acceleration, jerk.
POINT = ("{}.{}", "{}.v{}", "{}.a{}", "{}.j{}")
VECTOR = ("{}", "{}.v", "{}.a", "{}.j")
ANGLE = ("{}", "{}.omega", "{}.alpha", "{}.jerk")
SLIDE = VECTOR


class Options(NamedTuple):
    """What a table of a motion shows."""

    speed: npt.ArrayLike | None = None
    acceleration: npt.ArrayLike = 0.0
    jerk: npt.ArrayLike = 0.0
    degrees: bool = False
    moving: bool = False


def check_options(options: Options) -> None:
    """Refuse what is no flag, and rates without a speed."""
    flag(options.degrees, "degrees")
    flag(options.moving, "moving")
    refuse_without_speed(
        options.speed, "speed", acceleration=options.acceleration, jerk=options.jerk
    )


class _Quantity(NamedTuple):
    kind: str
    name: str
    shown: str
    analogues: Analogues


def motion_columns(motion: MotionModel, options: Options) -> list[Column]:
    """Return the columns of a motion's table, rows over designs and positions."""
    check_options(options)
    columns = row_columns(motion.mechanism, motion.q, motion.status, options.degrees, motion.kept)
    taken = {column.name for column in columns}
    for quantity in _quantities(motion, taken):
        if options.moving and not _moves(quantity.analogues):
            continue
        if options.speed is None:
            columns.extend(_analogues(motion, quantity, options.degrees))
        else:
            columns.extend(_velocities(motion, quantity, options))
    return columns


def row_columns(
    mechanism: MechanismModel,
    q: Float,
    status: npt.NDArray[np.uint8],
    degrees: bool,
    kept: npt.NDArray[np.intp] | None = None,
) -> list[Column]:
    """Return what says which row it is: design, its dimensions, coordinates, status."""
    shape, designs = status.shape, len(mechanism.shape)
    columns = design_columns(shape, designs, kept)
    columns += dimension_columns(mechanism, shape, degrees)
    columns += coordinate_columns(q, driven_angles(mechanism), shape, degrees)
    return [*columns, Column("status", status.reshape(-1), "", None)]


def dimension_columns(
    mechanism: MechanismModel, shape: tuple[int, ...], degrees: bool
) -> list[Column]:
    """Return the dimensions that differ between designs (first axes of a shape) for each row."""
    columns = []
    for name, values in differing_dimensions(mechanism).items():
        each = values.reshape(values.shape + (1,) * (len(shape) - values.ndim))
        columns.append(dimension_column(name, np.broadcast_to(each, shape).reshape(-1), degrees))
    return columns


def dimension_column(name: str, values: Float, degrees: bool) -> Column:
    """Return a dimension of designs, rad or deg where it is an angle."""
    unit = unit_of(name)
    return (
        angle_column(name, values, degrees) if unit == "rad" else Column(name, values, unit, None)
    )


def differing_dimensions(mechanism: MechanismModel) -> dict[str, Float]:
    """Return the dimensions that are not the same in all designs of a batch."""
    if not mechanism.shape:
        return {}
    named = zip(mechanism.core.dimension_names, mechanism.values, strict=True)
    return {name: value for name, value in named if (value != value.flat[:1]).any()}


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
    parts = _components(quantity.kind)
    for order, (rate, unit) in enumerate(_rates(motion, quantity, options)):
        flat = rate.reshape(motion.status.size, len(parts))
        for c, part in enumerate(parts):
            name = forms[order].format(quantity.shown, part)
            yield Column(name, flat[:, c], unit, quantity.shown)


def _rates(
    motion: MotionModel, quantity: _Quantity, options: Options
) -> Iterator[tuple[Float, str]]:
    """Value, velocity, acceleration and jerk, as far as the motion has them, with their units."""
    of, speed, acceleration = quantity.analogues, options.speed, options.acceleration
    assert speed is not None
    rates: list[Float] = [of.value]
    if motion.order >= 1:
        rates.append(of.velocity(speed))
    if motion.order >= 2:
        rates.append(of.acceleration(speed, acceleration))
    if motion.order >= 3:
        rates.append(of.jerk(speed, acceleration, options.jerk))
    unit = "rad" if quantity.kind == "link" else "m"
    for order, rate in enumerate(rates):
        if rate.shape != of.value.shape:
            message = (
                f"speed and acceleration give the shape {rate.shape}: a table has one speed at "
                f"each position {motion.shape}"
            )
            raise InputError(message)
        if options.degrees and order == 0 and unit == "rad":
            yield np.degrees(rate), "deg"
        else:
            yield rate, unit + ["", "/s", "/s2", "/s3"][order]


def dataset(motion: MotionModel, options: Options) -> xr.Dataset:
    """See `Motion.to_xarray`."""
    try:
        import xarray as xr
    except ImportError as error:  # pragma: no cover
        message = "to_xarray needs xarray: pip install assur[xarray]"
        raise ImportError(message) from error
    check_options(options)
    designs, drivers = len(motion.mechanism.shape), motion.driver_count
    rows = ["design"] if designs == 1 else [f"design{axis}" for axis in range(designs)]
    rows += ["position"] * (len(motion.shape) - designs)
    named: dict[str, Any] = {}
    taken = {"q", "status", *rows, "component"}
    for quantity in _quantities(motion, taken):
        if options.moving and not _moves(quantity.analogues):
            continue
        point = ["component"] if quantity.kind == "joint" else []
        clashes = quantity.kind == "joint" and quantity.shown in taken
        shown = f"joint {quantity.shown}" if clashes else quantity.shown
        if options.speed is None:
            arrays, by = _derivatives(motion, quantity, options.degrees), ["driver"] * (drivers > 1)
            forms = ("{}", "{}.d1", "{}.d2", "{}.d3")
        else:
            arrays, by = _rates(motion, quantity, options), []
            forms = {"joint": VECTOR, "link": ANGLE, "slide": SLIDE}[quantity.kind]
        for order, (array, unit) in enumerate(arrays):
            axes = [f"{name}{k}" for name in by for k in range(order)]
            named[forms[order].format(shown)] = ([*rows, *point, *axes], array, {"units": unit})
    q_rows = rows if motion.request.per_design else rows[designs:]
    angles = driven_angles(motion.mechanism)
    angle = "deg" if options.degrees else "rad"
    units = [angle if is_angle else "m" for is_angle in angles]
    q = motion.q
    if options.degrees:
        q = np.where(angles if drivers > 1 else angles[0], in_degrees(q), q)
    coordinates: dict[str, Any] = {
        "q": ([*q_rows, *(["driver"] if drivers > 1 else [])], q, {"units": ", ".join(units)}),
        "status": (rows, motion.status),
    }
    if any("component" in axes for axes, _, _ in named.values()):
        coordinates["component"] = ("component", ["x", "y"])
    if motion.kept is not None and designs:
        coordinates["design"] = ("design", motion.kept)
    for name, values in differing_dimensions(motion.mechanism).items():
        column = dimension_column(name, values, options.degrees)
        coordinates[name] = (rows[:designs], column.values, {"units": column.unit})
    return xr.Dataset(named, coordinates, {"mechanism": motion.mechanism.core.formula})


def _derivatives(
    motion: MotionModel, quantity: _Quantity, degrees: bool
) -> Iterator[tuple[Float, str]]:
    """Value and analogues, with their units."""
    angles = driven_angles(motion.mechanism)
    per = ("/rad" if angles[0] else "/m") if len(angles) == 1 else "/unit of the driver"
    unit = "rad" if quantity.kind == "link" else "m"
    for order, array in enumerate(quantity.analogues.arrays):
        if degrees and order == 0 and unit == "rad":
            yield np.degrees(array), "deg"
        else:
            yield array, unit + per * order
