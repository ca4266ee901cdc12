"""Threads that compute. One that is not done in time is left behind, and its request answered.

The core releases the interpreter while it computes, so the server goes on meanwhile. Threads do
not keep the program from ending.
"""

from __future__ import annotations

import asyncio
import threading
from concurrent.futures import Future
from queue import SimpleQueue
from typing import TYPE_CHECKING

from assur.errors import InputError
from assur.studio.limits import MOST_COMPUTATIONS
from assur.studio.session import TimeIsUpError

if TYPE_CHECKING:
    from collections.abc import Callable

# Computations end by themselves at their deadline; those that cannot are left so much later.
GRACE = 0.5


class BusyError(InputError):
    """All threads are busy with calls that were left behind."""

    def __init__(self) -> None:
        message = "the studio is still busy with earlier requests"
        super().__init__(message, kind="busy", hint="wait a little")


class Workers:
    """A few threads, started when needed."""

    def __init__(self, most: int = MOST_COMPUTATIONS) -> None:
        self._most = most
        self._waiting: SimpleQueue[tuple[Future[bytes], Callable[[], bytes]]] = SimpleQueue()
        self._threads: list[threading.Thread] = []
        self._busy = 0
        # The last call of each kind that was left behind.
        self._left: dict[str, Future[bytes]] = {}
        self._lock = threading.Lock()

    async def compute(self, call: Callable[[], bytes], seconds: float, kind: str) -> bytes:
        """Return what the call returns, within the time.

        A kind with a call that was left behind has to wait until that has ended: a slow request,
        repeated, takes one thread and not all.

        Raises
        ------
        TimeIsUpError, BusyError
            It takes longer, or it could not be started.
        """
        if kind in self._left:
            if not self._left[kind].done():
                raise BusyError
            del self._left[kind]
        future: Future[bytes] = Future()
        with self._lock:
            self._waiting.put((future, call))
            self._busy += 1
            if self._busy > len(self._threads) and len(self._threads) < self._most:
                thread = threading.Thread(target=self._work, daemon=True, name="assur-studio")
                self._threads.append(thread)
                thread.start()
        try:
            return await asyncio.wait_for(asyncio.wrap_future(future), seconds + GRACE)
        except asyncio.TimeoutError:
            if future.cancelled():
                # It had not been started.
                raise BusyError from None
            self._left[kind] = future
            raise TimeIsUpError(seconds) from None

    def _work(self) -> None:
        while True:
            future, call = self._waiting.get()
            if future.set_running_or_notify_cancel():
                try:
                    future.set_result(call())
                except BaseException as error:  # noqa: BLE001 - it is raised where it is awaited
                    future.set_exception(error)
            with self._lock:
                self._busy -= 1
