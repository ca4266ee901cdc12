"""The Python blocks of the README and of the manual's pages run, those of a page as one session."""

from __future__ import annotations

import doctest
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).parents[3]
DOCS = ROOT / "docs"
BUILT = ("_build", "gallery")
BLOCK = re.compile(r"^```(?:python|pycon)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)\s]*)?\)|(?:src|srcset)=\"([^\"]+)\"")
# What users of other programs look for, on whatever page it stands.
WORDS = [
    "Monte Carlo",
    "tolerance",
    "inverse dynamics",
    "Jacobian",
    "gradient",
    "JAX",
    "report",
    "rpm",
    "exercise",
    "language",
    "Grashof",
    "quick return",
]


def written() -> Iterator[Path]:
    """The README, what stands beside it, and every page of the manual that somebody wrote."""
    yield from sorted(ROOT.glob("*.md"))
    for page in sorted(DOCS.rglob("*.md")):
        if page.relative_to(DOCS).parts[0] not in BUILT and "generated" not in page.parts:
            yield page


PAGES = [
    page
    for page in written()
    # test_files_page.py runs the one on files: its Python reads its TOML.
    if page.name != "files.md" and BLOCK.search(page.read_text(encoding="utf-8"))
]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_blocks_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A block with prompts must print what it shows; one without must run."""
    monkeypatch.chdir(tmp_path)  # files that the examples write
    text, where = page.read_text(encoding="utf-8"), page.relative_to(ROOT).as_posix()
    names: dict[str, Any] = {"__name__": "page", "np": np, "assur": assur}
    for block in BLOCK.finditer(text):
        source, line = block.group(1), text.count("\n", 0, block.start(1))
        if ">>>" not in source:
            exec(compile("\n" * line + source, str(page), "exec"), names)
            continue
        test = doctest.DocTestParser().get_doctest(source, names, where, str(page), line)
        complaints: list[str] = []
        runner = doctest.DocTestRunner(optionflags=FLAGS)
        result = runner.run(test, out=complaints.append, clear_globs=False)
        assert result.failed == 0, "".join(complaints)
        names.update(test.globs)


def test_every_link_leads_to_a_file() -> None:
    """The manual's own are checked by Sphinx too; it does not read the README."""
    dead = []
    for page in written():
        for match in LINK.finditer(page.read_text(encoding="utf-8")):
            target = match[1] or match[2]
            built = "gallery/" in target
            if "://" not in target and not built and not (page.parent / target).exists():
                dead.append((page.relative_to(ROOT).as_posix(), target))
    assert dead == []


@pytest.mark.parametrize("word", WORDS)
def test_the_search_finds(word: str) -> None:
    """Sphinx's search reads the text of pages: each word is on one, not in a title alone."""
    texts = [page.read_text(encoding="utf-8") for page in written() if DOCS in page.parents]
    lines = [line for text in texts for line in text.splitlines() if not line.startswith("#")]
    assert any(re.search(rf"\b{word}", line, re.IGNORECASE) for line in lines)


def test_the_speed_in_the_readme_is_that_of_the_page() -> None:
    page = (DOCS / "explanation" / "speed.md").read_text(encoding="utf-8")
    row = re.search(
        r"^\| 100.000 random four-bars × 72, a coupler point \|(.*)", page, re.MULTILINE
    )
    assert row
    call, _, position, *_ = (cell.strip() for cell in row[1].split("|"))
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    assert f"takes {call}, {position} a position" in readme
