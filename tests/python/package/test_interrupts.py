"""Signals stop long calls at the next block; what they leave behind cannot be read."""

from __future__ import annotations

import gc
import math
import signal
import subprocess
import sys
import textwrap
import threading
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


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


def stopped(call: Callable[[int], object], size: int, seconds: float = 0.1) -> int:
    """Make a call larger until it lasts long enough to be stopped; how large it was."""
    while True:
        try:
            with signal_after(seconds):
                call(size)
        except StoppedError:
            return size
        size *= 4
        assert size < 1e10, "the signal is never heard"


def test_a_motion_whose_overwriting_was_stopped_cannot_be_read() -> None:
    for size in (10_000 * 4**k for k in range(6)):
        m = _class_iv(size)
        motion: Any = m.solve([0.3], order=0, on_error="nan")
        with suppress(StoppedError), signal_after(0.05):
            m.solve([0.4], order=0, on_error="nan", out=motion)
        if not motion._stored.buffers.complete:
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
    """Of the memory that was asked for few pages are ever touched: they are counted."""
    code = """
        import resource, signal, sys, time
        import numpy as np, assur
        m, q = assur.FourBar(1.0, 3.0, 2.5, 3.0), np.linspace(0.0, 6.0, int(sys.argv[1]))
        faults = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_minflt
        signal.signal(signal.SIGPROF, signal.default_int_handler)
        before, started = faults(), time.process_time()
        signal.setitimer(signal.ITIMER_PROF, float(sys.argv[2]))
        try:
            m.solve(q, order=2, threads=1)
            print(faults() - before, time.process_time() - started, "whole")
        except KeyboardInterrupt:
            print(faults() - before, time.process_time() - started, "stopped")
    """

    def run(size: int, seconds: float) -> tuple[int, float, str]:
        command = [sys.executable, "-c", textwrap.dedent(code), str(size), str(seconds)]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        count, worked, how = text.split()
        return int(count), float(worked), how

    whole, worked, how = run(10**6, 600.0)
    assert how == "whole"
    # Thirty times as much, several GB if it were filled; stopped after the work of the first.
    few, _, how = run(3 * 10**7, worked)
    assert how == "stopped"
    assert few < 15 * whole


LONG: dict[str, Callable[[int], object]] = {
    "designs of class IV": lambda n: _class_iv(n).solve([0.3], on_error="nan"),
    "assemblies": lambda n: _many_assemblies(n).assemblies(0.1),
    "construction": lambda n: _chain(max(n // 1000, 1)),
    "crank-rocker": lambda n: assur.crank_rocker.solve(np.linspace(0, 6, n), 1.0, 3.0, 2.5, 3.0),
    "strokes": lambda n: assur.slider_crank.stroke(np.linspace(0, 6, n), 1.0, 3.0),
    "deviations": lambda n: assur.slider_crank.deviation(np.linspace(0.1, 0.3, n // 100), 2),
    "curvature": lambda n: assur.SliderCrank(1.0, 3.0).solve(np.linspace(0, 6, n)).curvature("B"),
    "flywheel curve": lambda n: _flywheel().speed(np.linspace(0.0, 6.0, n)),
    "condition": lambda n: assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(np.linspace(0, 6, n)).condition,
    "reduced inertia": lambda n: _machine().reduced_inertia(np.linspace(0.0, 6.0, n)),
    "run": lambda n: _machine().run(float(n), 0.0, 1.0, max_steps=10**9),
}


@pytest.mark.parametrize("name", LONG)
def test_every_long_call_can_be_stopped(name: str) -> None:
    stopped(LONG[name], 20_000)


def test_other_threads_of_python_go_on_while_a_mechanism_is_built() -> None:
    """The lock is free: what another thread does in between shows."""
    ticks = 0
    done = threading.Event()

    def tick() -> None:
        nonlocal ticks
        while not done.is_set():
            time.sleep(0.001)
            ticks += 1

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        joints, links = _chain_parts(600)
        before = ticks
        assur.Mechanism(joints, links, driver="crank")
        during = ticks - before
    finally:
        done.set()
        thread.join()
    assert during > 10


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
    joints, links = _chain_parts(dyads)
    return assur.Mechanism(joints, links, driver="crank")


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


def _flywheel() -> assur.flywheel.Flywheel:
    phi = np.linspace(0.0, 2 * np.pi, 25)
    return assur.flywheel.evaluate(phi, 10 * np.sin(phi), np.full(25, 2.0), speed0=10.0)


def _machine() -> assur.Machine:
    bodies = {"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)}
    return assur.Machine(assur.SliderCrank(0.1, 0.4), bodies)
