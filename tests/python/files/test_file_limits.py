"""Files that are too large are refused with a plain message, before they take time or memory."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

import assur
from assur.files.limits import MOST_BRACKETS, MOST_BYTES, MOST_ITEMS, MOST_LETTERS, MOST_PARTS
from assur.files.write import text_of
from files.sample_files import BY_HAND
from models.machines.machines import four_bar

if TYPE_CHECKING:
    from pathlib import Path

PRESS = BY_HAND["press"]


def refused(raw: str | bytes, path: Path) -> assur.files.FileError:
    path.write_bytes(raw.encode() if isinstance(raw, str) else raw)
    with pytest.raises(assur.files.FileError) as caught:
        assur.load(path)
    return caught.value


def test_a_large_file(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    with path.open("wb") as file:
        file.truncate(200 * 10**6)  # takes no room on the disk
    with pytest.raises(assur.files.FileError, match="is larger than 8 MiB") as caught:
        assur.load(path)
    assert caught.value.line is None
    # Just as large as allowed, a comment.
    fill = "#" * (MOST_BYTES - len(PRESS.encode()))
    path.write_text(PRESS + fill, encoding="utf-8")
    assert isinstance(assur.load(path), assur.Machine)


@pytest.mark.parametrize(
    ("text", "words", "column"),
    [
        ("a = " + "[" * 10_000, f"deeper than {MOST_BRACKETS}", 5 + MOST_BRACKETS),
        ("a = " + "[" * 900 + "]" * 900, f"deeper than {MOST_BRACKETS}", 5 + MOST_BRACKETS),
        ("a = " + "{a=" * 10_000, f"deeper than {MOST_BRACKETS}", 5 + 3 * MOST_BRACKETS),
        ("a" + ".a" * 500_000 + " = 1", f"more than {MOST_PARTS} parts", 2 * MOST_PARTS),
        ("[" + 'a."a".' * 100_000, f"more than {MOST_PARTS} parts", None),
        ("{a = 1, " + "a . " * 100_000, f"more than {MOST_PARTS} parts", None),
        ("a = " + "9" * 1_000_000, f"longer than {MOST_LETTERS} characters", 5),
        ('a = "' + "x" * 1_000_000 + '"', f"longer than {MOST_LETTERS} characters", 5),
        ("a = '''\n" + "x\n" * 100_000 + "'''", f"longer than {MOST_LETTERS} characters", 5),
        ("é" * 1_000_000, f"longer than {MOST_LETTERS} characters", 1),
        ('a = "' + '\\"' * 100_000, "not TOML: unterminated string", None),
        ('a = """' + '\\"""' * 100_000, "not TOML", None),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 40 else None,
)
def test_what_is_nested_or_long(text: str, words: str, column: int | None, tmp_path: Path) -> None:
    error = refused(f"format = 1\n{text}", tmp_path / "m.toml")
    assert words in str(error)
    assert len(str(error)) < 200
    assert error.line == 2 or column is None
    assert column is None or error.column == column


def test_brackets_in_texts_and_comments_do_not_count(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    path.write_text(PRESS + f"# {'[' * 50} {'a.' * 50}\n", encoding="utf-8")
    assert isinstance(assur.load(path), assur.Machine)
    error = refused(PRESS.replace('"ram"', f'"{"[" * 50}"', 1), path)
    assert error.key == "slides.guide.link"


@pytest.mark.parametrize("section", ["joints", "links", "slides", "loads"])
def test_many_entries(section: str, tmp_path: Path) -> None:
    entry = {"joints": "{} = [0, 0]", "links": "{} = []", "slides": "{} = 1"}.get(section)
    if entry is None:
        added = '\n[[loads]]\ntype = "Gravity"' * MOST_ITEMS
        text = PRESS + added
    else:
        added = "\n".join(entry.format(f"x{i}") for i in range(MOST_ITEMS))
        text = PRESS.replace(f"[{section}]\n", f"[{section}]\n{added}\n", 1)
    error = refused(text, tmp_path / "m.toml")
    assert f"a file may have {MOST_ITEMS}" in str(error)
    assert error.key == section


def test_a_million_joints(tmp_path: Path) -> None:
    joints = "\n".join(f"J{i} = [0, 0]" for i in range(1_000_000))
    error = refused(f"format = 1\n[joints]\n{joints}\n", tmp_path / "m.toml")
    assert "is larger than 8 MiB" in str(error)


def test_many_designs_are_read(tmp_path: Path) -> None:
    lengths = [0.9 + i * 1e-5 for i in range(20_000)]
    batch = four_bar().with_dimensions({"crank.length": lengths})
    batch.save(tmp_path / "m.toml")
    assert assur.load(tmp_path / "m.toml") == batch
    assert max(map(len, text_of(batch).splitlines())) < 100
