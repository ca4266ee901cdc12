"""The command line: ``assur flywheel table.csv --fluctuation 0.125 --mean-speed 15``."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from assur import flywheel
from assur._core import version
from assur.errors import AssurError

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Parameters
    ----------
    arguments : sequence of str, optional
        Words behind the program's name; those of the process by default.

    Returns
    -------
    int
        0, or 1 after an error that is told on the standard error.
    """
    given = _parser().parse_args(arguments)
    try:
        given.run(given)
    except AssurError as error:
        print(f"assur: {error}", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="assur", description="Planar linkages.")
    parser.add_argument("--version", action="version", version=f"assur {version()}")
    commands = parser.add_subparsers(title="commands", required=True)
    wheel = commands.add_parser(
        "flywheel",
        help="the flywheel for a table of reduced moment and inertia",
        description="The flywheel with which the speed varies by a given part of its mean.",
    )
    wheel.add_argument("table", help="columns phi (rad), moment (N·m), inertia (kg·m²); one period")
    one = wheel.add_mutually_exclusive_group(required=True)
    one.add_argument("--fluctuation", type=float, help="coefficient δ wanted")
    one.add_argument("--flywheel", type=float, help="a given flywheel, kg·m², instead")
    wheel.add_argument("--mean-speed", type=float, required=True, help="rad/s")
    wheel.add_argument("--mean", choices=flywheel.MEANS, default="extremes")
    wheel.add_argument("--spline", choices=flywheel.SPLINES, default="not-a-knot")
    wheel.add_argument("--degrees", action="store_true", help="phi is in degrees")
    wheel.add_argument("--plot", metavar="PICTURE", help="draw the speed over the turn to a file")
    wheel.set_defaults(run=_flywheel)
    return parser


def _flywheel(given: argparse.Namespace) -> None:
    table = flywheel.read_table(given.table, degrees=given.degrees)
    if given.flywheel is None:
        f = flywheel.from_table(
            *table, given.fluctuation, given.mean_speed, mean=given.mean, spline=given.spline
        )
    else:
        f = flywheel.evaluate(
            *table,
            given.flywheel,
            mean_speed=given.mean_speed,
            mean=given.mean,
            spline=given.spline,
        )
    print(f"flywheel      {f.inertia:.9g} kg·m²")
    print(f"fluctuation   {f.delta:.9g}")
    print(f"mean speed    {f.mean_speed:.9g} rad/s ({given.mean})")
    print(f"speed0        {f.speed0:.9g} rad/s")
    print(f"greatest      {f.greatest.value:.9g} rad/s at {f.greatest.at:.6g} rad")
    print(f"least         {f.least.value:.9g} rad/s at {f.least.at:.6g} rad")
    print(f"motor         {f.motor_moment:.9g} N·m")
    print(f"period        {f.period:.9g} s")
    if given.plot:
        f.plot().figure.savefig(given.plot)


if __name__ == "__main__":
    sys.exit(main())
