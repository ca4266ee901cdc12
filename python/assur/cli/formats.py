"""Tables in files, by their ending."""

from __future__ import annotations

import csv
import json
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from assur._table import Column

# Rows that are made into text at a time.
BLOCK = 10_000


def write_rows(file: Any, columns: Sequence[Column]) -> None:
    """Write comma-separated values; numbers have all their digits."""
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([column.name for column in columns])
    size = len(columns[0].values) if columns else 0
    for start in range(0, size, BLOCK):
        parts = [column.values[start : start + BLOCK].tolist() for column in columns]
        writer.writerows(zip(*parts, strict=True))


def _write_csv(path: Path, columns: Sequence[Column]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        write_rows(file, columns)


def _write_npz(path: Path, columns: Sequence[Column]) -> None:
    """Write an array for each column, as numpy.savez does; that takes no names such as "file"."""
    from zipfile import ZipFile, ZipInfo

    with ZipFile(path, "w") as archive:
        for column in columns:
            member = ZipInfo(f"{column.name}.npy")
            with archive.open(member, "w", force_zip64=True) as file:
                values = np.ascontiguousarray(column.values)
                np.lib.format.write_array(file, values, allow_pickle=False)


def _write_json(path: Path, columns: Sequence[Column]) -> None:
    """Write strict JSON, which has no NaN and no infinity: null, and words."""
    table = {
        "units": {column.name: column.unit for column in columns if column.unit},
        "columns": {column.name: [*map(_plain, column.values.tolist())] for column in columns},
    }
    with path.open("w", encoding="utf-8") as file:
        json.dump(table, file, allow_nan=False)
        file.write("\n")


def _plain(value: Any) -> Any:
    if isinstance(value, float) and not np.isfinite(value):
        return None if np.isnan(value) else f"{value}"
    return value


def _write_parquet(path: Path, columns: Sequence[Column]) -> None:
    from assur._table import write_parquet

    write_parquet(path, columns)


def _write_excel(path: Path, columns: Sequence[Column]) -> None:
    from assur._table import write_excel

    write_excel(path, columns)


WRITERS: dict[str, Callable[[Path, Sequence[Column]], None]] = {
    ".csv": _write_csv,
    ".parquet": _write_parquet,
    ".npz": _write_npz,
    ".json": _write_json,
    ".xlsx": _write_excel,
}
# Modules by ending, and the extra that installs them.
NEEDS = {
    ".parquet": (("pandas", "parquet"), ("pyarrow", "parquet")),
    ".xlsx": (("openpyxl", "excel"),),
}
