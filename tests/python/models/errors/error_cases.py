"""Every kind of error by its origin: a case, or why no Python input reaches it."""

from __future__ import annotations

from models.errors.error_case import FIELDS, Case
from models.errors.error_cases_dynamics import RUN, STEADY, TABLE
from models.errors.error_cases_kinematics import POSITION, REQUEST, STRUCTURE
from models.errors.error_cases_papers import JAMMING, SERIES

__all__ = ["CASES", "FIELDS", "UNREACHABLE", "Case"]

CASES: dict[str, dict[str, Case]] = {
    "structure": STRUCTURE,
    "request": REQUEST,
    "position": POSITION,
    "run": RUN,
    "steady state": STEADY,
    "table": TABLE,
    "series": SERIES,
    "jamming": JAMMING,
}

UNREACHABLE: dict[str, dict[str, str]] = {
    "structure": {"interrupted": "Ctrl-C raises KeyboardInterrupt."},
    "request": {
        "interrupted": "Ctrl-C raises KeyboardInterrupt.",
        "out_of_memory": "It is Python's MemoryError.",
        "shape": "Python checks shapes first.",
        "order": "Python checks the order first.",
    },
    "position": {
        "not_converged": "No such position is known: iterations begin beside the solution.",
        "step_too_long": "Steps of a run are shorter.",
    },
    "run": {
        "callback": "An exception of a function is raised as it is.",
        "out_of_memory": "It is Python's MemoryError.",
        "no_initial_position": "The error has the kind of the position.",
        "wrong_count": "Python checks the numbers of drivers and dimensions first.",
    },
    "steady state": {
        "run": "The error has the kind of the run.",
        "no_flywheel": "A great flywheel evens every motion, or leaves it `poorly_determined`.",
        "not_rotary": "Python checks the driver first.",
    },
    "table": {"unequal": "Python checks shapes first."},
    "series": {},
    "jamming": {"ground": "An exception of the function is raised as it is."},
}
