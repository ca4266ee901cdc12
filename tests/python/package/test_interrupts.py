"""Signals stop long calls at the next block; incomplete results cannot be read.

Work is counted, not time on the wall clock: processor time, or pages of memory.
"""

from __future__ import annotations

import gc
import hashlib
import math
import signal
import subprocess
import sys
import textwrap
from contextlib import contextmanager, suppress
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from support.interruptions import (
    SILENT,
    SOON,
    WORKED,
    heard_after,
    interrupted,
    is_heard,
    longest_silence,
    longest_standstill,
    processor_time,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path


# On a loaded machine the thread that sends a signal may not run before the work is done.
ATTEMPTS = 3


class StoppedError(Exception):
    """What the handler raises: an ordinary exception, as that of a time limit is."""


@contextmanager
def signal_after(seconds: float) -> Iterator[None]:
    """Raise `StoppedError` in the main thread by a signal, after so much processor time."""

    def stop(*_: object) -> None:
        raise StoppedError

    before = signal.signal(signal.SIGPROF, stop)
    # What is raised within the collector's callbacks (Hypothesis has one) is lost.
    gc.disable()
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
        gc.enable()


def test_a_motion_whose_overwriting_was_stopped_cannot_be_read() -> None:
    for size in (10_000 * 4**k for k in range(6)):
        m = _class_iv(size)
        motion: Any = m.solve([0.3], order=0, on_error="nan")
        with suppress(StoppedError), signal_after(0.05):
            m.solve([0.4], order=0, on_error="nan", out=motion)
        if not motion.stored.buffers.complete:
            break
    else:
        pytest.fail("the signal is never heard before the work is done")
    with pytest.raises(assur.InputError, match="this motion is incomplete"):
        motion.joint("8")
    with pytest.raises(assur.InputError, match="this motion is incomplete"):
        assert motion.status is None
    assert f"shape {(*m.shape, 1)}" in repr(motion)
    whole = m.solve([0.4], order=0, on_error="nan", out=motion)
    again = m.design(7).solve([0.4], order=0, on_error="nan")
    np.testing.assert_array_equal(whole.joint("8").value[7], again.joint("8").value)


def test_new_arrays_are_dropped_without_being_filled() -> None:
    """Of the memory that was asked for few pages are ever touched: they are counted.

    The signal comes when a thirtieth of them is; a call that filled the rest would touch all.
    """
    code = """
        import resource, signal, sys, threading, time
        import numpy as np, assur
        m, q = assur.FourBar(1.0, 3.0, 2.5, 3.0), np.linspace(0.0, 6.0, int(sys.argv[1]))
        signal.signal(signal.SIGINT, signal.default_int_handler)
        started = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
        faults = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_minflt - started
        ended = threading.Event()

        def ctrl_c():
            while faults() < int(sys.argv[2]):
                if ended.wait(0.001):
                    return
            signal.raise_signal(signal.SIGINT)

        thread = threading.Thread(target=ctrl_c)
        thread.start()
        try:
            m.solve(q, order=2, threads=1)
            how = "whole"
        except KeyboardInterrupt:
            how = "stopped"
        count = faults()
        ended.set()
        thread.join()
        print(count, how)
    """

    def run(size: int, limit: int) -> tuple[int, str]:
        command = [sys.executable, "-c", textwrap.dedent(code), str(size), str(limit)]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        count, how = text.split()
        return int(count), how

    whole, how = run(3 * 10**5, 10**9)
    assert how == "whole"
    # Thirty times as much, a GB and more if it were filled. The signal comes at a thirtieth of the
    # pages, but the thread that watches runs only now and then beside the one that works: half of
    # them leaves it time on a loaded machine, and a call that went on to the end would touch twice
    # as many.
    for _ in range(ATTEMPTS):
        few, how = run(9 * 10**6, whole)
        if how == "stopped":
            break
    assert how == "stopped"
    assert whole <= few < 15 * whole


# Metrics and curves of flywheels run in the same loop as strokes; a second of them fills gigabytes.
LONG: dict[str, Callable[[int], Callable[[], object]]] = {
    "designs of class IV": lambda n: _solve_designs(_class_iv(n)),
    "metrics": lambda n: _measure(_class_iv(n)),
    "metrics of many positions": lambda n: _measure(_class_iv(1), 100 * n),
    "the path to a large target": lambda n: _to_target(10 * n),
    "a sweep in blocks": lambda n: _sweep(_class_iv(n)),
    "designs that move": lambda n: partial(assur.sweep, _class_iv(n), {}, [0.3], on_error="drop"),
    "assemblies": lambda n: partial(_many_assemblies(n).assemblies, 0.1),
    "crank-rocker": lambda n: partial(assur.crank_rocker.solve, _angles(n), 1.0, 3.0, 2.5, 3.0),
    "strokes": lambda n: partial(_strokes, _angles(n)),
    "deviations": lambda n: partial(assur.slider_crank.deviation, 0.1 + _angles(n) / 30.0, 2),
    "condition": lambda n: _condition(_angles(n)),
    "reduced inertia": lambda n: partial(_machine().reduced_inertia, _angles(n)),
    "runs": lambda n: partial(_machine().run, 0.5, np.linspace(0.0, 6.0, n), 1.0),
    "run": lambda n: partial(_machine().run, float(n), 0.0, 1.0, max_steps=10**9),
    "reactions": lambda n: partial(_machine().reactions, *_moving(n)),
    "reactions of class IV": lambda n: partial(_loom().reactions, np.linspace(0.2, 1.4, n), 1.0),
    "dynamics of class IV": lambda n: partial(_loom().dynamics, np.linspace(0.2, 1.4, n), 1.0),
    "steps": lambda n: partial(_machine().step, 0.1, 1.0, 0.0, 1e-6, n=n),
    "controlled steps": lambda n: partial(
        _machine().step, 0.1, 1.0, 0.0, 0.1, n=n, method="RK45", rtol=1e-14
    ),
    "steps of class IV": lambda n: partial(_loom().step, 0.5, 0.1, 0.0, 1e-7, n=n),
    "a flywheel of one long table": lambda n: partial(_wheel, n),
    "reactions that friction locks": lambda n: partial(_rubbing().reactions, *_moving(n)),
    "safety": lambda n: partial(getattr, _rubbing(0.1).reactions(*_moving(n)), "safety"),
    "self-locking": lambda n: partial(_rubbing(0.3).self_locking, n=n),
    "limits of a chain": lambda n: _chain(n).limits,
    "extremes of a chain": lambda n: partial(_chain(n).extremes, f"rocker{n}"),
    "extremes of accelerations of a chain": lambda n: partial(
        _chain(n).extremes, f"rocker{n}", order=2
    ),
    "a mechanism of many links": lambda n: partial(_built, _chain_parts(n)),
    "a group of many links": lambda n: partial(_built, _group_parts(n)),
    "dwells of a chain": lambda n: partial(_chain(n).extremes(f"rocker{n}").dwells, 0.01),
}


@pytest.mark.parametrize("name", LONG)
def test_every_long_call_can_be_stopped(name: str) -> None:
    assert is_heard(LONG[name], 64)


def test_much_work_at_once_can_be_stopped() -> None:
    """A part of it, as above, shows too little of how long it is between two checks."""
    call = partial(_rubbing(0.3).self_locking, n=10**5)
    after = (interrupted(call, WORKED) for _ in range(ATTEMPTS))
    assert any(seconds is not None and seconds < SOON for seconds in after)


def test_a_link_is_cut_at_many_sections_in_parts() -> None:
    """NumPy hears no signal within an operation: none takes long."""
    call = partial(_rod().internal_loads, "coupler", _angles(10**5), 1.0)
    assert any(longest_silence(call) < SILENT for _ in range(ATTEMPTS))


# Rows of a long table: a few tenths of a second.
ROWS = 3_000_000
CURVES: dict[str, Callable[..., Callable[[], object]]] = {
    "a law": lambda x, y: partial(assur.laws.Tabulated, x, y),
    "a periodic law": lambda x, y: partial(assur.laws.Tabulated, x, y, spline="periodic"),
    "a load": lambda x, y: partial(_loaded, assur.Table(x, y)),
    "a table that is read": lambda x, y: partial(assur.Table(x, y).at, 1.0),
    "a machine, not-a-knot": lambda x, y: partial(assur.Machine.from_table, x, y, 2.0),
    "a machine, natural": lambda x, y: partial(
        assur.Machine.from_table, x, y, 2.0, spline="natural"
    ),
    "a machine, pchip": lambda x, y: partial(assur.Machine.from_table, x, y, 2.0, spline="pchip"),
    "a flywheel, pchip": lambda x, y: partial(
        assur.flywheel.from_table, x, y, 2.0, fluctuation=1e-3, mean_speed=10.0, spline="pchip"
    ),
}


@pytest.mark.parametrize("name", CURVES)
def test_the_curve_of_a_long_table_is_fitted_in_parts(name: str) -> None:
    x = np.linspace(0.0, math.tau, ROWS)
    y = np.sin(3.0 * x)
    y[-1] = y[0]
    call = CURVES[name](x, y)
    assert any(longest_silence(call) < SILENT for _ in range(ATTEMPTS))


def test_a_parquet_file_is_written_in_parts(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(_angles(300_000))
    call = partial(motion.to_parquet, tmp_path / "motion.parquet")
    assert any(longest_silence(call) < SILENT for _ in range(ATTEMPTS))


def test_a_call_that_hears_nothing_is_found() -> None:
    """One that frees the lock and one that holds it: what the tests here say of them."""

    def free(size: int) -> Callable[[], object]:
        return lambda: hashlib.pbkdf2_hmac("sha256", b"", b"", size)

    def held(size: int) -> Callable[[], object]:
        return lambda: sum(range(size))

    assert heard_after(free, 64) > SOON
    assert heard_after(held, 64) > SOON
    assert _lets_others_run(free(2_000_000))
    assert not _lets_others_run(held(6_000_000))


def test_other_threads_of_python_go_on_while_a_mechanism_is_built() -> None:
    """The lock is free: of the work of the build little is done while another thread waits."""
    assert processor_time(lambda: _chain(6000)) > 0.1
    assert _lets_others_run(lambda: _chain(6000))


def _lets_others_run(call: Callable[[], object]) -> bool:
    """A call that holds the lock stops the others every time, a busy machine now and then."""
    tries = (longest_standstill(call) for _ in range(ATTEMPTS))
    return any(longest < worked / 2 for worked, longest in tries)


def _wheel(rows: int) -> assur.flywheel.Flywheel:
    """The mean over the period takes most time for its memory."""
    phi = np.linspace(0.0, math.tau, rows)
    moment = 100.0 * np.sin(phi)
    moment[-1] = moment[0]
    return assur.flywheel.from_table(
        phi, moment, 2.0, fluctuation=0.1, mean_speed=10.0, mean="period"
    )


def _chain_parts(dyads: int) -> tuple[Any, Any]:
    joints = {"O": (0.0, 0.0), "J0": (0.6, 0.8)}
    links: dict[str, list[str]] = {"ground": ["O"], "crank": ["O", "J0"]}
    for i in range(1, dyads + 1):
        lean = 0.05 * math.sin(7.0 * i)
        joints[f"J{i}"], joints[f"G{i}"] = (0.6 + i, 0.8 + lean), (i + 0.3 * lean, lean - 0.2)
        links[f"rod{i}"], links[f"rocker{i}"] = [f"J{i - 1}", f"J{i}"], [f"G{i}", f"J{i}"]
        links["ground"].append(f"G{i}")
    return joints, links


def _chain(dyads: int) -> assur.Mechanism:
    return _built(_chain_parts(dyads))


def _built(parts: tuple[Any, Any]) -> assur.Mechanism:
    return assur.Mechanism(*parts, driver="crank")


def _group_parts(count: int) -> tuple[Any, Any]:
    """One group: bodies in a row, each on a leg, the first and the last on one more."""
    joints = {"O": (0.0, 0.0), "C": (0.6, 0.5)}
    links: dict[str, list[str]] = {"ground": ["O"], "crank": ["O", "C"]}
    bodies = max(round(math.sqrt(count)), 3)
    for k in range(bodies):
        own = links[f"body{k}"] = [f"H{i}" for i in (k, k + 1) if 0 < i < bodies]
        if k > 0:
            joints[f"H{k}"] = (2.0 * k, 3.2 + 0.2 * math.sin(5.0 * k))
        for i in range(1 + (k == 0) + (k == bodies - 1)):
            x, lean = 2.0 * k + 0.8 * i, 0.1 * math.sin(3.0 * k + i)
            pin, foot = f"P{k}{'ab'[i]}", f"G{k}{'ab'[i]}"
            joints |= {pin: (x + 0.5 + lean, 2.5 + 0.3 * i - lean)}
            own.append(pin)
            if k == i == 0:
                links["leg0"] = ["C", pin]
            else:
                joints[foot] = (x + 0.7 + 0.3 * lean, 0.1 + lean)
                links["ground"].append(foot)
                links[f"leg{foot}"] = [foot, pin]
    return joints, links


def _angles(count: int) -> Any:
    return np.linspace(0.0, 6.0, count)


def _strokes(q: Any) -> object:
    """By the series: exact ones take less time than the memory of their results."""
    return assur.slider_crank.stroke(q, 1.0, 3.0, method="series", harmonics=40)


def _condition(q: Any) -> Callable[[], object]:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    return lambda: m.solve(q, outputs=[]).condition


def _solve_designs(m: assur.Mechanism) -> Callable[[], object]:
    return lambda: m.solve([0.3], on_error="nan")


def _measure(m: assur.Mechanism, positions: int = 8) -> Callable[[], object]:
    asked = {"off": assur.metric.deviation("8"), "swing": assur.metric.span("l48", order=1)}
    q = np.linspace(0.3, 0.4, positions)
    return lambda: assur.sweep(m, {}, q, metrics=asked)


def _to_target(count: int) -> Callable[[], object]:
    """Many pairs of few positions and many points."""
    points = np.random.default_rng(0).normal(size=(count, 2))
    asked = {"off": assur.metric.path_error("C", points)}
    q = np.linspace(0.0, 6.0, 5000)
    return lambda: assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), {}, q, metrics=asked)


