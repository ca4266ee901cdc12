"""``assur convert``: a file of another program, or a changed one, as a TOML file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.cli.help import describe
from assur.cli.source import read
from assur.cli.source_arguments import add_source
from assur.cli.toml_output import add_toml, check_toml, write_toml
from assur.cli.written import refuse_same

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Write what FILE holds as a TOML file (docs/reference/files.md). What does not carry over\n"
        "from another program is said on the standard error.",
        "assur convert example:watt_1 --out watt.toml",
        "assur convert example:engine --set rod.length=220mm --out long.toml",
    )
    add_source(parser)
    add_toml(parser)


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    refuse_same(arguments.out, arguments.file)
    check_toml(arguments.out, arguments.force)
    write_toml(read(arguments), arguments.out)
