"""The command line: a result or a one-line error, whatever the terminal, pipe or disk."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

PHI = np.linspace(0.0, 2.0 * np.pi, 25)
FULL = Path("/dev/full")


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "table.csv"
    moment = 100.0 * np.sin(PHI)
    moment[-1] = moment[0]
    rows = zip(PHI, moment, np.full(25, 2.0), strict=True)
    path.write_text("".join(f"{p!r},{m!r},{i!r}\n" for p, m, i in (map(float, r) for r in rows)))
    return path


def assur(*words: object, **more: str) -> subprocess.CompletedProcess[bytes]:
    environment = {**os.environ, **more}
    command = [sys.executable, "-m", "assur.cli", *map(str, words)]
    return subprocess.run(command, capture_output=True, env=environment, check=False)


def sized(table: Path, *words: object, **more: str) -> subprocess.CompletedProcess[bytes]:
    asked = ("flywheel", table, "--fluctuation", "0.1", "--mean-speed", "15")
    return assur(*asked, *words, **more)


def one_line(done: subprocess.CompletedProcess[bytes], *words: str) -> None:
    """It ended with 1 and one line on the standard error."""
    said = done.stderr.decode()
    assert done.returncode == 1
    assert said.startswith("assur: ")
    assert said.count("\n") == 1
    assert not [word for word in words if word not in said], said


@pytest.mark.parametrize(
    ("encoding", "unit"),
    [("utf-8", "kg·m²"), ("cp1252", "kg·m²"), ("ascii", "kg*m^2"), ("cp437", "kg·m²")],
)
def test_figures_are_printed_in_any_encoding(table: Path, encoding: str, unit: str) -> None:
    exact = sized(table, PYTHONIOENCODING="utf-8").stdout.decode()
    done = sized(table, PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.decode(encoding) == exact.replace("kg·m²", unit).replace(
        "N·m", unit.replace("kg", "N").replace("²", "").replace("^2", "")
    )


@pytest.mark.parametrize("encoding", ["cp1252", "ascii", "utf-8"])
def test_help_is_printed_in_any_encoding(encoding: str) -> None:
    done = assur("flywheel", "--help", PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    delta = "δ" if encoding == "utf-8" else "delta"
    assert f"coefficient {delta} wanted" in done.stdout.decode(encoding)


def test_letters_of_a_file_are_printed_in_any_encoding(tmp_path: Path) -> None:
    path = tmp_path / "таблица.csv"
    path.write_text("1,2,x\n", encoding="utf-8")
    one_line(sized(path, PYTHONIOENCODING="ascii"), "line 1", "\\u0442")


def test_a_picture_that_cannot_be_drawn_is_one_line_after_the_figures(
    table: Path, tmp_path: Path
) -> None:
    (tmp_path / "taken.png").mkdir()
    for path, words in (
        ("p.xyz", "xyz"),
        ("missing/p.png", "No such file"),
        ("taken.png", "directory"),
    ):
        done = sized(table, "--plot", tmp_path / path)
        one_line(done, "the picture cannot be written", words)
        assert b"flywheel " in done.stdout
    done = sized(table, "--plot", tmp_path / "p.png")
    assert done.returncode == 0
    assert (tmp_path / "p.png").stat().st_size > 1000


def test_an_invalid_table_gives_one_line_with_its_name(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    for text, words in (
        ("", "table.csv: the table has 0 rows"),
        ("# nothing\n", "table.csv: the table has 0 rows"),
        ("phi,moment,inertia\n", "table.csv: the table has 0 rows"),
        ("0,1,2\n", "table.csv: the table has 1 row:"),
        ("0," + "1" * 140_000 + ",2\n1,1,2\n", "table.csv: the table cannot be read (field larger"),
    ):
        path.write_text(text)
        one_line(sized(path), words)
    path.write_bytes(b"\xff\xfe\x00\xd8")
    one_line(sized(path), "table.csv: the table cannot be read")


def test_a_warning_is_one_line_without_source(table: Path) -> None:
    degrees = table.read_text().splitlines()
    rows = (line.split(",") for line in degrees)
    table.write_text("".join(f"{np.rad2deg(float(p))!s},{m},{i}\n" for p, m, i in rows))
    done = sized(table)
    assert done.returncode == 0
    assert b"flywheel " in done.stdout
    said = done.stderr.decode()
    assert said.startswith("assur: warning: phi covers 360 rad")
    assert said.count("\n") == 1
    one_line(sized(table, PYTHONWARNINGS="error"), "phi covers 360 rad")


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
def test_a_closed_pipe_ends_it_without_a_word(table: Path) -> None:
    for words, more in to_print(table):
        read, write = os.pipe()
        os.close(read)
        done = written_to(write, words, more)
        os.close(write)
        assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.skipif(not FULL.exists(), reason="a device that is always full")
def test_a_full_disk_is_one_line(table: Path) -> None:
    for words, more in to_print(table):
        with FULL.open("wb") as full:
            done = written_to(full.fileno(), words, more)
        one_line(done, "the output cannot be written", "No space")


def to_print(table: Path) -> list[tuple[tuple[str, ...], dict[str, str]]]:
    """Help and figures, written at the end and (figures; argparse ignores it) at once."""
    figures = "flywheel", str(table), "--fluctuation", "0.1", "--mean-speed", "15"
    at_once = {"PYTHONUNBUFFERED": "1"}
    return [(("flywheel", "--help"), {}), (figures, {}), (figures, at_once)]


def written_to(
    output: int, words: tuple[str, ...], more: dict[str, str]
) -> subprocess.CompletedProcess[bytes]:
    own = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    command = [sys.executable, "-m", "assur.cli", *words]
    errors = subprocess.PIPE
    return subprocess.run(command, stdout=output, stderr=errors, env={**own, **more}, check=False)
