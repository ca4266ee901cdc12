"""The implementation of ``Mechanism.assemblies``."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._callers import level_of_caller
from assur._validate import checked_threads
from assur.errors import AssurWarning, InputError
from assur.kinematics.assembly import Assemblies, Assembly, joints_that_differ
from assur.kinematics.model import Place, with_values
from assur.kinematics.solve_arguments import checked_coordinates

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur.kinematics.assembly import FoundAssemblies
    from assur.kinematics.model import MechanismModel


def assemblies(mechanism: MechanismModel, q: npt.ArrayLike, threads: int | None = None) -> Any:
    """See `Mechanism.assemblies`."""
    array, positions, per_design = checked_coordinates(mechanism, q)
    if not np.isfinite(array).all():
        message = f"q = {short(q)}: a finite coordinate is needed"
        raise InputError(message, value=float(array[~np.isfinite(array)][0]))
    drivers = mechanism.driver_count
    answers = mechanism.core.assemblies(
        mechanism.values.ravel(), array.ravel(), per_design, checked_threads(threads)
    )
    shape = (*mechanism.shape, *positions)
    rows = np.broadcast_to(array if drivers > 1 else array[..., None], (*shape, drivers)).reshape(
        -1, drivers
    )
    designs = np.moveaxis(mechanism.values, 0, -1).reshape(-1, len(mechanism.values))
    each = max(len(answers) // max(len(designs), 1), 1)
    if not answers and shape:
        # No positions, or no designs.
        empty: Any = []
        for size in reversed(shape[:-1]):
            empty = [list(empty) for _ in range(size)]
        return empty
    lists: list[Any] = []
    for index, (answer, row) in enumerate(zip(answers, rows.tolist(), strict=True)):
        design = (
            mechanism if not mechanism.shape else with_values(mechanism, designs[index // each])
        )
        lists.append(_named(design, tuple(row), answer))
    for size in reversed(shape[1:]):
        lists = [lists[i : i + size] for i in range(0, len(lists), size)]
    return lists if shape else lists[0]


def _named(mechanism: MechanismModel, q: tuple[float, ...], answer: FoundAssemblies) -> Assemblies:
    count = answer["complex_count"]
    shown = joints_that_differ(mechanism.joint_names, answer["assemblies"])
    named = [
        Assembly._found(Place(mechanism, q, numbers), count, shown)
        for numbers in answer["assemblies"]
    ]
    if not answer["is_complete"]:
        message = f"assemblies at q = {q}: the list may be incomplete: {answer['failures'][0]}"
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
    return Assemblies(named, count, answer["failures"], answer["is_complete"])
