"""Results as tables: a file by its ending, CSV on a pipe, a short view in a terminal."""

from __future__ import annotations

import csv
import json
import os
import secrets
import shutil
import sys
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterator, Sequence

    from assur._table import Column

# Rows that are made into text at a time.
BLOCK = 10_000
# Of a table in a terminal.
FIRST_ROWS, LAST_ROWS = 8, 4
STDOUT = "-"


def add_output(parser: argparse.ArgumentParser) -> None:
    """Add ``--out``."""
    parser.add_argument(
        "--out",
        metavar="TABLE",
        help=f"the table's file, by its ending: {', '.join(WRITERS)}; one that exists is replaced; "
        "- is CSV on the standard output, as without --out on a pipe; a terminal shows a part",
    )


class Output:
    """Where a table goes. What cannot be written is refused here, before the work.

    Parameters
    ----------
    path : str or None
        The value of ``--out``.
    source : str
        The file that is read, which is not overwritten.
    """

    def __init__(self, path: str | None, source: str) -> None:
        self.path = path
        if path is None or path == STDOUT:
            return
        ending = Path(path).suffix.lower()
        if ending not in WRITERS:
            known = ", ".join(WRITERS)
            message = f"--out {path}: the ending {ending or 'is missing'!r}: known are {known}"
            if not ending:
                message = f"--out {path}: the file needs an ending: {known}"
            raise InputError(message)
        self._ending = ending
        for module, extra in NEEDS.get(ending, ()):
            if find_spec(module) is None:
                message = f"--out {path} needs {module}: pip install assur[{extra}]"
                raise InputError(message)
        refuse_same(path, source)
        require_writable(path)

    def write(self, columns: Sequence[Column]) -> None:
        """Write a table."""
        if self.path is None and sys.stdout.isatty():
            print(view(columns, shutil.get_terminal_size().columns))
        elif self.path is None or self.path == STDOUT:
            write_rows(sys.stdout, columns)
        else:
            with replacing(self.path) as temporary:
                WRITERS[self._ending](temporary, columns)


@contextmanager
def replacing(path: str) -> Iterator[Path]:
    """Give a file beside `path` that takes its place at the end, or nothing does."""
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        # A device or a named pipe.
        yield target
        return
    temporary = target.with_name(f".assur-{secrets.token_hex(4)}")
    try:
        try:
            yield temporary
            with suppress(OSError):
                temporary.chmod(target.stat().st_mode & 0o777)
            temporary.replace(target)
        except OSError as error:
            raise cannot_write(path, error) from error
    finally:
        with suppress(OSError):
            temporary.unlink()


def require_writable(path: str) -> None:
    """Refuse a file that cannot be written, before the work whose result it takes."""
    try:
        target = Path(os.path.realpath(path))
        if target.is_dir():
            raise IsADirectoryError(None, "it is a directory")
        if target.exists():
            if not os.access(target, os.W_OK):
                raise PermissionError(None, "it is write-protected")
            if not target.is_file():
                return
        probe = target.with_name(f".assur-{secrets.token_hex(4)}")
        probe.open("xb").close()
        probe.unlink()
        with suppress(FileNotFoundError):
            target.lstat()  # refuses a name that is too long
    except (OSError, ValueError) as error:
        raise cannot_write(path, error) from error


def refuse_same(path: str, source: str) -> None:
    """Refuse to overwrite what is read."""
    with suppress(OSError, ValueError):
        if Path(path).samefile(source):
            message = f"{path} is the file that is read: name another"
            raise InputError(message)


def cannot_write(path: str, error: Exception) -> InputError:
    """Return the error of a file."""
    why = getattr(error, "strerror", None) or error
    return InputError(f"{path}: cannot be written: {why}")


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
    more = f"; {left} more columns: --out table.csv has all, --outputs chooses" if left else ""
    return "\n".join([*lines, f"{size} rows{more}" if cut or left else ""]).rstrip()


def _cell(column: Column, row: int) -> str:
    value = column.values[row]
    if column.name == "status":
        from assur.description.words import Status

        return Status(int(value)).name
    return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)
