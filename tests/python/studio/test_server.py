"""The server: who is let in, what it serves, and that it goes on whatever is sent."""

from __future__ import annotations

import asyncio
import json
import random
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, TypeVar

import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from assur.studio import connection, limits, workers
from assur.studio.app import application, pages
from assur.studio.frame import decode
from assur.studio.kinds import KINDS
from assur.studio.session import Answer, TimeIsUpError
from studio.asking import FOUR_BAR, PRESS, Reply

if TYPE_CHECKING:
    from collections.abc import Coroutine, Iterator

    from starlette.testclient import WebSocketTestSession

    from assur.studio.session import Session

Result = TypeVar("Result")

TOKEN, PORT = "a-token-of-tests", 8417
HOST = f"127.0.0.1:{PORT}"
ORIGIN = f"http://{HOST}"
COOKIE = f"assur-studio-{PORT}={TOKEN}"
# What a browser sends from the page itself.
OWN = {"host": HOST, "origin": ORIGIN, "cookie": COOKIE}


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    app = application(None, TOKEN, "127.0.0.1", PORT)
    with TestClient(app, base_url=ORIGIN, follow_redirects=False) as one:
        yield one


def without(*names: str, **others: str) -> dict[str, str]:
    return {name: value for name, value in {**OWN, **others}.items() if name not in names}


def read(socket: WebSocketTestSession) -> Reply:
    return Reply(*decode(socket.receive_bytes()))


def asked(socket: WebSocketTestSession, message: Any) -> Reply:
    socket.send_text(message if isinstance(message, str) else json.dumps(message))
    return read(socket)


def test_the_page_with_its_token(client: TestClient) -> None:
    page = client.get(f"/?token={TOKEN}", headers={"sec-fetch-site": "cross-site"})
    assert page.status_code == 200
    assert '<script type="module" src="/studio.js">' in page.text
    cookie = page.headers["set-cookie"]
    assert cookie == f"{COOKIE}; Path=/; HttpOnly; SameSite=Strict"
    client.cookies.clear()
    for path in pages():
        found = client.get(path, headers=without("origin"))
        assert found.status_code == 200
        assert "set-cookie" not in found.headers
        for name, value in (
            ("x-content-type-options", "nosniff"),
            ("referrer-policy", "no-referrer"),
            ("cache-control", "no-store"),
        ):
            assert found.headers[name] == value
        policy = found.headers["content-security-policy"]
        for part in ("default-src 'none'", "script-src 'self'", "frame-ancestors 'none'"):
            assert part in policy
    assert (
        client.get("/studio.js", headers=OWN).headers["content-type"].startswith("text/javascript")
    )


@pytest.mark.parametrize(
    "headers",
    [
        {},
        without("cookie"),
        without(cookie=f"{COOKIE}x"),
        without(cookie=f"assur-studio-1={TOKEN}"),
        without(cookie='";;=,\x7f'),
        without(host="evil.example"),
        without(host=f"evil.example:{PORT}"),
        without(host="127.0.0.1"),
        without(host="127.0.0.1:80"),
        without(host=f"127.0.0.1.evil.example:{PORT}"),
        without(host=f"192.168.1.7:{PORT}"),
        without(origin="http://evil.example"),
        without(origin="null"),
        without(origin=f"https://{HOST}"),
        without(origin=f"http://localhost:{PORT}"),
        without("origin", **{"sec-fetch-site": "cross-site"}),
        without("origin", **{"sec-fetch-site": "same-site"}),
    ],
)
def test_others_are_refused(client: TestClient, headers: dict[str, str]) -> None:
    client.cookies.clear()
    refused = client.get("/", headers=headers)
    assert (refused.status_code, "default-src" in refused.headers["content-security-policy"]) == (
        403,
        True,
    )
    assert TOKEN not in refused.text + str(refused.headers)
    with pytest.raises(WebSocketDisconnect), client.websocket_connect("/socket", headers=headers):
        pass


@pytest.mark.parametrize(
    "address",
    [
        "/?token=",
        "/?token=x",
        "/?tok=1",
        "/?" + "token=x&" * 50,
        f"/studio.js?token={TOKEN}",
    ],
)
def test_the_token_opens_the_page_alone(client: TestClient, address: str) -> None:
    client.cookies.clear()
    assert client.get(address).status_code == 403


def test_a_socket_needs_an_origin(client: TestClient) -> None:
    with (
        pytest.raises(WebSocketDisconnect),
        client.websocket_connect("/socket", headers=without("origin")),
    ):
        pass


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "TRACE"])
def test_pages_are_only_read(client: TestClient, method: str) -> None:
    assert client.request(method, "/", headers=OWN).status_code == 403


