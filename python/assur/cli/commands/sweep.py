"""``assur sweep``: many designs, measured."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.cli.coordinates import add_coordinates, coordinates
from assur.cli.designs import read_designs
from assur.cli.failures import INCOMPLETE
from assur.cli.help import describe
from assur.cli.output import Output, add_output
from assur.cli.progress import add_progress, progress
from assur.cli.source import read, require_one
from assur.cli.source_arguments import add_source
from assur.cli.terminal import note
from assur.cli.units import LENGTH, argument, evenly, kind_of
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur._table import Column
    from assur.cli.units import Numbers
    from assur.files import Contents
    from assur.sweeps.measures import Measures

POSITIONS = 72
# They and two metrics take a gigabyte.
MOST_DESIGNS = 20_000_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Measure every combination of some dimensions (--vary), or the designs of a table\n"
        "(--designs). Metrics are those of assur.metric: span(B.x), min(bore), max,\n"
        "mean, rms, min_transmission_angle(C), deviation(P, line, part=0.5), time_ratio(bore),\n"
        "path_error(P, ((0, 0), (10mm, 5mm)), kind=chamfer);\n"
        "of a machine peak_reaction(B, speed=20), peak_effort(); with order=1, over=(0,90deg),\n"
        "between=(B,D); with + - * / and numbers. A design that does not move over all\n"
        "positions, or misses a condition, has NaN; if no design is left, the exit status is 3.\n"
        "Results are in m and rad.",
        "assur sweep example:crank_rocker --vary coupler.length=90:150mm:20 "
        "--vary rocker.length=60:120mm:20 --metric 'gamma=min_transmission_angle(C)' "
        "--nlargest 5",
        "assur sweep example:engine --vary rod.length=0.1:0.2:50 --metric 'span(bore)' "
        "--out strokes.csv",
        "assur sweep example:crank_rocker --vary coupler.length=90:150mm:20 "
        "--metric 'off=deviation(P, line, relative=true)' "
        "--where 'min_transmission_angle(C) > 40deg'",
    )
    add_source(parser)
    parser.add_argument(
        "--vary",
        metavar="NAME=FROM:TO:COUNT",
        type=argument(_axis),
        action="append",
        default=[],
        help="values of a dimension, both ends included: coupler.length=100:200mm:50, or a list; "
        "several make a grid",
    )
    parser.add_argument(
        "--designs",
        metavar="TABLE.csv",
        help="a design in each row; the header names the dimensions, m and rad",
    )
    parser.add_argument(
        "--metric",
        metavar="NAME=METRIC",
        action="append",
        required=True,
        help="a metric, gamma=min_transmission_angle(C)",
    )
    parser.add_argument(
        "--where",
        metavar="CONDITION",
        action="append",
        default=[],
        help="drop designs that miss it: min_transmission_angle(C) > 40deg",
    )
    few = parser.add_mutually_exclusive_group()
    few.add_argument("--nsmallest", type=int, metavar="N", help="only N designs, least first")
    few.add_argument("--nlargest", type=int, metavar="N", help="only N designs, greatest first")
    parser.add_argument("--by", metavar="NAME", help="the metric for them; the first")
    add_coordinates(parser)
    parser.add_argument(
        "--positions",
        type=int,
        metavar="N",
        help=f"instead of --q: the number of even steps of a turn; {POSITIONS}",
    )
    parser.add_argument("--threads", type=int, metavar="N", help="most threads; one per core")
    add_output(parser)
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Run the command."""
    from assur.cli.metrics import condition, named_metric
    from assur.sweeps.measures import counts_text
    from assur.sweeps.sweep import sweep

    word = "nsmallest" if arguments.nlargest is None else "nlargest"
    most: int | None = getattr(arguments, word)
    if most is None and arguments.by is not None:
        arguments.parser.error("--by needs --nsmallest or --nlargest")
    if most is not None and most < 1:
        arguments.parser.error(f"--{word} needs a number of at least 1")
    if arguments.positions is not None and arguments.q is not None:
        arguments.parser.error("--positions is in place of --q")
    output = Output(arguments.out, arguments.file)
    metrics = dict(named_metric(text) for text in arguments.metric)
    if len(metrics) < len(arguments.metric):
        message = "--metric: two have the same name"
        raise InputError(message)
    by = _by(arguments, list(metrics))
    where = [condition(text) for text in arguments.where]
    contents = read(arguments)
    require_one(contents.mechanism, arguments.file)
    dimensions = _dimensions(arguments, contents.mechanism.core.dimension_names)
    rows = math.prod(np.broadcast_shapes(*map(np.shape, dimensions.values())))
    output.require_few(rows if most is None else min(rows, most))
    measures: Measures = sweep(
        contents.machine or contents.mechanism,
        dimensions,
        _positions(contents, arguments),
        metrics=metrics,
        where=where or None,
        threads=arguments.threads,
        progress=progress(arguments),
    )
    if not len(measures.kept):
        output.write(_columns(measures, None))
        note(f"no design is left: {counts_text(measures)}")
        return INCOMPLETE
    first = None if most is None else getattr(measures, word)(most, by)
    output.write(_columns(measures, first))
    return 0


