"""The space of designs: variables, each within bounds of its own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur.errors import InputError
from assur.fitting.fit import drawn_size
from assur.fitting.variables import checked_variables, matching_names

if TYPE_CHECKING:
    from assur.fitting.variables import Variables
    from assur.kinematics.mechanism import Mechanism


def bounded_variables(m: Mechanism, vary: Any, bounds: Any, ties: Any) -> Variables:
    """Return the variables; errors name the dimension and what to do."""
    if not isinstance(bounds, Mapping) or not bounds:
        message = (
            f"bounds is {short(bounds)}: a mapping of names to (least, greatest) is needed, "
            "{'*.length': (0.1, 0.5)}: a population is spread over them"
        )
        raise InputError(message)
    known = list(m.dimensions)
    bounded = matching_names(known, bounds, "bounds", "*")
    variables = checked_variables(m, bounded if vary is None else vary, bounds, ties, drawn_size(m))
    for moves, _ in variables.each:
        if (name := known[moves[0][0]]) not in bounded:
            message = f"bounds: {name!r} varies and has none: give them, or leave it out of vary"
            raise InputError(message)
    return variables