@pytest.mark.parametrize(
    "path",
    [
        "/studio/page/../app.py",
        "/studio/page/%2e%2e/app.py",
        "/studio/page/..%2fapp.py",
        "/pictures/page/../../errors.py",
        "/pictures/page/html.py",
        "/studio/page/__init__.py",
        "//etc/passwd",
        "/studio//etc/passwd",
        "/studio.js/",
        "/studio.js%00.html",
        "/socket",
    ],
)
def test_no_other_file(client: TestClient, path: str) -> None:
    found = client.get(path, headers=OWN)
    assert (found.status_code, found.text) == (404, "There is nothing here.")


def test_a_network_only_where_asked_for() -> None:
    for host, name, status in (
        ("127.0.0.1", "localhost", 200),
        ("127.0.0.1", "[::1]", 200),
        ("0.0.0.0", "192.168.1.7", 200),
        ("0.0.0.0", "evil.example", 403),
        ("studio.lan", "studio.lan", 200),
        ("studio.lan", "evil.example", 403),
    ):
        app = TestClient(application(None, TOKEN, host, PORT), base_url=ORIGIN)
        headers = without("origin", host=f"{name}:{PORT}")
        assert app.get("/", headers=headers).status_code == status, (host, name)


MALFORMED = [
    "",
    "{",
    "7",
    "null",
    "[]",
    '"text"',
    "{}",
    '{"id": 1}',
    '{"id": 1, "rev": 1}',
    '{"id": "1", "rev": 1, "kind": "start"}',
    '{"id": true, "rev": 1, "kind": "start"}',
    '{"id": 1, "rev": 1, "kind": 7}',
    '{"id": 1, "rev": 1, "kind": "turn", "q": NaN}',
    '{"id": 1e400, "rev": 1, "kind": "start"}',
    "[" * 100_000,
    '{"id": 1, "rev": 1, "kind": "x", "a": ' + "[" * 100_000,
    '{"id": ' + "9" * 5000 + ', "rev": 1, "kind": "start"}',
    " " * (limits.MOST_UP + 1),
]


def test_malformed_messages_are_answered(client: TestClient) -> None:
    with client.websocket_connect("/socket", headers=OWN) as socket:
        for message in MALFORMED:
            assert asked(socket, message)["error"]["kind"] == "malformed", message[:60]
        socket.send_bytes(b"\xff\xfe\x00")
        assert read(socket)["error"]["kind"] == "malformed"
        # Letters that are halves of letters, as a name.
        half = {**FOUR_BAR, "joints": {"\ud800": [0, 0]}}
        assert (
            asked(socket, {"id": 2, "rev": 1, "kind": "check", "document": half}).header["id"] == 2
        )
        unknown = asked(socket, {"id": 3, "rev": 4, "kind": "rm -rf"})
        assert (unknown["id"], unknown["rev"], unknown["error"]["kind"]) == (3, 4, "malformed")
        assert asked(socket, {"id": 4, "rev": 1, "kind": "start"})["version"]


def values(rng: random.Random, depth: int = 0) -> Any:
    """Return any JSON."""
    kinds: list[Any] = [None, True, -1, 10**30, 0.5, 1e308, "", "crank", "\u0000", "x" * 300]
    if depth > 3 or rng.random() < 0.6:
        return rng.choice(kinds)
    if rng.random() < 0.5:
        return [values(rng, depth + 1) for _ in range(rng.randrange(4))]
    names = ["document", "joints", "links", "driver", "A", "ground", "q", "x", ""]
    return {rng.choice(names): values(rng, depth + 1) for _ in range(rng.randrange(4))}


def mutated(rng: random.Random, value: Any) -> Any:
    """Return JSON with something in it changed, left out or doubled."""
    if isinstance(value, dict) and value and rng.random() < 0.9:
        key = rng.choice(list(value))
        if rng.random() < 0.15:
            return {k: v for k, v in value.items() if k != key}
        return {**value, key: mutated(rng, value[key])}
    if isinstance(value, list) and value and rng.random() < 0.8:
        at = rng.randrange(len(value))
        return [*value[:at], mutated(rng, value[at]), *value[at + rng.randrange(2) :]]
    return values(rng)


