"""A table in a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._table import Column

FIRST_ROWS, LAST_ROWS = 8, 4


def view(columns: Sequence[Column], width: int) -> str:
    """Return a table for a terminal: its first and last rows, and the columns that fit."""
    size = len(columns[0].values)
    cut = size > FIRST_ROWS + LAST_ROWS + 1
    rows = [*range(FIRST_ROWS), *range(size - LAST_ROWS, size)] if cut else [*range(size)]
    shown: list[list[str]] = []
    used = 0
    for column in columns:
        cells = [column.name, column.unit, *(_cell(column, row) for row in rows)]
        wide = max(map(len, cells)) + 2
        if shown and used + wide > width:
            break
        used += wide
        shown.append([cell.rjust(wide - 2) for cell in cells])
    lines = ["  ".join(line).rstrip() for line in zip(*shown, strict=True)]
    if cut:
        lines.insert(2 + FIRST_ROWS, "...")
    left = len(columns) - len(shown)
    more = f"; {left} more columns: --out table.csv has all" if left else ""
    return "\n".join([*lines, f"{size} rows{more}" if cut or left else ""]).rstrip()


def _cell(column: Column, row: int) -> str:
    value = column.values[row]
    if column.name == "status":
        from assur.description.words import Status

        return Status(int(value)).name
    return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)
