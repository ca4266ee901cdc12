"""Arrays of values and batches of designs: each as by itself, in its place."""

from __future__ import annotations

import pickle
import re
import threading
from typing import Any

import numpy as np
import pytest

import assur
from models.mechanisms.assembly_models import CASES
from support.interruptions import is_heard

Status = assur.Status


def four_bar() -> Any:
    return assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))


def compare(found: Any, one_by_one: list[list[Any]]) -> None:
    """Hold arrays against lists of single calls, to the bit."""
    count = found.count.ravel()
    assert count.tolist() == [len(one) for one in one_by_one]
    rows = found.q.reshape(len(one_by_one), -1, *found.q.shape[found.count.ndim + 1 :])
    assert rows.shape[1] == max(count, default=0)
    for row, one, entry in zip(rows, one_by_one, np.ndindex(found.count.shape), strict=True):
        for q, solution in zip(row, one, strict=False):
            np.testing.assert_array_equal(q, solution.q)
        assert np.isnan(row[len(one) :]).all()
        assert [solution.assembly for solution in found[entry]] == [s.assembly for s in one]
        for mine, other in zip(found[entry], one, strict=True):
            np.testing.assert_array_equal(mine.q, other.q)


@pytest.mark.parametrize("name", ["rocker", "P.x", "C.y"])
def test_values_of_one_design(name: str) -> None:
    m = four_bar()
    values = np.linspace(-1.0, 3.5, 40)
    found = m.find(name, values)
    compare(found, [m.find(name, float(value)) for value in values])
    assert (found.status == np.where(found.count > 0, Status.OK, Status.UNREACHABLE)).all()
    grid = m.find(name, values.reshape(8, 5))
    np.testing.assert_array_equal(grid.q.reshape(40, -1), found.q)
    for threads in (1, 2, 7):
        np.testing.assert_array_equal(m.find(name, values, threads=threads).q, found.q)


def test_places_of_one_design() -> None:
    m: Any = assur.examples.five_bar()
    rng = np.random.default_rng(1)
    places = np.array(m.joints["P"]) + rng.uniform(-0.4, 0.4, (50, 2))
    found = m.find("P", places)
    assert found.q.shape == (50, 4, 2)
    assert set(found.count.tolist()) == {0, 4}
    compare(found, [m.find("P", tuple(place)) for place in places.tolist()])


@pytest.mark.parametrize("kind", ["triad", "IV"])
def test_values_of_a_higher_class(kind: str) -> None:
    m: Any = CASES[kind][0](np.random.default_rng(3)).mechanism
    link = [name for name in m.links if name not in ("ground", m.driver)][-1]
    values = float(m.solve(m.q0, order=0).link(link).value) + np.linspace(-0.2, 0.2, 4)
    found = m.find(link, values)
    assert found.count.max() > 0
    for value, q, count in zip(values, found.q, found.count, strict=True):
        one = m.find(link, float(value))
        assert count == len(one)
        np.testing.assert_array_equal(q[:count], [solution.q for solution in one])


def test_designs() -> None:
    batch = four_bar().with_dimensions({"coupler.length": [[3.0, 3.1, 2.9], [2.8, np.nan, -1.0]]})
    designs = [four_bar().with_dimensions({"coupler.length": x}) for x in (3.0, 3.1, 2.9, 2.8)]
    found = batch.find("P.x", 1.4)
    assert found.count.shape == (2, 3)
    assert len(found) == len(list(found)) == 6
    bad = [Status.BAD_DIMENSION] * 2
    assert found.status.ravel().tolist() == [Status.OK] * 4 + bad
    singles = [one.find("P.x", 1.4) for one in designs]
    compare(found, [*singles, [], []])
    values = np.array([1.2, np.nan, 1.4, 9.0])
    found = batch.find("P.x", values)
    assert found.count.shape == (2, 3, 4)
    assert found.status[0, 0].tolist() == [0, Status.BAD_INPUT, 0, Status.UNREACHABLE]
    assert [len(one) for one in (found[0, 1, 0], found[0, 1, 1], found[-1, -1, 0])] == [
        len(designs[1].find("P.x", 1.2)),
        0,
        0,
    ]
    own = 1.2 + 0.01 * np.arange(6.0).reshape(2, 3, 1) + np.array([0.0, 0.1])
    found = batch.find("P.x", own)
    assert found.count.shape == (2, 3, 2)
    for k, design in enumerate(designs):
        for j, value in enumerate(own.reshape(6, 2)[k]):
            want = [q for q, _ in design.find("P.x", float(value))]
            got = found.q[np.unravel_index(k, (2, 3))][j]
            np.testing.assert_array_equal(got[: len(want)], want)


