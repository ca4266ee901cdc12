"""Tables of motions: velocities, degrees, what moves, workbooks, Parquet and xarray."""

from __future__ import annotations

import io
from functools import partial
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from openpyxl import load_workbook

import assur
from assur import _table, metric
from models.errors.refusals import refused

if TYPE_CHECKING:
    from pathlib import Path

Q = np.linspace(0.2, 6.1, 8)


def engine() -> assur.Motion:
    return assur.SliderCrank(0.05, 0.2, 0.01).solve(Q, order=3)


def test_velocities_in_place_of_analogues() -> None:
    motion = engine()
    table = motion.to_dataframe(speed=30.0, acceleration=5.0)
    pin, rod, bore = motion.joint("A"), motion.link("rod"), motion.slide("bore")
    np.testing.assert_array_equal(table["A.vx"], pin.velocity(30.0)[:, 0])
    np.testing.assert_array_equal(table["A.ay"], pin.acceleration(30.0, 5.0)[:, 1])
    np.testing.assert_array_equal(table["A.jx"], pin.jerk(30.0, 5.0)[:, 0])
    np.testing.assert_array_equal(table["rod.omega"], rod.velocity(30.0))
    np.testing.assert_array_equal(table["rod.alpha"], rod.acceleration(30.0, 5.0))
    np.testing.assert_array_equal(table["rod.jerk"], rod.jerk(30.0, 5.0))
    np.testing.assert_array_equal(table["bore.v"], bore.velocity(30.0))
    np.testing.assert_array_equal(table["bore.a"], bore.acceleration(30.0, 5.0))
    np.testing.assert_array_equal(table["bore.j"], bore.jerk(30.0, 5.0))
    units = table.attrs["units"]
    assert [units[n] for n in ("q", "A.x", "rod.omega", "bore.a")] == ["rad", "m", "rad/s", "m/s2"]
    assert not [name for name in table if ".d" in str(name)]


def test_a_speed_at_each_position() -> None:
    motion = engine()
    omega = np.linspace(1.0, 2.0, len(Q))
    table = motion.to_dataframe(speed=omega)
    np.testing.assert_array_equal(table["bore.v"], motion.slide("bore").d1 * omega)
    refused(assur.InputError, "one speed", partial(motion.to_dataframe, speed=np.ones((3, 1))))


def test_degrees_are_of_angles_only() -> None:
    motion = engine()
    table = motion.to_dataframe(speed=30.0, degrees=True)
    np.testing.assert_array_equal(table["q"], np.degrees(Q))
    np.testing.assert_array_equal(table["rod"], np.degrees(motion.link("rod").value))
    np.testing.assert_array_equal(table["rod.omega"], motion.link("rod").velocity(30.0))
    assert table.attrs["units"]["rod"] == "deg"
    analogues = motion.to_dataframe(degrees=True)
    np.testing.assert_array_equal(analogues["rod.d1"], motion.link("rod").d1)
    assert analogues.attrs["units"]["rod.d2"] == "rad/rad/rad"
    driven = assur.SliderCrank(0.05, 0.2, 0.01).with_driver("bore")
    table = driven.solve(driven.q0, order=1).to_dataframe(degrees=True)
    assert table["q"][0] == driven.q0
    assert table.attrs["units"]["crank.d1"] == "rad/m"


def test_only_what_moves() -> None:
    names = [str(name) for name in engine().to_dataframe(speed=1.0, moving=True)]
    assert not [n for n in names if n.startswith(("O.", "ground", "piston"))]
    assert {"A.x", "B.x", "crank", "rod", "bore"} <= set(names)
    one = assur.SliderCrank(0.05, 0.2).solve(1.0).to_dataframe(moving=True)
    assert "A.x" in one
    # One position without analogues does not tell what moves.
    assert "O.x" in assur.SliderCrank(0.05, 0.2).solve(1.0, order=0).to_dataframe(moving=True)
    assert "O.x" not in one


def test_a_workbook_has_a_sheet_for_each_quantity(tmp_path: Path) -> None:
    motion = assur.FourBar(3.0, 2.5, 2.0, 4.0).solve([0.0, 1.0, 3.0], on_error="nan")
    motion.to_excel(tmp_path / "motion.xlsx", speed=10.0, degrees=True, moving=True)
    book = load_workbook(tmp_path / "motion.xlsx")
    assert book.sheetnames == ["B", "C", "crank", "coupler", "rocker"]
    rows = list(book["C"].iter_rows(values_only=True))
    assert rows[0] == ("q", "status", "C.x", "C.y", "C.vx", "C.vy", "C.ax", "C.ay")
    assert rows[1][:3] == ("deg", None, "m")
    assert rows[2][2] == motion.joint("C").value[0, 0]
    # Out of reach: an empty cell.
    assert rows[4][1:3] == (3, None)