def _by(arguments: argparse.Namespace, names: list[str]) -> str:
    if arguments.by is None:
        return names[0]
    if arguments.by not in names:
        message = f"--by {arguments.by}: there is no such --metric; there are {', '.join(names)}"
        raise InputError(message)
    return str(arguments.by)


def _dimensions(arguments: argparse.Namespace, known: Sequence[str]) -> Mapping[str, npt.ArrayLike]:
    from assur.sweeps.grid import Grid

    if arguments.designs is not None:
        if arguments.vary:
            arguments.parser.error("--designs is in place of --vary")
        return read_designs(arguments.designs, known)
    if not arguments.vary:
        arguments.parser.error("the designs are missing: --vary, or --designs")
    axes: dict[str, Float] = {}
    for name, values in arguments.vary:
        values.index_of(kind_of(name), f"--vary {name}")
        if name in axes:
            message = f"--vary {name} is given twice"
            raise InputError(message)
        axes[name] = values.values
    count = math.prod(map(len, axes.values()))
    if count > MOST_DESIGNS:
        message = f"--vary: these are {count} designs, of {MOST_DESIGNS} at most"
        raise InputError(message)
    return Grid(axes)


def _positions(contents: Contents, arguments: argparse.Namespace) -> Any:
    from assur.kinematics.solve_arguments import in_radians
    from assur.kinematics.table import driven_angles

    mechanism = contents.mechanism
    if arguments.q is None and driven_angles(mechanism) == [True]:
        count = POSITIONS if arguments.positions is None else arguments.positions
        if not 1 <= count <= 1_000_000:
            message = f"--positions is {count}: a whole number from 1 to 1000000 is needed"
            raise InputError(message)
        return np.linspace(0.0, math.tau, count, endpoint=False)
    if arguments.positions is not None:
        message = "--positions is for a driver that turns: give --q"
        raise InputError(message)
    place = coordinates(mechanism, arguments.q, contents.wanted.get("solve", {}))
    q = in_radians(mechanism, None, place["deg"]) if "deg" in place else place["q"]
    return np.atleast_1d(q) if len(driven_angles(mechanism)) == 1 else np.atleast_2d(q)


def _columns(measures: Measures, best: npt.NDArray[np.intp] | None) -> list[Column]:
    """Return the columns of `Measures.to_dataframe`, of the best designs or of all."""
    from assur._table import Column, design_columns
    from assur.sweeps.measures import changed_dimensions

    size = measures.status.size
    which = np.arange(size) if best is None else best
    columns = [*design_columns(measures.shape, len(measures.shape))]
    for name, values in changed_dimensions(measures).items():
        unit = "m" if kind_of(name) == LENGTH else "rad"
        columns.append(Column(name, values, unit, None))
    columns.append(Column("status", measures.status.reshape(-1), "", None))
    columns.append(Column("kept", np.isin(np.arange(size), measures.kept), "", None))
    taken = {column.name for column in columns}
    for name, values in measures.items():
        shown = f"metric {name}" if name in taken else name
        columns.append(Column(shown, values.reshape(-1), "", "metrics"))
    return [column._replace(values=column.values[which]) for column in columns]


def _axis(text: str) -> tuple[str, Numbers]:
    name, equals, values = text.partition("=")
    if not equals or not name.strip():
        message = f"{text[:60]!r}: NAME=FROM:TO:COUNT is needed, coupler.length=0.1:0.2:50"
        raise InputError(message)
    return name.strip(), evenly(values)
