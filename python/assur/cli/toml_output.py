"""TOML files that commands write: descriptions, which are not overwritten unasked."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from assur.cli.written import cannot_write, replacing, require_writable
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.files import Contents


def add_toml(parser: argparse.ArgumentParser) -> None:
    """Add ``--out`` and ``--force``."""
    parser.add_argument(
        "--out", metavar="TOML", default="-", help="the file; the standard output by default"
    )
    parser.add_argument("--force", action="store_true", help="replace a file that exists")


def check_toml(path: str, force: bool) -> None:
    """Refuse a file that exists, has another ending, or cannot be written."""
    if path == "-":
        return
    try:
        target = Path(path)
        if target.suffix.lower() != ".toml":
            message = f"{path}: the name of a TOML file ends with .toml"
            raise InputError(message)
        if target.is_file() and not force:
            message = f"{path} exists: --force replaces it"
            raise InputError(message)
    except OSError as error:
        raise cannot_write(path, error) from error
    require_writable(path)


def write_toml(contents: Contents, path: str) -> None:
    """Write a file, or to the standard output."""
    from assur.files import save
    from assur.files.write import text_of

    if path == "-":
        print(text_of(contents), end="", file=sys.stdout)
        return
    with replacing(path) as temporary:
        save(contents, temporary)
