"""``assur examples``: those that the package contains."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.cli.help import describe
from assur.cli.named import EXAMPLE, example
from assur.cli.toml_output import add_toml, check_toml, write_toml

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "List the examples, or write one as a TOML file with its usual motion as [solve].\n"
        "Every command takes them as FILE, example:NAME.",
        "assur examples",
        "assur examples jansen_leg --out jansen_leg.toml",
    )
    parser.add_argument("name", metavar="NAME", nargs="?", help="an example; all are listed")
    add_toml(parser)


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    if arguments.name is not None:
        check_toml(arguments.out, arguments.force)
        write_toml(example(arguments.name.removeprefix(EXAMPLE)), arguments.out)
        return
    if arguments.out != "-":
        arguments.parser.error("--out needs the NAME of an example")
    from assur.examples import ALL

    width = max(map(len, ALL))
    for name, make in ALL.items():
        about = (make.__doc__ or "").strip().splitlines()[0]
        print(f"{name:{width}}  {about}")
