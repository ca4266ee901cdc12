"""The program: its commands, its errors and its exit statuses."""

from __future__ import annotations

import argparse
import os
import re
import sys
from importlib import import_module
from typing import TYPE_CHECKING, NoReturn

from assur._core import version
from assur.cli.terminal import any_encoding, cannot_write, note, reworded, short_warnings
from assur.errors import AssurError, AssurWarning

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["main"]

# 3 is that of `assur.cli.failures`.
OK, FAILED, USAGE, INTERRUPTED = 0, 1, 2, 130

# Each is a module of `assur.cli.commands`, imported when it is called.
COMMANDS = {
    "solve": "positions and their derivatives, as a table",
    "structure": "mobility, Assur groups, dimensions",
    "extremes": "stroke or swing of a coordinate, time ratio",
    "limits": "where the driver can move, dead points, assemblies",
    "reactions": "forces in joints and slides, and of the drive, as a table",
    "flywheel": "the flywheel of a machine, or of a table of moment and inertia",
    "sweep": "many designs, measured; the best of them",
    "fit": "dimensions with which a mechanism does a task",
    "search": "linkages that draw a path",
    "plot": "a picture",
    "studio": "mechanisms in the browser: draw, drag, run",
    "convert": "a file of another program, as a TOML file",
    "examples": "the examples that the package contains",
}
EPILOG = """\
FILE is a TOML file (docs/reference/files.md), a file of PMKS, PMKS+, pylinkage, pyslvs or
Linkage, an example (example:jansen_leg), or - for the standard input.

exit status:
  0    done
  1    the input is wrong, or has no answer: a line on the standard error says why
  2    the command line is wrong
  3    done, but some positions could not be solved, or a sweep has no design left
  130  interrupted
"""
# A value that begins like a number is not an option.
NEGATIVE = re.compile(r"-\.?\d")


class Parser(argparse.ArgumentParser):
    """Errors of the command line are one line, like all others; options have one name."""

    def __init__(self, *, prog: str) -> None:
        def wide(prog: str) -> argparse.HelpFormatter:
            return argparse.RawDescriptionHelpFormatter(prog, max_help_position=28)

        super().__init__(prog=prog, formatter_class=wide, allow_abbrev=False)

    def error(self, message: str) -> NoReturn:
        """Report a wrong command line and end."""
        note(f"{' '.join(message.split())} (see {self.prog} --help)")
        raise SystemExit(USAGE)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Parameters
    ----------
    arguments : sequence of str, optional
        Command-line arguments; ``sys.argv[1:]`` by default.

    Returns
    -------
    int
        Exit status: 0, or another one after an error, which is reported on standard error.

    Examples
    --------
    >>> from assur.cli import main
    >>> main(["solve", "example:engine", "--q", "0,90deg", "--order", "0", "--outputs", "bore"])
    q,status,bore
    0.0,0,0.195
    1.5707963267948966,0,0.14309088021254185
    0
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by the shell
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: PTH123, SIM115
    with any_encoding(), short_warnings():
        try:
            try:
                return _run(words)
            finally:
                # Flush here, where a full disk can still be reported.
                sys.stdout.flush()
        except (AssurError, AssurWarning, ImportError) as error:
            note(reworded(error))
        except MemoryError:
            note("there is not enough memory for these results: ask for fewer")
        except OSError as error:
            cannot_write(error)
        except KeyboardInterrupt:
            note("interrupted")
            return INTERRUPTED
    return FAILED


def _run(words: list[str]) -> int:
    try:
        parser = _parser(words)
        if any(word == "--" or (word[:2] == "--" and word.endswith("=--")) for word in words):
            # argparse drops it, also where it is a value.
            parser.error("-- is not understood; a file's name can be written ./-name")
        arguments, others = parser.parse_known_args(_joined(words))
        if others:
            is_file = hasattr(arguments, "out") and not others[0].startswith("-")
            hint = f": to write a file, --out {others[0]}" if is_file else ""
            arguments.parser.error(f"unrecognized arguments: {' '.join(others)}{hint}")
        return int(arguments.run(arguments) or OK)
    except SystemExit as end:  # argparse's, after help and errors
        return int(end.code or OK)


def _parser(words: list[str]) -> Parser:
    parser = Parser(prog="assur")
    parser.description, parser.epilog = "Planar linkages: structure, motion, forces.", EPILOG
    parser.add_argument("--version", action="version", version=f"assur {version()}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    # The options above take no values: the first other word is the command.
    called = next((word for word in words if not word.startswith("-")), None)
    for name, does in COMMANDS.items():
        subparser = commands.add_parser(name, help=does)
        if name == called:
            command = import_module(f"assur.cli.commands.{name}")
            command.add_arguments(subparser)
            subparser.set_defaults(run=command.run, parser=subparser)
    return parser


def _joined(words: list[str]) -> list[str]:
    """Write ``--q -10:10:1deg`` as ``--q=-10:10:1deg``: no option to argparse."""
    joined: list[str] = []
    for word in words:
        last = joined[-1] if joined else ""
        if NEGATIVE.match(word) and last.startswith("--") and len(last) > 2 and "=" not in last:
            joined[-1] = f"{last}={word}"
        else:
            joined.append(word)
    return joined
