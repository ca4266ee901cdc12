"""Motions as pandas DataFrames."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from assur.kinematics.motion import Motion


def dataframe(motion: Motion) -> Any:
    """See `Motion.to_dataframe`.

    A link or slide named like a column of designs, coordinates or statuses ("q", "status",
    "design") appears as "link q", "slide status" and so on.
    """
    try:
        import pandas as pd
    except ImportError as error:  # pragma: no cover
        message = "to_dataframe needs pandas: pip install pandas"
        raise ImportError(message) from error
    shape, drivers = motion.shape, motion._drivers
    columns: dict[str, Any] = {}
    designs = len(motion.mechanism.shape)
    for axis in range(designs):
        name = "design" if designs == 1 else f"design{axis}"
        index = np.arange(shape[axis]).reshape((-1,) + (1,) * (len(shape) - axis - 1))
        columns[name] = np.broadcast_to(index, shape).reshape(-1)
    q = motion.q if drivers > 1 else motion.q[..., np.newaxis]
    for k in range(drivers):
        name = "q" if drivers == 1 else f"q{k}"
        columns[name] = np.broadcast_to(q[..., k], shape).reshape(-1)
    columns["status"] = motion.status.reshape(-1)
    columns.update(_columns(motion, set(columns)))
    return pd.DataFrame(columns)


def _columns(motion: Motion, taken: set[str]) -> dict[str, Any]:
    """Return quantities by column name; "link" or "slide" is prefixed to names already taken.

    Names have no blanks, so "link q" cannot clash.
    """
    results, drivers = motion._results, motion._drivers
    named = [(f"{n}.{xy}", a, k, 2) for n, a in results.joints.items() for k, xy in enumerate("xy")]
    for kind, held in (("link", results.links), ("slide", results.slides)):
        for name, arrays in held.items():
            named.append((f"{kind} {name}" if name in taken else name, arrays, 0, 1))
    columns: dict[str, Any] = {}
    for name, arrays, component, width in named:
        for order, array in enumerate(arrays):
            tails = _tails(order, drivers)
            flat = array.reshape(motion.status.size, width, len(tails))[:, component]
            columns.update({name + tail: flat[:, k] for k, tail in enumerate(tails)})
    return columns


def _tails(order: int, drivers: int) -> list[str]:
    if order == 0:
        return [""]
    if drivers == 1:
        return [f".d{order}"]
    indices = product(range(drivers), repeat=order)
    return [f".d{order}[{','.join(map(str, index))}]" for index in indices]
