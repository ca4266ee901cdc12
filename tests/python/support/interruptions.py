"""Ctrl-C in the midst of a long call: after processor time, not after time on the wall clock.

The process has then done a known part of the work, however busy the machine is.
"""

from __future__ import annotations

import gc
import math
import signal
import threading
import time
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

# Processor time of the work that is interrupted, s, and the part of it that is timed at least.
WHOLE, PART = 1.2, 1 / 8
# Processor time after which it is interrupted, and in which it is then to be heard, s. A machine
# that is busy does the same work in half of the time or in twice: half is longer than both.
WORKED, SOON = 0.1, 0.4
# Time between two signals, and the longest in which none may be heard where work is done in small
# parts, s of processor time.
TICK, SILENT = 0.01, 0.1
# A busy machine may keep the thread that listens waiting; what hears nothing is late every time.
ATTEMPTS = 3
LARGEST = 1e8
# Work that ends too early is doubled so often at most.
DOUBLINGS = 4
# Work grows at most like this power of its size; less than the first is noise.
SLOWEST, FASTEST = 1.0, 3.5


def interrupted(call: Callable[[], object], worked: float) -> float | None:
    """Send SIGINT once the call has worked for so long; processor time until it raised, s.

    If the call holds the lock the signal cannot be sent before it ends: so late it is then. None if
    the call ended before it was due.
    """
    ended = threading.Event()
    lock = threading.Lock()
    started = time.process_time()

    def ctrl_c() -> None:
        while time.process_time() - started < worked:
            if ended.wait(0.005):
                return
        with lock:
            if not ended.is_set():
                signal.raise_signal(signal.SIGINT)

    thread = threading.Thread(target=ctrl_c)
    # A shell starts what it sends to the background with the signal ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    # What is raised within the collector's callbacks (Hypothesis has one) is lost.
    gc.disable()
    thread.start()
    try:
        call()
        with lock:
            ended.set()
    except KeyboardInterrupt:
        return time.process_time() - started - worked
    finally:
        gc.enable()
        ended.set()
        thread.join()
        signal.signal(signal.SIGINT, before)
    return None


def is_heard(make: Callable[[int], Callable[[], object]], size: int) -> bool:
    """Whether Ctrl-C stops work soon: `make` makes work of a size, from `size` on."""
    return any(heard_after(make, size) < SOON for _ in range(ATTEMPTS))


def heard_after(make: Callable[[int], Callable[[], object]], size: int) -> float:
    """Interrupt work of the time `WHOLE`; processor time until it raised, s.

    A part of the work shows how large the whole is; where that was slow for once, the whole ends
    too early, and more is done. What is not heard is heard at its end.
    """
    before = 0.0
    while True:
        part = make(size)
        worked = processor_time(part)
        # The first time memory is new, and it takes longer.
        if worked > PART * WHOLE and (worked := processor_time(part)) > PART * WHOLE:
            break
        size, before = 2 * size, worked
        assert size < LARGEST, "the work does not grow"
    power = min(max(math.log2(worked / before), SLOWEST), FASTEST) if before else SLOWEST
    size = round(size * (WHOLE / worked) ** (1.0 / power))
    for _ in range(DOUBLINGS):
        if (after := interrupted(make(size), WORKED)) is not None:
            return after
        size *= 2
    message = "the work ended before it was interrupted"
    raise AssertionError(message)


def processor_time(call: Callable[[], object]) -> float:
    """Processor time that a call takes, s."""
    started = time.process_time()
    call()
    return time.process_time() - started


def longest_silence(call: Callable[[], object]) -> float:
    """Processor time of a call, at most, in which no signal is heard, s."""
    heard: list[float] = []

    def hear(*_: object) -> None:
        heard.append(time.process_time())

    before = signal.signal(signal.SIGPROF, hear)
    hear()
    signal.setitimer(signal.ITIMER_PROF, TICK, TICK)
    try:
        call()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
    hear()
    return max(after - before for before, after in pairwise(heard))


def longest_standstill(call: Callable[[], object]) -> tuple[float, float]:
    """Processor time of a call, s, and the most of it in which another thread did not go on.

    A lock that is held throughout stops the other thread throughout; a busy machine stops all.
    """
    longest = 0.0
    done, ready = threading.Event(), threading.Event()

    def tick() -> None:
        nonlocal longest
        last = time.process_time()
        while not done.is_set():
            time.sleep(0.001)
            now = time.process_time()
            longest, last = max(longest, now - last), now
            ready.set()

    thread = threading.Thread(target=tick)
    thread.start()
    # The collector stops every thread; what earlier calls left, when they were stopped, may be
    # gigabytes, which take tenths of a second to give back.
    gc.collect()
    gc.disable()
    try:
        ready.wait()
        longest, started = 0.0, time.process_time()
        call()
        worked = time.process_time() - started
    finally:
        gc.enable()
        done.set()
        thread.join()
    return worked, longest
