"""What a sweep for metrics returns: kept, missed and failed designs, the best, tables, designs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur import metric

Q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
GRID = {"coupler.length": [2.0, 3.0, 9.0, -1.0], "ground.D.y": [0.0, 0.2, 0.4]}
SWING, ANGLE = metric.span("rocker"), metric.min_transmission_angle("C")


def four_bar() -> assur.Mechanism:
    return assur.FourBar(1.0, 3.0, 2.5, 3.0)


def found() -> assur.Measures:
    asked = {"swing": SWING, "angle": ANGLE, "turns": metric.reachable()}
    limit = float(
        np.median(assur.sweep(four_bar(), assur.Grid(GRID), Q, metrics=asked)["angle"][:2])
    )
    return assur.sweep(four_bar(), assur.Grid(GRID), Q, metrics=asked, where=[limit < ANGLE])


def test_every_design_is_kept_missed_or_fails() -> None:
    some = found()
    fails = np.flatnonzero(some.status.reshape(-1) >= assur.Status.UNREACHABLE)
    assert len(some.kept) == len(some.missed) == 3
    assert fails.tolist() == [6, 7, 8, 9, 10, 11]
    assert sorted([*some.kept, *some.missed, *fails]) == list(range(12))
    assert (some.status.reshape(-1)[some.missed] == assur.Status.OK).all()
    turns = some["turns"].reshape(-1)
    assert turns[some.kept].tolist() == [1.0] * 3
    assert turns[fails].tolist() == [0.0] * 6
    assert np.isnan(turns[some.missed]).all()
    assert np.isnan(some["swing"].reshape(-1)[[*some.missed, *fails]]).all()
    for array in (some.kept, some.status, some["swing"]):
        with pytest.raises(ValueError, match="read-only"):
            array.flat[0] = 1


def test_rotation_in_conditions_and_sums() -> None:
    asked = {"turns": metric.reachable(), "twice": 2.0 * metric.reachable() + 1.0}
    where = [metric.reachable() > 0.5]
    some = assur.sweep(four_bar(), assur.Grid(GRID), Q, metrics=asked, where=where)
    assert some.kept.tolist() == [0, 1, 2, 3, 4, 5]
    assert (some["turns"] == [[1.0] * 3, [1.0] * 3, [0.0] * 3, [0.0] * 3]).all()
    assert (some["twice"] == 2.0 * some["turns"] + 1.0).all()


def test_the_best() -> None:
    some = found()
    values = some["swing"].reshape(-1)
    ascending = some.kept[np.argsort(values[some.kept])]
    for n in (1, 2, 3, 50):
        assert some.nsmallest(n, by="swing").tolist() == ascending[:n].tolist()
        best = some.nlargest(n, by="swing")
        assert best.tolist() == ascending[::-1][:n].tolist()
    # Of equal values the first is first.
    assert some.nsmallest(2, by="turns").tolist() == [6, 7]
    assert some.nlargest(7, by="turns").tolist() == [*some.kept, 6, 7, 8, 9]
    many = np.random.default_rng(1).uniform(2.0, 3.0, 1000)
    more = assur.sweep(four_bar(), {"coupler.length": many}, Q, metrics={"swing": SWING})
    assert more.nsmallest(10, by="swing").tolist() == np.argsort(more["swing"])[:10].tolist()
    three = more.designs(more.nsmallest(3, by="swing"))
    again = assur.sweep(three, {}, Q, metrics={"swing": SWING})["swing"]
    assert again.tolist() == np.sort(more["swing"])[:3].tolist()
    for arguments, message in [
        ({"n": 0, "by": "swing"}, "n is 0"),
        ({"n": 1, "by": "off"}, "by='off': one of 'swing', 'angle', 'turns'"),
        ({"n": 1, "by": "swin"}, "did you mean 'swing'"),
        ({"n": "swing", "by": 10}, r"nsmallest\(10, by='swing'\)"),
    ]:
        with pytest.raises(assur.InputError, match=message):
            some.nsmallest(**arguments)  # type: ignore[arg-type]
    none = assur.sweep(
        four_bar(), GRID | {"ground.D.y": 0.0}, Q, metrics={"swing": SWING}, where=[SWING > 9.5]
    )
    message = "no design has a value of 'swing': of 4 designs 2 do not move, 2 miss a condition, 0"
    with pytest.raises(assur.InputError, match=message):
        none.nsmallest(1, by="swing")


def test_designs_as_numpy_indexes() -> None:
    some = found()
    every = four_bar().with_dimensions(assur.Grid(GRID))
    indices = np.arange(12).reshape(4, 3)
    asked: list[Any] = [0, 5, -12, [0, 5], [-12], np.array([2, 2])]
    for index in asked:
        assert some.designs(index).shape == np.shape(index)
        assert dimensions(some.designs(index)) == dimensions(every, indices.reshape(-1)[index])
    for index in ((1, 1), (-3, 2), (0, [0, 1, 2]), ([0, 1], [0, -1]), (np.array([1, 0]), 2)):
        assert dimensions(some.designs(index)) == dimensions(every, indices[index])
    small = some["swing"] < 1.0
    assert dimensions(some.designs(small)) == dimensions(every, indices[small])
    assert some.designs([]).shape == (0,)
    assert some.designs(some.missed[:0]).shape == (0,)
    alone = assur.sweep(four_bar(), {}, Q, metrics={"swing": SWING})
    assert alone.designs(0) == alone.designs(()) == four_bar()
    assert alone.designs([0, 0]).shape == (2,)


def dimensions(m: assur.Mechanism, at: Any = None) -> Any:
    chosen = [np.asarray(m.dimensions[name]) for name in GRID]
    if at is not None:
        chosen = [values.reshape(-1)[np.asarray(at)] for values in chosen]
    return [values.tolist() for values in chosen]


@pytest.mark.parametrize(
    "index",
    [12, -13, 0.5, [0.5], "0", [[0]], (4, 0), (0, 3), (0,), (0, 0, 0), ([0, 1], [0, 1, 2]), [True]],
)
def test_no_such_designs(index: Any) -> None:
    with pytest.raises(assur.InputError, match=r"below 12, or one index into the shape \(4, 3\)"):
        found().designs(index)


def test_a_table() -> None:
    pytest.importorskip("pandas")
    some = found()
    table = some.to_dataframe()
    names = ["design0", "design1", *GRID, "status", "kept", "swing", "angle", "turns"]
    assert list(table) == names
    assert table["design0"].tolist() == [i // 3 for i in range(12)]
    assert table["coupler.length"].tolist() == np.repeat(GRID["coupler.length"], 3).tolist()
    assert table["ground.D.y"].tolist() == GRID["ground.D.y"] * 4
    assert np.flatnonzero(table["kept"]).tolist() == some.kept.tolist()
    assert np.array_equal(table["swing"], some["swing"].reshape(-1), equal_nan=True)
    of_one = assur.sweep(four_bar(), {"coupler.length": 3.0}, Q, metrics={"status": SWING})
    assert list(of_one.to_dataframe()) == ["coupler.length", "status", "kept", "metric status"]
    batch = assur.sweep(four_bar(), {"coupler.length": [3.0, 2.0]}, Q, metrics={"swing": SWING})
    assert batch.to_dataframe()["design"].tolist() == [0, 1]


def test_metrics_by_name() -> None:
    some = found()
    for name in ("swnig", "status", 3):
        assert name not in some
        assert some.get(name) is None  # type: ignore[arg-type]
    assert some.get("swing") is some["swing"]
    with pytest.raises(assur.InputError, match=r"'swnig'.*did you mean 'swing'\?"):
        some["swnig"]
    with pytest.raises(assur.InputError, match=r"3\]: no metric.*'swing', 'angle', 'turns'$"):
        some[3]  # type: ignore[index]
    assert dict(some).keys() == {"swing", "angle", "turns"}


def test_a_dataset() -> None:
    pytest.importorskip("xarray")
    some = found()
    data = some.to_xarray()
    assert data["swing"].dims == tuple(GRID)
    for name, values in GRID.items():
        assert data[name].values.tolist() == list(values)
        assert data[name].attrs["units"] == "m"
    assert np.array_equal(data["swing"].values, some["swing"], equal_nan=True)
    assert np.flatnonzero(data["kept"].values).tolist() == some.kept.tolist()
    assert np.array_equal(data["status"].values, some.status)
    pairs: dict[str, Any] = {"coupler.length": [3.0, 2.0], "rocker.length": [2.4, 2.5]}
    pairs["ground.D.y"] = 0.1
    asked = {"swing": SWING, "kept": SWING}
    data = assur.sweep(four_bar(), pairs, Q, metrics=asked).to_xarray()
    assert data["swing"].dims == data["coupler.length"].dims == ("design",)
    assert data["ground.D.y"].dims == ()
    assert np.array_equal(data["metric kept"].values, data["swing"].values)
    across = {"coupler.length": [[3.0], [2.0]], "rocker.length": [[2.4]]}
    data = assur.sweep(four_bar(), across, Q, metrics=asked).to_xarray()
    assert data["swing"].dims == ("coupler.length", "design1")
    one = assur.sweep(four_bar(), {"coupler.length": 3.0}, Q, metrics=asked).to_xarray()
    assert dict(one.sizes) == {}


def test_the_caller_may_change_his_arrays() -> None:
    lengths = np.array([2.0, 2.5, 3.0])
    view = lengths[:]
    view.flags.writeable = False
    for given in (lengths, view):
        some = assur.sweep(four_bar(), {"coupler.length": given}, Q, metrics={"swing": SWING})
        motion = assur.sweep(four_bar(), {"coupler.length": given}, Q)
        lengths[:] = 9.0
        assert some.designs([0, 2]).dimensions["coupler.length"].tolist() == [2.0, 3.0]
        assert motion.mechanism.dimensions["coupler.length"].tolist() == [2.0, 2.5, 3.0]
        lengths[:] = [2.0, 2.5, 3.0]


def test_grids_and_measures_compare() -> None:
    grid, same = assur.Grid(GRID), assur.Grid(GRID)
    assert grid == same
    assert hash(grid) == hash(same)
    assert grid != assur.Grid({**GRID, "ground.D.y": [0.0, 0.2, 0.5]})
    assert grid != assur.Grid(dict(reversed(GRID.items())))
    assert grid != GRID
    some, other = found(), found()
    assert some == some
    assert some != other
    with pytest.raises(ValueError, match="read-only"):
        grid["ground.D.y"][0, 0] = 1.0
    for use in (four_bar().with_dimensions, lambda g: assur.sweep(four_bar(), g, Q)):
        with pytest.raises(assur.InputError, match=r"coupler\.length"):
            use(assur.Grid({"coupler.lenght": [1.0]}))
