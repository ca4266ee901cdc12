"""The coordinates of the drivers, ``--q``, and their speeds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.cli.units import ANGLE, LENGTH, LINEAR, ROTARY, argument, numbers
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping

    from assur._arrays import Float
    from assur.cli.units import Numbers
    from assur.kinematics.mechanism import Mechanism

# Without --q and without one in the file a driver that is an angle turns once.
TURN = "0:360:1deg"


def add_coordinates(parser: argparse.ArgumentParser) -> None:
    """Add ``--q``."""
    parser.add_argument(
        "--q",
        metavar="START:END:STEP",
        type=argument(numbers),
        action="append",
        help="the driver's coordinate: 0:360:1deg, 0,90,180deg, 0.1:0.3:0.01 (rad or m), 50mm; "
        "of several drivers one --q each; by default what the file asks for, or a turn",
    )


def coordinates(
    mechanism: Mechanism, flags: list[Numbers] | None, in_file: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the argument ``q`` of a method, or ``deg``: from flags, or from the file."""
    from assur.kinematics.table import driven_angles

    angles = driven_angles(mechanism)
    if flags is None:
        asked = {name: in_file[name] for name in ("q", "deg") if name in in_file}
        if asked:
            return asked
        if angles != [True]:
            message = "nothing says where the drivers go: give --q for each, such as --q 0:0.1:0.01"
            raise InputError(message)
        flags = [numbers(TURN)]
    if len(flags) != len(angles):
        message = f"--q is given {len(flags)} times: the mechanism has {len(angles)} drivers"
        if len(angles) == 1:
            message = f"--q is given {len(flags)} times: the mechanism has one driver"
        raise InputError(message)
    for values, is_angle in zip(flags, angles, strict=True):
        values.index_of(ANGLE if is_angle else LENGTH, "--q")
    if len(flags) == 1:
        return {"q": flags[0].values}
    return {"q": _together([values.values for values in flags])}


def _together(columns: list[Float]) -> Float:
    """Return the positions of several drivers; one number holds its driver."""
    counts = {len(column) for column in columns if column.ndim}
    if len(counts) > 1:
        shown = ", ".join("1" if not column.ndim else str(len(column)) for column in columns)
        message = f"--q: the drivers have {shown} positions: the same number of each is needed"
        raise InputError(message)
    return np.stack(np.broadcast_arrays(*columns), axis=-1)


def speeds(mechanism: Mechanism, flag: Numbers | None, what: str) -> Any:
    """Return a speed, one for each of several drivers; None if none is given."""
    from assur.kinematics.table import driven_angles

    if flag is None:
        return None
    angles = driven_angles(mechanism)
    if flag.values.size != len(angles) or flag.values.ndim > 1:
        drivers = "one number is" if len(angles) == 1 else f"{len(angles)} numbers, 1,2, are"
        message = f"{what} has {flag.values.size} numbers: {drivers} needed"
        raise InputError(message)
    if flag.unit is not None:
        for is_angle in angles:
            flag.index_of(ROTARY if is_angle else LINEAR, what)
    return float(flag.values.ravel()[0]) if len(angles) == 1 else flag.values


def plain(flag: Numbers | None, mechanism: Mechanism, what: str) -> Any:
    """Return an acceleration, one for each of several drivers: always in SI units."""
    if flag is not None and flag.unit is not None:
        message = f"{what} is in rad/s² or m/s²: write no unit"
        raise InputError(message)
    return speeds(mechanism, flag, what)
