"""The page on importers prints what it shows; every list of programs names all."""

import doctest
import re
from pathlib import Path

import pytest

from assur import importers
from assur.cli.main import EPILOG
from cli.command_line import assur_command

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "how_to" / "importers.md"
# Of each format, from the page's table of formats: its name and its program's.
ROW = re.compile(r"^\| `(\w+)` \| ([\w+]+)[^|]*:", re.MULTILINE)
PROGRAMS = dict(ROW.findall(PAGE.read_text(encoding="utf-8")))
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def test_page() -> None:
    text = PAGE.read_text(encoding="utf-8")
    example = doctest.DocTestParser().get_doctest(text, {}, PAGE.name, str(PAGE), 0)
    assert len(example.examples) > 20
    complaints: list[str] = []
    result = doctest.DocTestRunner(optionflags=FLAGS).run(example, out=complaints.append)
    assert result.failed == 0, "".join(complaints)


def test_it_has_a_row_for_every_format() -> None:
    assert tuple(PROGRAMS) == importers.FORMATS


def test_help_names_every_format() -> None:
    shown = assur_command("solve", "--help").out.rpartition("--format NAME")[2]
    words = re.findall(r"\w+", shown.partition("--scale")[0])
    assert [name for name in importers.FORMATS if name not in words] == []


@pytest.mark.parametrize(
    "text", ["README.md", "docs/reference/command_line.md", "--help", "docstring"]
)
def test_lists_of_programs_are_whole(text: str) -> None:
    """Each begins with PMKS and PMKS+."""
    others = {"--help": EPILOG, "docstring": importers.__doc__ or ""}
    found = others[text] if text in others else (ROOT / text).read_text(encoding="utf-8")
    words = re.findall(r"[\w+]+", found[found.index("PMKS, PMKS+") :][:120])
    assert [name for name in PROGRAMS.values() if name not in words] == []
