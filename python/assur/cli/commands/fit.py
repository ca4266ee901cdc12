"""``assur fit``: dimensions with which a mechanism does a task."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.cli.finding import add_finding, options, require_folder, show
from assur.cli.help import describe
from assur.cli.path_file import read_points, read_rows
from assur.cli.source import read, require_one
from assur.cli.source_arguments import add_source
from assur.cli.units import LENGTH, argument, evenly, kind_of, numbers
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.cli.units import Numbers


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Dimensions with which a mechanism draws a path, gives a function or carries a link\n"
        "through poses: rows of a file, with or without a header. Designs are measured and proved\n"
        "by the solver; the best come first.",
        "assur fit example:crank_rocker --path points.csv --evaluations 1",
        "assur fit example:crank_rocker --path points.csv --where "
        "'min_transmission_angle(C) > 30deg' --evaluations 1 --out found",
    )
    add_source(parser, others=False)
    goal = parser.add_mutually_exclusive_group(required=True)
    goal.add_argument("--path", metavar="POINTS.csv", help="points x,y, m, for a joint")
    goal.add_argument(
        "--function",
        metavar="VALUES.csv",
        help="coordinate,value rows for a link's angle, rad, a slide or P.x, m",
    )
    goal.add_argument(
        "--poses", metavar="POSES.csv", help="x,y,angle rows, m and rad, for a link's frame"
    )
    parser.add_argument("--of", metavar="NAME", help="the joint, link or slide; P of a path")
    parser.add_argument(
        "--timing",
        action="store_true",
        help="a third column of the path is the driver's coordinate, rad or m",
    )
    parser.add_argument(
        "--scale",
        dest="points_scale",
        metavar="LENGTH",
        type=argument(numbers),
        help="the points' unit: 1mm; 1m",
    )
    parser.add_argument(
        "--vary", metavar="NAME", action="append", help="a dimension, coupler.*; all by default"
    )
    parser.add_argument(
        "--bounds",
        metavar="NAME=FROM:TO",
        type=argument(_bounds),
        action="append",
        default=[],
        help="least and greatest value of a dimension: *.length=20:200mm",
    )
    parser.add_argument(
        "--where",
        metavar="CONDITION",
        action="append",
        default=[],
        help="a condition over the travel: min_transmission_angle(C) > 40deg",
    )
    parser.add_argument(
        "--similarity", action="store_true", help="the path may be moved, turned and scaled"
    )
    turning = parser.add_mutually_exclusive_group()
    turning.add_argument(
        "--full-rotation", action="store_true", default=None, help="the driver turns fully"
    )
    turning.add_argument(
        "--part-turn", dest="full_rotation", action="store_false", help="it need not"
    )
    add_finding(parser)


def _bounds(text: str) -> tuple[str, Numbers]:
    """Return a name with its least and its greatest value."""
    name, equals, ends = text.partition("=")
    if not equals or not name.strip() or ends.count(":") != 1:
        message = f"{text!r}: NAME=FROM:TO is needed, *.length=20:200mm"
        raise InputError(message)
    return name.strip(), evenly(f"{ends}:2")


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    from assur.cli.metrics import condition
    from assur.fitting.fit import fit

    require_folder(arguments.out)
    mechanism = read(arguments).mechanism
    require_one(mechanism, arguments.file)
    given = options(arguments, "full_rotation", "vary")
    targets = _targets(arguments, given)
    known = list(mechanism.dimensions)
    if arguments.bounds:
        given["bounds"] = {
            name: ends.pair(_kind(name, known), f"--bounds {name}")
            for name, ends in arguments.bounds
        }
    if arguments.similarity:
        given["similarity"] = True
    given["where"] = [condition(text) for text in arguments.where]
    show(fit(mechanism, targets, **given), arguments.out)


def _targets(arguments: argparse.Namespace, given: dict[str, Any]) -> dict[str, Any]:
    """Return the target of the file; a timing goes to the other arguments."""
    scale = 1.0 if arguments.points_scale is None else arguments.points_scale.one(LENGTH, "--scale")
    if arguments.path is not None:
        of = arguments.of or "P"
        if not arguments.timing:
            return {of: scale * read_points(arguments.path)}
        rows = read_rows(arguments.path, ("x", "y", "q"), "point with its coordinate")
        given["timing"] = rows[:, 2]
        return {of: scale * rows[:, :2]}
    if arguments.of is None:
        arguments.parser.error("--function and --poses need --of NAME")
    if arguments.function is not None:
        rows = read_rows(arguments.function, ("q", "value"), "value")
        return {arguments.of: (rows[:, 0], rows[:, 1])}
    rows = read_rows(arguments.poses, ("x", "y", "angle"), "pose")
    rows[:, :2] *= scale
    return {arguments.of: rows}


def _kind(pattern: str, known: list[str]) -> str:
    """Return the kind of the dimensions that a pattern matches."""
    from fnmatch import fnmatchcase

    names = [name for name in known if fnmatchcase(name, pattern)]
    return kind_of(names[0]) if names else LENGTH
