"""Tables of reduced moment and inertia in files of comma-separated values."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._arrays import flag
from assur._by_value import key_of
from assur._files import checked_path, reason, shown_path
from assur._summary import summary
from assur._validate import require_rows
from assur.errors import InputError

if TYPE_CHECKING:
    from os import PathLike

    from assur._arrays import Float


class ReducedTable(NamedTuple):
    """A machine referred to its driver, over one period.

    Attributes
    ----------
    phi : ndarray
        Coordinates, rad.
    moment, inertia : ndarray
        Reduced moment, N·m, and reduced inertia, kg·m², there.

    Examples
    --------
    >>> import numpy as np
    >>> from assur import flywheel
    >>> phi = np.linspace(0.0, 2 * np.pi, 5)
    >>> table = flywheel.ReducedTable(phi, 100.0 * np.sin(phi), np.full(5, 2.0))
    >>> f = flywheel.from_table(*table, fluctuation=0.05, mean_speed=10.0)
    >>> round(f.delta, 6)
    0.05
    """

    phi: Float
    moment: Float
    inertia: Float

    # As a tuple it would compare arrays.

    def __repr__(self) -> str:
        return summary(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ReducedTable):
            return False
        return tuple(map(key_of, self)) == tuple(map(key_of, other))

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(tuple(map(key_of, self)))


def read_table(path: str | PathLike[str], *, degrees: bool = False) -> ReducedTable:
    """Read a table from a file of comma-separated values.

    Parameters
    ----------
    path : path-like
        The file: columns phi, moment and inertia, in any order under a header that names them, or
        in this order without one. Other columns and lines that begin with # are ignored.
    degrees : bool
        Whether phi is in degrees.

    Returns
    -------
    ReducedTable
        phi (rad), moment (N·m), inertia (kg·m²).

    Raises
    ------
    InputError
        A file that cannot be read or has fewer than two rows, or a row that is not three numbers
        (the message gives its line).

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import numpy as np
    >>> from assur import flywheel
    >>> rows = [(0, 0, 2), (90, 100, 2), (180, 0, 2), (270, -100, 2), (360, 0, 2)]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "table.csv")
    ...     np.savetxt(path, rows, delimiter=",")
    ...     table = flywheel.read_table(path, degrees=True)
    >>> table.phi.round(4), table.moment  # rad, N·m
    (array([0.    , 1.5708, 3.1416, 4.7124, 6.2832]), array([   0.,  100.,    0., -100.,    0.]))
    """
    file = checked_path(path)
    path = shown_path(file)
    try:
        lines = file.read_text(encoding="utf-8-sig").splitlines()
        kept = [(i, line) for i, line in enumerate(lines, 1) if line.strip() and line[:1] != "#"]
        cells = list(csv.reader(line for _, line in kept))
    except (OSError, ValueError, csv.Error) as error:
        message = f"{path}: the table cannot be read ({reason(error)})"
        raise InputError(message) from error
    columns = [0, 1, 2]
    if cells and _number(cells[0], 0) is None:
        names = [cell.strip().lower() for cell in cells[0]]
        missing = [name for name in ReducedTable._fields if name not in names]
        if missing:
            message = f"{path}: the header has no column {missing[0]!r}, it has {', '.join(names)}"
            raise InputError(message)
        columns = [names.index(name) for name in ReducedTable._fields]
        kept, cells = kept[1:], cells[1:]
    rows = [[_number(row, column) for column in columns] for row in cells]
    bad = next((i for i, row in enumerate(rows) if None in row), None)
    if bad is not None:
        line, text = kept[bad]
        message = f"{path}, line {line}: {text!r} is not three numbers phi, moment, inertia"
        raise InputError(message)
    require_rows(len(rows), 2, f"{path}: the table")
    phi, moment, inertia = np.array(rows, np.float64).reshape(-1, 3).T
    return ReducedTable(np.deg2rad(phi) if flag(degrees, "degrees") else phi, moment, inertia)


def _number(row: list[str], column: int) -> float | None:
    try:
        return float(row[column])
    except (ValueError, IndexError):
        return None
