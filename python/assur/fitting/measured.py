"""Candidates of a search, measured and proved by the solver."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from assur.errors import AssurError
from assur.fitting.condition import Condition
from assur.fitting.distance import chamfer, nearest, ordered
from assur.fitting.linkage import LinkageFit
from assur.fitting.naming import mechanism_of
from assur.fitting.proof import path_coordinates, prove
from assur.fitting.sensitivity import TOLERANCE, perturbed_errors

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur._arrays import Float
    from assur.fitting.proof import Proof
    from assur.fitting.target import PathTarget
    from assur.fitting.wanted import Wanted
    from assur.kinematics.mechanism import Mechanism

# What rounding may take from a condition, as a part of it.
ROUNDING = 1e-9
# Linkages whose joints differ by less than this part of their extent are variants of one.
ALIKE = 0.05
# A crank alone draws a circle: it answers a path that is one, to this error.
CIRCLE = 0.02


# Joints with their places, links, the crank's turn over the path, the objective.
Found: TypeAlias = tuple[list[tuple[str, float, float]], list[tuple[str, list[str]]], float, float]


class Spent(NamedTuple):
    """What a search has taken so far: time in s, and evaluations."""

    elapsed: float
    evaluations: int


def measured(
    found: Iterable[Found], target: PathTarget, wanted: Wanted, spent: Spent
) -> tuple[list[LinkageFit], int]:
    """Return the different candidates as the solver sees them, and how many miss a condition.

    Of variants of one linkage the first is kept that misses none.
    """
    fits: list[LinkageFit] = []
    rejected = 0
    for joints, links, arc, _ in found:
        try:
            drawn = [(name, target.unit * x, target.unit * y) for name, x, y in joints]
            mechanism = mechanism_of((drawn, links), target.joint)
            if any(_are_alike(mechanism, fit, target) for fit in fits):
                continue
            proof = prove(mechanism, target)
        except AssurError:
            # What the solver refuses is no linkage.
            proof = None
        conditions = () if proof is None else _conditions(mechanism, proof, arc, target, wanted)
        if proof is None or not all(map(_holds, conditions)):
            rejected += 1
            continue
        fit = _fit(mechanism, proof, arc, target, (wanted, spent, conditions))
        if mechanism.assembly or fit.error <= CIRCLE:
            fits.append(fit)
        else:
            rejected += 1
    return fits, rejected


def _fit(
    mechanism: Mechanism,
    proof: Proof,
    arc: float,
    target: PathTarget,
    of: tuple[Wanted, Spent, tuple[Condition, ...]],
) -> LinkageFit:
    wanted, spent, conditions = of
    q = path_coordinates(mechanism, arc)
    curve = target.framed(mechanism.solve(q, order=0).joint(target.joint).value)
    at = nearest(target.framed(target.points), curve)
    sensitivities = perturbed_errors(mechanism, arc, target, TOLERANCE)
    return LinkageFit(
        mechanism=mechanism,
        error=chamfer(curve, target.corners),
        ordered_error=ordered(curve, target.corners, target.closed),
        q=_frozen(q[at.segment] + at.part * (q[1] - q[0])),
        arc=arc,
        full_rotation=True,
        transmission_angle=proof.apex,
        extent=proof.extent,
        sensitivity=max(sensitivities.values()),
        sensitivities=sensitivities,
        joints=len(mechanism.joint_names),
        seed=wanted.seed,
        elapsed=spent.elapsed,
        evaluations=spent.evaluations,
        _conditions=conditions,
        _target=target,
    )


def _conditions(
    mechanism: Mechanism, proof: Proof, arc: float, target: PathTarget, wanted: Wanted
) -> tuple[Condition, ...]:
    count = len(mechanism.joint_names)
    apex = "apex angle" if proof.flattest is None else f"apex angle at {proof.flattest}"
    of_path = () if target.closed else (Condition("arc", abs(arc), wanted.min_arc, True, "°"),)
    return (
        Condition("joints", count, wanted.joints, False),
        Condition(apex, proof.apex, wanted.min_apex_angle, True, "°"),
        Condition(f"extent by {proof.farthest}", proof.extent, wanted.frame, False),
        *of_path,
    )


def _holds(condition: Condition) -> bool:
    slack = ROUNDING * abs(condition.limit)
    if condition.is_least:
        return condition.value >= condition.limit - slack
    return condition.value <= condition.limit + slack


def _are_alike(mechanism: Mechanism, fit: LinkageFit, target: PathTarget) -> bool:
    """Whether a linkage has the structure of another, and all joints nearly at its places."""
    if dict(mechanism.links) != dict(fit.mechanism.links):
        return False
    one, two = (np.array([*own.joints.values()]) for own in (mechanism, fit.mechanism))
    apart = np.sqrt(((target.framed(one) - target.framed(two)) ** 2).sum(axis=1))
    return bool(apart.max() < ALIKE * fit.extent)


def _frozen(array: Float) -> Float:
    array.flags.writeable = False
    return np.asarray(array)
