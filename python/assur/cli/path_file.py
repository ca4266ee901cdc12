"""Points of a path in a file of comma-separated values."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Float


def read_points(path: str) -> Float:
    """Return the points of a file (N, 2): columns x and y of its header, or the first two.

    Numbers are separated by commas, semicolons, tabs or blanks.
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        message = f"{path}: the points cannot be read ({getattr(error, 'strerror', 0) or error})"
        raise InputError(message) from error
    rows = [(line, _split(row)) for line, row in enumerate(text.splitlines(), 1) if row.strip()]
    if not rows:
        message = f"{path} is empty: a row x,y is needed for each point"
        raise InputError(message)
    header = [name.strip().lower() for name in rows[0][1]]
    columns = (0, 1)
    if not all(map(_is_number, header)):
        rows = rows[1:]
        if "x" in header and "y" in header:
            columns = header.index("x"), header.index("y")
    return np.array([_point(path, line, row, columns) for line, row in rows]).reshape(-1, 2)


def _split(row: str) -> list[str]:
    for sign in (",", ";", "\t"):
        if sign in row:
            return next(csv.reader([row], delimiter=sign))
    return row.split()


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _point(path: str, line: int, row: list[str], columns: tuple[int, int]) -> tuple[float, float]:
    words = [row[column] for column in columns if column < len(row)]
    numbers = [float(word) for word in words if _is_number(word)]
    if len(numbers) < 2 or not all(map(math.isfinite, numbers)):
        message = f"{path}, line {line}: {' '.join(row)[:80]!r} is no point: two numbers are needed"
        raise InputError(message)
    return numbers[0], numbers[1]
