"""Targets in a file of comma-separated values: points, values over coordinates, poses."""

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
    """Return the points of a file (N, 2): columns x and y of its header, or the first two."""
    return read_rows(path, ("x", "y"), "point")


def read_rows(path: str, names: tuple[str, ...], what: str) -> Float:
    """Return the rows of a file: the columns of these names in its header, or the first ones.

    Numbers are separated by commas, semicolons, tabs or blanks.
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        message = f"{path}: the {what}s cannot be read ({getattr(error, 'strerror', 0) or error})"
        raise InputError(message) from error
    rows = [(line, _split(row)) for line, row in enumerate(text.splitlines(), 1) if row.strip()]
    if not rows:
        message = f"{path} is empty: a row {','.join(names)} is needed for each {what}"
        raise InputError(message)
    header = [name.strip().lower() for name in rows[0][1]]
    columns = list(range(len(names)))
    if not all(map(_is_number, header)):
        rows = rows[1:]
        if all(name in header for name in names):
            columns = [header.index(name) for name in names]
    numbers = [_numbers(path, line, row, columns, what) for line, row in rows]
    return np.array(numbers).reshape(-1, len(names))


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


def _numbers(path: str, line: int, row: list[str], columns: list[int], what: str) -> list[float]:
    words = [row[column] for column in columns if column < len(row)]
    numbers = [float(word) for word in words if _is_number(word)]
    if len(numbers) < len(columns) or not all(map(math.isfinite, numbers)):
        needed = {2: "two", 3: "three"}[len(columns)]
        shown = repr(" ".join(row)[:80])
        message = f"{path}, line {line}: {shown} is not a {what}: {needed} numbers are needed"
        raise InputError(message)
    return numbers
