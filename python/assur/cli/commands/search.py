"""``assur search``: linkages that draw a path."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur.cli.help import describe
from assur.cli.path_file import read_points
from assur.cli.progress import add_progress, search_progress
from assur.cli.units import ANGLE, LENGTH, argument, numbers
from assur.cli.written import cannot_write, require_writable
from assur.errors import InputError

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
    closing = parser.add_mutually_exclusive_group()
    closing.add_argument(
        "--closed", action="store_true", default=None, help="the last point leads to the first"
    )
    closing.add_argument("--open", dest="closed", action="store_false", help="it does not")
    parser.add_argument(
        "--joint-price",
        type=float,
        metavar="PART",
        help="what a joint must lower the error by; 0.02",
    )
    parser.add_argument(
        "--robust", type=float, metavar="PART", help="rank by the error after lengths changed, 1e-3"
    )
    parser.add_argument("--time-limit", type=float, metavar="SECONDS", help="time for it all; 10")
    parser.add_argument(
        "--evaluations", type=int, metavar="N", help="in place of the time: linkages to evaluate"
    )
    parser.add_argument("--seed", type=int, metavar="N", help="another one finds others; 0")
    parser.add_argument("--threads", type=int, metavar="N", help="most threads; one per core")
    parser.add_argument("--out", metavar="FOLDER", help="writes each as a TOML file there")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    from assur.fitting.search import search

    if arguments.out is not None:
        _require_folder(arguments.out)
    points = read_points(arguments.path)
    if arguments.scale is not None:
        points = points * arguments.scale.one(LENGTH, "--scale")
    found = search({arguments.joint: points}, **_options(arguments))
    print(found)
    print(found[0].report())
    if arguments.out is not None:
        for file in found.save(arguments.out):
            print(file)


def _options(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return what was given; the rest is as `assur.search` has it."""
    options: dict[str, Any] = {"progress": search_progress(arguments)}
    for name in (
        *("joints", "frame", "closed", "joint_price", "robust", "time_limit", "evaluations"),
        *("seed", "threads"),
    ):
        if (value := getattr(arguments, name)) is not None:
            options[name] = value
    for name in ("min_apex_angle", "min_arc"):
        if (angle := getattr(arguments, name)) is not None:
            options[name] = angle.one(ANGLE, f"--{name.replace('_', '-')}")
    return options


def _require_folder(folder: str) -> None:
    """Refuse a folder that cannot be written, before the work."""
    try:
        into = Path(folder)
        if into.exists() and not into.is_dir():
            message = f"--out {folder}: a folder is needed, and this is a file"
            raise InputError(message)
        into.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise cannot_write(folder, error) from error
    require_writable(str(into / "fit_01.toml"))