def test_no_values_and_no_designs() -> None:
    found = four_bar().find("rocker", [])
    assert found.q.shape == (0, 0)
    assert len(found) == 0
    empty = four_bar().with_dimensions({"coupler.length": np.empty(0)})
    assert empty.find("rocker", 1.9).q.shape == (0, 0)
    assert empty.find("rocker", [1.9, 2.0]).count.shape == (0, 2)
    assert empty.find("rocker", [1.9, 2.0], near=1.0).q.shape == (0, 2)
    assert four_bar().find("rocker", [], near=1.0).q.shape == (0,)


def test_refusals() -> None:
    m = four_bar()
    five: Any = assur.examples.five_bar()
    batch = m.with_dimensions({"coupler.length": [3.0, 3.1]})
    for call, text in (
        (lambda: m.find("roker", [1.0, 2.0]), "roker"),
        (lambda: five.find("Q", [(0.1, 0.2)]), "Q"),
        (lambda: five.find("P", [1.0, 2.0, 3.0]), "the last axis must hold"),
        (lambda: five.find("P", 1.0), "the last axis must hold"),
        (lambda: five.find(["P.x"], [1.0]), "2 drivers"),
        (lambda: five.find(["P.x", "P.x"], (1.0, 1.0)), "different coordinates"),
        (lambda: five.find(["P.x", 3], (1.0, 1.0)), "not a string"),
        (lambda: batch.find("rocker", np.ones((3, 4))), r"for designs \(2,\)"),
        (lambda: m.find("rocker", [1.0], threads=0), "threads"),
        (lambda: m.find("rocker", ["a"]), "value"),
        (lambda: m.find("C.x", deg=[10.0, 20.0]), "deg is for the angle of a link"),
        (lambda: m.find("rocker", [1.9])[3], "outside the shape"),
    ):
        made: Any = call
        with pytest.raises(assur.InputError, match=text):
            made()
    assert m.find("rocker", deg=[100.0, 105.0]).count.tolist() == [2, 2]
    with pytest.warns(assur.AssurWarning, match=re.escape("np.radians()")):
        m.find("rocker", [90, 180])


def test_results_are_kept_by_pickle() -> None:
    found = four_bar().find("P.x", [1.2, 1.4, 9.0])
    again = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(again.q, found.q)
    assert again[1] == found[1]
    path = four_bar().find("P.x", [1.2, 1.4, 9.0], near=1.0)
    again = pickle.loads(pickle.dumps(path))
    np.testing.assert_array_equal(again.q, path.q)
    assert again[0] == path[0]


def test_threads_of_users() -> None:
    m = four_bar()
    values = np.linspace(0.0, 3.0, 200)
    want = m.find("P.x", values).q
    seen: list[bool] = []

    def work() -> None:
        fresh = m.with_dimensions({"coupler.length": 3.0})
        seen.append(np.array_equal(fresh.find("P.x", values).q, want, equal_nan=True))
        m.inverses.clear()

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert seen == [True] * 8


def test_ctrl_c_is_heard_in_a_million_values() -> None:
    m = four_bar()
    assert is_heard(lambda n: lambda: m.find("P.x", np.linspace(0.0, 3.0, n)), 10_000)


def test_ctrl_c_is_heard_along_a_path() -> None:
    m: Any = assur.SliderCrank(1.0, 3.0)
    assert is_heard(
        lambda n: lambda: m.find("bore", 3.0 + 0.5 * np.sin(np.arange(n)), near=1.0), 10_000
    )
