"""Coordinates over which loads are given."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.dynamics.loads.table import Table
from assur.errors import InputError
from assur.kinematics.configuration import size_of
from assur.kinematics.model import with_values
from assur.kinematics.table import driven_angles

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from assur.kinematics.mechanism import Mechanism

__all__ = ["check_over", "jump_over"]

# Shortest period of a table over another coordinate, rad or sizes: all of its rows are found.
SHORTEST_PERIOD = 1e-3
# Where a link that never turns has the same angle: beside the drawing's q, rad or sizes.
BESIDE = (-1e-3, 0.0, 1e-3)


def check_over(mechanism: Mechanism, loads: Sequence[Any]) -> None:
    """Refuse loads over the angle of a link that never turns, and tables of far too many periods.

    The former would act never, or always.
    """
    for load in loads:
        tables = list(_tables(load))
        names = [load.over] if getattr(load, "over", None) is not None else []
        for name in (*names, *(table.over for table in tables)):
            if name in mechanism.links and not _turns(mechanism, name):
                raise InputError(_message(mechanism, load, name), link=name)
        for table in tables:
            _require_long_period(mechanism, load, table)


def jump_over(loads: Sequence[Any]) -> bool:
    """Whether loads may jump where another coordinate turns back or passes a row of a table."""
    return any(
        getattr(load, "while_", None) is not None
        or any(bool((np.diff(table.q) == 0.0).any()) for table in _tables(load))
        for load in loads
    )


def _tables(load: Any) -> Iterator[Table]:
    values = (getattr(load, part, None) for part in ("force", "torque", "pressure"))
    for value in values:
        for number in value if isinstance(value, tuple) else (value,):
            if isinstance(number, Table) and number.over is not None:
                yield number


def _require_long_period(mechanism: Mechanism, load: Any, table: Table) -> None:
    period = float(table.q[-1] - table.q[0])
    unit = size_of(mechanism, drawn=True) if table.over in mechanism.slides else 1.0
    if table.periodic and not period >= SHORTEST_PERIOD * unit:
        message = (
            f"{type(load).__name__}: a table over {table.over!r} has a period of {period:g}: it "
            f"must be at least {SHORTEST_PERIOD * unit:g}"
        )
        raise InputError(message, value=period)


def _turns(mechanism: Mechanism, link: str) -> bool:
    drawn = with_values(mechanism, np.array(mechanism.core.drawing))
    size = size_of(mechanism, drawn=True)
    units = [1.0 if is_angle else size for is_angle in driven_angles(mechanism)]
    q = drawn.q0_array + np.multiply.outer(BESIDE, units)
    places = q if drawn.driver_count > 1 else q[:, 0]
    angles = drawn.solve(places, order=0, outputs=[link], on_error="nan").link(link).value
    return not (np.isfinite(angles).all() and bool((angles == angles[0]).all()))


def _message(mechanism: Mechanism, load: Any, link: str) -> str:
    slides = [name for name, slide in mechanism.slides.items() if slide.link == link]
    hint = f': its travel is the slide "{slides[0]}"' if slides else ""
    return f'{type(load).__name__}: over="{link}": this link does not turn{hint}'
