"""``assur studio``: mechanisms in the browser, drawn, dragged, run."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from assur.cli.help import describe
from assur.cli.named import EXAMPLE, example
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.studio.session import Given


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    describe(
        parser,
        "Open the studio in the browser: draw a mechanism, drag its joints, run it. It computes\n"
        "on this machine, for this machine alone; Ctrl-C ends it. Without FILE the page is empty.",
        "assur studio example:crank_rocker",
        "assur studio press.toml --no-browser",
    )
    parser.add_argument(
        "file",
        metavar="FILE",
        nargs="?",
        help="a TOML file, also to save to, a file of another program, or example:NAME",
    )
    parser.add_argument("--port", type=int, metavar="N", help="0 for any that is free")
    parser.add_argument(
        "--no-browser", action="store_true", help="only print the address of the page"
    )
    parser.add_argument(
        "--host",
        metavar="H",
        help="listen there, 0.0.0.0 for the whole network: anyone with the address can use it",
    )


def run(arguments: argparse.Namespace) -> None:
    """Run the command."""
    from assur.studio.serve import require_packages, serve

    require_packages()
    opened = _given(arguments.file)
    if opened is not None and opened.path is not None:
        _require_readable(opened)
    serve(opened, arguments.host, arguments.port, not arguments.no_browser, _say)


def _say(address: str) -> None:
    print(address)
    sys.stdout.flush()


def _given(file: str | None) -> Given | None:
    from assur.studio.session import Given

    if file is None:
        return None
    if file.startswith(EXAMPLE):
        name = file.removeprefix(EXAMPLE)
        example(name)
        return Given(example=name)
    if file == "-" or "://" in file:
        message = f"{file}: the studio opens a file or an example"
        raise InputError(message)
    return Given(path=Path(file))


def _require_readable(opened: Given) -> None:
    """Refuse a file without a mechanism before a browser opens."""
    from assur.studio.kinds.opening import read_text

    read_text(str(opened.path), opened.bytes())
