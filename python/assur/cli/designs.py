"""Designs in a file of comma-separated values."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from assur._arrays import counted
from assur.errors import InputError
from assur.kinematics.named_dimensions import columns_of_designs

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur._arrays import Float


def read_designs(path: str, known: Iterable[str]) -> dict[str, Float]:
    """Return the dimensions of a table, a column each: the header has their names.

    Of a table that ``assur sweep`` wrote, the columns of results are left out.
    """
    try:
        with Path(path).open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file)
            lines = [(reader.line_num, row) for row in reader if any(map(str.strip, row))]
    except (OSError, ValueError, csv.Error) as error:
        message = f"{path}: the designs cannot be read ({error})"
        raise InputError(message) from error
    if len(lines) < 2:
        message = f"{path}: a header with names of dimensions, and a row for each design are needed"
        raise InputError(message)
    names = [name.strip() for name in lines[0][1]]
    if len(set(names)) < len(names):
        message = f"{path}: the header has a name twice: {', '.join(names)[:200]}"
        raise InputError(message)
    wanted = columns_of_designs(names, known)
    if not wanted:
        message = f"{path}: no column is a dimension: {', '.join(names)[:200]}"
        raise InputError(message)
    places = [names.index(name) for name in wanted]
    values = np.array([_numbers(path, line, row, len(names), places) for line, row in lines[1:]])
    return dict(zip(wanted, values.T, strict=True))


def _numbers(path: str, line: int, row: list[str], count: int, places: list[int]) -> list[float]:
    try:
        found = [float(row[place]) for place in places] if len(row) == count else []
    except ValueError:
        found = []
    if not found or not all(map(math.isfinite, found)):
        message = f"{path}, line {line}: {','.join(row)[:80]!r} is not {counted(count, 'number')}"
        raise InputError(message)
    return found
