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


def run(given: argparse.Namespace) -> None:
    """Run the command."""
    from assur.kinematics.table import driven_angles

    output = Output(given.out, given.file)
    mechanism = read(given).mechanism
    require_one(mechanism, given.file)
    found = mechanism.extremes(given.name, order=given.order)
    of_driver = _unit(driven_angles(mechanism)[0] and given.degrees, driven_angles(mechanism)[0])
    is_angle = given.name in mechanism.links
    unit = _unit(is_angle and given.degrees and not given.order, is_angle)
    if given.order:
        unit = f"{unit}/{'rad' if of_driver == 'deg' else of_driver}" + (
            f"^{given.order}" if given.order > 1 else ""
        )
    if given.out is not None:
        output.write(_columns(found, of_driver, unit))
    if given.out != "-":
        for name, at in (("least", found.least), ("greatest", found.greatest)):
            value, q = _shown(at.value, unit), _shown(at.q, of_driver)
            print(f"{name:<10}  {value!r} {unit} at q = {q!r} {of_driver}")
        print(f"stroke      {_shown(found.stroke, unit)!r} {unit}")
        if found.time_ratio is not None:
            print(f"time ratio  {found.time_ratio!r}")
        if is_angle and not given.order:
            for line in _instead(mechanism, given.name, found):
                print(line)


def _instead(mechanism: Mechanism, link: str, found: Extremes) -> list[str]:
    """Return, of a link that does not turn, which of its slides move."""
    from assur.kinematics.configuration import size_of
    from assur.kinematics.extremes import STANDS

    if found.stroke > STANDS:
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


def _columns(found: Extremes, of_driver: str, unit: str) -> list[Column]:
    """Return a row for each of the two."""
    from assur._table import Column

    both = found.least, found.greatest
    return [
        Column("q", np.array([_shown(at.q, of_driver) for at in both]), of_driver, "extremes"),
        Column("value", np.array([_shown(at.value, unit) for at in both]), unit, "extremes"),
    ]
