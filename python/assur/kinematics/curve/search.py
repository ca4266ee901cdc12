"""Finding the branches of a configuration curve, the folds between them and the circuits."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from assur._validate import whole_number
from assur.errors import InputError
from assur.kinematics.curve.branches import Branches
from assur.kinematics.curve.circuits import circuits_of
from assur.kinematics.curve.curve import ConfigurationCurve
from assur.kinematics.curve.fan import Fan, around_drawing, look_within_intervals
from assur.kinematics.curve.folds import Folds
from assur.kinematics.model import as_made

if TYPE_CHECKING:
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.curve.elements import Fold
    from assur.kinematics.model import MechanismModel

# A fan of this size takes minutes and 100 MB; its time grows faster than its positions.
MOST_POSITIONS = 100_000
# Halvings of the fan where the ends of branches do not explain a change of the count.
MOST_HALVINGS = 12


def configuration_curve(mechanism: MechanismModel, positions: int) -> ConfigurationCurve:
    """See `Mechanism.configuration_curve`."""
    if mechanism.shape:
        message = f"configuration_curve() is for one design, this is a batch {mechanism.shape}"
        raise InputError(message)
    require_one_driver(mechanism, "configuration_curve")
    positions = whole_number(positions, "positions", 2, MOST_POSITIONS)
    known = Branches(mechanism)
    # The drawing's own circuit may be narrower than the fan.
    known.look_at(float(np.ravel(mechanism.q0)[0]))
    fan, folds = Fan(known), Folds(known)
    fan.look_at(around_drawing(mechanism, positions, known.is_angle))
    if not look_within_intervals(known):
        fan.look_where_known(positions)
    pairs = folds.find()
    for _ in range(MOST_HALVINGS):
        gaps = fan.gaps()
        if not gaps:
            break
        fan.look_at(gaps)
        pairs = folds.find()
    return _curve_of(known, pairs, fan.q)


def curve_through(
    mechanism: MechanismModel, places: list[tuple[float, Assembly]]
) -> ConfigurationCurve:
    """Return the circuits of a design that go through positions, as they were found."""
    known = Branches(mechanism)
    for q, assembly in places:
        known.add(assembly, q)
    return _curve_of(known, Folds(known).find(), [])


def require_one_driver(mechanism: MechanismModel, what: str) -> None:
    """Refuse a mechanism with several drivers."""
    if mechanism.driver_count > 1:
        message = f"{what}() is for one driver; this mechanism has {mechanism.driver_count}"
        raise InputError(message)


def _curve_of(known: Branches, folds: list[Fold], fan: list[float]) -> ConfigurationCurve:
    branches = list(known.branches)
    for index, fold in enumerate(folds):
        for number in fold.branches:
            low, high = branches[number].folds
            ends = (low, index) if fold.is_greatest else (index, high)
            branches[number] = replace(branches[number], folds=ends)
    circuits = circuits_of(branches, folds)
    return ConfigurationCurve(
        tuple(branches), tuple(folds), tuple(circuits), np.array(fan), as_made(known.mechanism)
    )
