"""Every format of a table is read back equal, by the library that users read it with."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np
import openpyxl
import pandas as pd
import pytest

import assur
from assur._table import MAX_ROWS, Column
from assur.cli.formats import WRITERS
from assur.cli.output import Output
from cli.command_line import Columns, assur_command, columns, refused, same

if TYPE_CHECKING:
    from pathlib import Path

# Some positions fail, and there is one link whose name is that of a parameter of numpy.savez.
WORDS = "--q", "0:360:15deg", "--order", "1"


@pytest.fixture
def drawn(tmp_path: Path) -> Path:
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    joints = {name: (float(x), float(y)) for name, (x, y) in m.joints.items()}
    links = {"ground": "AD", "file": "AB", "coupler": "BC", "żółw": "DC"}
    path = tmp_path / "m.toml"
    assur.Mechanism(joints, links, "file").save(path)
    return path


def expected(path: Path) -> Columns:
    mechanism = assur.files.read(path).mechanism
    motion = mechanism.solve(deg=np.arange(0.0, 361.0, 15.0), order=1, on_error="nan")
    assert np.isnan(motion.joint("C").value).any()
    frame = motion.to_dataframe()
    return {str(name): frame[name].to_numpy() for name in frame}


def read_csv(path: Path) -> Columns:
    return columns(path.read_text("utf-8"))


def read_npz(path: Path) -> Columns:
    with np.load(path) as held:
        return dict(held)


def read_json(path: Path) -> Columns:
    def strict(word: str) -> None:
        raise AssertionError(word)

    held = json.loads(path.read_text("utf-8"), parse_constant=strict)
    assert held["units"]["C.x.d1"] == "m/rad"
    return {name: np.array(of, np.float64) for name, of in held["columns"].items()}


def read_parquet(path: Path) -> Columns:
    frame = pd.read_parquet(path)
    assert frame.attrs["units"]["C.x.d1"] == "m/rad"
    return {str(name): frame[name].to_numpy() for name in frame}


def read_xlsx(path: Path) -> Columns:
    found: Columns = {}
    for sheet in openpyxl.load_workbook(path).worksheets:
        names, _, *rows = sheet.iter_rows(values_only=True)
        for name, cells in zip(names, zip(*rows, strict=True), strict=True):
            found[str(name)] = np.array(cells, np.float64)
    return found


READERS = {
    ".csv": read_csv,
    ".npz": read_npz,
    ".json": read_json,
    ".parquet": read_parquet,
    ".xlsx": read_xlsx,
}


def test_every_format_has_a_reader() -> None:
    assert set(READERS) == set(WRITERS)


@pytest.mark.parametrize("ending", list(READERS))
def test_what_is_written_is_read_back(drawn: Path, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"motion{ending.upper()}"
    path.write_text("an older file")
    done = assur_command("solve", drawn, *WORDS, "--out", path)
    assert (done.code, done.out) == (3, "")
    found, wanted = READERS[ending](path), expected(drawn)
    assert set(found) == set(wanted)
    for name, values in wanted.items():
        if ending == ".xlsx":  # openpyxl writes 16 digits
            np.testing.assert_allclose(found[name], values, rtol=1e-15, atol=0.0)
        else:
            assert same(found[name], values)


def test_the_same_command_writes_the_same_bytes(drawn: Path, tmp_path: Path) -> None:
    for ending in (".csv", ".npz", ".json"):
        paths = [tmp_path / f"{k}{ending}" for k in range(2)]
        for path in paths:
            assert assur_command("solve", drawn, *WORDS, "--out", path).code == 3
        assert paths[0].read_bytes() == paths[1].read_bytes()


def test_words_and_infinities(tmp_path: Path) -> None:
    """A turning driver has no ends; groups are words."""
    for ending in READERS:
        path = tmp_path / f"limits{ending}"
        assert assur_command("limits", "example:hart", "--out", path).code == 0
        assert path.stat().st_size > 10
    limits = assur.examples.hart().limits()
    with np.load(tmp_path / "limits.npz") as held:
        assert same(held["start"], limits.intervals[:, 0])
        assert held["end_group"].tolist() == [limits.dead_points[-1].group]
    assert assur_command("limits", "example:engine", "--out", path.with_suffix(".json")).code == 0
    held = json.loads(path.with_suffix(".json").read_text())
    assert held["columns"]["start"] == ["-inf"]


def test_long_tables_are_written_in_blocks(tmp_path: Path) -> None:
    values = np.random.default_rng(1).normal(size=25_000)
    WRITERS[".csv"](tmp_path / "long.csv", [Column("x", values, "m", None)])
    assert same(read_csv(tmp_path / "long.csv")["x"], values)


def test_a_workbook_of_too_many_rows_is_refused_before(tmp_path: Path) -> None:
    output = Output(str(tmp_path / "many.xlsx"), "m.toml")
    output.require_few(MAX_ROWS - 2)
    with pytest.raises(assur.InputError, match="of 1048574 that a sheet holds"):
        output.require_few(MAX_ROWS - 1)
    Output(str(tmp_path / "many.csv"), "m.toml").require_few(MAX_ROWS)
    words = "sweep", "example:engine", "--vary", "rod.length=1:2:1048575", "--metric", "span(bore)"
    assert "use .parquet" in refused(*words, "--out", tmp_path / "many.xlsx")
    turn = "solve", "example:engine", "--q", "0:1048574:1deg"
    assert "use .parquet" in refused(*turn, "--out", tmp_path / "many.xlsx")
