"""The page of a mechanism as a file, and as it is shown in a notebook."""

from __future__ import annotations

import base64
import hashlib
import html
import json
from functools import cache
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from assur._arrays import flag, real_array, real_number, short
from assur._files import checked_path, writing
from assur.errors import AssurError, InputError
from assur.pictures.page.bundle import script, stylesheet
from assur.pictures.page.payload import payload, played_of
from assur.pictures.page.svg import svg_picture
from assur.pictures.page.turn import Turn, require_one, turn_of, turn_of_rows
from assur.pictures.style import DARK, LIGHT

if TYPE_CHECKING:
    from os import PathLike

    from assur._faces import Mechanism, Motion
    from assur.pictures.page.payload import Played
    from assur.pictures.style import Style

# Colours of a page beside those of pictures: panels, edges, the ring of the dial.
PANELS = {
    False: {"panel": "#FFFFFF", "canvas": "#FBFCFD", "edge": "#D9DFE5", "hover": "#EEF3F9",
            "reach": "#9BB5DA", "on-driver": "#FFFFFF", "dark": "0"},
    True: {"panel": "#171D25", "edge": "#2A333C", "hover": "#222B36", "reach": "#2F568F",
           "on-driver": "#0F1419", "dark": "1"},
}  # fmt: skip
NOTEBOOK_HEIGHT = 640
# Durations, s: speeds and accelerations of others would not fit the numbers of a page.
SHORTEST, LONGEST = 1e-9, 1e9


def write_page(
    of: Mechanism | Motion | Turn,
    path: str | PathLike[str],
    *,
    q: Any = None,
    speed: Any = None,
    duration: Any = None,
    joint: Any = None,
    diagrams: Any = None,
    title: Any = None,
    dark: Any = None,
) -> None:
    """Write one self-contained page."""
    out = checked_path(path)
    if title is not None and not isinstance(title, str):
        message = f"title is {short(title)}: a text is needed"
        raise InputError(message)
    if dark is not None:
        dark = flag(dark, "dark")
    played, data = contents(of, q, speed, duration, joint, diagrams)
    data["title"] = out.stem if title is None else title
    text = page(played, data, dark)
    with writing(out):
        out.write_text(text, encoding="utf-8", newline="\n")


def notebook_html(of: Mechanism | Motion | Turn) -> str | None:
    """Return what a notebook shows: a static picture, alive where scripts run.

    None where there is nothing to play: the notebook then shows the repr.
    """
    try:
        played, data = contents(of)
    except AssurError:
        return None
    identifier = f"assur-{uuid4().hex}"
    start = f"""(() => {{
const host = document.getElementById({json.dumps(identifier)});
if (!host || host.shadowRoot) return;
{script()}
const shadow = host.attachShadow({{ mode: "open" }});
const style = document.createElement("style");
style.textContent = {_json(css())};
const root = document.createElement("div");
root.className = "assur embedded";
shadow.append(style, root);
host.style.height = "{NOTEBOOK_HEIGHT}px";
mount(root, {_json(data)});
}})();"""
    picture = svg_picture(played)
    return (
        f'<div id="{identifier}" class="assur-picture">{picture}</div>\n<script>{start}</script>\n'
    )


def notebook_svg(of: Mechanism | Motion) -> str | None:
    """Return the static picture alone."""
    try:
        return svg_picture(contents(of)[0])
    except AssurError:
        return None


def page(played: Played, data: dict[str, Any], dark: bool | None) -> str:
    """Return the page of one mechanism."""
    start = (
        f"{script()}\n"
        'window.assurPage = mount(document.getElementById("assur"), '
        'JSON.parse(document.getElementById("assur-data").textContent));\n'
    )
    style = f"html,body{{height:100%;margin:0}}\n{css()}"
    body = f"""<main id="assur" class="assur"{theme(dark)}>
{svg_picture(played, own_style=False)}
</main>"""
    return document(data["title"], style, body, data, start)


def theme(dark: bool | None) -> str:
    """Return the attribute of an element that is dark or light, not as the reader's system."""
    return "" if dark is None else f' data-theme="{"dark" if dark else "light"}"'


def document(title: str, style: str, body: str, data: Any, start: str) -> str:
    """Return a document: nothing in it comes from elsewhere, and nothing can be fetched."""
    policy = (
        f"default-src 'none'; script-src {_hash(start)}; style-src {_hash(style)}; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="assur">
<title>{html.escape(title)}</title>
<style>{style}</style>
</head>
<body>
{body}
<script id="assur-data" type="application/json">{_json(data)}</script>
<script type="module">{start}</script>
</body>
</html>
"""


@cache
def css() -> str:
    """Return the style with the colours of both schemes."""
    light, dark = (_variables(style, PANELS[style is DARK]) for style in (LIGHT, DARK))
    return (
        f".assur{{{light}color-scheme:light}}\n"
        f"@media (prefers-color-scheme:dark){{.assur:not([data-theme=light]){{{dark}"
        "color-scheme:dark}}\n"
        f".assur[data-theme=dark]{{{dark}color-scheme:dark}}\n{stylesheet()}"
    )


def _variables(style: Style, panel: dict[str, str]) -> str:
    names = ("canvas", "ink", "second", "faint", "grid", "driver", "path", "velocity")
    colours = {name: getattr(style, name) for name in (*names, "acceleration", "force", "error")}
    colours |= {f"group-{i}": colour for i, colour in enumerate(style.groups)} | panel
    return "".join(f"--{name}:{colour};" for name, colour in colours.items())


def contents(
    of: Mechanism | Motion | Turn,
    q: Any = None,
    speed: Any = None,
    duration: Any = None,
    joint: Any = None,
    diagrams: Any = None,
) -> tuple[Played, dict[str, Any]]:
    """Return what a page plays, and its numbers; errors name the argument."""
    if speed is not None:
        speed = real_number(speed, "speed")
    if duration is not None:
        duration = real_number(duration, "duration")
        if duration <= 0.0:
            message = f"duration is {duration:g} s, it must be positive"
            raise InputError(message)
        if not SHORTEST <= duration <= LONGEST:
            message = f"duration is {duration:g} s: from {SHORTEST:g} to {LONGEST:g} s are played"
            raise InputError(message, value=duration)
    turn = _turn(of, q, duration)
    played = played_of(turn)
    return played, payload(played, "", speed, joint, diagrams)


def _turn(of: Any, q: Any, duration: float | None) -> Turn:
    """Return the positions of a motion, or those of a mechanism's turn."""
    if isinstance(of, Turn):
        return of
    if not hasattr(of, "solve"):
        return turn_of_rows(of, duration)
    several = of.driver_count > 1
    q = None if q is None else real_array(q, "q")
    if q is None or (q.ndim == 0 and not several):
        return turn_of(of, q)
    require_one(of)
    return turn_of_rows(of.solve(q, order=0, on_error="nan"), duration)


def _hash(text: str) -> str:
    digest = base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii")
    return f"'sha256-{digest}'"


def _json(value: Any) -> str:
    """Return JSON that no HTML parser takes for an end of the script."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for letter in "<>&\u2028\u2029":
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return text
