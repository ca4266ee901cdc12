"""A table says which design a row is, and every kind of table says the same."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import pytest

import assur

if TYPE_CHECKING:
    from pathlib import Path

BATCH = assur.FourBar(1.0, 3.0, [2.4, 2.5, 2.6], 3.2, ground_angle=[0.0, 0.1, 0.2])
TURN = np.array([0.0, 0.5, 1.0, 1.5])
ASKED: list[dict[str, Any]] = [
    {},
    {"degrees": True},
    {"moving": True},
    {"speed": 2.0},
    {"speed": 2.0, "acceleration": 3.0, "jerk": 4.0, "degrees": True, "moving": True},
]


def test_rows_hold_the_dimensions_that_differ() -> None:
    table = BATCH.solve(TURN).to_dataframe()
    assert list(table)[:5] == ["design", "ground.D.x", "ground.D.y", "rocker.length", "q"]
    for design, rows in table.groupby("design"):
        own = BATCH.design(int(str(design)))
        assert (rows["rocker.length"] == own.dimensions["rocker.length"]).all()
        np.testing.assert_array_equal(rows["C.x"], own.solve(TURN).joint("C").value[:, 0])
    assert table.attrs["units"]["rocker.length"] == "m"
    # Rows make designs again.
    again = BATCH.design(0).with_dimensions(table[["rocker.length", "ground.D.x", "ground.D.y"]])
    assert again.shape == (len(table),)
    assert not {"rocker.length"} & set(BATCH.design(0).solve(TURN).to_dataframe())


def test_forces_hold_the_dimensions_that_differ() -> None:
    bodies = {"rocker": assur.Body(mass=1.0, inertia=0.5, at=(1.0, 0.0))}
    table = assur.Machine(BATCH, bodies=bodies).reactions(TURN, speed=2.0).to_dataframe()
    assert list(table)[:5] == ["design", "ground.D.x", "ground.D.y", "rocker.length", "q"]


def test_angles_among_the_dimensions_are_in_degrees() -> None:
    bores = assur.SliderCrank(0.05, 0.2).with_dimensions({"bore.angle": np.radians([0.0, 30.0])})
    table = bores.solve(TURN).to_dataframe(degrees=True)
    assert table["bore.angle"].unique().tolist() == [0.0, 30.0]
    assert table.attrs["units"]["bore.angle"] == "deg"
    data = bores.solve(TURN).to_xarray(degrees=True)
    assert (data["bore.angle"].values.tolist(), data["bore.angle"].attrs["units"]) == (
        [0.0, 30.0],
        "deg",
    )


@pytest.mark.parametrize("asked", ASKED, ids=lambda asked: "-".join(asked) or "default")
@pytest.mark.parametrize("design", [None, 1])
def test_tables_agree(asked: dict[str, Any], design: int | None, tmp_path: Path) -> None:
    """The same names, units and values; a joint has the axis `component` in a Dataset."""
    motion = (BATCH if design is None else BATCH.design(design)).solve(TURN, order=3)
    table = motion.to_dataframe(**asked)
    motion.to_parquet(tmp_path / "motion.parquet", **asked)
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "motion.parquet"), table)
    data = motion.to_xarray(**asked)
    names = dict.fromkeys(str(name) for name in [*data.data_vars, *data.coords])
    left = [name for name in table if name != "design"]
    for name in names:
        values, unit = data[name].values, data[name].attrs.get("units", "")
        if name == "component" or name == "design":
            continue
        if "component" in data[name].dims:
            for c, axis in enumerate("xy"):
                stem, dot, tail = name.partition(".")
                ends = f".{tail}{axis}" if tail in ("v", "a", "j") else f".{axis}{dot}{tail}"
                column = stem + ends
                np.testing.assert_array_equal(table[column], values[..., c].reshape(-1))
                assert table.attrs["units"][column] == unit
                left.remove(column)
            continue
        whole = data[name].broadcast_like(data["status"]).transpose(*data["status"].dims)
        np.testing.assert_array_equal(table[name], whole.values.reshape(-1))
        assert table.attrs["units"].get(name, "") == unit
        left.remove(name)
    assert not left
    motion.to_excel(tmp_path / "motion.xlsx", **asked)
    sheets = pd.read_excel(tmp_path / "motion.xlsx", sheet_name=None, skiprows=[1])
    shown = dict.fromkeys(name for sheet in sheets.values() for name in sheet)
    assert list(shown) == list(table)


def test_tables_of_measures_agree(tmp_path: Path) -> None:
    angles = {
        "bore.angle": np.radians([0.0, 30.0, 60.0]),
        "crank.length": np.array([0.1, 0.2, 0.5]),
    }
    asked = {
        "stroke": assur.metric.span("bore"),
        "status": assur.metric.max("bore"),
        "swing": assur.metric.span("rod"),
        "part": assur.metric.span("bore") / assur.metric.max("bore"),
    }
    found = assur.sweep(assur.SliderCrank(0.1, 0.4), angles, deg=range(0, 360, 10), metrics=asked)
    table = found.to_dataframe(degrees=True)
    names = ["design", "bore.angle", "crank.length", "status", "kept", "stroke", "metric status"]
    names += ["swing", "part"]
    assert list(table) == names
    np.testing.assert_allclose(table["bore.angle"], [0.0, 30.0, 60.0])
    units = {"bore.angle": "deg", "crank.length": "m", "stroke": "m", "metric status": "m"}
    assert table.attrs["units"] == {**units, "swing": "deg"}
    np.testing.assert_array_equal(table["swing"], np.degrees(found["swing"]))
    found.to_parquet(tmp_path / "found.parquet", degrees=True)
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "found.parquet"), table)
    found.to_excel(tmp_path / "found.xlsx", degrees=True)
    assert list(pd.read_excel(tmp_path / "found.xlsx", skiprows=[1])) == names
    data = found.to_xarray(degrees=True)
    for name in set(names) - {"design"}:
        np.testing.assert_array_equal(data[name].values, table[name])
    assert data["bore.angle"].attrs["units"] == "deg"
    again = found.designs(1)
    rows = assur.SliderCrank(0.1, 0.4).with_dimensions(found.to_dataframe().iloc[1:2])
    assert again.dimensions["crank.length"] == rows.design(0).dimensions["crank.length"]
