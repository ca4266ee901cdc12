"""`assur search`: points of a file, linkages as a table and as files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assur
from cli.command_line import assur_command, refused

HOOK = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
ROWS = "0,2\n0,0.5\n0.4,0\n1.2,0.2\n"
FEW = ("--joints", 6, "--evaluations", 1)


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def written(text: str) -> Path:
    file = Path("points.csv")
    file.write_text(text, encoding="utf-8")
    return file


@pytest.mark.parametrize(
    "text",
    [
        ROWS,
        "x,y\n" + ROWS,
        "\ufeffX;Y\r\n" + ROWS.replace(",", ";"),
        ROWS.replace(",", "\t") + "\n\n",
        ROWS.replace(",", " "),
        "i,y,x\n0,2,0\n1,0.5,0\n2,0,0.4\n3,0.2,1.2\n",
    ],
)
def test_points_of_a_file(text: str) -> None:
    from assur.cli.path_file import read_points

    np.testing.assert_array_equal(read_points(str(written(text))), HOOK)


def test_what_it_prints_and_writes() -> None:
    done = assur_command("search", "--path", written(ROWS), *FEW, "--out", "new/legs")
    assert (done.code, done.err) == (0, "")
    wanted = assur.search({"P": HOOK}, joints=6, evaluations=1)
    assert repr(wanted) in done.out
    report = wanted[0].report().splitlines()
    # The last line has the time.
    assert "\n".join(report[:-1]) in done.out
    files = sorted(Path("new/legs").iterdir())
    assert [str(file) for file in files] == done.out.splitlines()[-len(files) :]
    assert [assur.load(file) for file in files] == [fit.mechanism for fit in wanted]


def test_options_are_those_of_the_function() -> None:
    options = (
        *("--joint", "foot", "--min-apex-angle", "30deg", "--frame", 12, "--closed", "--seed", 3),
        *("--scale", "1mm", "--joint-price", 0.05, "--robust", 1e-3, "--threads", 1),
    )
    done = assur_command("search", "--path", written(ROWS), *FEW, *options)
    assert (done.code, done.err) == (0, "")
    wanted = assur.search(
        {"foot": np.array(HOOK) * 1e-3},
        joints=6,
        evaluations=1,
        min_apex_angle=np.pi / 6.0,
        frame=12.0,
        closed=True,
        seed=3,
        joint_price=0.05,
        robust=1e-3,
    )
    assert repr(wanted) in done.out
    open_one = assur_command("search", "--path", "points.csv", *FEW, "--open", "--min-arc", "2rad")
    assert repr(assur.search({"P": HOOK}, joints=6, evaluations=1, min_arc=2.0)) in open_one.out


def test_files_and_words_that_are_wrong() -> None:
    path = ("search", "--path")
    assert "cannot be read" in refused(*path, "nowhere.csv")
    assert "is empty" in refused(*path, written("\n"))
    assert "line 2: '1 a' is not a point" in refused(*path, written("0,0\n1,a\n"))
    assert "line 3: '3' is not a point" in refused(*path, written("x,y\n1,2\n3\n"))
    assert "has 0 points" in refused(*path, written("x,y\n"))
    assert "line 1: 'nan 1'" in refused(*path, written("nan,1\n2,2\n"))
    file = written(ROWS)
    assert "joints is 2" in refused(*path, file, "--joints", 2)
    assert "its unit can be rad, deg, not mm" in refused(*path, file, "--min-arc", "2mm")
    assert "is a file" in refused(*path, file, *FEW, "--out", file)
    assert "cannot be written" in refused(*path, file, *FEW, "--out", "points.csv/x")
    assert "no linkage keeps all" in refused(
        *path, file, *FEW, "--frame", 4, "--min-apex-angle", "69deg"
    )
    assert "--path" in refused("search", code=2)


def test_progress_without_a_terminal() -> None:
    from assur.cli import progress

    times = iter([0.0, 1.0, 6.0, 7.0, 20.0])
    show = progress.search_lines(lambda: next(times))
    lines: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("builtins.print", lambda text, **_: lines.append(text))
        for part in (0.1, 0.3, 0.5, 1.0):
            show(part, 0.0123)
    assert lines == ["assur: 30 % done, error 0.0123"]
