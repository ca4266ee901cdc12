"""One page: reads its requests, computes them in two lanes, keeps the newest of live kinds."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from starlette.websockets import WebSocketDisconnect

from assur.studio.answers import answered, failed
from assur.studio.frame import encode
from assur.studio.kinds import LIVE, LONG
from assur.studio.limits import EXPORT_SECONDS, MOST_CONNECTIONS, MOST_WAITING, SECONDS
from assur.studio.request import MalformedError, Request, parse
from assur.studio.session import Deadline, Session, TimeIsUpError
from assur.studio.workers import BusyError, Workers

if TYPE_CHECKING:
    from starlette.websockets import WebSocket

    from assur.studio.session import Given

# What WebSockets call "try again later".
TRY_LATER = 1013


class Studio:
    """What all connections share: the file given, the threads, the connections."""

    def __init__(self, given: Given | None = None) -> None:
        self.given = given
        self.workers = Workers()
        self.connections: set[Connection] = set()

    async def connect(self, socket: WebSocket) -> None:
        """Serve a page until it leaves."""
        await socket.accept()
        if len(self.connections) >= MOST_CONNECTIONS:
            error = MalformedError(f"{MOST_CONNECTIONS} windows are open already: close one")
            await socket.send_bytes(failed({"id": None, "rev": None, "kind": None}, error))
            await socket.close(TRY_LATER)
            return
        connection = Connection(self, socket)
        self.connections.add(connection)
        try:
            await connection.serve()
        finally:
            self.connections.discard(connection)


class Lane:
    """Requests that are computed one at a time, the oldest first."""

    def __init__(self) -> None:
        self.waiting: list[Request] = []
        self._is_waiting = asyncio.Event()

    def add(self, request: Request) -> None:
        """Let a request wait."""
        self.waiting.append(request)
        self._is_waiting.set()

    async def next(self) -> Request:
        """Return the oldest once there is one."""
        await self._is_waiting.wait()
        request = self.waiting.pop(0)
        if not self.waiting:
            self._is_waiting.clear()
        return request


class Connection:
    """One page."""

    def __init__(self, studio: Studio, socket: WebSocket) -> None:
        self._studio, self._socket = studio, socket
        # What a hand waits for, and what may take long: neither waits for the other.
        self._quick, self._long = Lane(), Lane()
        self._sending = asyncio.Lock()
        self.has_file = False

    async def serve(self) -> None:
        """Read until the page leaves; compute meanwhile."""
        lanes = (self._quick, self._long)
        tasks = [asyncio.create_task(self._compute(lane)) for lane in lanes]
        try:
            while True:
                message = await self._socket.receive()
                if message["type"] == "websocket.disconnect":
                    return
                text = message.get("text")
                await self._take(message.get("bytes", b"") if text is None else text)
        except WebSocketDisconnect:
            return
        finally:
            # Each by itself: one may have failed at a page that left.
            for task in tasks:
                task.cancel()
            for task in tasks:
                with suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):
                    await task

    async def _take(self, text: str | bytes) -> None:
        try:
            request = parse(text)
        except MalformedError as error:
            await self._send(failed({"id": error.id, "rev": None, "kind": None}, error))
            return
        lane = self._long if request.kind in LONG else self._quick
        place = LIVE.get(request.kind)
        older = [
            queued
            for queued in lane.waiting
            if place is not None and LIVE.get(queued.kind) == place
        ]
        for outdated in older:
            lane.waiting.remove(outdated)
            await self._send(encode({**_head(outdated), "dropped": True}, {}))
        if len(lane.waiting) >= MOST_WAITING:
            await self._send(failed(_head(request), BusyError()))
            return
        lane.add(request)

    async def _compute(self, lane: Lane) -> None:
        """Answer the requests that wait in a lane."""
        while True:
            await self._send(await self._answer(await lane.next()))

    async def _answer(self, request: Request) -> bytes:
        seconds = EXPORT_SECONDS if request.kind == "export" else SECONDS
        other_files = sum(
            connection.has_file for connection in self._studio.connections if connection is not self
        )

        def call() -> bytes:
            return answered(request, Session(self._studio.given, Deadline(seconds), other_files))

        try:
            frame = await self._studio.workers.compute(call, seconds, request.kind)
        except (TimeIsUpError, BusyError) as error:
            return failed(_head(request), error)
        if request.kind == "open":
            self.has_file = request.fields.get("file") is True
        return frame

    async def _send(self, frame: bytes) -> None:
        async with self._sending:
            await self._socket.send_bytes(frame)


def _head(request: Request) -> dict[str, Any]:
    return {"id": request.id, "rev": request.rev, "kind": request.kind}
