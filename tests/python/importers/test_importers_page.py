"""The examples of docs/importers.md print what it shows."""

import doctest
from pathlib import Path

PAGE = Path(__file__).parents[3] / "docs" / "importers.md"
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def test_page() -> None:
    text = PAGE.read_text(encoding="utf-8")
    example = doctest.DocTestParser().get_doctest(text, {}, PAGE.name, str(PAGE), 0)
    assert len(example.examples) > 20
    complaints: list[str] = []
    result = doctest.DocTestRunner(optionflags=FLAGS).run(example, out=complaints.append)
    assert result.failed == 0, "".join(complaints)
