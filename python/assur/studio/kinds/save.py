"""``save``: to the file given, and to no other."""

from __future__ import annotations

import os
import secrets
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur.errors import InputError
from assur.files.errors import FileError
from assur.studio import document
from assur.studio.request import Fields
from assur.studio.session import Answer, stamp_of

if TYPE_CHECKING:
    from assur.studio.session import Session


def save(data: dict[str, Any], session: Session) -> Answer:
    """Write the document to the file, if it is still what was opened."""
    fields = Fields(data, ("document", "stamp", "force"), ("document",))
    opened = session.given
    if opened is None or opened.path is None or not opened.is_saved:
        message = "there is no TOML file to save to: export one"
        raise InputError(message, kind="no_file")
    raw = document.toml_of(fields["document"]).encode()
    target = Path(os.path.realpath(opened.path))
    stamp = stamp_of(opened.bytes()) if target.exists() else None
    if stamp is not None and stamp != fields["stamp"] and not fields.flag("force"):
        message = (
            f"{opened.title} has been changed by another window or program since it was opened"
        )
        raise InputError(message, kind="changed", hint="save all the same, or open it again")
    _write(target, raw, opened.title)
    return Answer({"stamp": stamp_of(raw), "title": opened.title})


def _write(target: Path, raw: bytes, name: str) -> None:
    """Replace the file at once, or leave it."""
    temporary = target.with_name(f".assur-{secrets.token_hex(4)}")
    try:
        temporary.write_bytes(raw)
        with suppress(OSError):
            temporary.chmod(target.stat().st_mode & 0o777)
        temporary.replace(target)
    except OSError as error:
        message = f"{name}: cannot be written: {error.strerror or error}"
        raise FileError(message, path=name) from error
    finally:
        with suppress(OSError):
            temporary.unlink()
