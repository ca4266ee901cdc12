"""Examples by name, ``example:jansen_leg``."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from assur.errors import InputError

if TYPE_CHECKING:
    from assur.files import Contents

EXAMPLE = "example:"
# An example with several drivers moves along the line between the ends of its range.
POSITIONS_OF_SEVERAL = 91
FULL_TURN = (0.0, math.tau)


def example(name: str) -> Contents:
    """Return an example with its motion over the range in which it is used."""
    from assur import examples
    from assur.files import Contents, Range
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.table import driven_angles

    if name not in examples.ALL:
        from difflib import get_close_matches

        near = get_close_matches(name, examples.ALL, n=3)
        rest = f"did you mean {' or '.join(near)}?" if near else "assur examples lists them"
        message = f"there is no example {name[:60]!r}; {rest}"
        raise InputError(message)
    made: Any = examples.ALL[name]()
    machine = None if isinstance(made, Mechanism) else made
    mechanism: Mechanism = made if machine is None else machine.mechanism
    first, last = examples.RANGES[name]
    if isinstance(first, tuple):
        over = {"q": Range(first, last, count=POSITIONS_OF_SEVERAL)}
    elif (first, last) == FULL_TURN and driven_angles(mechanism)[0]:
        over = {"deg": Range(0.0, 360.0, step=1.0)}
    else:
        over = {"q": Range(first, last, count=361)}
    return Contents(mechanism, machine, {"solve": over})
