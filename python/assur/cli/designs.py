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

    The columns of results in a table that ``assur sweep`` wrote are left out.
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
    columns = columns_of_designs(names, known)
    if not columns:
        message = f"{path}: no column is a dimension: {', '.join(names)[:200]}"
        raise InputError(message)
    places = [names.index(name) for name in columns]
    values = np.array([_numbers(path, line, row, len(names), places) for line, row in lines[1:]])
    return dict(zip(columns, values.T, strict=True))


def _numbers(path: str, line: int, row: list[str], count: int, places: list[int]) -> list[float]:
    try:
        numbers = [float(row[place]) for place in places] if len(row) == count else []
    except ValueError:
        numbers = []
    if not numbers or not all(map(math.isfinite, numbers)):
        message = f"{path}, line {line}: {','.join(row)[:80]!r} is not {counted(count, 'number')}"
        raise InputError(message)
    return numbers
