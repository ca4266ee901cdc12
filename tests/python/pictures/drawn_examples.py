"""The examples' mechanisms, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

import assur
from assur.examples import ALL

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism


def mechanism(name: str) -> Mechanism:
    """Return an example's mechanism, of a machine the one that it drives."""
    made = ALL[name]()
    if not isinstance(made, assur.Machine):
        return made
    assert made.mechanism is not None
    return made.mechanism
