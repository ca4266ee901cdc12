"""Every --help has examples, and they run as they stand."""

from __future__ import annotations

import shlex
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.cli.main import COMMANDS
from cli.command_line import assur_command

HERE = Path(__file__)
PRESS = HERE.parents[3] / "examples" / "press.toml"


def examples(command: str) -> list[str]:
    """Return the commands at the end of a --help."""
    done = assur_command(command, "--help")
    assert (done.code, done.err) == (0, "")
    _, _, tail = done.out.partition("\nexamples:\n")
    return [line.strip() for line in tail.splitlines()]


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What examples read: press.toml, table.csv and points.csv."""
    monkeypatch.chdir(tmp_path)
    Path("press.toml").write_text(PRESS.read_text("utf-8"), encoding="utf-8")
    phi = np.linspace(0.0, 2 * np.pi, 25)
    moment = 100.0 * np.sin(phi)
    moment[-1] = moment[0]
    np.savetxt("table.csv", np.transpose([phi, moment, np.full(25, 2.0)]), delimiter=",")
    Path("points.csv").write_text("x,y\n0,2\n0,0.5\n0.4,0\n1.2,0.2\n", encoding="utf-8")


@pytest.mark.usefixtures("files")
@pytest.mark.parametrize("command", list(COMMANDS))
def test_examples_run(command: str) -> None:
    found = examples(command)
    assert found
    for line in found:
        name, *words = shlex.split(line)
        assert name == "assur"
        assert words[0] == command
        before = set(Path().iterdir())
        done = assur_command(*words)
        assert (done.code, done.err) == (0, ""), line
        written = set(Path().iterdir()) - before
        named = [Path(word) for word in words if word.endswith((".csv", ".png", ".svg"))]
        assert written >= {path for path in named if path.name not in ("table.csv", "points.csv")}
        assert done.out or written


def test_the_program_lists_its_commands_and_statuses() -> None:
    done = assur_command("--help")
    assert done.code == 0
    for name, does in COMMANDS.items():
        assert f"    {name}" in done.out
        assert does in done.out
    for status in ("0    done", "1    the", "2    the", "3    done, but", "130  interrupted"):
        assert status in done.out
    assert assur_command("--version").out == f"assur {assur.__version__}\n"


@pytest.mark.parametrize("command", list(COMMANDS))
def test_a_line_of_help_fits_a_terminal(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "90")
    text = assur_command(command, "--help").out.partition("\nexamples:\n")[0]
    assert max(map(len, text.splitlines())) <= 90
