"""Any words end with a status and lines that begin with "assur: ", never with a traceback."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest

from assur.cli.main import COMMANDS
from command_line import assur_command

FLAGS = (
    *("--q", "--set", "--design", "--format", "--scale", "--drivers", "--order", "--outputs"),
    *("--omega", "--alpha", "--degrees", "--moving", "--out", "--quiet", "--dimensions"),
    *("--speed", "--acceleration", "--sense", "--fluctuation", "--flywheel", "--mean-speed"),
    *("--mean", "--spline", "--vary", "--designs", "--metric", "--where", "--best", "--by"),
    *("--greatest", "--positions", "--threads", "--joint", "--force", "--help", "--version", "-h"),
)
VALUES = (
    *("0:90:30deg", "0,1", "1", "-1", "-1:1:0.5", "1e999", "nan", "0:1", "5mm", "1,2,3deg", ""),
    *("rod.length=0.2", "rod.length=200mm", "rod.length=-1", "crank.length=0.1:0.2:3", "x=1"),
    *("rod.length=1e308", "crank.length=0.3mm", "a=span(bore)", "span(B.x)", "span(B.x) > 1"),
    *("least_transmission(A)", "span(", "peak_effort()", "pmks", "0-1", "0-1-2", "A,bore", "B"),
    *("out.csv", "out.json", "out.toml", "out.svg", "no/out.csv", "out.exe", "-", "--", "\0", "é"),
    *("table.csv", "press.toml", "broken.toml", "sketch.txt", "example:engine", "example:x"),
    *("example:toggle_press", "example:five_bar", "a://b", ".", "10", "99999999999999999999"),
    *("--out=-", "--q=0", "--q=", "rpm", "20rpm", "period", "natural", "%s", "{0}", "\ud800"),
)
COUNT = 400
MOST_WORDS = 7


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


def commands() -> list[list[str]]:
    """Return a command and words: mostly a file first, and a value after a flag."""
    rng = np.random.default_rng(2024)
    found = []
    for _ in range(COUNT):
        words = [str(rng.choice(list(COMMANDS)))] if rng.random() < 0.95 else []
        if rng.random() < 0.8:
            sources = ("press.toml", "example:engine", "example:toggle_press", "sketch.txt", "-")
            words.append(str(rng.choice(sources)))
        for _ in range(rng.integers(0, MOST_WORDS)):
            pool = FLAGS if rng.random() < 0.5 else VALUES
            words.append(pool[int(rng.integers(len(pool)))])
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
    assert set(ends) >= {0, 1, 2}
    assert ends[0] > COUNT / 20


@pytest.mark.usefixtures("files")
@pytest.mark.filterwarnings("ignore::assur.AssurWarning")
def test_each_flag_with_each_value() -> None:
    """Of one good command; every status is possible."""
    for flag in ("--q", "--set", "--outputs", "--omega", "--out", "--design", "--drivers"):
        for value in VALUES:
            done = assur_command("solve", "example:engine", "--q=1", f"{flag}={value}")
            lines = done.err.splitlines()
            assert all(line.startswith("assur: ") for line in lines), (flag, value, done.err)
            assert done.code in (0, 1, 2, 3)
    left = {path.name for path in Path().iterdir()}
    assert not [name for name in left if name.startswith(".assur")]
