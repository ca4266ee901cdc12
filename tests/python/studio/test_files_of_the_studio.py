"""Texts that are opened, the one file that is saved to, and what is exported."""

from __future__ import annotations

import csv
import io
import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.studio import document
from assur.studio.session import Given
from studio.asking import FOUR_BAR, PRESS, ask, refused

if TYPE_CHECKING:
    from pathlib import Path

TEXT = "ground crank R 0 0 0 ffft\ncrank rod R 0 1\nrod block R 3 0\nground block P 3 0 0\n"


def test_texts() -> None:
    toml = document.toml_of(PRESS)
    assert document.toml_of(ask("open", text=toml)["document"]) == toml
    opened = ask("open", text=TEXT, name="dir/crank.txt")
    assert opened["title"] == "crank"
    assert opened["omitted"]
    assert opened["structure"]["formula"] == ["I(crank)", "II(rod, block)"]


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({}, "one of example, text and file"),
        ({"text": TEXT, "example": "hart"}, "one of example, text and file"),
        ({"example": "../secret"}, "known are"),
        ({"text": "joints = ["}, "not TOML"),
        ({"text": "format = 1\ndriver = 'a'\n[joints]\n[links]\n"}, ""),
        ({"text": ""}, ""),
        ({"text": "\0\0"}, ""),
        ({"file": True}, "without a file"),
        ({"text": 7}, "a text in quotes"),
    ],
)
def test_refused_texts(fields: dict[str, Any], said: str) -> None:
    error = refused("open", **fields)
    assert said in error["message"]
    assert error.get("kind") != "internal"


def test_batches_are_not_shown() -> None:
    own = document.toml_of(FOUR_BAR) + "\n[dimensions]\nrocker.length = [3.0, 4.0]\n"
    assert "2" in refused("open", text=own)["message"]
    batch = {**FOUR_BAR, "dimensions": {"rocker.length": [3.0, 4.0]}}
    assert "one design" in refused("turn", document=batch)["message"]


def test_the_file_given(tmp_path: Path) -> None:
    path = tmp_path / "press.toml"
    document.read_machine(PRESS).save(path)
    given = Given(path=path)
    opened = ask("open", given, file=True)
    assert (opened["title"], opened["saves"]) == ("press", True)
    changed = {**opened["document"], "dimensions": {"rod.length": 0.44}}
    saved = ask("save", given, document=changed, stamp=opened["stamp"])
    assert assur.files.read(path).mechanism.dimensions["rod.length"] == 0.44
    # Another window opened it before that.
    error = refused("save", given, document=PRESS, stamp=opened["stamp"])
    assert (error["kind"], "press.toml" in error["message"]) == ("changed", True)
    assert "open it again" in error["what_to_do"]
    ask("save", given, document=PRESS, stamp=opened["stamp"], force=True)
    assert path.read_text("utf-8") == document.toml_of(PRESS)
    assert saved["stamp"] != ask("open", given, file=True)["stamp"]
    # What is no mechanism leaves it as it was.
    before = path.read_bytes()
    wrong: list[dict[str, Any]] = [{"joints": {}}, {**FOUR_BAR, "driver": "x"}]
    for own in wrong:
        assert refused("save", given, document=own, force=True)["message"]
    assert path.read_bytes() == before
    assert [one.name for one in tmp_path.iterdir()] == ["press.toml"]


def test_nothing_else_is_written(tmp_path: Path) -> None:
    other = tmp_path / "linkage.txt"
    other.write_text(TEXT, encoding="utf-8")
    for given in (None, Given(example="hart"), Given(path=other)):
        error = refused("save", given, document=FOUR_BAR, stamp=None, force=True)
        assert error["kind"] == "no_file"
    assert other.read_text("utf-8") == TEXT
    assert ask("open", Given(path=other), file=True)["saves"] is False
    assert refused("save", Given(path=other), document=FOUR_BAR, path="x")["key"] == "path"
    gone = Given(path=tmp_path / "gone" / "x.toml")
    assert "cannot be" in refused("open", gone, file=True)["message"]
    assert "cannot be" in refused("save", gone, document=FOUR_BAR, force=True)["message"]


def exported(own: dict[str, Any], **fields: Any) -> tuple[Any, bytes]:
    reply = ask("export", document=own, **fields)
    return reply, reply.arrays["bytes"].tobytes()


def test_exports() -> None:
    reply, raw = exported(PRESS, format="toml", name="../a/press é")
    assert (reply["name"], reply["size"]) == ("___a_press é.toml", len(raw))
    assert document.read(ask("open", text=raw.decode())["document"]).machine is not None
    _, raw = exported(FOUR_BAR, format="csv", rows=13, speed=2.0)
    rows = list(csv.DictReader(io.StringIO(raw.decode())))
    motion = document.read_mechanism(FOUR_BAR).solve(np.linspace(0.0, 2.0 * np.pi, 13))
    assert [float(row["P.vx"]) for row in rows] == motion.joint("P").velocity(2.0)[:, 0].tolist()
    _, raw = exported(FOUR_BAR, format="html", name="<b>")
    assert b"<title>&lt;b&gt;</title>" in raw


@pytest.mark.parametrize(("kind", "start"), [("svg", b"<?xml"), ("dxf", b"  0"), ("gif", b"GIF8")])
def test_pictures(kind: str, start: bytes) -> None:
    fields = {"rows": 5} if kind == "gif" else {"q": 0.3}
    assert exported(FOUR_BAR, format=kind, **fields)[1].startswith(start)


def test_examples_are_listed() -> None:
    reply = ask("start", Given(example="hart"))
    assert [one["name"] for one in reply["examples"]] == list(assur.examples.ALL)
    given = Given(example="hart")
    assert reply["file"] == {"title": "hart", "saves": False, "others": 0, "id": given.id}
    assert json.dumps(reply.header)
