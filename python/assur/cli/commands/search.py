"""``assur search``: linkages that draw a path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.cli.finding import add_finding, options, require_folder, show
from assur.cli.help import describe
from assur.cli.path_file import read_points
from assur.cli.units import ANGLE, LENGTH, argument, numbers

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Linkages of one crank and dyads that draw the path through the points of a file: a row\n"
        "x,y each, with or without a header. They are measured and proved over the whole turn;\n"
        "the best come first. Lengths are over the path's root mean square radius.",
        "assur search --path points.csv --joints 8 --evaluations 1",
        "assur search --path points.csv --scale 1mm --evaluations 1 --out found",
    )
    parser.add_argument("--path", metavar="POINTS.csv", required=True, help="the points, m")
    parser.add_argument(
        "--scale", metavar="LENGTH", type=argument(numbers), help="the file's unit: 1mm; 1m"
    )
    parser.add_argument("--joint", metavar="NAME", default="P", help="the traced joint; P")
    parser.add_argument("--joints", type=int, metavar="N", help="most joints; 12")
    parser.add_argument(
        "--min-apex-angle",
        metavar="ANGLE",
        type=argument(numbers),
        help="least angle between the bars of a dyad, over the whole turn; 20deg",
    )
    parser.add_argument(
        "--frame",
        type=float,
        metavar="RADII",
        help="diameter of the circle about the path that holds every joint, in its radii; 20",
    )
    parser.add_argument(
        "--min-arc",
        metavar="ANGLE",
        type=argument(numbers),
        help="least turn of the crank over an open path; 90deg",
    )
    parser.add_argument(
        "--joint-price",
        type=float,
        metavar="PART",
        help="what a joint must lower the error by; 0.02",
    )
    add_finding(parser)


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    from assur.fitting.search import search

    require_folder(arguments.out)
    points = read_points(arguments.path)
    if arguments.scale is not None:
        points = points * arguments.scale.one(LENGTH, "--scale")
    given = options(arguments, "joints", "frame", "joint_price")
    for name in ("min_apex_angle", "min_arc"):
        if (angle := getattr(arguments, name)) is not None:
            given[name] = angle.one(ANGLE, f"--{name.replace('_', '-')}")
    show(search({arguments.joint: points}, **given), arguments.out)
