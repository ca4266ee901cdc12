"""Forces of loads on moving links, along the rows of ``reactions`` and ``run``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.dynamics.forces.applied_loads import Positions, load_on
from assur.dynamics.loads.loads import Force

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.forces.reactions import Reactions
    from assur.dynamics.machine import Machine
    from assur.kinematics.mechanism import Mechanism


def applied_forces(
    machine: Machine, mechanism: Mechanism, found: Reactions, q: Float, speed: Any, t: Any = 0.0
) -> tuple[list[dict[str, Any]], Float]:
    """Return which load acts on which link, and place and force, [row][of them][x, y, Fx, Fy]."""
    motion = mechanism.solve(q, order=1, on_error="nan")
    count = mechanism.driver_count
    own = np.asarray(q, dtype=float).reshape(-1, count)
    rows = own.shape[0]
    rates = np.broadcast_to(np.asarray(speed, dtype=float).reshape(-1, count), own.shape)
    at = Positions(
        machine, motion, found, own, rates, np.broadcast_to(np.asarray(t, dtype=float), (rows,))
    )
    # Absurd numbers give infinite forces: so they are shown.
    with np.errstate(over="ignore", invalid="ignore"):
        return _acting(at, rows)


def _acting(at: Positions, rows: int) -> tuple[list[dict[str, Any]], Float]:
    names: list[dict[str, Any]] = []
    columns: list[Float] = []
    for index, load in enumerate(at.machine.loads):
        for link in at.motion.mechanism.links:
            # What pulls at the ground moves nothing.
            if link == "ground" and not isinstance(load, Force):
                continue
            for acting in load_on(at, load, link):
                if np.any(acting.couple) or not np.any(acting.force):
                    continue
                names.append({"load": index, "on": link, "joint": acting.joint})
                shape = (rows, 2)
                place = np.broadcast_to(acting.place.reshape(-1, 2), shape)
                columns.append(
                    np.concatenate([place, np.broadcast_to(acting.force, shape)], axis=-1)
                )
    return names, np.stack(columns, axis=1) if columns else np.zeros((rows, 0, 4))