def _sweep(m: assur.Mechanism) -> Callable[[], object]:
    return lambda: assur.sweep(m, {}, [0.3, 0.4], progress=lambda *_: None)


def _many_assemblies(count: int) -> assur.Mechanism:
    """Dyads side by side between one crank and the ground: 2^n assemblies."""
    dyads = min(round(math.log2(count)) + 2, 24)
    joints: dict[str, tuple[float, float]] = {"O": (0.0, 0.0), "J": (0.6, 0.8)}
    links = {"ground": ["O"], "crank": ["O", "J"]}
    for i in range(dyads):
        joints |= {f"G{i}": (3.0 + 0.1 * i, 0.0), f"K{i}": (2.0, 2.0 + 0.05 * i)}
        links |= {f"a{i}": ["J", f"K{i}"], f"b{i}": [f"G{i}", f"K{i}"]}
        links["ground"].append(f"G{i}")
    return assur.Mechanism(joints, links, driver="crank")


def _class_iv(count: int) -> assur.Mechanism:
    joints = {
        "1": (0.0, 0.0), "2": (0.35, 0.0), "3": (1.24, 0.99), "4": (0.75, 1.91), "5": (3.02, -0.73),
        "6": (2.45, 1.02), "7": (3.2, 2.24), "8": (1.85, 2.35), "9": (1.62, -1.11),
        "10": (4.28, 1.52),
    }  # fmt: skip
    lengths = np.random.default_rng(3).uniform(0.6, 1.6, count)
    return assur.ClassIV(joints=joints).with_dimensions({"l48.length": lengths})


