"""Trouble of the terminal, the pipe or the disk: letters it lacks, warnings, a closed pipe."""

from __future__ import annotations

import codecs
import contextlib
import io
import os
import sys
import warnings
from typing import TYPE_CHECKING, TextIO

from assur.errors import AssurWarning

if TYPE_CHECKING:
    from collections.abc import Iterator

# ASCII replacements for letters that the terminal's encoding lacks.
PLAIN = {
    "±": "+-",
    "·": "*",
    "²": "^2",
    "δ": "delta",
    "φ": "phi",
    "π": "pi",
    "ω": "omega",
    "−": "-",
    "→": "->",
    "°": "deg",
    "…": "...",
}
# Advice for Python users, in words of the command line.
IN_DEGREES = ("deg=..., or np.radians(q)", "write --q 0:360:1deg")


def reworded(message: object) -> str:
    """Return a message of the package in words of the command line."""
    return str(message).replace(*IN_DEGREES)


def note(text: str) -> None:
    """Print a line on the standard error."""
    # A name may have line ends in it.
    print(f"assur: {' '.join(text.splitlines())}", file=sys.stderr)


@contextlib.contextmanager
def any_encoding() -> Iterator[None]:
    """Replace letters that the output streams cannot encode."""
    codecs.register_error("assur.plain", _plain)
    streams = [s for s in (sys.stdout, sys.stderr) if isinstance(s, io.TextIOWrapper)]
    before = [stream.errors for stream in streams]
    for stream in streams:
        stream.reconfigure(errors="assur.plain")
    try:
        yield
    finally:
        for stream, errors in zip(streams, before, strict=True):
            # Reconfiguring flushes: it would raise the same write error again.
            with contextlib.suppress(OSError):
                stream.reconfigure(errors=errors)


def _plain(error: UnicodeError) -> tuple[str | bytes, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    letters = error.object[error.start : error.end]
    escaped = (x.encode("ascii", "backslashreplace").decode("ascii") for x in letters)
    return "".join(PLAIN.get(x, y) for x, y in zip(letters, escaped, strict=True)), error.end


@contextlib.contextmanager
def short_warnings() -> Iterator[None]:
    """Print a warning of this package as one line, without its source line."""
    with warnings.catch_warnings():
        warnings.showwarning = _show_warning
        yield


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    if issubclass(category, AssurWarning):
        print(f"assur: warning: {reworded(message)}", file=file or sys.stderr)
    else:
        text = warnings.formatwarning(message, category, filename, lineno, line)
        print(text, end="", file=file or sys.stderr)


def cannot_write(error: OSError) -> None:
    """Report an error of the standard output; a pipe closed by its reader is not an error."""
    # Otherwise Python flushes again at exit and shows a traceback.
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
    if not isinstance(error, BrokenPipeError):
        note(f"the output cannot be written ({error})")
