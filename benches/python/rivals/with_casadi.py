"""What a user of CasADi writes: symbols of one position, derivatives, a map over all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import casadi
import numpy as np

if TYPE_CHECKING:
    from subject import Float


def four_bar() -> Any:
    """Function of (lengths, q): coupler and rocker angle, each with two analogues."""
    lengths, q = casadi.SX.sym("lengths", 4), casadi.SX.sym("q")
    a, b, c, g = (lengths[i] for i in range(4))
    bx, by = a * casadi.cos(q), a * casadi.sin(q)
    kx, ky = g - bx, -by
    d2 = kx * kx + ky * ky
    x = (d2 + (b - c) * (b + c)) / (2 * d2)
    y = casadi.sqrt((d2 - (b - c) ** 2) * ((b + c) ** 2 - d2)) / (2 * d2)
    ux, uy = kx * x - ky * y, ky * x + kx * y
    angles = casadi.vertcat(casadi.atan2(uy, ux), casadi.atan2(uy - ky, ux - kx))
    first = casadi.jacobian(angles, q)
    second = casadi.jacobian(first, q)
    return casadi.Function("four_bar", [lengths, q], [angles, first, second])


def solve(function: Any, lengths: Float, q: Float) -> list[Any]:
    """Evaluate it: (2, designs · positions) for each order."""
    # A column is a position.
    columns = np.repeat(lengths, q.size, axis=1)
    results = function(columns, np.tile(q, lengths.shape[1])[None, :])
    return [np.asarray(array) for array in results]
