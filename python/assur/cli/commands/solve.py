"""``assur solve``: positions and their derivatives."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from assur.cli.coordinates import add_coordinates, coordinates, plain, speeds
from assur.cli.failures import report
from assur.cli.help import describe
from assur.cli.output import Output, add_output
from assur.cli.progress import add_progress, progress
from assur.cli.source import read
from assur.cli.source_arguments import add_source
from assur.cli.units import argument, numbers
from assur.description.words import Status

if TYPE_CHECKING:
    import argparse

    from assur.files import Contents
    from assur.kinematics.motion import Motion


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Positions of joints, links and slides, with their derivatives by the driver's\n"
        "coordinate, or velocities (--speed). Without --q, --order and --outputs those of\n"
        "the file's [solve]. Where a position cannot be solved the table has NaN (its status\n"
        "says why), and the exit status is 3.",
        "assur solve example:jansen_leg",
        "assur solve example:crank_rocker --q 0:360:30deg --outputs C,rocker --out turn.csv",
        "assur solve example:engine --set rod.length=220mm --speed 3000rpm --degrees",
        "assur solve example:five_bar --q 1.5:2:0.1 --q 1.2 --order 0",
    )
    add_source(parser)
    add_coordinates(parser)
    parser.add_argument(
        "--order", type=int, choices=range(4), help="highest order of the derivatives; 2"
    )
    parser.add_argument("--outputs", metavar="NAMES", help="joints, links, slides: C,rocker; all")
    parser.add_argument(
        "--speed",
        metavar="SPEED",
        type=argument(numbers),
        help="speed of the driver, 10rad/s, 60rpm, 20mm/s: velocities in place of derivatives; "
        "of several drivers 1,2",
    )
    parser.add_argument(
        "--acceleration",
        metavar="NUMBER",
        type=argument(numbers),
        help="its acceleration, rad/s² or m/s²",
    )
    parser.add_argument("--degrees", action="store_true", help="angles of the table in degrees")
    parser.add_argument("--moving", action="store_true", help="only what moves")
    add_output(parser)
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Run the command."""
    from assur.kinematics.table import Options, motion_columns

    output = Output(arguments.out, arguments.file)
    contents = read(arguments)
    speed = speeds(contents.mechanism, arguments.speed, "--speed")
    acceleration = plain(arguments.acceleration, contents.mechanism, "--acceleration")
    motion = _motion(contents, arguments, output)
    rates = speed, 0.0 if acceleration is None else acceleration
    options = Options(*rates, degrees=arguments.degrees, moving=arguments.moving)
    output.write(motion_columns(motion, options))
    return report(motion.status, Status.UNREACHABLE, motion)


def _motion(contents: Contents, arguments: argparse.Namespace, output: Output) -> Motion:
    from assur.kinematics.solve_arguments import in_radians
    from assur.sweeps.sweep import sweep

    mechanism, in_file = contents.mechanism, contents.wanted.get("solve", {})
    asked = {name: in_file[name] for name in ("order", "outputs") if name in in_file}
    if arguments.order is not None:
        asked["order"] = arguments.order
    if arguments.outputs is not None:
        asked["outputs"] = [name.strip() for name in arguments.outputs.split(",")]
    place = coordinates(mechanism, arguments.q, in_file)
    drivers = mechanism.driver_count
    size = np.size(place["q"] if "q" in place else place["deg"])
    output.require_few(size // drivers * math.prod(mechanism.shape))
    if not mechanism.shape:
        motion: Motion = mechanism.solve(**place, **asked, on_error="nan")
        return motion
    q = in_radians(mechanism, None, place["deg"]) if "deg" in place else place["q"]
    many: Motion = sweep(mechanism, {}, q, **asked, progress=progress(arguments))
    return many
