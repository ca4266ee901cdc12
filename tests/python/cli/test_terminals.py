"""The command line: a result or a one-line error, whatever the terminal, pipe or disk."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from assur.cli import main
from assur.cli.progress import lines, progress
from cli.command_line import assur_command

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
    """Call a command in a process of its own."""
    environment = {**os.environ, **more}
    command = [sys.executable, "-m", "assur", *map(str, words)]
    return subprocess.run(command, capture_output=True, env=environment, check=False)


def encoded(*words: object, encoding: str = "utf-8") -> subprocess.CompletedProcess[bytes]:
    """Call a command in this process, with outputs of an encoding."""
    held = io.BytesIO(), io.BytesIO()
    out, err = (io.TextIOWrapper(each, encoding=encoding, newline="\n") for each in held)
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main([str(word) for word in words])
    for stream in (out, err):
        assert stream.errors == "strict"
        stream.flush()
    return subprocess.CompletedProcess((), code, *(each.getvalue() for each in held))


def sizing(table: Path) -> tuple[object, ...]:
    return ("flywheel", table, "--fluctuation", "0.1", "--mean-speed", "15")


def sized(
    table: Path, *words: object, encoding: str = "utf-8"
) -> subprocess.CompletedProcess[bytes]:
    return encoded(*sizing(table), *words, encoding=encoding)


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
    exact = sized(table).stdout.decode()
    done = sized(table, encoding=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.decode(encoding) == exact.replace("kg·m²", unit).replace(
        "N·m", unit.replace("kg", "N").replace("²", "").replace("^2", "")
    )


@pytest.mark.parametrize("encoding", ["cp1252", "ascii", "utf-8"])
def test_help_is_printed_in_any_encoding(encoding: str) -> None:
    done = encoded("flywheel", "--help", encoding=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    delta = "δ" if encoding == "utf-8" else "delta"
    assert f"coefficient {delta} wanted" in done.stdout.decode(encoding)


def test_letters_of_a_file_are_printed_in_any_encoding(tmp_path: Path) -> None:
    path = tmp_path / "таблица.csv"
    path.write_text("1,2,x\n", encoding="utf-8")
    one_line(sized(path, encoding="ascii"), "line 1", "\\u0442")


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
    done = assur(*sizing(table))
    assert done.returncode == 0
    assert b"flywheel " in done.stdout
    said = done.stderr.decode()
    assert said.startswith("assur: warning: phi covers 360 rad")
    assert said.count("\n") == 1
    one_line(sized(table), "phi covers 360 rad")  # warnings are errors here


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
    command = [sys.executable, "-m", "assur", *words]
    errors = subprocess.PIPE
    return subprocess.run(command, stdout=output, stderr=errors, env={**own, **more}, check=False)


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
def test_a_reader_that_has_enough() -> None:
    """As `assur solve ... | head -1` does: the first line, and not a word of error."""
    command = [sys.executable, "-m", "assur.cli", "solve", "example:loom", "--q", "0:3600:1deg"]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdout=pipe, stderr=pipe) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.readline().startswith(b"q,status,")
        process.stdout.close()
        assert process.wait() == 1
        assert process.stderr.read() == b""


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_an_interrupt_from_the_keyboard() -> None:
    """While it waits for the standard input: one line and 130."""
    code = (
        "import os, signal, threading\n"
        # A shell's job in the background ignores it.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from assur.cli import main\n"
        "kill = lambda: os.kill(os.getpid(), signal.SIGINT)\n"
        "threading.Timer(0.05, kill).start()\n"
        "raise SystemExit(main(['structure', '-']))"
    )
    pipe = subprocess.PIPE
    command = [sys.executable, "-c", code]
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe) as process:
        assert process.stdin is not None
        assert process.stderr is not None
        assert process.wait(60.0) == 130
        assert process.stderr.read() == b"assur: interrupted\n"
        process.stdin.close()


def test_no_memory_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    def solve(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr("assur.Mechanism.solve", solve)
    done = assur_command("solve", "example:engine")
    assert (done.code, done.err.count("\n")) == (1, 1)
    assert "not enough memory" in done.err


class Screen(io.StringIO):
    """A terminal."""

    def isatty(self) -> bool:
        return True


def on_screen(*words: str) -> str:
    screen = Screen()
    with contextlib.redirect_stdout(screen):
        assert main(words) == 0
    return screen.getvalue()


def test_a_terminal_shows_a_part_of_a_table(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    shown = on_screen("solve", "example:engine", "--degrees").splitlines()
    assert max(map(len, shown[:-1])) <= 60
    assert shown[0].split()[:3] == ["q", "status", "O.x"]
    assert shown[1].split()[:2] == ["deg", "m"]
    assert [line.split()[0] for line in shown[2:10]] == [str(k) for k in range(8)]
    assert shown[10] == "..."
    assert [line.split()[0] for line in shown[11:15]] == ["357", "358", "359", "360"]
    assert all(line.split()[1] == "OK" for line in shown[11:15])
    assert shown[15].startswith("361 rows; ")
    assert "more columns" in shown[15]
    words = "solve", "example:engine", "--q", "0,90deg", "--outputs", "bore", "--order", "0"
    assert on_screen(*words) == (
        "     q  status      bore\n"
        "   rad                 m\n"
        "     0      OK     0.195\n"
        "1.5708      OK  0.143091\n"
    )
    assert on_screen(*words, "--out", "-").startswith("q,status,bore\n0.0,0,0.195\n")


def test_progress_is_a_bar_in_a_terminal_and_lines_elsewhere(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    class Given:
        quiet = False

    now = 0.0
    show = lines(lambda: now)
    for now, done in ((1.0, 10), (6.0, 20), (8.0, 30), (12.0, 40), (20.0, 50)):  # noqa: B007
        show(done, 50)
    assert capsys.readouterr().err.splitlines() == [
        "assur: 20 of 50 designs done",
        "assur: 40 of 50 designs done",
    ]
    given = Given()
    assert callable(progress(given))  # type: ignore[arg-type]
    monkeypatch.setattr(sys, "stderr", Screen())
    assert progress(given) is True  # type: ignore[arg-type]
    monkeypatch.setattr("assur.cli.progress.find_spec", lambda _: None)
    assert callable(progress(given))  # type: ignore[arg-type]
    given.quiet = True
    assert progress(given) is False  # type: ignore[arg-type]


def test_a_bar_of_a_sweep() -> None:
    screen = Screen()
    words = "sweep", "example:engine", "--vary", "rod.length=0.1:0.2:50", "--metric", "span(bore)"
    with contextlib.redirect_stderr(screen), contextlib.redirect_stdout(io.StringIO()):
        assert main(words) == 0
    assert "50.0/50.0" in screen.getvalue()
    assert assur_command(*words).err == ""


def test_the_program_starts_quickly() -> None:
    """Importing it imports no command, and nothing that only some commands need."""
    code = (
        "import sys, assur.cli\n"
        "late = 'assur.cli.commands', 'assur.sweeps', 'assur.files', 'assur.importers', "
        "'assur.dynamics.machine', 'assur.flywheel', 'pandas', 'matplotlib', 'tqdm', 'scipy'\n"
        "print([name for name in late if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert done.stdout.strip() == b"[]"


@pytest.mark.parametrize("closed", ["stdout", "stderr"])
def test_a_stream_that_the_shell_has_closed(closed: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As by `2>&-`: errors do not go to the other stream."""
    streams = {"stdout": io.StringIO(), "stderr": io.StringIO()}
    for name, stream in streams.items():
        monkeypatch.setattr(sys, name, None if name == closed else stream)
    assert main(["structure", "example:nothing"]) == 1
    assert main(["structure", "example:engine"]) == 0
    getattr(sys, closed).close()
    written = {name: stream.getvalue() for name, stream in streams.items()}
    assert written["stdout"].startswith("I(crank)") == (closed == "stderr")
    assert written["stderr"].startswith("assur: there is") == (closed == "stdout")
