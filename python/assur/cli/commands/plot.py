"""``assur plot``: a picture of a mechanism, a film, or a page that plays it."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.cli.coordinates import add_coordinates, coordinates
from assur.cli.help import describe
from assur.cli.named import EXAMPLE
from assur.cli.source import STDIN, read, require_one
from assur.cli.source_arguments import add_source
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.kinematics.mechanism import Mechanism

FILMS = (".gif", ".webp", ".mp4")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Draw the mechanism at one position or at many, or with --joint the paths of joints over\n"
        "the turn. A name in .gif, .webp or .mp4 gives a film, .html a page that plays. A file\n"
        "that exists is replaced.",
        "assur plot example:klann_leg --out klann.png",
        "assur plot example:crank_rocker --q 0:330:30deg --groups --out positions.svg",
        "assur plot example:crank_rocker --joint P --out path.svg",
        "assur plot example:crank_rocker --joint P --out rocker.gif",
        "assur plot example:shaper --out shaper.html",
    )
    add_source(parser)
    add_coordinates(parser)
    parser.add_argument(
        "--joint", metavar="NAME", action="append", help="draw the path of this joint (again: more)"
    )
    parser.add_argument("--groups", action="store_true", help="each Assur group in its colour")
    parser.add_argument("--dark", action="store_true", help="for dark backgrounds")
    parser.add_argument(
        "--out",
        metavar="PICTURE",
        help=".png, .svg, .pdf, .gif, .html …; by default FILE's name with .svg",
    )


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    from assur.cli.written import refuse_same, require_writable

    out = arguments.out or f"{_stem(arguments.file)}.svg"
    refuse_same(out, arguments.file)
    require_writable(out)
    contents = read(arguments)
    mechanism = contents.mechanism
    require_one(mechanism, arguments.file)
    suffix = PurePath(out).suffix.lower()
    asked = contents.wanted.get("solve", {})
    if suffix == ".html":
        _write_page(arguments, mechanism, asked, out)
    elif suffix in FILMS:
        motion = mechanism.solve(
            **coordinates(mechanism, arguments.q, asked), order=0, on_error="nan"
        )
        motion.animate(out, joint=arguments.joint, groups=arguments.groups, dark=arguments.dark)
    else:
        _draw(arguments, mechanism, asked, out)
    print(out)


def _draw(arguments: argparse.Namespace, mechanism: Mechanism, asked: Any, out: str) -> None:
    from assur.cli.picture import save_figure

    shown = {"groups": arguments.groups, "dark": arguments.dark}
    if arguments.joint is not None:
        place = coordinates(mechanism, arguments.q, asked)
        motion = mechanism.solve(**place, order=0, on_error="nan")
        save_figure(lambda: motion.plot(arguments.joint, **shown), out)
    else:
        q = None if arguments.q is None else coordinates(mechanism, arguments.q, {})["q"]
        save_figure(lambda: mechanism.plot(q, **shown), out)


def _write_page(arguments: argparse.Namespace, mechanism: Mechanism, asked: Any, out: str) -> None:
    if arguments.groups:
        message = "--groups: a page has a switch for them"
        raise InputError(message)
    shown = {"joint": arguments.joint, "dark": True if arguments.dark else None}
    if arguments.q is None and not isinstance(mechanism.driver, tuple):
        mechanism.to_html(out, **shown)
        return
    place = coordinates(mechanism, arguments.q, asked)
    if np.ndim(place.get("q", [])) == 0:
        mechanism.to_html(out, **place, **shown)
        return
    mechanism.solve(**place, on_error="nan").to_html(out, **shown)


def _stem(file: str) -> str:
    """Return the name of a picture's file by default."""
    if file == STDIN or "://" in file:
        return "mechanism"
    return PurePath(file.removeprefix(EXAMPLE)).stem or "mechanism"
