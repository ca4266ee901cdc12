"""Targets of a fit as the core takes them: numbers, weights, timing, what is free."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from assur._arrays import flag, not_negative, real_array, real_number, short
from assur._validate import checked_name
from assur.description.dotted_names import split_name
from assur.errors import InputError
from assur.sweeps.terms import Metric
from assur.target import Function, Near, Path, Poses

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism

# Sizes of which squares are numbers, m.
LEAST_SIZE, MOST_SIZE = 1e-60, 1e60
# Kind, name, component, weight, what it is to be, whether whole turns do not matter.
Number: TypeAlias = tuple[str, str, int, float, list[float], bool]
# Numbers, weights, timing, coordinates, whether it is closed, what is free.
Parts: TypeAlias = tuple[list[Number], list[float], str, list[float], bool, str]


@dataclass(frozen=True, slots=True, eq=False)
class Goal:
    """A target that was checked.

    Attributes
    ----------
    name : str
        What it is of.
    parts : Parts
        As the core takes it.
    count : int
        Its positions.
    radius : float
        Root mean square of what is wanted, from its mean: m, or rad of a function of an angle.
    in_radii : bool
        Whether its error is over that.
    goes_round : bool
        Whether the driver is to turn fully unless the user says otherwise.
    """

    name: str
    parts: Parts
    count: int
    radius: float
    in_radii: bool
    goes_round: bool


def checked_goals(
    m: Mechanism, targets: Any, timing: Any, closed: Any, similarity: Any
) -> tuple[list[Goal], dict[str, Near]]:
    """Return the targets, those of metrics apart; errors name the target and what to do."""
    if not isinstance(targets, Mapping) or not targets:
        message = f"targets is {short(targets)}: a mapping is needed, {{'P': points}}"
        raise InputError(message)
    goals: list[Goal] = []
    metrics: dict[str, Near] = {}
    for name, target in targets.items():
        checked_name(name, "targets")
        if isinstance(target, Near):
            metrics[str(name)] = _near(str(name), target)
            continue
        known = _known(m, name, target)
        if isinstance(known, Path):
            given = {"timing": timing, "closed": closed}
            said = {key: value for key, value in given.items() if value is not None}
            if similarity is not False:
                said["similarity"] = similarity
            goals.append(_path(m, name, replace(known, **said)))
        elif isinstance(known, Function):
            goals.append(_function(m, name, known))
        else:
            goals.append(
                _poses(m, name, known if timing is None else replace(known, timing=timing))
            )
    _refuse_unused(goals, timing, closed, similarity)
    return goals, metrics


def _refuse_unused(goals: list[Goal], timing: Any, closed: Any, similarity: Any) -> None:
    """Refuse options of paths and poses where there are none."""
    kinds = {goal.parts[0][0][0] for goal in goals if goal.in_radii}
    for option, is_given, of in (
        ("timing", timing is not None, {"joint", "origin"}),
        ("closed", closed is not None, {"joint"}),
        ("similarity", similarity is not False, {"joint"}),
    ):
        if is_given and not kinds & of:
            what = "paths or poses" if "origin" in of else "paths"
            message = f"{option} is for {what}, and no target is one: leave it out"
            raise InputError(message)


def _known(m: Mechanism, name: str, target: Any) -> Path | Function | Poses:
    """Return a target as one of the classes; arrays alone are read by what they are of."""
    if isinstance(target, Path | Function | Poses):
        return target
    if isinstance(target, tuple) and len(target) == 2 and name not in m.joint_names:
        return Function(*target)
    if name in m.joint_names:
        return Path(target)
    if name in m.links:
        return Poses(target)
    joint, what = split_name(name) if "." in name else (name, "")
    message = (
        f"targets[{name!r}]: points (N, 2) for a joint, a pair (coordinates, values) for a link's "
        "angle, a slide or a coordinate like 'P.x', poses (N, 3) for a link"
    )
    if joint not in m.joint_names and name not in m.slides:
        message = f"targets: there is no {name!r}; joints are {short(list(m.joint_names))}"
    raise InputError(message, joint=joint if what else None)


def _path(m: Mechanism, name: str, path: Path) -> Goal:
    what = f"targets[{name!r}]"
    if name not in m.joint_names:
        message = f"{what}: a path is of a joint; joints are {short(list(m.joint_names))}"
        raise InputError(message)
    points = _rows(path.points, 2, what, "points (N, 2), x and y in m")
    same_ends = bool((points[0] == points[-1]).all()) and len(points) > 2
    closed = same_ends if path.closed is None else flag(path.closed, "closed")
    if closed and same_ends and path.timing is None:
        points = points[:-1]
    radius = _radius(points, what)
    weights = _weights(path.weights, path.weight, len(points), what)
    when, q = _timing(path.timing, path.phase, path.ordered, len(points), what)
    free = {False: "none", True: "similarity", "place": "place"}
    asked: object = path.similarity
    if not isinstance(asked, bool | str) or asked not in free:
        message = f"similarity is {short(path.similarity)}: True, False or 'place' is needed"
        raise InputError(message)
    numbers: list[Number] = [
        ("joint", name, axis, 1.0, points[:, axis].tolist(), False) for axis in (0, 1)
    ]
    parts = (numbers, weights, when, q, closed, free[path.similarity])
    return Goal(name, parts, len(points), radius, True, True)


def _function(m: Mechanism, name: str, function: Function) -> Goal:
    what = f"targets[{name!r}]"
    theta = np.atleast_1d(real_array(function.coordinate, f"{what}: coordinates"))
    value = np.atleast_1d(real_array(function.value, f"{what}: values"))
    if theta.ndim != 1 or theta.shape != value.shape:
        message = f"{what}: coordinates {theta.shape} and values {value.shape}: (N,) each is needed"
        raise InputError(message)
    _finite(np.column_stack([theta, value]), what)
    if len(theta) < 2:
        message = f"{what} has {len(theta)} positions: at least 2 are needed"
        raise InputError(message)
    kind, of, axis = _output(m, name, what)
    weights = _weights(function.weights, function.weight, len(theta), what)
    when = "phase" if flag(function.phase, "phase") else "fixed"
    scale, offset = flag(function.scale, "scale"), flag(function.offset, "offset")
    free = " and ".join(["scale"] * scale + ["offset"] * offset) or "none"
    is_angle = kind == "angle"
    parts = (
        [(kind, of, axis, 1.0, value.tolist(), is_angle)],
        weights,
        when,
        theta.tolist(),
        False,
        free,
    )
    return Goal(name, parts, len(theta), float(np.std(value)), False, False)


def _output(m: Mechanism, name: str, what: str) -> tuple[str, str, int]:
    """Return the kind, the name and the component of an output."""
    if name in m.slides:
        return "slide", name, 0
    if name in m.links:
        return "angle", name, 0
    joint, axis = split_name(name) if "." in name else (name, "")
    if joint in m.joint_names and axis in ("x", "y"):
        return "joint", joint, int(axis == "y")
    message = (
        f"{what}: there is no such output; links are {short(list(m.links))}, slides "
        f"{short(list(m.slides))}, coordinates of joints are written 'P.x'"
    )
    raise InputError(message)


def _poses(m: Mechanism, name: str, target: Poses) -> Goal:
    what = f"targets[{name!r}]"
    if name not in m.links or not m.links[name]:
        message = f"{what}: poses are of a link with joints; links are {short(list(m.links))}"
        raise InputError(message)
    poses = _rows(target.poses, 3, what, "poses (N, 3), x, y in m and the angle in rad")
    if target.length is None:
        length = radius = _radius(poses[:, :2], what)
    else:
        length = not_negative(target.length, "length")
        radius = length
    weights = _weights(target.weights, target.weight, len(poses), what)
    when, q = _timing(target.timing, target.phase, False, len(poses), what)
    numbers: list[Number] = [
        ("origin", name, axis, 1.0, poses[:, axis].tolist(), False) for axis in (0, 1)
    ]
    numbers.append(("angle", name, 0, length, poses[:, 2].tolist(), True))
    free = "turned" if flag(target.turned, "turned") else "none"
    parts = (numbers, weights, when, q, False, free)
    return Goal(name, parts, len(poses), radius, True, False)


def _rows(values: Any, width: int, what: str, needed: str) -> Float:
    rows = real_array(values, what)
    if rows.ndim != 2 or rows.shape[1] != width:
        message = f"{what} has the shape {rows.shape}: {needed}, are needed"
        raise InputError(message)
    if len(rows) < 2:
        message = f"{what} has {len(rows)} rows: at least 2 are needed"
        raise InputError(message)
    _finite(rows, what)
    return rows


def _finite(rows: Float, what: str) -> None:
    is_finite = np.isfinite(rows).all(axis=1)
    if not is_finite.all():
        wrong = int(is_finite.argmin())
        message = (
            f"{what}, row {wrong} of {len(rows)} is {short(tuple(rows[wrong].tolist()))}: finite "
            "numbers are needed; leave it out"
        )
        raise InputError(message)


def _radius(points: Float, what: str) -> float:
    """Return the root mean square distance of points from their centroid."""
    with np.errstate(over="ignore"):
        extent = float(np.ptp(points, axis=0).max())
    if extent > 0.0 and not LEAST_SIZE < extent < MOST_SIZE:
        message = (
            f"{what} is {extent:g} m long or high: from {LEAST_SIZE:g} to {MOST_SIZE:g} m is needed"
        )
        raise InputError(message, value=extent)
    radius = float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))
    if not radius > 0.0:
        message = f"{what}: all points are {short(tuple(points[0].tolist()))}: they must differ"
        raise InputError(message)
    return radius


def _weights(weights: Any, weight: Any, count: int, what: str) -> list[float]:
    """Return the square roots' weights: residuals count so many times."""
    whole = not_negative(weight, f"{what}: weight")
    if whole == 0.0:
        message = f"{what}: weight is 0: leave the target out"
        raise InputError(message)
    if weights is None:
        return [whole] * count
    each = np.atleast_1d(real_array(weights, f"{what}: weights"))
    if each.shape != (count,) or not (each >= 0.0).all():
        message = f"{what}: weights has the shape {each.shape}; {count} numbers from 0 are needed"
        raise InputError(message)
    if not each.any():
        message = f"{what}: all {count} weights are 0: one at least must be more"
        raise InputError(message)
    return [float(whole * one) for one in each]


