"""The studio as one script and one style, for a notebook: its modules one after another."""

from __future__ import annotations

import json
import re
from functools import cache
from importlib.resources import files
from posixpath import join, normpath
from typing import TYPE_CHECKING

from assur.pictures.page.bundle import inlined
from assur.pictures.page.html import css

if TYPE_CHECKING:
    from collections.abc import Iterator

ENTRY = "studio/page/widget.js"
PAGE = "studio/page/index.html"
_IMPORT = re.compile(r'^import \{[^}]*\} from "(\.[^"]*)";$', re.MULTILINE)
_STYLE = re.compile(r'href="/(studio/[^"]*\.css)"')


@cache
def script() -> str:
    """Return the widget's module: who is imported comes first."""
    text = "".join(inlined(_text(path)) for path in dict.fromkeys(_modules(ENTRY)))
    return f"const STYLE={json.dumps(style())};\n{text}export default {{ render }};\n"


@cache
def style() -> str:
    """Return the style of the studio, as its page has it."""
    return css() + "".join(_text(path) for path in _STYLE.findall(_text(PAGE)))


def _modules(path: str) -> Iterator[str]:
    for other in _IMPORT.findall(_text(path)):
        yield from _modules(normpath(join(path.rpartition("/")[0], other)))
    yield path


def _text(path: str) -> str:
    return files("assur").joinpath(path).read_text(encoding="utf-8")
