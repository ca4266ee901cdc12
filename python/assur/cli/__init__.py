"""The command line, ``assur solve press.toml --q 0:360:1deg``: a file for each command."""

from assur.cli.main import main

__all__ = ["main"]
