"""``assur plot``: a picture of a mechanism."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING

from assur.cli.coordinates import add_coordinates, coordinates
from assur.cli.help import describe
from assur.cli.named import EXAMPLE
from assur.cli.source import STDIN, read, require_one
from assur.cli.source_arguments import add_source

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Draw the mechanism at one position, or with --joint the path of a joint over the turn.\n"
        "A picture that exists is replaced.",
        "assur plot example:klann_leg --out klann.png",
        "assur plot example:crank_rocker --q 60deg --out at60.svg",
        "assur plot example:crank_rocker --joint P --out path.svg",
    )
    add_source(parser)
    add_coordinates(parser)
    parser.add_argument("--joint", metavar="NAME", help="draw the path of this joint")
    parser.add_argument(
        "--out", metavar="PICTURE", help=".png, .svg, .pdf …; by default FILE's name with .svg"
    )


def run(given: argparse.Namespace) -> None:
    """Run the command."""
    from assur.cli.picture import save_figure
    from assur.cli.written import refuse_same, require_writable

    out = given.out or f"{_stem(given.file)}.svg"
    refuse_same(out, given.file)
    require_writable(out)
    contents = read(given)
    mechanism = contents.mechanism
    require_one(mechanism, given.file)
    if given.joint is not None:
        place = coordinates(mechanism, given.q, contents.wanted.get("solve", {}))
        motion = mechanism.solve(**place, order=0, on_error="nan")
        save_figure(lambda: motion.plot(given.joint), out)
    else:
        q = None if given.q is None else coordinates(mechanism, given.q, {})["q"]
        save_figure(lambda: mechanism.plot(q), out)
    print(out)


def _stem(file: str) -> str:
    """Return what a picture is called if it has no name."""
    if file == STDIN or "://" in file:
        return "mechanism"
    return PurePath(file.removeprefix(EXAMPLE)).stem or "mechanism"
