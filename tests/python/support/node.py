"""Node, where it is found: it runs the tests of the page's modules."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
MODULES = ROOT / "tests" / "js"
# From this version on a module is known by its imports.
LEAST = (20, 19)


def node() -> str:
    """Return the program, or skip the test."""
    found = shutil.which("node")
    if found is None:
        pytest.skip("Node is not installed: the page's modules are not tested")
    version = subprocess.run([found, "--version"], capture_output=True, text=True, check=True)
    numbers = re.findall(r"\d+", version.stdout)
    if (int(numbers[0]), int(numbers[1])) < LEAST:
        pytest.skip(f"Node {version.stdout.strip()} is older than 20.19")
    return found


def run_node(*arguments: str, stdin: str | None = None) -> str:
    """Run Node and return what it prints."""
    ran = subprocess.run(
        [node(), *arguments], input=stdin, capture_output=True, text=True, check=False, cwd=ROOT
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout
