"""The line of the user's program that a warning is about."""

from __future__ import annotations

import sys

__all__ = ["level_of_caller"]

PACKAGE = __file__[: -len("_callers.py")]


def level_of_caller() -> int:
    """Return the `stacklevel` of the first frame outside the package, seen from its caller."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(PACKAGE):
        frame, level = frame.f_back, level + 1
    return level