FIELDS: dict[str, dict[str, Any]] = {
    "open": {"text": "format = 1\ndriver = 'a'\n", "name": "a.toml"},
    "drag": {"q": 0.3, "joint": "C", "to": [4.0, 3.0], "rows": 9},
    "turn": {"q": 0.3, "rows": 9, "orders": 2, "paths": ["P"], "diagrams": ["P.x"], "axis": 0},
    "sensitivity": {"q": 0.3, "of": "rocker", "order": 1},
    "run": {"by": "law", "law": {"law": "Uniform", "start": 0, "end": 1, "duration": 1}, "rows": 9},
    "map": {
        "x": {"dimension": "coupler.length", "low": 3, "high": 5},
        "y": {"dimension": "rocker.length", "low": 3, "high": 5},
        "metric": {"metric": "span", "of": "P.x", "order": 1, "over": [0, 1]},
        "n": 3,
        "rows": 9,
    },
    "lesson": {"l1": 1, "l2": 4.5, "l3": 1.5, "l4": 4.8, "gamma_min": 0.2, "run": True, "rows": 9},
    "flywheel": {"fluctuation": 0.02, "rows": 9},
    "reactions": {"q": 0.3, "speed": 1.0},
    "steady": {"rows": 9},
    "save": {"stamp": "x"},
    "export": {"format": "toml", "name": "x"},
}


@pytest.mark.parametrize("seed", range(2))
def test_anything_is_answered(
    client: TestClient, seed: int, caplog: pytest.LogCaptureFixture
) -> None:
    """Any JSON, and valid messages with something in them changed: one answer each."""
    rng = random.Random(seed)
    with client.websocket_connect("/socket", headers=OWN) as socket:
        for i in range(250):
            kind = rng.choice([k for k in KINDS if k != "start"])
            document = PRESS if kind in ("reactions", "flywheel", "steady") else FOUR_BAR
            message: Any = {"id": i, "rev": i, "kind": kind, **FIELDS.get(kind, {})}
            if kind not in ("open", "lesson"):
                message["document"] = document
            for _ in range(rng.randrange(1, 3)):
                message = values(rng) if rng.random() < 0.15 else mutated(rng, message)
            caplog.clear()
            reply = asked(socket, message)
            error = reply.header.get("error")
            assert error is None or error["message"], message
            assert error is None or error.get("kind") != "internal", (
                json.dumps(message),
                caplog.text,
            )
        assert asked(socket, {"id": 1, "rev": 1, "kind": "start"})["version"]


def test_too_much_is_refused(client: TestClient) -> None:
    many = {f"J{i}": [i, 0] for i in range(limits.MOST_JOINTS + 1)}
    with client.websocket_connect("/socket", headers=OWN) as socket:
        own = {**FOUR_BAR, "joints": many}
        error = asked(socket, {"id": 1, "rev": 1, "kind": "turn", "document": own})["error"]
        assert (error["kind"], error["key"]) == ("too_many", "joints")
        fields = {"kind": "turn", "document": FOUR_BAR, "rows": 10**6}
        error = asked(socket, {"id": 1, "rev": 1, **fields})["error"]
        assert error["message"] == "rows: is 1000000: 3 to 1441 is needed"
        assert asked(socket, {"id": 1, "rev": 1, "kind": "start"})["version"]


def test_connections_are_counted(client: TestClient) -> None:
    from contextlib import ExitStack

    with ExitStack() as stack:
        for _ in range(limits.MOST_CONNECTIONS):
            one = stack.enter_context(client.websocket_connect("/socket", headers=OWN))
            assert asked(one, {"id": 1, "rev": 1, "kind": "start"})["version"]
        with client.websocket_connect("/socket", headers=OWN) as socket:
            assert "windows are open" in read(socket)["error"]["message"]
            with pytest.raises(WebSocketDisconnect):
                socket.receive_bytes()
    time.sleep(0.05)
    with client.websocket_connect("/socket", headers=OWN) as socket:
        assert asked(socket, {"id": 1, "rev": 1, "kind": "start"})["version"]


@pytest.fixture
def gate(monkeypatch: pytest.MonkeyPatch) -> Iterator[threading.Event]:
    """Make `position` wait until the gate is open, and end soon otherwise."""
    opened = threading.Event()

    def waits(data: dict[str, Any], session: Session) -> Answer:
        assert session.deadline.seconds > 0.0
        opened.wait(5.0)
        return Answer({"waited": data["q"]})

    monkeypatch.setitem(KINDS, "position", waits)
    yield opened
    opened.set()


