"""Forces of loads on moving links, along the rows of ``reactions`` and ``run``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.dynamics.forces.load_forces import loads_of
from assur.dynamics.loads.loads import Force

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.forces.reactions import Reactions
    from assur.dynamics.machine import Machine


def applied_forces(machine: Machine, solved: Reactions) -> tuple[list[dict[str, Any]], Float]:
    """Return which load acts on which link, and place and force, [row][of them][x, y, Fx, Fy]."""
    rows = np.size(solved.status)
    names: list[dict[str, Any]] = []
    columns: list[Float] = []
    for force in loads_of(solved):
        # A load that pulls at the ground moves nothing.
        is_anchor = force.link == "ground" and not isinstance(machine.loads[force.load], Force)
        if force.place is None or is_anchor or not np.any(force.force):
            continue
        names.append({"load": force.load, "on": force.link, "joint": force.joint})
        columns.append(np.concatenate([force.place, force.force], axis=-1).reshape(rows, 4))
    return names, np.stack(columns, axis=1) if columns else np.zeros((rows, 0, 4))
