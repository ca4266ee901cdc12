"""Results printed in a line: of long arrays the least and the greatest number."""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["summary"]

# Arrays of more numbers are printed by their range.
MOST = 6


def summary(record: Any) -> str:
    """Return the repr of a named tuple, short however long its arrays are."""
    shown = ", ".join(f"{name}={_short(value)}" for name, value in record._asdict().items())
    return f"{type(record).__name__}({shown})"


def _short(value: Any) -> str:
    if not isinstance(value, np.ndarray) or value.size <= MOST:
        return repr(value)
    shape = "×".join(map(str, value.shape))
    finite = value[np.isfinite(value)]
    if not finite.size:
        return f"<{shape}: NaN>"
    return f"<{shape}: {finite.min():.6g} … {finite.max():.6g}>"
