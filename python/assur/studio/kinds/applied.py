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


def applied_forces(machine: Machine, found: Reactions) -> tuple[list[dict[str, Any]], Float]:
    """Return which load acts on which link, and place and force, [row][of them][x, y, Fx, Fy]."""
    rows = np.size(found.status)
    names: list[dict[str, Any]] = []
    columns: list[Float] = []
    for one in loads_of(found):
        # What pulls at the ground moves nothing.
        is_anchor = one.link == "ground" and not isinstance(machine.loads[one.load], Force)
        if one.place is None or is_anchor or not np.any(one.force):
            continue
        names.append({"load": one.load, "on": one.link, "joint": one.joint})
        columns.append(np.concatenate([one.place, one.force], axis=-1).reshape(rows, 4))
    return names, np.stack(columns, axis=1) if columns else np.zeros((rows, 0, 4))
