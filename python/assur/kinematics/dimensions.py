"""The dimensions of a mechanism by name, printed as a table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._summary import LINES
from assur.description.dotted_names import unit_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pandas as pd

    from assur._arrays import Number

__all__ = ["Dimensions"]

# A difference of two typed coordinates carries their rounding; one digit less hides it.
SHOWN = ".15g"


class Dimensions(Mapping[str, "Number"]):
    """Dimensions by name, m or rad: floats, or arrays of the shape of the designs.

    Values are the numbers that are computed with; only the printed table rounds them.

    Examples
    --------
    >>> import assur
    >>> print(assur.SliderCrank(0.05, 0.2).dimensions)
    ground.O.x      0  m
    ground.O.y      0  m
    crank.length  0.05  m
    rod.length    0.2  m
    bore.angle      0  rad
    bore.offset     0  m
    """

    __slots__ = ("_values",)

    def __init__(self, values: Mapping[str, Number]) -> None:
        self._values = dict(values)

    def __getitem__(self, name: str) -> Number:
        """Return a dimension."""
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names."""
        return iter(self._values)

    def __len__(self) -> int:
        """Return the number of dimensions."""
        return len(self._values)

    def __repr__(self) -> str:
        names = max(map(len, self._values), default=0)
        numbers = {name: _shown(value) for name, value in self._values.items()}
        width = max(map(len, numbers.values()), default=0)
        rows = [
            f"{name:<{names}}  {number:>{width}}  {unit_of(name)}"
            for name, number in numbers.items()
        ]
        if len(rows) > LINES + 1:
            rows[LINES:] = [f"… {len(rows) - LINES} more: to_dataframe() has all"]
        return "\n".join(rows)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a pandas DataFrame with a row for each design (needs pandas).

        Columns are the design's index (one for each axis of S) and the dimensions;
        ``attrs["units"]`` has the units. `Mechanism.with_dimensions` takes such a table.

        Returns
        -------
        pandas.DataFrame
            m and rad.

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"rocker.length": [2.4, 2.5]})
        >>> m.dimensions.to_dataframe()[["design", "rocker.length"]].values.tolist()
        [[0.0, 2.4], [1.0, 2.5]]
        """
        # `import assur` does without tables.
        from assur._table import Column, design_columns, frame

        values = {name: np.asarray(value) for name, value in self._values.items()}
        shape = np.broadcast_shapes(*(array.shape for array in values.values()))
        columns = design_columns(shape, len(shape))
        for name, array in values.items():
            columns.append(Column(name, array.reshape(-1), unit_of(name), "dimensions"))
        return frame(columns)


def _shown(value: Any) -> str:
    if isinstance(value, float):
        return format(value, SHOWN)
    values = np.asarray(value)
    if not values.size:
        return f"shape {values.shape}"
    least, most = values.min(), values.max()
    return f"{least:.6g}" if least == most else f"{least:.6g} … {most:.6g}"
