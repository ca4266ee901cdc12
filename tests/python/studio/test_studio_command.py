"""The command: a server of its own, spoken to as a page does."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import urllib.request
import webbrowser
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

import assur
from assur.cli import main
from assur.studio import document, serve
from assur.studio.frame import decode
from assur.studio.limits import MOST_READ, MOST_UP
from studio.asking import FOUR_BAR, Reply

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from websockets.sync.client import ClientConnection


class Server:
    """The command in a process of its own."""

    def __init__(self, path: Path) -> None:
        words = [sys.executable, "-W", "error", "-m", "assur", "studio", str(path)]
        self.process = subprocess.Popen(
            [*words, "--no-browser", "--port", "0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
        )
        assert self.process.stdout is not None
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:"), self.process.communicate()
        self.origin = self.address.partition("/?token=")[0]
        with urllib.request.urlopen(self.address) as page:
            self.cookie = page.headers["set-cookie"].partition(";")[0]

    def socket(self, **changed: Any) -> ClientConnection:
        """Connect as the page does, but for what is changed."""
        given: dict[str, Any] = {
            "origin": self.origin,
            "additional_headers": {"Cookie": self.cookie},
            "compression": None,
            "max_size": None,
            **changed,
        }
        page: ClientConnection = connect(self.origin.replace("http", "ws") + "/socket", **given)
        return page


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    path = tmp_path_factory.mktemp("studio") / "four_bar.toml"
    path.write_text(document.toml_of(FOUR_BAR), encoding="utf-8")
    one = Server(path)
    yield one
    one.process.send_signal(signal.SIGINT)
    _, err = one.process.communicate(timeout=20)
    assert (one.process.returncode, err) == (0, "")


def asked(page: ClientConnection, kind: str, **fields: Any) -> Reply:
    page.send(json.dumps({"id": 1, "rev": 1, "kind": kind, **fields}))
    frame = page.recv()
    assert isinstance(frame, bytes)
    return Reply(*decode(frame))


def test_a_page(server: Server) -> None:
    with server.socket() as page:
        start = asked(page, "start")
        own = {key: start["file"][key] for key in ("title", "saves", "others")}
        assert own == {"title": "four_bar.toml", "saves": True, "others": 0}
        own = asked(page, "open", file=True)["document"]
        turn = asked(page, "turn", document=own)
        motion = document.read_mechanism(own).solve(np.linspace(0.0, 2.0 * np.pi, 361))
        link = turn["payload"]["links"].index("rocker") - 1
        assert np.array_equal(turn.arrays["values"][0, :, link, 2], motion.link("rocker").value)
        with server.socket() as second:
            assert asked(second, "open", file=True)["others"] == 1
            assert asked(page, "start")["file"]["others"] == 1


@pytest.mark.parametrize(
    "changed",
    [
        {"additional_headers": {}},
        {"origin": "http://evil.example"},
        {"origin": None},
    ],
)
def test_others(server: Server, changed: dict[str, Any]) -> None:
    with pytest.raises(InvalidStatus) as refused, server.socket(**changed):
        pass
    assert refused.value.response.status_code == 403


def test_too_long_a_message(server: Server) -> None:
    with server.socket() as page:
        page.send("x" * (MOST_UP + 1))
        frame = page.recv()
        assert isinstance(frame, bytes)
        assert "KiB" in Reply(*decode(frame))["error"]["message"]
        assert asked(page, "start")["version"] == assur.__version__
        # What is far too long is not even read.
        with pytest.raises(ConnectionClosed):
            asked(page, "start", much="x" * MOST_READ)
    with server.socket() as page:
        assert asked(page, "start")["version"]


def test_refused_words(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bad = tmp_path / "bad.toml"
    bad.write_text("joints = [", encoding="utf-8")
    for words, said in (
        (["missing.toml"], "missing.toml: cannot be read"),
        ([str(bad)], "bad.toml:1:"),
        (["example:hartt"], "did you mean hart"),
        (["-"], "a file or an example"),
        (["example:hart", "--port", "99999"], "from 0 to 65535"),
        (["example:hart", "--host", "no.such.host.invalid"], "cannot listen"),
    ):
        assert main(["studio", *words, "--no-browser"]) == 1
        assert said in capsys.readouterr().err
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert main(["studio", "--port", str(port), "--no-browser"]) == 1
        assert f"127.0.0.1:{port}: the studio cannot listen" in capsys.readouterr().err


def test_without_its_packages(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    assert main(["studio"]) == 1
    assert capsys.readouterr().err == (
        "assur: the studio needs uvicorn: pip install assur[studio]\n"
    )


def test_the_browser_is_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    import uvicorn

    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr(uvicorn.Server, "run", lambda _self, sockets: sockets[0].close())
    said: list[str] = []
    serve.serve(None, say=said.append)
    assert opened == said
    with socket.create_server(("127.0.0.1", 0)) as taken:
        monkeypatch.setattr(serve, "USUAL_PORT", taken.getsockname()[1])
        serve.serve(None, say=said.append)
    # The same token never twice, and another port if the usual one is taken.
    assert len(set(said)) == 2
    assert f":{serve.USUAL_PORT}/" not in said[1]
    serve.serve(None, browser=False, say=said.append)
    assert len(opened) == 2
