"""``assur limits``: where the driver can move."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from assur.cli.help import describe
from assur.cli.output import Output, add_output
from assur.cli.source import read, require_one
from assur.cli.source_arguments import add_source
from assur.kinematics.limits import period_of_one

if TYPE_CHECKING:
    import argparse

    from assur._table import Column
    from assur.kinematics.limits import Limits
    from assur.kinematics.mechanism import Mechanism


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Intervals of the driver's coordinate in which the drawn assembly exists, its dead\n"
        "points, after how many turns the motion closes, and how many assemblies there are at\n"
        "the drawing's coordinate.",
        "assur limits example:pentagon --degrees",
        "assur limits example:crank_rocker --set rocker.length=1.2 --out intervals.csv",
    )
    add_source(parser)
    parser.add_argument("--degrees", action="store_true", help="angles in degrees")
    add_output(parser)


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    from assur.kinematics.table import driven_angles

    output = Output(arguments.out, arguments.file)
    mechanism = read(arguments).mechanism
    require_one(mechanism, arguments.file)
    limits = mechanism.limits()
    is_angle = driven_angles(mechanism)[0]
    unit = "m" if not is_angle else "deg" if arguments.degrees else "rad"
    if arguments.out is not None:
        output.write(_columns(limits, unit))
    if arguments.out != "-":
        _print(mechanism, limits, unit)


def _shown(q: float, unit: str) -> float:
    return float(np.degrees(q)) if unit == "deg" else q


def _print(mechanism: Mechanism, limits: Limits, unit: str) -> None:
    parts = [
        "everywhere"
        if math.isinf(low) and math.isinf(high)
        else f"[{_shown(low, unit)!r}, {_shown(high, unit)!r}] {unit}"
        for low, high in limits.intervals.tolist()
    ]
    print(f"intervals      {', '.join(parts) or 'none'}")
    print(f"full rotation  {'yes' if limits.full_rotation else 'no'}")
    period = period_of_one(limits)
    turns = {None: "does not close", 1: "closes in 1 turn"}
    print(f"period         {turns.get(period, f'closes in {period} turns')}")
    for point in limits.dead_points:
        group = point.group or "two guides become parallel"
        print(f"dead point     {_shown(point.q, unit)!r} {unit}, {group}")
    if not limits.dead_points:
        print("dead points    none")
    q0 = float(mechanism.q0)
    assemblies = mechanism.assemblies(q0)
    at = f"{_shown(q0, unit)!r} {unit}"
    of = f", of {math.prod(assemblies.complex_count)} complex" if assemblies.complex_count else ""
    print(f"assemblies     {len(assemblies)} at q = {at}{of}")


def _columns(limits: Limits, unit: str) -> list[Column]:
    """Return a row for each interval."""
    from assur._table import Column

    groups = {point.q: point.group or "" for point in limits.dead_points}
    columns = []
    for name, ends in zip(("start", "end"), limits.intervals.reshape(-1, 2).T, strict=True):
        values = np.degrees(ends) if unit == "deg" else ends
        columns.append(Column(name, values, unit, "limits"))
        at = np.array([groups.get(q, "") for q in ends.tolist()], dtype=np.str_)
        columns.append(Column(f"{name}_group", at, "", "limits"))
    return columns
