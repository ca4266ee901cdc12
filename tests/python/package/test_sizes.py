"""tools/check_sizes: no folder and no file is too large, and what is planted is seen."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import pytest

TOOL: dict[str, Any] = runpy.run_path(
    str(Path(__file__).resolve().parents[3] / "tools" / "check_sizes")
)
CODE = "x = 1\n" * 500
CLI, PAGE = "tests/python/cli", "python/assur/pictures/page"

# By what is wrong: files, and what is said of them.
PLANTED = {
    "a file of too many lines": (
        {"python/assur/laws.py": '"""Text."""\n\n# A comment.\n' + CODE + "y = 2\n"},
        "python/assur/laws.py has 501 lines of code, more than 500",
    ),
    "a test of too many lines": (
        {"tests/python/dynamics/motion/test_run.py": CODE + "y = 2\n"},
        "tests/python/dynamics/motion/test_run.py has 501 lines of code, more than 500",
    ),
    "a file in Rust of too many lines": (
        {"rust/core/src/plan/tape.rs": "//! Text.\n\n/* A\ncomment */\n" + "x();\n" * 501},
        "rust/core/src/plan/tape.rs has 501 lines of code, more than 500",
    ),
    "a folder of too many files": (
        {f"{CLI}/test_{i}.py": "" for i in range(26)},
        f"{CLI} has 26 files, more than 25",
    ),
    "a page with a new module": (
        {f"{PAGE}/module{i}.js": "" for i in range(32)},
        f"{PAGE} has 32 files, more than 31",
    ),
    "an exception that is none any more": (
        {f"{PAGE}/module{i}.js": "" for i in range(25)},
        f"{PAGE} has 25 files: take it out of LARGER in tools/check_sizes",
    ),
}
# What no rule is against.
ALLOWED = {
    "comments": {
        "python/assur/laws.py": "# Text.\n" * 99 + "\n" * 99 + CODE,
        "rust/core/src/lib.rs": "// Text.\n" * 99 + "/*\n\nText.\n*/\n" + "x();\n" * 500,
    },
    "what is built": {f"docs/gallery/picture{i}.svg": "" for i in range(26)}
    | {f"rust/py/.hidden/{i}.rs": "" for i in range(26)}
    | {f"python/assur/__pycache__/module{i}.pyc": "" for i in range(26)},
}


def planted(files: dict[str, str], root: Path) -> list[str]:
    for name, text in files.items():
        file = root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    found: list[str] = TOOL["faults"](root)
    return found


def test_nothing_is_too_large() -> None:
    assert TOOL["faults"]() == []


@pytest.mark.parametrize("what", PLANTED)
def test_a_planted_fault_is_seen(what: str, tmp_path: Path) -> None:
    files, expected = PLANTED[what]
    assert planted(files, tmp_path) == [expected]


@pytest.mark.parametrize("what", ALLOWED)
def test_what_does_not_count(what: str, tmp_path: Path) -> None:
    assert planted(ALLOWED[what], tmp_path) == []