def test_what_takes_long_does_not_hold_a_hand(
    client: TestClient, gate: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(KINDS, "map", KINDS["position"])
    with client.websocket_connect("/socket", headers=OWN) as socket:
        socket.send_text(json.dumps({"id": 1, "rev": 1, "kind": "map", "q": 1}))
        time.sleep(0.05)
        drag = {"document": FOUR_BAR, "joint": "C", "to": [4, 3], "rows": 9}
        assert asked(socket, {"id": 2, "rev": 1, "kind": "drag", **drag})["id"] == 2
        gate.set()
        assert read(socket)["id"] == 1


def run_apart(work: Coroutine[Any, Any, Result]) -> Result:
    """Run it in a thread of its own: a browser of other tests may keep the loop of this one."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, work).result()


def test_a_page_that_left_leaves_no_task_behind() -> None:
    class Left:
        """A socket whose page has gone before the answer."""

        def __init__(self) -> None:
            self.asked = False
            self.is_tried = asyncio.Event()

        async def receive(self) -> dict[str, Any]:
            if not self.asked:
                self.asked = True
                return {"type": "websocket.receive", "text": '{"id": 1, "rev": 1, "kind": "start"}'}
            await self.is_tried.wait()
            await asyncio.sleep(0.01)
            return {"type": "websocket.disconnect"}

        async def send_bytes(self, frame: bytes) -> None:
            del frame
            self.is_tried.set()
            raise WebSocketDisconnect

    async def served() -> int:
        socket: Any = Left()
        await connection.Connection(connection.Studio(), socket).serve()
        return len(asyncio.all_tasks())

    assert run_apart(served()) == 1


def test_only_the_newest_that_waits(client: TestClient, gate: threading.Event) -> None:
    with client.websocket_connect("/socket", headers=OWN) as socket:

        def send(number: int, kind: str, **fields: Any) -> None:
            socket.send_text(json.dumps({"id": number, "rev": 1, "kind": kind, **fields}))

        send(1, "position", q=1)
        time.sleep(0.1)
        send(2, "turn", document=FOUR_BAR, rows=9)
        send(3, "start")
        send(4, "drag", document=FOUR_BAR, joint="C", to=[4, 3], rows=9)
        send(5, "turn", document=FOUR_BAR, rows=9)
        dropped = [read(socket).header for _ in range(2)]
        assert [(one["id"], one["dropped"]) for one in dropped] == [(2, True), (4, True)]
        for i in range(limits.MOST_WAITING - 2):
            send(10 + i, "start")
        send(99, "start")
        full = read(socket)
        assert (full["id"], full["error"]["kind"]) == (99, "busy")
        gate.set()
        order = [read(socket)["id"] for _ in range(limits.MOST_WAITING + 1)]
        assert order[:3] == [1, 3, 5]


def test_a_request_that_takes_too_long(
    client: TestClient, gate: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connection, "SECONDS", 0.1)
    monkeypatch.setattr(workers, "GRACE", 0.1)
    with client.websocket_connect("/socket", headers=OWN) as socket:
        error = asked(socket, {"id": 1, "rev": 1, "kind": "position", "q": 1})["error"]
        assert (error["kind"], "0.1 s" in error["message"]) == ("time_limit", True)
        # Another thread goes on meanwhile.
        assert asked(socket, {"id": 2, "rev": 1, "kind": "start"})["version"]
        # The same again would take thread after thread.
        again = asked(socket, {"id": 3, "rev": 1, "kind": "position", "q": 1})["error"]
        assert again["kind"] == "busy"
        gate.set()
        time.sleep(0.1)
        assert asked(socket, {"id": 9, "rev": 1, "kind": "position", "q": 1})["waited"] == 1


def test_all_threads_may_be_left_behind() -> None:
    gate, few = threading.Event(), workers.Workers(most=1)

    def waits() -> bytes:
        gate.wait(5.0)
        return b""

    async def both() -> None:
        with pytest.raises(TimeIsUpError):
            await few.compute(waits, 0.05, "one")
        with pytest.raises(workers.BusyError):
            await few.compute(waits, 0.05, "other")
        gate.set()
        await asyncio.sleep(0.1)
        assert await few.compute(waits, 5.0, "one") == b""

    run_apart(both())


def test_loops_end_at_the_limit(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "SECONDS", 0.02)
    axes = {
        "x": {"dimension": "coupler.length", "low": 3, "high": 5},
        "y": {"dimension": "rocker.length", "low": 3, "high": 5},
        "metric": {"metric": "deviation", "of": "P"},
    }
    with client.websocket_connect("/socket", headers=OWN) as socket:
        message = {"id": 1, "rev": 1, "kind": "map", "document": FOUR_BAR, **axes, "rows": 1441}
        began = time.monotonic()
        assert asked(socket, {**message, "n": 101})["error"]["kind"] == "time_limit"
        assert time.monotonic() - began < 5.0


def test_failures_are_told_and_logged(
    client: TestClient, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def fails(data: dict[str, Any], session: Session) -> Answer:
        raise ZeroDivisionError(data, session)

    monkeypatch.setitem(KINDS, "position", fails)
    with client.websocket_connect("/socket", headers=OWN) as socket:
        error = asked(socket, {"id": 1, "rev": 1, "kind": "position"})["error"]
        assert (error["kind"], "ZeroDivisionError" in error["message"]) == ("internal", True)
        assert "Traceback" not in error["message"]
    assert "ZeroDivisionError" in caplog.text
