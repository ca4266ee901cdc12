"""``assur flywheel``: for a machine, or a table of reduced moment and inertia."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from assur import flywheel
from assur.cli.help import describe
from assur.cli.named import EXAMPLE
from assur.cli.output import Output, add_output
from assur.cli.source import STDIN, read, require_machine
from assur.cli.source_arguments import add_source
from assur.cli.units import ROTARY, argument, numbers, ratio
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.flywheel import Flywheel


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "The flywheel with which the speed varies by a given part of its mean. FILE is a\n"
        "machine (its ending is .toml), or a table with the columns phi (rad), moment (N·m) and\n"
        "inertia (kg·m²) of one period, comma-separated. Of a machine the arguments are by\n"
        "default those of the file's [flywheel]; without a mean speed its own motor sets the\n"
        "speed.",
        "assur flywheel table.csv --fluctuation 0.125 --mean-speed 15",
        "assur flywheel press.toml",
        "assur flywheel press.toml --fluctuation 0.03 --out speed.csv",
    )
    add_source(parser, others=False)
    either = parser.add_mutually_exclusive_group()
    either.add_argument(
        "--fluctuation", type=argument(ratio), help="coefficient δ wanted: 0.04, or 1/25"
    )
    either.add_argument(
        "--flywheel",
        type=argument(numbers),
        help="instead, a given flywheel, kg·m² (tables only)",
    )
    parser.add_argument(
        "--mean-speed", metavar="SPEED", type=argument(numbers), help="rad/s, or 143rpm"
    )
    parser.add_argument("--mean", choices=flywheel.MEANS, help="definition of the mean; extremes")
    parser.add_argument("--turns", type=int, help="turns of a cycle (machines only); 1")
    parser.add_argument("--spline", choices=flywheel.SPLINES, help="tables only; not-a-knot")
    parser.add_argument(
        "--degrees", action="store_true", help="phi of the table, q of --out, in degrees"
    )
    parser.add_argument("--plot", metavar="PICTURE", help="draw the speed over the turn to a file")
    add_output(parser)


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    output = Output(arguments.out, arguments.file)
    result = _of_machine(arguments) if _is_machine(arguments.file) else _of_table(arguments)
    if arguments.out is not None:
        from assur._table import columns_of

        output.write(columns_of(result, arguments.degrees))
    if arguments.out != "-":
        _print(result)
    if arguments.plot:
        from assur.cli.picture import save_figure

        save_figure(result.plot, arguments.plot)


def _is_machine(file: str) -> bool:
    return file.startswith(EXAMPLE) or file == STDIN or PurePath(file).suffix.lower() == ".toml"


def _number(flag: Any, kind: str, what: str) -> float | None:
    return None if flag is None else flag.one(kind, what)


def _of_table(arguments: argparse.Namespace) -> Flywheel:
    if (
        arguments.fluctuation is None and arguments.flywheel is None
    ) or arguments.mean_speed is None:
        arguments.parser.error("a table needs --fluctuation (or --flywheel) and --mean-speed")
    if arguments.set or arguments.design is not None:
        arguments.parser.error("--set and --design are for machines, not for tables")
    table = flywheel.read_table(arguments.file, degrees=arguments.degrees)
    speed = arguments.mean_speed.one(ROTARY, "--mean-speed")
    mean, spline = arguments.mean or "extremes", arguments.spline or "not-a-knot"
    options: dict[str, Any] = {"mean": mean, "spline": spline}
    if arguments.flywheel is None:
        fluctuation = arguments.fluctuation.one("", "--fluctuation")
        return flywheel.from_table(*table, fluctuation=fluctuation, mean_speed=speed, **options)
    inertia = arguments.flywheel.one("", "--flywheel")
    return flywheel.evaluate(*table, flywheel=inertia, mean_speed=speed, **options)


def _of_machine(arguments: argparse.Namespace) -> Flywheel:
    for name in ("flywheel", "spline"):
        if getattr(arguments, name) is not None:
            arguments.parser.error(f"--{name} is for tables, not for machines")
    contents = read(arguments)
    machine = require_machine(contents, arguments.file)
    asked = dict(contents.wanted.get("flywheel", {}))
    flags = {
        "fluctuation": _number(arguments.fluctuation, "", "--fluctuation"),
        "mean_speed": _number(arguments.mean_speed, ROTARY, "--mean-speed"),
        "mean": arguments.mean,
        "turns": arguments.turns,
    }
    asked.update({name: value for name, value in flags.items() if value is not None})
    if "fluctuation" not in asked:
        message = "no fluctuation is given: write --fluctuation 0.05, or [flywheel] in the file"
        raise InputError(message)
    if machine.shape:
        message = f"{arguments.file} has {machine.shape} designs: choose one by --design"
        raise InputError(message)
    return machine.flywheel(**asked)


def _print(f: Flywheel) -> None:
    print(f"flywheel      {f.inertia:.9g} kg·m²")
    print(f"fluctuation   {f.delta:.9g}")
    print(f"mean speed    {f.mean_speed:.9g} rad/s ({f.mean})")
    print(f"speed0        {f.speed0:.9g} rad/s")
    print(f"greatest      {f.max.value:.9g} rad/s at {f.max.q:.6g} rad")
    print(f"least         {f.min.value:.9g} rad/s at {f.min.q:.6g} rad")
    print(f"motor         {f.motor_moment:.9g} N·m")
    print(f"period        {f.period:.9g} s")
