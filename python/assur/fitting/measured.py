"""Candidates of a search, measured and proved by the solver."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur.errors import AssurError
from assur.fitting.condition import Condition
from assur.fitting.distance import chamfer, nearest, ordered
from assur.fitting.found import Fit
from assur.fitting.naming import mechanism_of
from assur.fitting.proof import path_coordinates, prove
from assur.fitting.sensitivity import TOLERANCE, perturbed_errors

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.fitting.naming import Drawn
    from assur.fitting.proof import Proof
    from assur.fitting.target import PathTarget
    from assur.fitting.wanted import Wanted
    from assur.kinematics.mechanism import Mechanism

# What rounding may take from a condition, as a part of it.
ROUNDING = 1e-9


class Spent(NamedTuple):
    """What a search has taken so far: time in s, and evaluations."""

    elapsed: float
    evaluations: int


def measured(
    drawn: Drawn, arc: float, target: PathTarget, wanted: Wanted, spent: Spent
) -> Fit | None:
    """Return a candidate as the solver sees it; None if it misses a condition."""
    try:
        mechanism = mechanism_of(drawn, target.joint)
        proof = prove(mechanism, target)
    except AssurError:
        # What the solver refuses is no linkage.
        return None
    if proof is None:
        return None
    conditions = _conditions(mechanism, proof, arc, target, wanted)
    if not all(map(_holds, conditions)):
        return None
    return _fit(mechanism, proof, arc, target, (wanted, spent, conditions))


def _fit(
    mechanism: Mechanism,
    proof: Proof,
    arc: float,
    target: PathTarget,
    of: tuple[Wanted, Spent, tuple[Condition, ...]],
) -> Fit:
    wanted, spent, conditions = of
    q = path_coordinates(mechanism, arc)
    curve = target.framed(mechanism.solve(q, order=0).joint(target.joint).value)
    at = nearest(target.framed(target.points), curve)
    sensitivities = perturbed_errors(mechanism, arc, target, TOLERANCE)
    return Fit(
        mechanism=mechanism,
        error=chamfer(curve, target.corners),
        ordered_error=ordered(curve, target.corners, target.closed),
        q=_frozen(q[at.segment] + at.part * (q[1] - q[0])),
        arc=arc,
        full_rotation=True,
        transmission_angle=proof.apex,
        extent=proof.extent,
        sensitivity=max(sensitivities.values()),
        sensitivities=MappingProxyType(sensitivities),
        joints=len(mechanism.joint_names),
        seed=wanted.seed,
        elapsed=spent.elapsed,
        evaluations=spent.evaluations,
        _conditions=conditions,
    )


def _conditions(
    mechanism: Mechanism, proof: Proof, arc: float, target: PathTarget, wanted: Wanted
) -> tuple[Condition, ...]:
    count = len(mechanism.joint_names)
    of_path = () if target.closed else (Condition("arc", abs(arc), wanted.min_arc, True, "°"),)
    return (
        Condition("joints", count, wanted.joints, False),
        Condition(f"apex angle at {proof.flattest}", proof.apex, wanted.min_apex_angle, True, "°"),
        Condition(f"extent by {proof.farthest}", proof.extent, wanted.frame, False),
        *of_path,
    )


def _holds(condition: Condition) -> bool:
    slack = ROUNDING * abs(condition.limit)
    if condition.is_least:
        return condition.value >= condition.limit - slack
    return condition.value <= condition.limit + slack


def _frozen(array: Float) -> Float:
    array.flags.writeable = False
    return np.asarray(array)
