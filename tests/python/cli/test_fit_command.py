"""`assur fit`: rows of a file, designs as a table and as files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assur
from assur import metric
from cli.command_line import assur_command, refused

SOURCE = ("fit", "example:crank_rocker")
FEW = ("--evaluations", 1)
ARCH = np.array([(0.0, 0.0), (0.05, 0.04), (0.1, 0.05), (0.15, 0.04), (0.2, 0.0)])


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def written(rows: object, name: str = "rows.csv") -> Path:
    file = Path(name)
    lines = [",".join(repr(float(number)) for number in row) for row in np.asarray(rows)]
    file.write_text("\n".join(lines), encoding="utf-8")
    return file


def crank_rocker() -> assur.Mechanism:
    from assur.examples import crank_rocker

    return crank_rocker()


def test_a_path() -> None:
    done = assur_command(
        *SOURCE,
        *("--path", written(ARCH * 1e3), "--scale", "1mm", *FEW, "--out", "new/legs"),
        *("--where", "min_transmission_angle(C) > 30deg", "--bounds", "*.length=10:500mm"),
        *("--vary", "*", "--seed", 3),
    )
    assert (done.code, done.err) == (0, "")
    wanted = assur.fit(
        crank_rocker(),
        {"P": ARCH * 1e3 * 1e-3},
        where=[metric.min_transmission_angle("C") > np.deg2rad(30.0)],
        bounds={"*.length": (0.01, 0.5)},
        evaluations=1,
        seed=3,
    )
    assert repr(wanted) in done.out
    files = sorted(Path("new/legs").iterdir())
    assert [str(file) for file in files] == done.out.splitlines()[-len(files) :]
    for file, fit in zip(files, wanted, strict=True):
        loaded = assur.load(file)
        assert isinstance(loaded, assur.Mechanism)
        assert dict(loaded.dimensions) == dict(fit.mechanism.dimensions)


def test_a_function_poses_and_timing() -> None:
    theta = np.linspace(1.0, 2.0, 6)
    values = written(np.column_stack([theta, 1.0 + 0.2 * np.sin(theta)]), "values.csv")
    done = assur_command(*SOURCE, "--function", values, "--of", "rocker", *FEW)
    wanted = assur.fit(
        crank_rocker(), {"rocker": (theta, 1.0 + 0.2 * np.sin(theta))}, evaluations=1
    )
    assert repr(wanted) in done.out
    poses = np.array([(0.0, 0.0, 0.0), (0.1, 0.05, 0.2), (0.15, 0.15, 0.5)])
    file = written(poses, "poses.csv")
    done = assur_command(*SOURCE, "--poses", file, "--of", "coupler", "--part-turn", *FEW)
    assert repr(assur.fit(crank_rocker(), {"coupler": poses}, evaluations=1)) in done.out
    timed = written(np.column_stack([ARCH, np.linspace(0.0, 2.0, 5)]), "timed.csv")
    done = assur_command(*SOURCE, "--path", timed, "--timing", "--full-rotation", *FEW)
    wanted = assur.fit(crank_rocker(), {"P": ARCH}, timing=np.linspace(0.0, 2.0, 5), evaluations=1)
    assert repr(wanted) in done.out


def test_words_that_are_wrong() -> None:
    file = written(ARCH)
    assert "one of the arguments --path" in refused(*SOURCE, code=2)
    assert "need --of" in refused(*SOURCE, "--poses", written(np.ones((3, 3)), "p.csv"), code=2)
    assert "NAME=FROM:TO" in refused(
        *SOURCE, "--path", file, "--bounds", "coupler.length=3", code=2
    )
    assert "is not a dimension" in refused(*SOURCE, "--path", file, "--vary", "rod.length")
    assert "there is no 'Q'" in refused(*SOURCE, "--path", file, "--of", "Q")
    assert "three numbers are needed" in refused(*SOURCE, "--path", file, "--timing")
    assert "not a condition" in refused(*SOURCE, "--path", file, "--where", "span(P.x)")
