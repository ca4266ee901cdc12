"""``assur extremes``: stroke, swing and time ratio."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.cli.help import describe
from assur.cli.output import Output, add_output
from assur.cli.source import read, require_one
from assur.cli.source_arguments import add_source

if TYPE_CHECKING:
    import argparse

    from assur._table import Column
    from assur.kinematics.extremes import Extremes
    from assur.kinematics.mechanism import Mechanism


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "The least and the greatest value of a coordinate, where they are, the stroke or swing\n"
        "between them and the time ratio at a constant speed of the driver.",
        "assur extremes example:shaper bed",
        "assur extremes example:crank_rocker rocker --degrees",
        "assur extremes example:engine bore --order 1 --out speed.csv",
    )
    add_source(parser)
    parser.add_argument("name", metavar="NAME", help="a slide, a link, or a joint's B.x or B.y")
    parser.add_argument(
        "--order", type=int, default=0, help="1 to 3: of the first to third analogue; 0"
    )
    parser.add_argument("--degrees", action="store_true", help="angles in degrees")
    add_output(parser)


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    from assur.kinematics.table import driven_angles

    output = Output(arguments.out, arguments.file)
    mechanism = read(arguments).mechanism
    require_one(mechanism, arguments.file)
    extremes = mechanism.extremes(arguments.name, order=arguments.order)
    of_driver = _unit(
        driven_angles(mechanism)[0] and arguments.degrees, driven_angles(mechanism)[0]
    )
    is_angle = arguments.name in mechanism.links
    unit = _unit(is_angle and arguments.degrees and not arguments.order, is_angle)
    if arguments.order:
        unit = f"{unit}/{'rad' if of_driver == 'deg' else of_driver}" + (
            f"^{arguments.order}" if arguments.order > 1 else ""
        )
    if arguments.out is not None:
        output.write(_columns(extremes, of_driver, unit))
    if arguments.out != "-":
        for name, at in (("min", extremes.min), ("max", extremes.max)):
            value, q = _shown(at.value, unit), _shown(at.q, of_driver)
            print(f"{name:<10}  {value!r} {unit} at q = {q!r} {of_driver}")
        print(f"stroke      {_shown(extremes.stroke, unit)!r} {unit}")
        if extremes.time_ratio is not None:
            print(f"time ratio  {extremes.time_ratio!r}")
        if is_angle and not arguments.order:
            for line in _instead(mechanism, arguments.name, extremes):
                print(line)


def _instead(mechanism: Mechanism, link: str, extremes: Extremes) -> list[str]:
    """Return the notes on a link that does not turn: which of its slides move."""
    from assur.kinematics.configuration import size_of
    from assur.kinematics.extremes import STANDS

    if extremes.stroke > STANDS:
        return []
    lines = [f"note        {link} does not turn"]
    for name, slide in mechanism.slides.items():
        if link not in (slide.link, slide.on):
            continue
        stroke = mechanism.extremes(name).stroke
        if stroke > STANDS * size_of(mechanism):
            lines.append(f"note        it slides: {name} has a stroke of {float(stroke)!r} m")
    return lines


def _unit(in_degrees: bool, is_angle: bool) -> str:
    return "deg" if in_degrees else "rad" if is_angle else "m"


def _shown(value: float, unit: str) -> float:
    return float(np.degrees(value)) if unit == "deg" else float(value)


def _columns(extremes: Extremes, of_driver: str, unit: str) -> list[Column]:
    """Return a row for each of the two."""
    from assur._table import Column

    both = extremes.min, extremes.max
    return [
        Column("q", np.array([_shown(at.q, of_driver) for at in both]), of_driver, "extremes"),
        Column("value", np.array([_shown(at.value, unit) for at in both]), unit, "extremes"),
    ]
