"""Ctrl-C in the midst of a long call: after processor time, not after time on the wall clock."""

from __future__ import annotations

import signal
import threading
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

# The process has then done this much of the work, however busy the machine is.
WORKED = 0.1
# Processor time of the work that is interrupted, s, and the parts of it of which one is timed.
WHOLE, PARTS = 4.0, 32
LARGEST = 1e8


def interrupted(call: Callable[[], object]) -> float | None:
    """Send SIGINT once the call has worked for a while; processor time until it raised, s.

    None if the call ended before.
    """
    sent: list[float] = []
    ended = threading.Event()
    lock = threading.Lock()
    started = time.process_time()

    def ctrl_c() -> None:
        while time.process_time() - started < WORKED:
            if ended.wait(0.005):
                return
        with lock:
            if not ended.is_set():
                sent.append(time.process_time())
                signal.raise_signal(signal.SIGINT)

    thread = threading.Thread(target=ctrl_c)
    thread.start()
    try:
        call()
        with lock:
            ended.set()
    except KeyboardInterrupt:
        return time.process_time() - sent[0]
    finally:
        ended.set()
        thread.join()
    return None


def heard_after(make: Callable[[int], Callable[[], object]], size: int) -> float:
    """Interrupt work of more than `WHOLE`; processor time until it raised, s.

    A part of the work shows how long the whole would be: what is not heard is heard `WHOLE` late.
    """
    while True:
        part = make(size)
        started = time.process_time()
        part()
        if (time.process_time() - started) * PARTS > WHOLE:
            break
        size *= 2
        assert size < LARGEST, "the work does not grow"
    after = interrupted(make(PARTS * size))
    assert after is not None, "the work ended before it was interrupted"
    return after