def _timing(
    timing: Any, phase: Any, ordered: Any, count: int, what: str
) -> tuple[str, list[float]]:
    """Return the word for the timing, and the coordinates."""
    if timing is None:
        if flag(phase, "phase"):
            message = f"{what}: phase=True is for a timing, which is missing"
            raise InputError(message)
        return ("ordered" if flag(ordered, "ordered") else "free"), []
    q = np.atleast_1d(real_array(timing, f"{what}: timing"))
    if q.shape != (count,) or not np.isfinite(q).all():
        message = f"{what}: timing has the shape {q.shape}; {count} finite coordinates are needed"
        raise InputError(message)
    return ("phase" if flag(phase, "phase") else "fixed"), q.tolist()


def _near(name: str, target: Near) -> Near:
    """Return the target of a metric, with its unit: what counts as a miss of 1."""
    metric: object = target.metric
    if not isinstance(metric, Metric):
        message = f"targets[{name!r}]: {short(metric)} is no metric"
        raise InputError(message)
    value = real_number(target.value, f"targets[{name!r}]")
    if target.unit is None:
        return Near(metric, value, unit=abs(value) or 1.0)
    unit = not_negative(target.unit, f"targets[{name!r}]: unit")
    if unit == 0.0:
        message = f"targets[{name!r}]: unit is 0: a positive one is needed"
        raise InputError(message)
    return Near(metric, value, unit=unit)
