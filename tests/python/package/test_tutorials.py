"""The tutorials run as they stand, and are short."""

from __future__ import annotations

import ast
import runpy
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import openpyxl
import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

EXAMPLES = Path(__file__).parents[3] / "examples"
MOST_LINES = 25


def lines_of_code(path: Path) -> int:
    """Lines that are no comment, docstring or blank."""
    module = ast.parse(path.read_text(encoding="utf-8"))
    assert ast.get_docstring(module)
    return len({line for node in module.body[1:] for line in _lines(node)})


def _lines(node: ast.AST) -> set[int]:
    return {one.lineno for one in ast.walk(node) if hasattr(one, "lineno")}


@pytest.fixture
def tutorial(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], dict[str, Any]]:
    """Run a tutorial in an empty folder; return its variables."""
    monkeypatch.chdir(tmp_path)

    def run(name: str) -> dict[str, Any]:
        path = EXAMPLES / f"tutorial_{name}.py"
        assert lines_of_code(path) <= MOST_LINES
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return runpy.run_path(str(path))

    return run


def test_shaper(tutorial: Callable[[str], dict[str, Any]], capsys: Any) -> None:
    found = tutorial("shaper")
    text = capsys.readouterr().out
    assert "I(crank) → II(block, lever) → II(rod, ram)" in text
    assert found["flywheel"].delta == pytest.approx(1 / 30, rel=1e-9)
    # The cutting force does its work once a turn, which the flywheel's motor gives.
    stroke = found["shaper"].extremes("bed").stroke
    turn = found["machine"].duty(np.linspace(0.0, 2.0 * np.pi, 721), found["omega"])
    assert float(turn.energy) == pytest.approx(1500.0 * stroke, rel=1e-6)
    # Names, units, and a row for each position.
    rows = list(openpyxl.load_workbook("shaper.xlsx")["bed"].values)
    assert rows[0] == ("q", "status", "bed", "bed.v", "bed.a")
    speeds = found["motion"].slide("bed").velocity(found["omega"])
    written = np.array([row[3] for row in rows[2:]], dtype=float)
    np.testing.assert_allclose(written, speeds, rtol=1e-14, atol=1e-15)
    assert "O" in openpyxl.load_workbook("forces.xlsx").sheetnames


def test_search(tutorial: Callable[[str], dict[str, Any]], tmp_path: Path) -> None:
    found = tutorial("search")
    best = found["best"]
    assert len(best) == 10
    off = found["found"]["off"]
    assert np.all(np.diff(off[best]) >= 0.0)
    assert off[best[0]] == np.nanmin(off)
    assert np.degrees(found["motion"].transmission_angle("C").min()) > 39.9
    assert (tmp_path / "straightest.png").stat().st_size > 10_000


def test_classes(tutorial: Callable[[str], dict[str, Any]], capsys: Any) -> None:
    found = tutorial("classes")
    text = capsys.readouterr().out
    assert "class III" in text
    assert "class IV" in text
    for q, assembly in found["five_bar"].find("P", (0.11, 0.48)):
        place = found["five_bar"].solve(q, order=0, assembly=assembly).joint("P").value
        np.testing.assert_allclose(place, (0.11, 0.48), atol=1e-12)
    assert found["run"].energy.error < 1e-9
