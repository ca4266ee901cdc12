"""``assur structure``: mobility, Assur groups, dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.cli.help import describe
from assur.cli.source import read
from assur.cli.source_arguments import add_source
from assur.cli.units import LENGTH, kind_of

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "The structural formula, the mobility and the Assur groups in solving order.",
        "assur structure example:stephenson_3",
        "assur structure example:crank_rocker --dimensions",
    )
    add_source(parser)
    parser.add_argument(
        "--dimensions",
        action="store_true",
        help="also the dimensions, by the names that --set and --vary take",
    )


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    mechanism = read(arguments).mechanism
    print(mechanism.structure)
    if mechanism.shape:
        print(f"{mechanism.shape} designs")
    if not arguments.dimensions:
        return
    for name, value in mechanism.dimensions.items():
        unit = "m" if kind_of(name) == LENGTH else "rad"
        if mechanism.shape:
            text = f"{float(np.min(value))!r} to {float(np.max(value))!r}"
        else:
            text = repr(float(value))
        print(f"{name} = {text} {unit}")
