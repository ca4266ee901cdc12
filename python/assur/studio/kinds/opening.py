"""``start``: what can be opened. ``open``: an example, a text, or the file given."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from assur import examples, importers
from assur._core import version
from assur.errors import InputError
from assur.files.contents import Contents, contents_of, known_speed
from assur.files.limits import MOST_BYTES
from assur.files.source import Source
from assur.importers.source import LARGEST_FILE
from assur.importers.source import Source as Text
from assur.kinematics.mechanism import Mechanism
from assur.studio import document, limits
from assur.studio.kinds.structure import described
from assur.studio.request import Fields
from assur.studio.session import Answer, stamp_of

if TYPE_CHECKING:
    from assur.dynamics.machine import Machine
    from assur.studio.session import Session

LONGEST_TITLE = 200


def start(data: dict[str, Any], session: Session) -> Answer:
    """Say what can be opened, and the limits."""
    Fields(data, ())
    opened = session.given
    return Answer(
        {
            "version": version(),
            "examples": [
                {"name": name, "text": (make.__doc__ or "").strip().split("\n")[0]}
                for name, make in examples.ALL.items()
            ],
            "file": None
            if opened is None
            else {
                "title": opened.title,
                "saves": opened.is_saved,
                "others": session.others,
                "id": opened.id,
            },
            "limits": {
                "up": limits.MOST_UP,
                "links": limits.MOST_LINKS,
                "rows": limits.MOST_ROWS,
                "cells": limits.MOST_CELLS,
                "seconds": limits.SECONDS,
            },
        }
    )


def open_document(data: dict[str, Any], session: Session) -> Answer:
    """Open one of the three."""
    fields = Fields(data, ("example", "text", "name", "file"))
    ways = [way for way in ("example", "text", "file") if way in fields]
    if len(ways) != 1:
        message = "open needs one of example, text and file"
        raise InputError(message)
    if ways == ["example"]:
        return _example(fields)
    if ways == ["text"]:
        name = fields.text("name")[:LONGEST_TITLE] if "name" in fields else ""
        raw = fields.text("text").encode(errors="replace")
        return _opened(*read_text(name, raw), title=PurePath(name).stem)
    return _file(fields, session)


def _example(fields: Fields) -> Answer:
    name = fields.word("example", examples.ALL)
    return _opened(examples.ALL[name](), (), None, title=name)


def _file(fields: Fields, session: Session) -> Answer:
    opened = session.given
    if opened is None or not fields.flag("file"):
        raise fields.error("file", "the studio was started without a file")
    if opened.example is not None:
        return _opened(examples.ALL[opened.example](), (), None, title=opened.title)
    raw = opened.bytes()
    answer = _opened(*read_text(opened.title, raw), title=PurePath(opened.title).stem)
    saved = {"stamp": stamp_of(raw), "saves": opened.is_saved, "others": session.others}
    return Answer({**answer.header, **saved})


def read_text(name: str, raw: bytes) -> tuple[Contents, tuple[str, ...], Any]:
    """Return the contents of a text, what was left out, and its speed."""
    try:
        text = raw.decode("utf-8")
    except UnicodeDecodeError:
        # Linkage writes the code page of Windows.
        text = raw.decode("cp1252", errors="replace")
    if PurePath(name).suffix.lower() == ".toml" or importers.detect(name, text) is None:
        contents = contents_of(Source(name or "text", raw[: MOST_BYTES + 1]))
        if contents.mechanism.shape:
            message = f"{name or 'the text'} has {contents.mechanism.shape} designs: the studio "
            raise InputError(f"{message}shows one; choose it by assur solve --design, or delete")
        return contents, (), contents.input_speed
    source = Text(text.removeprefix("\ufeff"), name)
    if len(text) > LARGEST_FILE:
        raise source.error("", f"more than {LARGEST_FILE} letters: not the file of a linkage")
    imported = importers.read(source)
    contents = Contents(imported.mechanism, input_speed=known_speed(imported.input_speed))
    return contents, imported.omitted, imported.input_speed


def _opened(
    what: Mechanism | Machine | Contents, omitted: tuple[str, ...], speed: Any, *, title: str
) -> Answer:
    mechanism = what if isinstance(what, Mechanism) else what.mechanism
    assert mechanism is not None
    data = document.document_of(what)
    document.checked(data)
    return Answer(
        {
            "document": data,
            "title": title,
            "omitted": omitted,
            "speed": speed,
            "stamp": None,
            "saves": False,
            "others": 0,
            **described(mechanism),
        }
    )
