"""The command line: ``assur flywheel table.csv --fluctuation 0.125 --mean-speed 15``."""

from __future__ import annotations

import argparse
import codecs
import contextlib
import io
import os
import sys
import warnings
from typing import TYPE_CHECKING, TextIO

from assur import flywheel
from assur._core import version
from assur.errors import AssurError, AssurWarning, InputError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

__all__ = ["main"]


# ASCII replacements for letters that the terminal's encoding lacks.
PLAIN = {"·": "*", "²": "^2", "δ": "delta", "φ": "phi", "π": "pi", "ω": "omega", "−": "-"}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Parameters
    ----------
    arguments : sequence of str, optional
        Command-line arguments; ``sys.argv[1:]`` by default.

    Returns
    -------
    int
        Exit status: 0, or 1 after an error, which is reported on standard error.
    """
    with _any_encoding(), warnings.catch_warnings():
        warnings.showwarning = _show_warning
        try:
            try:
                given = _parser().parse_args(arguments)
                given.run(given)
            finally:
                # Flush here, where a full disk can still be reported.
                sys.stdout.flush()
        except (AssurError, AssurWarning) as error:
            print(f"assur: {error}", file=sys.stderr)
            return 1
        except OSError as error:
            return _cannot_write(error)
    return 0


@contextlib.contextmanager
def _any_encoding() -> Iterator[None]:
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


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Print a warning of this package as one line, without its source line."""
    if issubclass(category, AssurWarning):
        print(f"assur: warning: {message}", file=file or sys.stderr)
    else:
        text = warnings.formatwarning(message, category, filename, lineno, line)
        print(text, end="", file=file or sys.stderr)


def _cannot_write(error: OSError) -> int:
    # Otherwise Python flushes again at exit and shows a traceback.
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
    # The reader closed the pipe: not an error.
    if not isinstance(error, BrokenPipeError):
        print(f"assur: the output cannot be written ({error})", file=sys.stderr)
    return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="assur", description="Planar linkages.")
    parser.add_argument("--version", action="version", version=f"assur {version()}")
    commands = parser.add_subparsers(title="commands", required=True)
    wheel = commands.add_parser(
        "flywheel",
        help="the flywheel for a table of reduced moment and inertia",
        description="The flywheel with which the speed varies by a given part of its mean.",
    )
    wheel.add_argument("table", help="columns phi (rad), moment (N·m), inertia (kg·m²); one period")
    one = wheel.add_mutually_exclusive_group(required=True)
    one.add_argument("--fluctuation", type=float, help="coefficient δ wanted")
    one.add_argument("--flywheel", type=float, help="a given flywheel, kg·m², instead")
    wheel.add_argument("--mean-speed", type=float, required=True, help="rad/s")
    wheel.add_argument("--mean", choices=flywheel.MEANS, default="extremes")
    wheel.add_argument("--spline", choices=flywheel.SPLINES, default="not-a-knot")
    wheel.add_argument("--degrees", action="store_true", help="phi is in degrees")
    wheel.add_argument("--plot", metavar="PICTURE", help="draw the speed over the turn to a file")
    wheel.set_defaults(run=_flywheel)
    return parser


def _flywheel(given: argparse.Namespace) -> None:
    table = flywheel.read_table(given.table, degrees=given.degrees)
    if given.flywheel is None:
        f = flywheel.from_table(
            *table, given.fluctuation, given.mean_speed, mean=given.mean, spline=given.spline
        )
    else:
        f = flywheel.evaluate(
            *table,
            given.flywheel,
            mean_speed=given.mean_speed,
            mean=given.mean,
            spline=given.spline,
        )
    print(f"flywheel      {f.inertia:.9g} kg·m²")
    print(f"fluctuation   {f.delta:.9g}")
    print(f"mean speed    {f.mean_speed:.9g} rad/s ({given.mean})")
    print(f"speed0        {f.speed0:.9g} rad/s")
    print(f"greatest      {f.greatest.value:.9g} rad/s at {f.greatest.at:.6g} rad")
    print(f"least         {f.least.value:.9g} rad/s at {f.least.at:.6g} rad")
    print(f"motor         {f.motor_moment:.9g} N·m")
    print(f"period        {f.period:.9g} s")
    if given.plot:
        _draw(f, given.plot)


def _draw(f: flywheel.Flywheel, path: str) -> None:
    figure = f.plot().figure
    try:
        figure.savefig(path)
    except (OSError, ValueError) as error:
        message = f"{path}: the picture cannot be written ({error})"
        raise InputError(message) from error


if __name__ == "__main__":
    sys.exit(main())
