"""P4's mechanism of class IV."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from models.errors.refusals import Table


def class_iv() -> Table:
    """P4 at crank angle 0."""
    places = {"1": (0, 0), "2": (0.35, 0), "3": (1.24, 0.99), "4": (0.75, 1.91), "6": (2.45, 1.02)}
    places |= {"8": (1.85, 2.35), "5": (3.02, -0.73), "9": (1.62, -1.11), "7": (3.2, 2.24)}
    links = {"ground": ["1", "9", "10"], "crank": "12", "l234": "234", "l365": "365", "l48": "48"}
    links |= {"l876": "876", "l95": "95", "l107": ["10", "7"]}
    return {"joints": {**places, "10": (4.28, 1.52)}, "links": links}
