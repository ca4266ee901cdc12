"""The arguments that say what to read: FILE, changes of it, how to read it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.cli.units import argument, numbers
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.cli.units import Numbers


def add_source(parser: argparse.ArgumentParser, others: bool = True) -> None:
    """Add the arguments that `assur.cli.source.read` takes.

    `others`: also those for files of other programs.
    """
    parser.add_argument(
        "file",
        metavar="FILE",
        help="a TOML file, a file of another program, example:NAME, or - for the standard input",
    )
    parser.add_argument(
        "--set",
        metavar="NAME=VALUE",
        type=argument(_setting),
        action="append",
        default=[],
        help="change a dimension, coupler.length=120mm; m and rad without a unit",
    )
    parser.add_argument(
        "--design", type=int, metavar="I", help="one design of a file of several, from 0"
    )
    if not others:
        parser.set_defaults(format=None, scale=None, drivers=None)
        return
    group = parser.add_argument_group("files of other programs")
    group.add_argument(
        "--format", metavar="NAME", help="pmks, pmks_plus, pylinkage, pyslvs or linkage2"
    )
    group.add_argument(
        "--scale",
        metavar="LENGTH",
        type=argument(numbers),
        help="the file's unit of length, such as 1mm; by default 1m, and 1/96 inch in Linkage",
    )
    group.add_argument(
        "--drivers",
        metavar="I-J",
        type=argument(_pairs),
        help="drivers of a pyslvs expression, each by its two points, 0-1",
    )


def _setting(text: str) -> tuple[str, Numbers]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        message = f"{text[:60]!r}: NAME=VALUE is needed, such as coupler.length=120mm"
        raise InputError(message)
    return name.strip(), numbers(value)


def _pairs(text: str) -> list[tuple[int, int]]:
    try:
        pairs = [tuple(int(end) for end in pair.split("-")) for pair in text.split(",")]
        return [(first, second) for first, second in pairs]
    except ValueError as error:
        message = f"{text[:60]!r}: pairs of points are needed, such as 0-1 or 0-1,2-3"
        raise InputError(message) from error
