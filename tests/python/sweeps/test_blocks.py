"""Sweeps block by block, here and on an engine: the same bits; progress and errors are real."""

from __future__ import annotations

from concurrent.futures import Future, ProcessPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import metric
from assur.sweeps import measuring
from models.mechanisms import named_drawings
from net import bits, design_spaces

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

Q = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
COUNT = 90


@pytest.fixture
def small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks of 20 designs: five of them."""
    monkeypatch.setattr(measuring, "POSITIONS_OF_BLOCK", 20 * len(Q))


class Here:
    """An engine that does calls at once."""

    def __init__(self) -> None:
        self.cancelled = 0

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.cancel = self.count  # type: ignore[method-assign]
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:  # noqa: BLE001
            future.set_exception(error)
        return future

    def count(self) -> bool:
        self.cancelled += 1
        return True


@pytest.fixture(scope="module")
def processes() -> Iterator[ProcessPoolExecutor]:
    import multiprocessing

    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        yield pool


def batch(name: str = "stephenson_six_bar") -> assur.Mechanism:
    return design_spaces.space(named_drawings.CLASS_II[name](), np.random.default_rng(3), COUNT)


def height(motion: assur.Motion) -> Any:
    return motion.joint("P").value[..., 1].max(axis=-1)


def fails(_: assur.Motion) -> Any:
    message = "no height"
    raise ValueError(message)


def same(one: assur.Motion, other: assur.Motion) -> bool:
    return bool(np.array_equal(bits.bits(one), bits.bits(other)))


def own_q() -> Any:
    return Q + np.random.default_rng(1).uniform(0.0, 0.1, (COUNT, 1))


@pytest.mark.parametrize("on_error", ["nan", "drop"])
@pytest.mark.parametrize("q", [Q, own_q(), 0.3, np.array([0.3, np.nan])], ids=str)
@pytest.mark.usefixtures("small_blocks")
def test_motions(on_error: Any, q: Any) -> None:
    m = batch()
    done: list[int] = []

    def report(count: int, of: int) -> None:
        assert of == COUNT
        done.append(count)

    whole = assur.sweep(m, {}, q, on_error=on_error)
    apart = assur.sweep(m, {}, q, on_error=on_error, progress=report)
    assert same(whole, apart)
    assert done == sorted(done)
    assert done[-1] == COUNT
    if np.size(q) > 2:
        assert len(done) >= 5
    engine = assur.sweep(m, {}, q, on_error=on_error, engine=Here())
    assert same(whole, engine)
    over = assur.sweep(m, {}, q, on_error=on_error)
    assert assur.sweep(m, {}, q, on_error=on_error, out=over, engine=Here()) is over
    assert same(whole, over)
    again = assur.sweep(m, {}, q, on_error=on_error, out=over, progress=lambda *_: None)
    assert same(whole, again)
    if on_error == "drop":
        status = m.solve(q, on_error="nan").status.reshape(COUNT, -1)
        moves = np.flatnonzero((status < assur.Status.UNREACHABLE).all(axis=-1))
        assert whole.kept is not None
        assert apart.kept is not None
        assert whole.kept.tolist() == apart.kept.tolist() == moves.tolist()
        expected = m.solve(q, on_error="nan").joint("P").d2[moves]
        assert np.array_equal(whole.joint("P").d2, expected, equal_nan=True)


@pytest.mark.usefixtures("small_blocks")
def test_several_drivers_and_grids() -> None:
    press = named_drawings.CLASS_II["excavator"]()
    q = np.linspace(*named_drawings.RANGES["excavator"], 24)
    lengths = press.dimensions["bucket.length"] * np.linspace(0.9, 1.1, 10)
    grid = assur.Grid({"bucket.length": lengths, "link.length": [0.6, 0.65, 0.7]})
    for given in (q, q[0], np.broadcast_to(q, (10, 3, *q.shape)) + 0.01):
        whole = assur.sweep(press, grid, given, order=1)
        parts = [assur.sweep(press, grid, given, order=1, engine=Here())]
        parts.append(assur.sweep(press, grid, given, order=1, progress=lambda *_: None))
        for apart in parts:
            assert apart.shape == whole.shape
            assert same(whole, apart)


@pytest.mark.usefixtures("small_blocks")
def test_the_first_error_is_that_of_the_whole() -> None:
    messages = []
    for given in ({}, {"progress": lambda *_: None}, {"engine": Here()}):
        with pytest.raises(assur.AssurError) as error:
            assur.sweep(batch(), {}, Q, on_error="raise", **given)
        messages.append(str(error.value))
    assert messages[0] == messages[1] == messages[2]
    assert "more of 2160" in messages[0]


@pytest.mark.usefixtures("small_blocks")
def test_metrics() -> None:
    m = batch()
    asked: dict[str, metric.Metric] = {
        "off": metric.deviation("P"),
        "jerk": metric.rms("P.x", order=3),
        "high": metric.function(height, outputs=["P"]),
        "sum": metric.function(height, outputs=["P"]) - 2.0 * metric.span("P.y"),
    }
    where = [metric.function(height, outputs=["P"]) > 0.0, metric.span("P.x") * 3.0 < 40.0]
    done: list[tuple[int, int]] = []
    whole = assur.sweep(m, {}, Q, metrics=asked, where=where, progress=lambda *of: done.append(of))
    assert done == [(k, COUNT) for k in (20, 40, 60, 80, 90)]
    engine = assur.sweep(m, {}, Q, metrics=asked, where=where, engine=Here())
    for name in asked:
        assert np.array_equal(whole[name], engine[name], equal_nan=True)
    assert whole.kept.tolist() == engine.kept.tolist()
    assert (whole.status == engine.status).all()


@pytest.mark.usefixtures("small_blocks")
def test_processes(processes: ProcessPoolExecutor) -> None:
    m = batch()
    asked = {"off": metric.deviation("P"), "high": metric.function(height, outputs=["P"])}
    whole = assur.sweep(m, {}, Q, metrics=asked)
    apart = assur.sweep(m, {}, Q, metrics=asked, engine=processes)
    for name in asked:
        assert np.array_equal(whole[name], apart[name], equal_nan=True)
    for on_error in ("nan", "drop"):
        here = assur.sweep(m, {}, Q, on_error=on_error)
        there = assur.sweep(m, {}, Q, on_error=on_error, engine=processes)
        assert same(here, there)
    # What cannot be sent, and what fails there, names its designs.
    unsendable = {"f": metric.function(lambda motion: 2.0 * height(motion))}
    with pytest.raises(assur.AssurError, match=r"designs 0 to 19 failed with .*lambda"):
        assur.sweep(m, {}, Q, metrics=unsendable, engine=processes)
    with pytest.raises(assur.AssurError, match="designs 0 to 19 failed with ValueError: no height"):
        assur.sweep(m, {}, Q, metrics={"f": metric.function(fails)}, engine=processes)


@pytest.mark.usefixtures("small_blocks")
def test_what_stops_a_sweep_stops_its_engine_and_its_bar() -> None:
    engine = Here()
    with pytest.raises(assur.AssurError, match="no height"):
        assur.sweep(batch(), {}, Q, metrics={"f": metric.function(fails)}, engine=engine)
    assert engine.cancelled == 4
    tqdm = pytest.importorskip("tqdm.auto").tqdm
    before = set(tqdm._instances)
    with pytest.raises(ValueError, match="no height"):
        assur.sweep(batch(), {}, Q, metrics={"f": metric.function(fails)}, progress=True)
    assert set(tqdm._instances) == before


@pytest.mark.usefixtures("small_blocks")
def test_a_motion_that_was_stopped_cannot_be_read() -> None:
    def stop(done: int, _: int) -> None:
        if done > 40:
            raise KeyboardInterrupt

    out = assur.sweep(batch(), {}, Q)
    with pytest.raises(KeyboardInterrupt):
        assur.sweep(batch(), {}, Q, out=out, progress=stop)
    with pytest.raises(assur.InputError, match="incomplete"):
        out.joint("P")


def test_no_engine() -> None:
    for engine in ("dask", object(), 4):
        with pytest.raises(assur.InputError, match=r"submit\(function, ...\) is needed"):
            assur.sweep(batch(), {}, Q, engine=engine)  # type: ignore[call-overload]


def test_many_positions_of_a_design() -> None:
    """They are solved piece by piece; the last pieces are not whole."""
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"coupler.length": [3.0, 2.9]})
    q = np.linspace(0.0, 2 * np.pi, 200_001, endpoint=False)
    asked = {
        "span": metric.span("rocker", order=2),
        "angle": metric.min_transmission_angle("C"),
        "at": metric.argmax("C.x"),
        "ratio": metric.time_ratio("rocker"),
    }
    found = assur.sweep(m, {}, q, metrics=asked)
    motion = m.solve(q)
    assert (found["span"] == np.ptp(motion.link("rocker").d2, axis=1)).all()
    np.testing.assert_allclose(found["angle"], motion.transmission_angle("C").min(axis=1), 1e-14)
    assert (found["at"] == q[motion.joint("C").value[..., 0].argmax(axis=1)]).all()
    angle = motion.link("rocker").value
    ahead = np.abs(angle.argmax(axis=1) - angle.argmin(axis=1)) / len(q)
    slow = np.maximum(ahead, 1 - ahead)
    np.testing.assert_allclose(found["ratio"], slow / (1 - slow), rtol=1e-9)
