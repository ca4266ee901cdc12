"""Where a table goes: a file, CSV on a pipe, a short view in a terminal."""

from __future__ import annotations

import shutil
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from assur.cli.formats import NEEDS, WRITERS, write_rows
from assur.cli.view import view
from assur.cli.written import refuse_same, replacing, require_writable
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from assur._table import Column

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
    """Where a table goes. A file that cannot be written is refused here, before the work.

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
            wrong = f"not {ending}" if ending else "but has none"
            message = f"--out {path}: the name ends with {', '.join(WRITERS)}, {wrong}"
            raise InputError(message)
        self._ending = ending
        for module, extra in NEEDS.get(ending, ()):
            if find_spec(module) is None:
                message = f"--out {path} needs {module}: pip install assur[{extra}]"
                raise InputError(message)
        refuse_same(path, source)
        require_writable(path)

    def require_few(self, rows: int) -> None:
        """Refuse more rows than a workbook takes, before the work."""
        from assur._table import MAX_ROWS

        if self.path not in (None, STDOUT) and self._ending == ".xlsx" and rows + 2 > MAX_ROWS:
            message = f"--out {self.path}: {rows} rows, of {MAX_ROWS - 2} that a sheet holds"
            raise InputError(f"{message}: use .parquet or .csv")

    def write(self, columns: Sequence[Column]) -> None:
        """Write a table."""
        if self.path is None and sys.stdout.isatty():
            print(view(columns, shutil.get_terminal_size().columns))
        elif self.path is None or self.path == STDOUT:
            write_rows(sys.stdout, columns)
        else:
            with replacing(self.path) as temporary:
                WRITERS[self._ending](temporary, columns)