def _rubbing(coefficient: float = 0.9) -> assur.Machine:
    """A slider-crank whose friction is so strong that all its solutions are searched for."""
    friction: dict[str, Any] = {
        "A": assur.JointFriction(coefficient, 0.2),
        "B": assur.JointFriction(coefficient, 0.3),
        "bore": assur.SlideFriction(coefficient, 0.05),
    }
    load = assur.Force("B", (-100.0, 0.0))
    return assur.Machine(assur.SliderCrank(0.1, 0.35), bodies={}, loads=[load], friction=friction)


def _moving(count: int) -> tuple[Any, ...]:
    """Positions, their speed, acceleration."""
    return _angles(count), 10.0, 0.0


def _rod() -> assur.Machine:
    bodies = {"coupler": assur.Body(mass=1.0, inertia=0.75, at=(1.5, 0.0))}
    return assur.Machine(assur.FourBar(1.0, 3.0, 2.5, 3.0), bodies=bodies)


def _loaded(table: assur.Table) -> assur.Machine:
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies={}, loads=[assur.Torque("crank", table)]
    )


def _loom() -> assur.Machine:
    loom = assur.examples.loom()
    body = assur.Body(mass=1.0, inertia=0.01)
    return assur.Machine(loom, bodies=dict.fromkeys(set(loom.links) - {"ground"}, body))


def _machine() -> assur.Machine:
    bodies = {"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)}
    return assur.Machine(assur.SliderCrank(0.1, 0.4), bodies=bodies)
