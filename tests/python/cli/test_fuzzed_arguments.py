"""Any words end with a status and lines that begin with "assur: ", never with a traceback."""

from __future__ import annotations

import argparse
import io
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from assur.cli.main import COMMANDS
from cli.command_line import assur_command

if TYPE_CHECKING:
    from collections.abc import Sequence

VALUES = (
    *("0:90:30deg", "0,1", "1", "-1", "-1:1:0.5", "1e999", "nan", "0:1", "5mm", "1,2,3deg", ""),
    *("rod.length=0.2", "rod.length=200mm", "rod.length=-1", "crank.length=0.1:0.2:3", "x=1"),
    *("rod.length=1e308", "crank.length=0.3mm", "a=span(bore)", "span(B.x)", "span(B.x) > 1"),
    *("min_transmission_angle(A)", "span(", "peak_effort()", "pmks", "0-1", "0-1-2", "A,bore", "B"),
    *("out.csv", "out.json", "out.toml", "out.svg", "no/out.csv", "out.exe", "-", "--", "\0", "é"),
    *("table.csv", "press.toml", "broken.toml", "sketch.txt", "example:engine", "example:x"),
    *("example:toggle_press", "example:five_bar", "a://b", ".", "10", "99999999999999999999"),
    *(
        "--out=-",
        "--q=0",
        "--q=",
        "rpm",
        "20rpm",
        "period",
        "natural",
        "%s",
        "{0}",
        "a\nb",
        "\ud800",
    ),
)
SOURCES = ("press.toml", "example:engine", "example:andrews_squeezer", "sketch.txt", "-")
COUNT = 300
MOST_WORDS = 4


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    press = Path(__file__).parents[3] / "examples" / "press.toml"
    text = press.read_text("utf-8")
    Path("press.toml").write_text(text, encoding="utf-8")
    Path("broken.toml").write_text(text.replace("joints", "jonts"), encoding="utf-8")
    Path("table.csv").write_text("crank.length,rod.length\n0.1,0.4\n0.1,0.05\n")
    sketch = "ground a R 0 0 0 ffft\na b R 0 1\nb c R 3 0\nground c P 3 0 0\n"
    Path("sketch.txt").write_text(sketch)
    monkeypatch.setattr("sys.stdin", io.StringIO("format = 1\n"))


def flags(command: str) -> dict[str, bool]:
    """Return the options of a command, and whether each takes a value."""
    parser = argparse.ArgumentParser()
    import_module(f"assur.cli.commands.{command}").add_arguments(parser)
    return {
        option: action.nargs != 0 for action in parser._actions for option in action.option_strings
    }


def commands() -> list[list[str]]:
    """Return a command and words: mostly a file, and then its flags with any values."""
    rng = np.random.default_rng(2024)

    def one_of(pool: Sequence[str]) -> str:
        return pool[int(rng.integers(len(pool)))]

    own = {command: flags(command) for command in COMMANDS}
    found = []
    for _ in range(COUNT):
        command = one_of(list(COMMANDS))
        words = [command] if rng.random() < 0.98 else []
        if rng.random() < 0.95:
            words.append(one_of(SOURCES) if rng.random() < 0.9 else one_of(VALUES))
        if command == "sweep":
            words += ["--vary", "rod.length=0.3:0.4:3"] if rng.random() < 0.8 else []
            words += ["--metric", "span(bore)"] if rng.random() < 0.9 else []
        for _ in range(rng.integers(0, MOST_WORDS)):
            if rng.random() < 0.1:
                words.append(one_of(VALUES))
                continue
            flag = one_of(list(own[command]))
            words.append(flag)
            if own[command][flag]:
                words.append(one_of(VALUES))
        found.append(words)
    return found


@pytest.mark.usefixtures("files")
@pytest.mark.filterwarnings("ignore::assur.AssurWarning")
def test_random_words() -> None:
    ends: dict[int, int] = {}
    for words in commands():
        done = assur_command(*words)
        ends[done.code] = ends.get(done.code, 0) + 1
        lines = done.err.splitlines()
        assert all(line.startswith("assur: ") for line in lines), (words, done.err)
        assert done.code == 0 or len(lines) == 1 or lines[0].startswith("assur: note"), words
        assert done.code in (0, 3) or lines, words
        assert max(map(len, lines), default=0) < 1500, words
    assert {0, 1, 2} <= set(ends)
    assert min(ends.values()) > COUNT / 10


@pytest.mark.usefixtures("files")
@pytest.mark.filterwarnings("ignore::assur.AssurWarning")
def test_each_flag_with_each_value() -> None:
    """Of one good command; every status is possible."""
    for flag in ("--q", "--set", "--outputs", "--speed", "--out", "--design", "--drivers"):
        for value in VALUES:
            done = assur_command("solve", "example:engine", "--q=1", f"{flag}={value}")
            lines = done.err.splitlines()
            assert all(line.startswith("assur: ") for line in lines), (flag, value, done.err)
            assert done.code in (0, 1, 2, 3)
    left = {path.name for path in Path().iterdir()}
    assert not [name for name in left if name.startswith(".assur")]
