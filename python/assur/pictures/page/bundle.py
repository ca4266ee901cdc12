"""The page's modules as one script: imports between them resolved by inlining.

Names at the top of all modules differ from each other (a test holds that), so that the modules
can stand one after another.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

# Imported modules come first.
MODULES = (
    *("elements", "numbers", "speeds", "words", "turn", "quantities", "view", "draw", "labels"),
    *("paths", "vectors", "dial", "chart", "player", "drag", "stage", "panel"),
    *("keys", "canvas", "playback", "driving", "main"),
)

_IMPORT = re.compile(r"^import \{[^}]*\} from \"\.[\w./]*\.js\";\n", re.MULTILINE)
_EXPORT = re.compile(r"^export (?=function|class|const|async)", re.MULTILINE)
_BLOCK_COMMENT = re.compile(r"^[ ]*/\*\*.*?\*/\n", re.MULTILINE | re.DOTALL)
_LINE_COMMENT = re.compile(r"^[ ]*//.*\n", re.MULTILINE)
_INDENT = re.compile(r"^[ ]+", re.MULTILINE)
_BLANK = re.compile(r"\n{2,}")
_NEEDLESS_END = re.compile(r"(?<=[;,{(\[])\n")
# Texts and templates are kept; of the rest blanks about signs go, about + and - not before another
# sign: `a - -b`.
_PIECE = re.compile(
    r"""("(?:\\.|[^"\\\n])*"|`(?:\\.|\$\{[^{}]*\}|[^`\\\n])*`"""
    r"""|/[^/\n ](?:\\.|[^/\\\n])*/[gu]*(?=[.,)]))"""
    r"""|[ ]*(=>|[=!]==|[<>*]=|\*\*|&&|\|\||\?\?=?|[=<>*?:,;(){}\[\]])[ ]*"""
    r"""|[ ]([-+/])[ ](?=[\w($.])"""
)


def module(name: str) -> str:
    """Return the source of a module."""
    return files(__package__).joinpath(f"{name}.js").read_text(encoding="utf-8")


@cache
def script() -> str:
    """Return all modules as one script without comments, which defines `mount`."""
    return "".join(inlined(module(name)) for name in MODULES)


def plain(source: str) -> str:
    """Return a module without imports and exports."""
    return _EXPORT.sub("", _IMPORT.sub("", source))


def inlined(source: str) -> str:
    """Return a module without imports, exports, comments and needless blanks."""
    lines = _tidy(_LINE_COMMENT.sub("", _BLOCK_COMMENT.sub("", plain(source))))
    return _PIECE.sub(lambda piece: piece[1] or piece[2] or piece[3], lines)


@cache
def stylesheet() -> str:
    """Return the page's style without needless blanks; colours are added by `html`."""
    source = files(__package__).joinpath("page.css").read_text(encoding="utf-8")
    return _tidy(source)


def _tidy(source: str) -> str:
    # No text and no template runs over lines (a test holds that), so indents mean nothing.
    lines = _BLANK.sub("\n", _INDENT.sub("", source)).lstrip("\n")
    return _NEEDLESS_END.sub("", lines)