def test_names_that_excel_refuses(tmp_path: Path) -> None:
    long = "a" * 40
    m = assur.Mechanism(
        {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
        {"ground": "AD", f"{long}1": "AB", f"{long}2": "BC", "b": "DC"},
        f"{long}1",
    )
    m.solve(Q).to_excel(tmp_path / "long.xlsx", moving=True)
    names = load_workbook(tmp_path / "long.xlsx").sheetnames
    # "b" and "B" are one name to Excel.
    assert names == ["B", "C", "a" * 31, "a" * 29 + "~2", "b~2"]


def test_parquet_keeps_bits_and_units(tmp_path: Path) -> None:
    motion = engine()
    motion.to_parquet(tmp_path / "motion.parquet", speed=30.0)
    table, wanted = pd.read_parquet(tmp_path / "motion.parquet"), motion.to_dataframe(speed=30.0)
    pd.testing.assert_frame_equal(table, wanted, check_exact=True)
    assert table.attrs["units"]["bore.v"] == "m/s"


def test_parquet_files_are_those_of_pandas(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    monkeypatch.setattr(_table, "NUMBERS_AT_ONCE", 1)
    monkeypatch.setattr(_table, "LEAST_ROWS", 3)
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    batch = m.with_dimensions({"rocker.length": [2.5, 2.6]})
    for motion in (engine(), batch.solve(Q), assur.sweep(m, {}, [], on_error="drop")):
        motion.to_parquet(tmp_path / "own.parquet")
        motion.to_dataframe().to_parquet(tmp_path / "pandas.parquet", index=False)
        own, wanted = (parquet.read_table(tmp_path / f"{n}.parquet") for n in ("own", "pandas"))
        assert own.equals(wanted, check_metadata=True)


def test_a_parquet_file_that_is_not_finished_is_empty(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    monkeypatch.setattr(_table, "NUMBERS_AT_ONCE", 1)
    monkeypatch.setattr(_table, "LEAST_ROWS", 3)
    parts = []

    class Stopping:
        @staticmethod
        def from_pandas(*args: Any, **options: Any) -> Any:
            parts.append(args)
            if len(parts) == 2:
                raise KeyboardInterrupt
            return own.from_pandas(*args, **options)

    own = pyarrow.RecordBatch
    monkeypatch.setattr(pyarrow, "RecordBatch", Stopping)
    with pytest.raises(KeyboardInterrupt):
        engine().to_parquet(tmp_path / "motion.parquet")
    assert (tmp_path / "motion.parquet").read_bytes() == b""


def test_xarray_has_named_dimensions() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    rocker, ground = np.linspace(2.3, 2.6, 3)[:, None], np.linspace(3.0, 3.3, 2)
    batch = m.with_dimensions({"rocker.length": rocker, "ground.D.x": ground})
    data = batch.solve(Q).to_xarray()
    assert dict(data["C"].sizes) == {"design0": 3, "design1": 2, "position": 8, "component": 2}
    np.testing.assert_array_equal(
        data["C.d2"].sel(component="y").isel(design0=1), batch.solve(Q).joint("C").d2[1, ..., 1]
    )
    assert data["rocker"].attrs["units"] == "rad"
    assert data["C.d2"].attrs["units"] == "m/rad/rad"
    np.testing.assert_array_equal(data.coords["rocker.length"][:, 0], rocker[:, 0])
    assert "coupler.length" not in data.coords
    own = Q + np.zeros((3, 2, 1))
    assert batch.solve(own).to_xarray()["q"].dims == ("design0", "design1", "position")
    assert isinstance(m.solve(1.0).to_xarray(), xr.Dataset)


def test_xarray_of_numbers_alone_has_no_components() -> None:
    slide = assur.examples.engine().solve([0.0, 1.0], outputs=["bore"]).to_xarray()
    assert dict(slide.sizes) == {"position": 2}


def test_xarray_of_two_drivers() -> None:
    joints = {"A": (0, 0), "B": (0, 1), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1, 0)}
    links = {"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"}
    m = assur.Mechanism(joints, links, ("left", "right"))
    data = m.solve(np.array([m.q0, m.q0]), order=2).to_xarray()
    assert data["q"].dims == ("position", "driver")
    assert data["P.d2"].dims == ("position", "component", "driver0", "driver1")


def test_dimensions_from_tables() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    columns = {"rocker.length": [2.4, 2.5, 2.6], "coupler.length": [2.9, 3.0, 3.1]}
    wanted = m.with_dimensions({name: np.array(values) for name, values in columns.items()})
    assert m.with_dimensions(pd.DataFrame(columns)) == wanted
    rows = {name: ("design", values) for name, values in columns.items()}
    assert m.with_dimensions(xr.Dataset(rows, {"design": [7, 8, 9]})) == wanted
    refused(assur.InputError, "roker", partial(m.with_dimensions, pd.DataFrame({"roker": [1.0]})))
    words = pd.DataFrame({"rocker.length": ["long"]})
    refused(assur.InputError, "rocker.length", partial(m.with_dimensions, words))


def test_names_like_formulas_are_text_in_a_workbook(tmp_path: Path) -> None:
    m = assur.Mechanism(
        {"O": (0, 0), "A": (0, 1), "B": (3, 2.5), "C": (4, 0)},
        {"ground": "OC", "=1+1": "OA", "=A1+B2": "AB", "History": "BC"},
        "=1+1",
    )
    m.solve([0.0, 1.0]).to_excel(tmp_path / "names.xlsx")
    book = load_workbook(tmp_path / "names.xlsx")
    assert "History" not in book.sheetnames
    kinds = {cell.data_type for sheet in book for cell in sheet[1]}
    assert kinds == {"s"}
    assert "=A1+B2" in [cell.value for sheet in book for cell in sheet[1]]


def test_joints_may_be_called_like_coordinates() -> None:
    m = assur.Mechanism(
        {"q": (0, 0), "status": (0, 1), "B": (3, 2.5), "C": (4, 0)},
        {"ground": ["q", "C"], "a": ["q", "status"], "b": ["status", "B"], "c": "BC"},
        "a",
    )
    motion = m.solve([0.0, 1.0])
    data = motion.to_xarray()
    np.testing.assert_array_equal(data["joint status"], motion.joint("status").value)


def test_variables_of_a_dataset_broadcast_by_name() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    rows = {
        "coupler.length": ("c", [2.9, 3.0]),
        "rocker.length": ("r", [2.4, 2.5]),
        "ground.D.y": (("r", "c"), [[0.0, 0.1], [0.2, 0.3]]),
    }
    data = xr.Dataset(rows)
    for found in (m.with_dimensions(data), assur.sweep(m, data, Q).mechanism):
        assert found.shape == (2, 2)
        # Axes in the order in which they first appear.
        assert found.dimensions["coupler.length"].tolist() == [[2.9, 2.9], [3.0, 3.0]]
        assert found.dimensions["rocker.length"].tolist() == [[2.4, 2.5], [2.4, 2.5]]
        assert found.dimensions["ground.D.y"].tolist() == [[0.0, 0.2], [0.1, 0.3]]


def test_sweeps_take_tables() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    table = pd.DataFrame({"rocker.length": [2.4, 2.5, 2.6], "coupler.length": [2.9, 3.0, 3.1]})
    assert assur.sweep(m, table, Q).mechanism == m.with_dimensions(table)
    one = table.iloc[1]
    as_mapping = {str(name): value for name, value in one.items()}
    assert m.with_dimensions(one) == m.with_dimensions(as_mapping)
    assert assur.sweep(m, one, Q).mechanism == m.with_dimensions(one)
    for ask in (m.with_dimensions, lambda of: assur.sweep(m, of, Q)):
        refused(assur.InputError, "DataFrame Series Dataset", partial(ask, cast("Any", 3.0)))
        twice = pd.concat([table, table], axis=1)
        refused(assur.InputError, "'rocker.length' twice", partial(ask, twice))


def test_tables_of_results_are_read_back() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    space = {"coupler.length": [2.8, 3.0, 3.1], "rocker.length": [2.4, 2.5, 9.9]}
    asked = {"swing": metric.span("rocker"), "P.x": metric.span("C.x")}
    found = assur.sweep(m, space, Q, metrics=asked)
    table = found.to_dataframe()
    assert m.with_dimensions(table) == found.designs([0, 1, 2])
    assert m.with_dimensions(table.iloc[[2, 0]]) == found.designs([2, 0])
    assert m.with_dimensions(table.iloc[1]) == found.designs(1)
    read = m.with_dimensions(pd.read_csv(io.StringIO(table.to_csv()))).dimensions
    for name, values in space.items():
        np.testing.assert_allclose(read[name], values, rtol=1e-15)
    # A dimension behind the results counts, and one that is misspelt is no metric.
    more = table.assign(**{"crank.length": 0.9})
    assert m.with_dimensions(more).dimensions["crank.length"].tolist() == [0.9] * 3
    wrong = table.assign(**{"crnk.length": 0.9})
    refused(assur.InputError, "crnk.length crank.length", partial(m.with_dimensions, wrong))
    apart = table[["swing", "coupler.length"]]
    refused(assur.InputError, "swing", partial(m.with_dimensions, apart))


def test_tables_of_designs_that_move_have_their_indices(tmp_path: Path) -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    lengths = {"rocker.length": [[0.1, 2.5, 2.6], [9.9, 2.7, 2.8]]}
    moved = assur.sweep(m, lengths, Q, on_error="drop")
    own = [1, 2, 4, 5]
    table = moved.to_dataframe()
    assert table["design"].tolist() == np.repeat(own, len(Q)).tolist()
    moved.to_parquet(tmp_path / "moved.parquet")
    assert pd.read_parquet(tmp_path / "moved.parquet")["design"].equals(table["design"])
    moved.to_excel(tmp_path / "moved.xlsx")
    sheet = load_workbook(tmp_path / "moved.xlsx").worksheets[0]
    assert [row[0].value for row in sheet.iter_rows(min_row=3)] == table["design"].tolist()
    data = moved.to_xarray()
    assert data["design"].values.tolist() == own
    one = assur.sweep(m, {"rocker.length": 2.7}, Q)["C"].value
    np.testing.assert_array_equal(data["C"].sel(design=4).values, one)
    # Parts of it keep them.
    assert moved[2:].to_xarray()["design"].values.tolist() == own[2:]
    assert moved[[3, 0]].to_dataframe()["design"].unique().tolist() == [5, 1]
    assert "design" not in moved[0].to_xarray().coords
    assert assur.sweep(m, lengths, Q).to_dataframe()["design1"].max() == 2


def test_datasets_of_results_are_read_back() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    grid = assur.Grid({"coupler.length": [2.8, 3.0, 3.1], "rocker.length": [2.4, 2.5]})
    data = assur.sweep(m, grid, Q, metrics={"swing": metric.span("rocker")}).to_xarray()
    assert m.with_dimensions(data) == m.with_dimensions(grid)
    one = m.with_dimensions({"coupler.length": 3.1, "rocker.length": 2.4})
    assert m.with_dimensions(data.isel({"coupler.length": 2, "rocker.length": 0})) == one
    for table in (data.drop_vars(list(grid)), pd.DataFrame({"status": [0], "kept": [True]})):
        refused(assur.InputError, "no column status", partial(m.with_dimensions, table))


def test_dimensions_as_a_table() -> None:
    m = assur.SliderCrank(0.05, 0.2)
    grid = m.with_dimensions({"crank.length": [[0.05], [0.06]], "rod.length": [0.2, 0.3, 0.4]})
    table = grid.dimensions.to_dataframe()
    assert list(table) == ["design0", "design1", *m.dimensions]
    assert table["design0"].tolist() == [0, 0, 0, 1, 1, 1]
    assert table["crank.length"].tolist() == [0.05] * 3 + [0.06] * 3
    assert table["rod.length"].tolist() == [0.2, 0.3, 0.4] * 2
    assert table.attrs["units"]["bore.angle"] == "rad"
    # It is read back, the axes of designs made one.
    again = m.with_dimensions(table)
    assert again.shape == (6,)
    assert again.design(4) == grid.design((1, 1))
    assert len(m.dimensions.to_dataframe()) == 1


@pytest.mark.parametrize("path", [12345, None, b"m.xlsx"])
def test_what_is_no_path_is_refused(path: Any) -> None:
    motion = assur.SliderCrank(1.0, 3.0).solve([0.0, 1.0])
    for write in (motion.to_excel, motion.to_parquet):
        refused(assur.InputError, f"path is {path!r}: a path is needed", partial(write, path))


def test_a_motion_of_no_designs_has_empty_columns() -> None:
    pytest.importorskip("xarray")
    no_turn = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    data = assur.sweep(no_turn, {}, [3.0], on_error="drop").to_xarray()
    assert data.sizes["design"] == 0
    assert data["C"].dims == ("design", "position", "component")
