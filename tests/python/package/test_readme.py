"""The Python blocks of the README run, in order, as one session."""

import doctest
import re
from pathlib import Path

import pytest

README = Path(__file__).parents[3] / "README.md"
BLOCK = re.compile(r"^```(?:python|pycon)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def test_readme(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A block with prompts must print what it shows; one without must run."""
    text = README.read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)  # files the examples write
    names: dict[str, object] = {"__name__": "readme"}
    blocks = list(BLOCK.finditer(text))
    assert blocks, "no Python block found"
    for block in blocks:
        source, line = block.group(1), text.count("\n", 0, block.start(1))
        where = f"README.md, line {line + 1}"
        if ">>>" not in source:
            exec(compile("\n" * line + source, str(README), "exec"), names)
            continue
        example = doctest.DocTestParser().get_doctest(source, names, where, str(README), line)
        complaints: list[str] = []
        runner = doctest.DocTestRunner(optionflags=FLAGS)
        result = runner.run(example, out=complaints.append, clear_globs=False)
        assert result.failed == 0, "".join(complaints)
        names.update(example.globs)
