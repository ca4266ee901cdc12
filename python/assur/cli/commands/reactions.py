"""``assur reactions``: forces in joints and slides, and of the drive."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.cli.coordinates import add_coordinates, coordinates, plain, speeds
from assur.cli.failures import INCOMPLETE, report
from assur.cli.help import describe
from assur.cli.output import Output, add_output
from assur.cli.source import read, require_machine
from assur.cli.source_arguments import add_source
from assur.cli.terminal import note
from assur.cli.units import argument, numbers
from assur.description.words import Status
from assur.errors import AssurError

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Forces in joints and slides, torque or force of the drive, shaking force and moment\n"
        "of a machine (kinetostatics). Without flags those of the file's [reactions]; without\n"
        "a speed statics. Where there is no result the table has NaN, and the exit status is 3.",
        "assur reactions press.toml --q 0:360:10deg --speed 200rpm --out forces.csv",
        "assur reactions example:andrews_squeezer --speed 20rad/s --degrees",
    )
    add_source(parser, others=False)
    add_coordinates(parser)
    parser.add_argument(
        "--speed",
        metavar="SPEED",
        type=argument(numbers),
        help="of the driver, 10rad/s, 60rpm, 20mm/s; 1,2 for several drivers",
    )
    parser.add_argument(
        "--acceleration", metavar="NUMBER", type=argument(numbers), help="rad/s² or m/s²"
    )
    parser.add_argument(
        "--sense",
        metavar="SIGN",
        type=argument(numbers),
        help="1 or -1: direction in which the drive is about to move at speed 0, with friction",
    )
    parser.add_argument("--degrees", action="store_true", help="angles of the table in degrees")
    add_output(parser)


def run(arguments: argparse.Namespace) -> int:
    """Run the command."""
    output = Output(arguments.out, arguments.file)
    contents = read(arguments)
    machine = require_machine(contents, arguments.file)
    mechanism = contents.mechanism
    in_file = contents.wanted.get("reactions", {})
    asked: dict[str, Any] = {name: in_file[name] for name in in_file if name not in ("q", "deg")}
    flags = {
        "speed": speeds(mechanism, arguments.speed, "--speed"),
        "acceleration": plain(arguments.acceleration, mechanism, "--acceleration"),
        "sense": plain(arguments.sense, mechanism, "--sense"),
    }
    asked.update({name: value for name, value in flags.items() if value is not None})
    place = coordinates(mechanism, arguments.q, in_file or contents.wanted.get("solve", {}))
    if "deg" in place:
        from assur.kinematics.solve_arguments import in_radians

        place = {"q": in_radians(mechanism, None, place["deg"])}
    from assur._table import columns_of

    reactions = machine.reactions(**place, **{**asked, "on_error": "nan"})
    output.write(columns_of(reactions, arguments.degrees))
    without = reactions.status == Status.NO_VALUE
    unknown = np.isnan(reactions.driver).reshape(*reactions.status.shape, -1).any(axis=-1)
    failed = report(np.where(without, 0, reactions.status), Status.SINGULAR)
    if failed or not unknown.any():
        return failed
    why = ": friction locks the machine"
    if without.any():
        why = f"; the first: {_why(machine, reactions, asked)}"
    note(f"{int(unknown.sum())} of {unknown.size} positions have no reactions{why}")
    return INCOMPLETE


def _why(machine: Any, reactions: Any, asked: dict[str, Any]) -> str:
    """Return why the first position without a value has none."""
    at = tuple(np.argwhere(reactions.status == Status.NO_VALUE)[0])
    rates = {name: getattr(reactions, name)[at] for name in ("speed", "acceleration")}
    try:
        machine.reactions(reactions.q[at], **{**asked, **rates, "on_error": "raise"})
    except AssurError as error:
        return str(error)
    return "a load has no value there"
