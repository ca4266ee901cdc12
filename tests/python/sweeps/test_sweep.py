"""`assur.sweep`: shapes, grids, what is dropped, progress, and what is refused."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import assur
from assur import metric
from assur.sweeps import measuring
from models.mechanisms import higher_drawings, named_drawings
from net import design_spaces

Q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)


def four_bar() -> assur.Mechanism:
    return assur.FourBar(1.0, 3.0, 2.5, 3.0)


def test_a_sweep_is_the_solution_of_its_batch() -> None:
    rng = np.random.default_rng(1)
    space = {name: rng.uniform(1.0, 4.0, 50) for name in ("coupler.length", "rocker.length")}
    found = assur.sweep(four_bar(), space, Q, outputs=["C", "rocker"], order=1)
    batch = four_bar().with_dimensions(space)
    expected = batch.solve(Q, outputs=["C", "rocker"], order=1, on_error="nan")
    assert found.mechanism == batch
    assert (found.status == expected.status).all()
    for of in ("value", "d1"):
        one, other = (getattr(motion.joint("C"), of) for motion in (found, expected))
        assert np.array_equal(one, other, equal_nan=True)
    again = assur.sweep(four_bar(), space, Q, outputs=["C", "rocker"], order=1, out=found)
    assert again is found


def test_a_grid_makes_every_combination() -> None:
    lengths, heights = np.linspace(2.0, 4.0, 5), np.array([-0.2, 0.0, 0.3])
    grid = assur.Grid({"coupler.length": lengths}, **{"ground.D.y": heights})
    assert grid.shape == (5, 3)
    assert len(grid) == 2
    assert "5" in repr(grid)
    found = assur.sweep(four_bar(), grid, Q, metrics={"swing": metric.span("rocker")})
    assert found.shape == found["swing"].shape == (5, 3)
    for i, j in np.ndindex(5, 3):
        one = four_bar().with_dimensions({"coupler.length": lengths[i], "ground.D.y": heights[j]})
        alone = assur.sweep(one, {}, Q, metrics={"swing": metric.span("rocker")})
        assert alone.shape == ()
        assert found["swing"][i, j] == alone["swing"]
    motion = assur.sweep(four_bar(), grid, Q, outputs=["C"], order=0)
    assert motion.shape == (5, 3, 72)
    few = found.designs([0, 4, 14])
    assert few.dimensions["coupler.length"].tolist() == lengths[[0, 1, 4]].tolist()
    assert few.dimensions["ground.D.y"].tolist() == heights[[0, 1, 2]].tolist()
    assert found.designs(14) == few.design(2)


def test_designs_that_do_not_move_are_dropped() -> None:
    batch = design_spaces.space(
        named_drawings.CLASS_II["stephenson_six_bar"](), np.random.default_rng(3)
    )
    whole = batch.solve(Q, order=1, on_error="nan")
    moves = (whole.status < assur.Status.UNREACHABLE).all(axis=-1)
    assert 0 < moves.sum() < moves.size
    found = assur.sweep(batch, {}, Q, order=1, on_error="drop")
    assert found.kept is not None
    assert found.kept.tolist() == np.flatnonzero(moves).tolist()
    assert np.array_equal(found.joint("P").d1, whole.joint("P").d1[moves], equal_nan=True)
    assert whole.kept is None
    for other in (copy.copy(found), pickle.loads(pickle.dumps(found))):
        assert other.kept is not None
        assert other.kept.tolist() == found.kept.tolist()
    with pytest.raises(assur.AssurError, match="design"):
        assur.sweep(batch, {}, Q, on_error="raise")


@pytest.mark.parametrize("name", ["stephenson_six_bar", "jansen_leg", "toggle_press"])
def test_neighbours_blocks_and_threads_do_not_matter(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    batch = design_spaces.space(named_drawings.CLASS_II[name](), np.random.default_rng(4), 200)
    asked: dict[str, metric.Metric] = {
        "span": metric.span(f"{[j for j in batch.joints if j not in batch.links['ground']][-1]}.x"),
        "turn": metric.span([link for link in batch.links if link != "ground"][-1], order=1),
    }
    whole = assur.sweep(batch, {}, Q, metrics=asked)
    monkeypatch.setattr(measuring, "POSITIONS_OF_BLOCK", 7 * 72)
    apart = assur.sweep(batch, {}, Q, metrics=asked, threads=1)
    order = np.random.default_rng(1).permutation(200)
    turned = assur.sweep(whole.designs(order), {}, Q, metrics=asked, threads=2)
    for of in asked:
        assert np.array_equal(whole[of], apart[of], equal_nan=True)
        assert np.array_equal(whole[of][order], turned[of], equal_nan=True)
    assert (whole.status == apart.status).all()
    assert (whole.status[order] == turned.status).all()


def test_bad_designs_keep_their_places() -> None:
    lengths = np.array([3.0, -1.0, np.nan, 3.1, 90.0])
    found = assur.sweep(
        four_bar(), {"coupler.length": lengths}, Q, metrics={"swing": metric.span("rocker")}
    )
    bad, open_ = assur.Status.BAD_DIMENSION, assur.Status.UNREACHABLE
    assert found.status.tolist() == [0, bad, bad, 0, open_]
    assert np.isnan(found["swing"]).tolist() == [False, True, True, False, True]
    assert found.kept.tolist() == [0, 3]


def test_higher_classes_and_several_drivers() -> None:
    press = named_drawings.CLASS_II["excavator"]()
    from_, to = (np.asarray(end, dtype=np.float64) for end in named_drawings.RANGES["excavator"])
    q = np.linspace(from_, to, 9)
    joint = [j for j in press.joints if j not in press.links["ground"]][-1]
    found = assur.sweep(press, {}, q, metrics={"reach": metric.max(f"{joint}.x")})
    expected = press.solve(q, order=0).joint(joint).value[:, 0].max()
    assert found["reach"] == expected
    of_class_iv = higher_drawings.quadrilateral()
    batch = design_spaces.space(of_class_iv, np.random.default_rng(2), 50)
    motion = batch.solve(Q, order=1, on_error="nan")
    moves = (motion.status < assur.Status.SINGULAR).all(axis=-1)
    link = [link for link in batch.links if link != "ground"][-1]
    turns = assur.sweep(batch, {}, Q, metrics={"most": metric.max(link, order=1)})
    assert len(turns.kept) > 0
    assert turns.kept.tolist() == np.flatnonzero(moves).tolist()
    assert (turns["most"][moves] == motion.link(link).d1[moves].max(axis=-1)).all()


def test_at_change_points_there_are_no_derivatives() -> None:
    """A parallelogram moves through them; what is asked besides does not matter."""
    q = np.linspace(0.0, 2 * np.pi, 8, endpoint=False)
    asked = {"swing": metric.span("rocker"), "rate": metric.max("rocker", order=1)}
    found = assur.sweep(assur.FourBar(1.0, 2.0, 1.0, 2.0), {}, q, metrics=asked)
    assert found.status == assur.Status.SINGULAR
    assert found.kept.tolist() == [0]
    assert found["swing"] == pytest.approx(1.75 * np.pi, abs=1e-12)
    assert np.isnan(found["rate"])
    where = [metric.max("rocker", order=1) < 9.0]
    assert not assur.sweep(
        assur.FourBar(1.0, 2.0, 1.0, 2.0), {}, q, metrics=asked, where=where
    ).kept.size


def test_progress() -> None:
    calls: list[tuple[int, int]] = []
    space = {"coupler.length": np.linspace(2.0, 4.0, 10)}
    asked = {"swing": metric.span("rocker")}

    def note(done: int, of: int) -> None:
        calls.append((done, of))

    assur.sweep(four_bar(), space, Q, metrics=asked, progress=note)
    assert calls == [(10, 10)]
    assur.sweep(four_bar(), space, Q, metrics=asked, progress=True)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"metrics": {"a": 3}}, "assur.metric"),
        ({"metrics": [metric.span("rocker")]}, "mapping"),
        ({"metrics": {"a": metric.span("roker")}}, "rocker"),
        ({"metrics": {"a": metric.span("C")}}, "C.x"),
        ({"metrics": {"a": metric.span("C.z")}}, "C.x"),
        ({"metrics": {"a": metric.span("E.x")}}, "E"),
        ({"metrics": {"a": metric.time_ratio("rocker")}, "q": Q[:40]}, "one turn"),
        ({"metrics": {"a": metric.deviation("C", part=0.01)}}, "too few"),
        ({"metrics": {"a": metric.span("rocker")}, "q": 1.0}, "shape"),
        ({"metrics": {"a": metric.span("rocker")}, "q": [0.0, np.nan]}, "finite"),
        ({"metrics": {"a": metric.span("rocker")}, "where": [True]}, "condition"),
        ({"metrics": {"a": metric.span("rocker")}, "outputs": ["C"]}, "outputs"),
        ({"metrics": {"a": metric.span("rocker")}, "progress": "yes"}, "progress"),
        ({"where": [metric.span("rocker") > 1]}, "metrics"),
        ({"on_error": "skip"}, "on_error"),
        ({"dimensions": {"coupler.lenght": [1.0]}}, "coupler.length"),
        ({"dimensions": [1.0]}, "mapping"),
        ({"dimensions": {"coupler.length": [1.0, 2.0], "rocker.length": [1.0] * 3}}, "broadcast"),
    ],
)
def test_refused(arguments: dict[str, Any], message: str) -> None:
    given = {"dimensions": {}, "q": Q, **arguments}
    with pytest.raises(assur.InputError, match=message):
        assur.sweep(four_bar(), **given)


def test_refused_metrics() -> None:
    with pytest.raises(assur.InputError, match="below"):
        metric.span("rocker", over=(2.0, 1.0))
    with pytest.raises(assur.InputError, match="order"):
        metric.span("rocker", order=4)
    with pytest.raises(assur.InputError, match="shape"):
        metric.deviation("C", shape="square")  # type: ignore[arg-type]
    with pytest.raises(assur.InputError, match="number"):
        metric.span("rocker") + "1"  # type: ignore[operator]
    with pytest.raises(assur.InputError, match="where"):
        assert metric.span("rocker") > 1.0
    wrong = metric.function(lambda motion: motion.joint("C").value[0, 0])
    with pytest.raises(assur.InputError, match="returned shape"):
        assur.sweep(four_bar(), {"coupler.length": [3.0] * 5}, Q, metrics={"a": wrong})
    found = assur.sweep(four_bar(), {}, Q, metrics={"a": metric.span("rocker")})
    for wrong_index in (1, -2, 0.5, [[0]], "0"):
        with pytest.raises(assur.InputError, match="indices below 1"):
            found.designs(wrong_index)  # type: ignore[arg-type]
    with pytest.raises(assur.InputError, match=r"\(n,\)"):
        assur.Grid({"coupler.length": 3.0})
