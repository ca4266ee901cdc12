"""``export``: the mechanism as a file to take away."""

from __future__ import annotations

import csv
import io
import tempfile
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.kinematics.table import Options, motion_columns
from assur.pictures.page.turn import turn_of
from assur.studio import document
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion
    from assur.studio.session import Session

ROWS, FILM_ROWS = 361, 73
LONGEST_NAME = 80
TYPES = {
    "toml": "application/toml",
    "csv": "text/csv",
    "svg": "image/svg+xml",
    "html": "text/html",
    "dxf": "image/vnd.dxf",
    "gif": "image/gif",
}
# Modules that a format needs, with the extra that installs them.
NEEDS = {"svg": ("matplotlib", "plot"), "gif": ("matplotlib", "plot"), "dxf": ("ezdxf", "drawing")}


def export(data: dict[str, Any], session: Session) -> Answer:
    """Return the bytes of a file, its name and its type."""
    known = ("document", "format", "q", "speed", "rows", "name", "paths", "dark")
    fields = Fields(data, known, ("document", "format"))
    kind = fields.word("format", TYPES)
    if kind in NEEDS and find_spec(NEEDS[kind][0]) is None:
        module, extra = NEEDS[kind]
        message = f"{kind} needs {module}: pip install assur[{extra}]"
        raise InputError(message, kind="missing_package")
    mechanism = document.read_mechanism(fields["document"])
    session.deadline.check()
    raw = WRITERS[kind](mechanism, fields)
    stem = _stem(fields.text("name") if "name" in fields else "")
    header = {"name": f"{stem}.{kind}", "type": TYPES[kind], "size": len(raw)}
    return Answer(header, {"bytes": np.frombuffer(raw, np.uint8)})


def _stem(name: str) -> str:
    """Return a name that every system takes."""
    kept = "".join(letter if letter.isalnum() or letter in " -_" else "_" for letter in name)
    return kept.strip()[:LONGEST_NAME] or "mechanism"


def _toml(mechanism: Mechanism, fields: Fields) -> bytes:
    del mechanism
    return document.toml_of(fields["document"]).encode()


def _csv(mechanism: Mechanism, fields: Fields) -> bytes:
    """Return the table of the turn, with velocities if a speed is given."""
    columns = motion_columns(
        _motion(mechanism, fields, ROWS, 2), Options(speed=fields.optional("speed"))
    )
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([column.name for column in columns])
    writer.writerows(zip(*(column.values.tolist() for column in columns), strict=True))
    return text.getvalue().encode()


def _motion(mechanism: Mechanism, fields: Fields, default: int, order: int) -> Motion:
    rows = fields.rows(default)
    if mechanism.driver_count > 1:
        q = np.asarray(fields.drivers("q", mechanism))[None]
    else:
        q = turn_of(mechanism, None, rows).coordinates()
    return mechanism.solve(q, order=order, on_error="nan")


def _svg(mechanism: Mechanism, fields: Fields) -> bytes:
    return _drawing(mechanism, fields, ".svg")


def _dxf(mechanism: Mechanism, fields: Fields) -> bytes:
    return _drawing(mechanism, fields, ".dxf")


def _drawing(mechanism: Mechanism, fields: Fields, ending: str) -> bytes:
    q = fields.drivers("q", mechanism)
    return _written(ending, lambda path: mechanism.to_drawing(path, q=q, title=_title(fields)))


def _html(mechanism: Mechanism, fields: Fields) -> bytes:
    q = fields.optional("q") if mechanism.driver_count == 1 else None
    speed, paths = fields.optional("speed"), fields["paths"]
    if mechanism.driver_count > 1:
        message = "a page plays one driver; this mechanism has several"
        raise InputError(message)
    return _written(
        ".html",
        lambda path: mechanism.to_html(path, q=q, speed=speed, joint=paths, title=_title(fields)),
    )


def _gif(mechanism: Mechanism, fields: Fields) -> bytes:
    motion, paths = _motion(mechanism, fields, FILM_ROWS, 0), fields["paths"]
    dark = fields.flag("dark")
    return _written(".gif", lambda path: motion.animate(path, joint=paths, dark=dark))


def _title(fields: Fields) -> str:
    return fields.text("name")[:LONGEST_NAME] if "name" in fields else ""


def _written(ending: str, write: Callable[[Path], Any]) -> bytes:
    """Return the bytes written to a file, in a folder that nobody else can read."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"mechanism{ending}")
        write(path)
        return path.read_bytes()


WRITERS: dict[str, Callable[[Mechanism, Fields], bytes]] = {
    "toml": _toml,
    "csv": _csv,
    "svg": _svg,
    "html": _html,
    "dxf": _dxf,
    "gif": _gif,
}
