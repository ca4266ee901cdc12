"""Files that are written: refused before the work if they cannot be, replaced whole or not."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

import assur
from assur.cli import formats, output
from assur.cli.written import replacing
from cli.command_line import assur_command, refused

if TYPE_CHECKING:
    from pathlib import Path

SOLVE = "solve", "example:engine", "--q", "1"


@pytest.fixture
def without_work(monkeypatch: pytest.MonkeyPatch) -> None:
    def work(*_: object, **__: object) -> None:
        message = "the work has begun"
        raise AssertionError(message)

    monkeypatch.setattr(assur.Mechanism, "solve", work)


@pytest.mark.usefixtures("without_work")
def test_what_cannot_be_written_is_refused_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "folder.csv").mkdir()
    for path, said in (
        ("missing/t.csv", "cannot be written: No such file or directory"),
        ("folder.csv", "cannot be written: it is a directory"),
        ("t.txt", "the name ends with .csv, .parquet, .npz, .json, .xlsx, not .txt"),
        ("t", ".xlsx, but has none"),
        ("n" * 300 + ".csv", "cannot be written: File name too long"),
        ("nul\0.csv", "cannot be written: "),
    ):
        assert said in refused(*SOLVE, "--out", tmp_path / path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder.csv"]


@pytest.mark.usefixtures("without_work")
@pytest.mark.skipif(os.name == "nt" or os.getuid() == 0, reason="who may write all")
def test_what_is_write_protected_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    path.touch(0o444)
    assert "it is write-protected" in refused(*SOLVE, "--out", path)
    tmp_path.chmod(0o555)
    assert "Permission denied" in refused(*SOLVE, "--out", tmp_path / "new.csv")
    tmp_path.chmod(0o755)


@pytest.mark.usefixtures("without_work")
def test_the_file_that_is_read_is_not_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "sketch.json"
    path.write_text("{}")
    (tmp_path / "link.json").symlink_to(path)
    for name in ("sketch.json", "link.json"):
        said = refused("solve", path, "--out", tmp_path / name)
        assert said.endswith("is the file that is read: name another")


@pytest.mark.usefixtures("without_work")
@pytest.mark.parametrize(
    ("ending", "extra"), [("parquet", "assur[parquet]"), ("xlsx", "assur[excel]")]
)
def test_a_missing_extra_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str, extra: str
) -> None:
    monkeypatch.setattr(output, "find_spec", lambda _: None)
    said = refused(*SOLVE, "--out", tmp_path / f"t.{ending}")
    assert said.endswith(f"pip install {extra}")


def test_a_table_is_replaced_at_the_end_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "t.csv"
    path.write_text("older")
    path.chmod(0o640)
    link = tmp_path / "link.csv"
    link.symlink_to(path)
    assert assur_command(*SOLVE, "--out", link).code == 0
    whole = path.read_text()
    assert whole.startswith("q,status,")
    assert link.is_symlink()
    assert os.name == "nt" or path.stat().st_mode & 0o777 == 0o640

    def breaks(target: Path, _: object) -> None:
        target.write_text("half")
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(formats.WRITERS, ".csv", breaks)
    said = refused(*SOLVE, "--out", path)
    assert said == f"{path}: cannot be written: No space left on device"
    assert path.read_text() == whole
    assert sorted(each.name for each in tmp_path.iterdir()) == ["link.csv", "t.csv"]


def test_an_interrupt_leaves_nothing(tmp_path: Path) -> None:
    def write() -> None:
        with replacing(str(tmp_path / "t.csv")) as temporary:
            temporary.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write()
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(os.name == "nt", reason="a device of POSIX")
def test_a_device_is_written_to(tmp_path: Path) -> None:
    link = tmp_path / "nothing.csv"
    link.symlink_to(os.devnull)
    assert assur_command(*SOLVE, "--out", link) == (0, "", "")
    assert link.is_symlink()


def test_descriptions_are_replaced_only_by_force(tmp_path: Path) -> None:
    path = tmp_path / "engine.toml"
    for words in (
        ("convert", "example:engine", "--out", path),
        ("examples", "engine", "--out", path),
    ):
        path.unlink(missing_ok=True)
        assert assur_command(*words) == (0, "", "")
        path.write_text("my own comment")
        assert refused(*words) == f"{path} exists: --force replaces it"
        assert path.read_text() == "my own comment"
        assert assur_command(*words, "--force") == (0, "", "")
        assert assur.load(path) == assur.examples.engine()
        for target, said in (("a.txt", "ends with .toml"), ("missing/a.toml", "No such file")):
            assert said in refused(*words[:-1], tmp_path / target)
    assert "is the file that is read" in refused("convert", path, "--out", path, "--force")
    assert assur.load(path) == assur.examples.engine()
    assert sorted(each.name for each in tmp_path.iterdir()) == ["engine.toml"]


def test_files_to_write_are_named_by_out() -> None:
    for command in ("plot", "convert", "solve"):
        said = refused(command, "example:engine", "x.toml", code=2)
        assert "to write a file, --out x.toml" in said
        assert f"assur {command} --help" in said
    assert "--out" not in refused("studio", "example:engine", "x", code=2)
