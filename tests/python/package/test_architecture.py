"""ARCHITECTURE.md names files and floors that exist; whoever names a test names one that exists."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

    TraceFunction: TypeAlias = Callable[[FrameType, str, Any], "TraceFunction"]

PACKAGE = Path(assur.__file__).parent

ROOT = Path(__file__).resolve().parents[3]
PAGE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
FILE = re.compile(r"(?<![\w/.])[\w./-]*\w\.(?:rs|pyi?|js|toml|json|md)\b")
FOLDERS = ("rust", "python", "tests", "docs", "tools")
TEST = re.compile(r"\btests/(?:js|python|rust)/[\w./-]*\w")
TEXTS = {"", ".js", ".md", ".py", ".rs", ".toml"}


def files() -> set[str]:
    """Every file by its path, in the folders of the repository and beside them."""
    found = {path.name for path in ROOT.iterdir() if path.is_file()}
    for folder in FOLDERS:
        paths = (ROOT / folder).rglob("*")
        found |= {path.relative_to(ROOT).as_posix() for path in paths if path.is_file()}
    return found


def test_every_file_that_is_named_exists() -> None:
    """By its path, or by the end of it where the page says in which folder it is."""
    ends = {"/" + path for path in files()}
    named = {path.removeprefix("./") for path in FILE.findall(PAGE)}
    assert len(named) > 100
    missing = sorted(one for one in named if not any(end.endswith("/" + one) for end in ends))
    assert not missing, f"ARCHITECTURE.md names what does not exist: {missing}"


def test_every_test_that_is_named_exists() -> None:
    """In the Makefile, whose campaign takes hours to get there, on every page, in every comment."""
    named = set()
    for path in files():
        if Path(path).suffix in TEXTS and not path.startswith(("docs/_build/", "docs/gallery/")):
            named |= {*TEST.findall((ROOT / path).read_text(encoding="utf-8"))}
    assert len(named) > 30
    assert [path for path in sorted(named) if not (ROOT / path).exists()] == []


@pytest.mark.parametrize("floor", runpy.run_path(str(ROOT / "tools" / "check_floors"))["FLOORS"])
def test_every_floor_is_drawn(floor: tuple[str, ...]) -> None:
    """Of those with underscores, which hold what all parts need, some stand for the others."""
    drawn = PAGE.partition("## The Python package")[2].partition("\n## ")[0]
    public = [part for part in floor if not part.startswith("_")]
    missing = [part for part in public if f"`{part}`" not in drawn]
    assert not missing


def test_a_debugger_stops_in_the_python_files_that_are_named() -> None:
    """Files of a line or two may be missing."""
    mechanism, q = assur.FourBar(0.1, 0.3, 0.25, 0.35), np.linspace(0.0, 6.0, 37)
    stops: dict[str, set[int]] = {}

    def trace(frame: FrameType, event: str, _: object) -> TraceFunction:
        path = Path(frame.f_code.co_filename)
        if event == "line" and PACKAGE in path.parents:
            stops.setdefault(path.name, set()).add(frame.f_lineno)
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        _ = mechanism.solve(q).joint("C").d1
    finally:
        sys.settrace(before)
    way = PAGE.partition("## The way of one number")[2].partition("\n## ")[0]
    assert [name for name, lines in stops.items() if len(lines) > 5 and name not in way] == []
    assert len(stops) <= 12
