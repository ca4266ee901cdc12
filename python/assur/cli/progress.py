"""Progress of long work on the standard error: a bar in a terminal, lines elsewhere."""

from __future__ import annotations

import sys
import time
from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

    from assur.fitting.effort import Progress as SearchProgress
    from assur.sweeps.progress import Progress

# Seconds before the first line, and between two.
PAUSE = 5.0


def add_progress(parser: argparse.ArgumentParser) -> None:
    """Add ``--quiet``."""
    parser.add_argument("--quiet", action="store_true", help="no progress on the standard error")


def progress(arguments: argparse.Namespace) -> Progress:
    """Return the progress for `assur.sweep`: tqdm's bar in a terminal, if it is installed."""
    if arguments.quiet or sys.stderr is None:
        return False
    if sys.stderr.isatty() and find_spec("tqdm") is not None:
        return True
    return lines()


def lines(clock: Callable[[], float] = time.monotonic) -> Callable[[int, int], None]:
    """Return a function that prints a line every few seconds; short work prints none."""
    last = clock()

    def show(done: int, total: int) -> None:
        nonlocal last
        now = clock()
        if now - last >= PAUSE and done < total:
            last = now
            print(f"assur: {done} of {total} designs done", file=sys.stderr, flush=True)

    return show


def search_progress(arguments: argparse.Namespace) -> SearchProgress:
    """Return the progress for `assur.search`: tqdm's bar in a terminal, if it is installed."""
    if arguments.quiet or sys.stderr is None:
        return False
    if sys.stderr.isatty() and find_spec("tqdm") is not None:
        return True
    return search_lines()


def search_lines(clock: Callable[[], float] = time.monotonic) -> Callable[[float, float], None]:
    """Return a function that prints a line every few seconds; short work prints none."""
    last = clock()

    def show(part: float, best: float) -> None:
        nonlocal last
        now = clock()
        if now - last >= PAUSE and part < 1.0:
            last = now
            text = f"assur: {100.0 * part:.0f} % done, error {best:.3g}"
            print(text, file=sys.stderr, flush=True)

    return show
