"""What the commands that find mechanisms share: how long, how many, where to."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur.cli.progress import add_progress, search_progress
from assur.cli.written import cannot_write, require_writable
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.fitting.fits import Fits
    from assur.fitting.found import Fit

OPTIONS = ("closed", "robust", "time_limit", "evaluations", "seed", "threads")


def add_finding(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    closing = parser.add_mutually_exclusive_group()
    closing.add_argument(
        "--closed", action="store_true", default=None, help="the last point leads to the first"
    )
    closing.add_argument("--open", dest="closed", action="store_false", help="it does not")
    parser.add_argument(
        "--robust", type=float, metavar="PART", help="rank by the error after lengths changed, 1e-3"
    )
    parser.add_argument("--time-limit", type=float, metavar="SECONDS", help="time for it all; 10")
    parser.add_argument(
        "--evaluations", type=int, metavar="N", help="in place of the time: how many to evaluate"
    )
    parser.add_argument("--seed", type=int, metavar="N", help="another one finds others; 0")
    parser.add_argument("--threads", type=int, metavar="N", help="most threads; one per core")
    parser.add_argument("--out", metavar="FOLDER", help="writes each as a TOML file there")
    add_progress(parser)


def options(arguments: argparse.Namespace, *more: str) -> dict[str, Any]:
    """Return what was given, of these and some more."""
    given: dict[str, Any] = {"progress": search_progress(arguments)}
    for name in (*OPTIONS, *more):
        if (value := getattr(arguments, name)) is not None:
            given[name] = value
    return given


def show(found: Fits[Any], out: str | None) -> None:
    """Print what was found, and write it."""
    best: Fit = found[0]
    print(found)
    print(best.report())
    if out is not None:
        for file in found.save(out):
            print(file)


def require_folder(folder: str | None) -> None:
    """Refuse a folder that cannot be written, before the work."""
    if folder is None:
        return
    try:
        into = Path(folder)
        if into.exists() and not into.is_dir():
            message = f"--out {folder}: a folder is needed, and this is a file"
            raise InputError(message)
        into.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise cannot_write(folder, error) from error
    require_writable(str(into / "fit_01.toml"))
