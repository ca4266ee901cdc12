"""Loads that act in one direction of motion only."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from assur._validate import checked_name, one_of
from assur.dynamics.loads.table import Table, replace_fields
from assur.errors import InputError

__all__ = ["DIRECTIONS", "Way", "check_way"]

Way: TypeAlias = Literal["forward", "backward"]

DIRECTIONS = ("forward", "backward")


def check_way(load: Any) -> None:
    """Check the fields `while_` and `over` of a load under construction."""
    kind = type(load).__name__
    if load.while_ is None:
        if load.over is not None:
            message = (
                f"{kind}: over={load.over!r} names the coordinate of while_=, which is missing: "
                "give it, or put over= into a Table, whose coordinate it then is"
            )
            raise InputError(message)
        return
    one_of(load.while_, DIRECTIONS, f"{kind} while_")
    if load.over is None:
        replace_fields(load, over=_of_tables(load))
    if load.over is not None:
        replace_fields(load, over=checked_name(load.over, f"{kind} over"))


def _of_tables(load: Any) -> str | None:
    """Return the coordinate of a load's tables, if they have one: it need not be said twice."""
    force, torque = (getattr(load, name, None) for name in ("force", "torque"))
    listed = [*force, torque] if isinstance(force, tuple | list) else [torque]
    named = sorted({value.over for value in listed if isinstance(value, Table) and value.over})
    if len(named) > 1:
        kind, tables = type(load).__name__, " and ".join(map(repr, named))
        message = f"{kind}: its tables are over {tables}: say which of them while_ is of, over="
        raise InputError(message)
    return named[0] if named else None
