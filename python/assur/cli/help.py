"""What every command's ``--help`` ends with: commands that run as they stand."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse


def describe(parser: argparse.ArgumentParser, description: str, *examples: str) -> None:
    """Set the description of a command and its examples."""
    parser.description = description
    parser.epilog = "\n".join(["examples:", *(f"  {example}" for example in examples)])
