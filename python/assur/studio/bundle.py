"""The studio's modules one after another, and its styles: for the page, and for a notebook.

Names at the top of all modules differ from each other (a test holds that). One script opens at
once where two hundred modules, each fetched by another, take a second.
"""

from __future__ import annotations

import json
import re
from functools import cache
from importlib.resources import files
from posixpath import join, normpath
from typing import TYPE_CHECKING

from assur.pictures.page.bundle import inlined, plain
from assur.pictures.page.html import css

if TYPE_CHECKING:
    from collections.abc import Iterator

PAGE_ENTRY, WIDGET_ENTRY = "studio/page/start.js", "studio/page/widget.js"
STYLES = (
    *("studio", "forces/forces", "build/build", "panel/panel"),
    *("design/design", "design/projector", "help/help", "lesson/lesson"),
)
_IMPORT = re.compile(r'^import \{[^}]*\} from "(\.[^"]*)";$', re.MULTILINE)


@cache
def joined(entry: str = PAGE_ENTRY) -> str:
    """Return a module with all that it imports as one script, as it is written."""
    return "".join(map(plain, _modules(entry)))


@cache
def widget_script() -> str:
    """Return the module of the widget, with its style."""
    text = "".join(map(inlined, _modules(WIDGET_ENTRY)))
    return f"const STYLE={json.dumps(style())};\n{text}export default {{ render }};\n"


@cache
def style() -> str:
    """Return the style of the studio."""
    return css() + "".join(_text(f"studio/page/{name}.css") for name in STYLES)


def _modules(entry: str) -> list[str]:
    """Return the sources of a module and of all that it imports, which come first."""
    return [_text(path) for path in dict.fromkeys(_imported(entry))]


def _imported(path: str) -> Iterator[str]:
    for imported in _IMPORT.findall(_text(path)):
        yield from _imported(normpath(join(path.rpartition("/")[0], imported)))
    yield path


@cache
def _text(path: str) -> str:
    return files("assur").joinpath(path).read_text(encoding="utf-8")
