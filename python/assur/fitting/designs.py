"""Designs of a fit, measured and proved by the solver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from assur.errors import AssurError, FitError
from assur.fitting.condition import Condition
from assur.fitting.design import DesignFit
from assur.fitting.misses import misses, nearest_misses
from assur.fitting.proof import least_apex
from assur.fitting.sensitivity import TOLERANCE, changed_lengths
from assur.kinematics.assembly import Assembly
from assur.sweeps.sweep import sweep

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.fitting.goals import Goal
    from assur.fitting.limits import Limit
    from assur.fitting.variables import Variables
    from assur.kinematics.mechanism import Mechanism
    from assur.target import Near

# Positions of a travel at which metrics are measured again, and those of changed designs.
TRAVEL, CHANGED = 1440, 361
# What rounding may take from a condition, as a part of it.
ROUNDING = 1e-9
# The core's sum of squares and the solver's agree to this part.
SAME = 1e-6

# Dimensions, index of the assembly, coordinates, numbers of targets, sum of squares, misses.
Found: TypeAlias = tuple[list[float], int, list[float], list[float], float, list[float]]


@dataclass(frozen=True, slots=True)
class Asked:
    """What a fit was asked for."""

    mechanism: Mechanism
    goals: list[Goal]
    metrics: dict[str, Near]
    limits: list[Limit]
    variables: Variables
    assemblies: list[list[tuple[str, int]]]
    full_rotation: bool
    robust: float | None
    seed: int


def measured_designs(
    found: Sequence[Found], asked: Asked, spent: tuple[float, int]
) -> tuple[list[DesignFit], int]:
    """Return the designs that keep all conditions, the best first, and how many do not."""
    fits: list[tuple[float, DesignFit]] = []
    rejected = 0
    for one in found:
        try:
            fit = _measured(one, asked, spent)
        except AssurError:
            # What the solver refuses is no design.
            fit = None
        if fit is None:
            rejected += 1
            continue
        rank = fit.error
        if asked.robust is not None:
            rank = max(rank, *_sensitivities(fit.mechanism, one, asked, asked.robust).values())
        fits.append((rank, fit))
    fits.sort(key=lambda ranked: ranked[0])
    return [fit for _, fit in fits], rejected


def _measured(one: Found, asked: Asked, spent: tuple[float, int]) -> DesignFit | None:
    dimensions, assembly, q, free, total, _ = one
    names = list(asked.mechanism.dimensions)
    mechanism = asked.mechanism.with_dimensions(dict(zip(names, dimensions, strict=True)))
    signs = dict(asked.assemblies[assembly])
    if signs:
        mechanism = mechanism.with_assembly(Assembly(signs))
    travel = _travel(mechanism, q, asked)
    if travel is None:
        return None
    positions, errors, square, count = {}, {}, 0.0, 0
    for goal, own_q, own_free in _parts(asked.goals, q, free):
        away = misses(mechanism, goal, own_q, own_free)
        own_q.flags.writeable = False
        positions[goal.name] = own_q
        scale = goal.radius if goal.in_radii else 1.0
        errors[goal.name] = float(np.sqrt((away**2).mean())) / scale
        square += float(((np.asarray(goal.parts[1]) * away) ** 2).sum())
        count += goal.count
    metrics = {f"limit {index}": limit.condition.metric for index, limit in enumerate(asked.limits)}
    metrics |= {f"target {name}": near.metric for name, near in asked.metrics.items()}
    values = sweep(mechanism, {}, travel, metrics=metrics) if metrics else {}
    for name, near in asked.metrics.items():
        unit = near.unit or abs(near.value) or 1.0
        errors[name] = abs(float(values[f"target {name}"]) - near.value) / unit
        square += errors[name] ** 2
    conditions = [
        limit.shown(float(values[f"limit {index}"])) for index, limit in enumerate(asked.limits)
    ]
    if not all(map(_holds, conditions)) or abs(square - total) > SAME * total + ROUNDING:
        return None
    sensitivities = _sensitivities(mechanism, one, asked, TOLERANCE)
    error = float(np.sqrt((np.array([*errors.values()]) ** 2).mean()))
    freedom = asked.goals[0].parts[5] if asked.goals else ""
    return DesignFit(
        mechanism=mechanism,
        error=error,
        errors=errors,
        q=next(iter(positions.values()), np.zeros(0)),
        positions=positions,
        full_rotation=asked.full_rotation or bool(mechanism.limits().full_rotation),
        transmission_angle=least_apex(mechanism, travel)[0] if mechanism.assembly else np.nan,
        sensitivity=max(sensitivities.values(), default=error),
        sensitivities=sensitivities,
        placement=tuple(free[-4:]) if freedom == "similarity" else None,
        seed=asked.seed,
        elapsed=spent[0],
        evaluations=spent[1],
        _conditions=(*conditions, *_bounds(mechanism, asked.variables)),
    )


def _parts(goals: list[Goal], q: list[float], free: list[float]) -> Any:
    """Yield each target with its coordinates and its own numbers."""
    sizes = {"none": 0, "turned": 1, "place": 3, "similarity": 4}
    sizes |= {"scale": 1, "offset": 1, "scale and offset": 2}
    first = extra = 0
    for goal in goals:
        size = sizes[goal.parts[5]] + (goal.parts[2] == "phase")
        yield goal, np.array(q[first : first + goal.count]), free[extra : extra + size]
        first += goal.count
        extra += size


def _travel(mechanism: Mechanism, q: list[float], asked: Asked) -> Float | None:
    """Return positions over the travel; None if the limits say that there is none."""
    limits = mechanism.limits()
    if asked.full_rotation:
        if not limits.full_rotation or limits.period != 1:
            return None
        return np.asarray(np.linspace(0.0, 2.0 * np.pi, TRAVEL, endpoint=False))
    if not q:
        return None
    low, high = min(q), max(q)
    turn = 2.0 * np.pi if limits.period is not None or not mechanism.slides else 0.0
    for interval in np.atleast_2d(limits.intervals):
        first, last = interval[0], interval[1]
        shift = turn * np.ceil((first - low) / turn) if turn and np.isfinite(first) else 0.0
        if first <= low + shift and high + shift <= last:
            return np.asarray(np.linspace(low, high, TRAVEL))
    return None


def _sensitivities(
    mechanism: Mechanism, one: Found, asked: Asked, tolerance: float
) -> dict[str, float]:
    """Return for every length the greater error after it has changed by a part of itself."""
    _, _, q, free, _, _ = one
    if not asked.goals:
        return {}
    names, designs = changed_lengths(mechanism, tolerance)
    squares = []
    for goal, own_q, own_free in _parts(asked.goals, q, free):
        if goal.parts[2] in ("ordered", "free"):
            travel = np.linspace(0.0, 2.0 * np.pi, CHANGED)
            if not asked.full_rotation:
                travel = np.linspace(own_q.min(), own_q.max(), CHANGED)
            away = nearest_misses(designs, goal, travel, own_free)
        else:
            away = misses(designs, goal, own_q, own_free)
        scale = goal.radius if goal.in_radii else 1.0
        squares.append((away**2).mean(axis=-1) / scale**2)
    errors = np.sqrt(np.mean(squares, axis=0))
    if asked.full_rotation:
        errors[~np.asarray(designs.limits().full_rotation)] = np.inf
    errors[np.isnan(errors)] = np.inf
    worst = np.maximum(*errors.reshape(2, -1))
    order = np.argsort(-worst, kind="stable")
    return {names[index]: float(worst[index]) for index in order}


def _bounds(mechanism: Mechanism, variables: Variables) -> list[Condition]:
    """Return the bounds at which dimensions are."""
    reached = []
    for name, (low, high) in variables.bounds.items():
        value = float(mechanism.dimensions[name])
        for limit, is_least in ((low, True), (high, False)):
            if np.isfinite(limit) and abs(value - limit) <= SAME * abs(limit):
                reached.append(Condition(name, value, limit, is_least))
    return reached


def _holds(condition: Condition) -> bool:
    slack = ROUNDING * abs(condition.limit)
    if condition.is_least:
        return condition.value >= condition.limit - slack
    return condition.value <= condition.limit + slack


def no_design(
    nearest: Found | None, asked: Asked, rejected: int, spent: tuple[float, int]
) -> FitError:
    """Return the error that says what is in the way."""
    tried = f"{spent[1]} designs were evaluated in {spent[0]:.3g} s"
    if nearest is not None:
        missed = [
            f"{limit.condition!r} by {miss * limit.unit:.3g}"
            for limit, miss in zip(asked.limits, nearest[5], strict=False)
            if miss > 0.0
        ]
        what = ", ".join(missed) or "a least transmission angle of 0.02 rad"
        message = f"no design keeps all conditions: {tried}; the best still misses {what}"
        hint = "relax what is missed, widen the bounds, or go on for longer"
    elif rejected:
        message = f"no design passes the solver's proof: {tried}, {rejected} were refused"
        hint = "ask for less travel, or take other bounds"
    elif asked.full_rotation:
        message = f"no design within the bounds turns fully and meets the targets in order: {tried}"
        hint = "widen the bounds, take full_rotation=False, or targets with ordered=False"
    else:
        message = f"no design within the bounds reaches all positions without a stop: {tried}"
        hint = "widen the bounds or vary more dimensions"
    return FitError(f"{message}; {hint}", hint=hint)
