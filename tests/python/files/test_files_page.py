"""The page about files: its Python runs, its TOML loads."""

from __future__ import annotations

import doctest
import json
import re
from pathlib import Path
from typing import TYPE_CHECKING

import jsonschema

import assur
from assur.files import limits
from assur.files.contents import KEYS
from assur.files.parser import loads
from files.sample_files import BY_HAND

if TYPE_CHECKING:
    import pytest

PAGE = (Path(__file__).parents[3] / "docs" / "reference" / "files.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(python|toml)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


BOOM = """
format = 1
driver = "lift"
joints = { O = [0, 0], foot = [1, -1], eye = [2, 1] }
links = { ground = ["O", "foot"], boom = ["O", "eye"] }
"""


def test_blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The complete example is press.toml; the other pieces of TOML replace its sections."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    example: dict[str, object] = {}
    validator = jsonschema.Draft7Validator(json.loads(assur.files.SCHEMA.read_text("utf-8")))
    for block in BLOCK.finditer(PAGE):
        language, source = block.groups()
        if language == "toml":
            data = loads(source)
            if "format" in data:
                example = data
                Path("press.toml").write_text(source, encoding="utf-8")
            validator.validate({**example, **data})
            continue
        line = PAGE.count("\n", 0, block.start(2))
        test = doctest.DocTestParser().get_doctest(source, names, "files.md", "files.md", line)
        complaints: list[str] = []
        runner = doctest.DocTestRunner(optionflags=FLAGS)
        failed = runner.run(test, out=complaints.append, clear_globs=False).failed
        assert failed == 0, "".join(complaints)
        names.update(test.globs)
    assert example


def test_what_it_says() -> None:
    named = set(re.findall(r"`\[{0,2}(\w+)\]{0,2}`", PAGE))
    assert set(KEYS) <= named
    assert f"{limits.MOST_BYTES // 2**20} MiB, {limits.MOST_ITEMS} joints" in PAGE
    assert f"and {limits.MOST_BRACKETS} brackets" in PAGE
    assert {f"{name}.toml" for name in BY_HAND} <= set(re.findall(r"`(\w+\.toml)`", PAGE))


def test_the_other_pieces_load(tmp_path: Path) -> None:
    """Each with what it belongs to."""
    pieces = [source for language, source in BLOCK.findall(PAGE) if language == "toml"]
    press = pieces[0]
    whole = [
        press.partition("[motor]")[0],
        BY_HAND["crank_rocker"].partition("[dimensions]")[0],
        BOOM,
        press.partition("[motor]")[0],
        press,
    ]
    shapes = []
    for text, piece in zip(whole, pieces[1:], strict=True):
        (tmp_path / "m.toml").write_text(f"{text}\n{piece}", encoding="utf-8")
        contents = assur.files.read(tmp_path / "m.toml")
        shapes.append(contents.mechanism.shape)
        for name in contents.wanted:
            contents.result(name)
    assert shapes == [(), (3,), (), (), ()]
