"""Sheets as SVG and PDF, by matplotlib: a figure as large as the paper, axes for each layer."""

from __future__ import annotations

import re
import warnings
from io import BytesIO
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import quoteattr

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle as Patch
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path

from assur.pictures.drawing.layers import valid_text
from assur.pictures.drawing.marks import (
    ARROW,
    ARROW_WIDTH,
    BEYOND,
    GAP,
    LETTER,
    TEXT_HEIGHT,
    THIN,
    Circle,
    Diameter,
    Distance,
    Filled,
    Outline,
    Text,
    number_text,
)
from assur.pictures.scene.geometry import left_of, unit_vector

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.drawing.marks import Mark
    from assur.pictures.drawing.sheet import Sheet

INCH = 25.4
POINTS = 72.0 / INCH
# Height of capitals as a part of a font's size.
CAPITALS = 0.72
GREY = "#55616D"
INKS = {"CENTRES": "#BE4230", "DIMENSIONS": GREY, "HATCHING": GREY, "DRIVER": "#1D5FB8"}
INK = "#17202A"
# Dashes and dots of centre lines, line widths.
DASH_DOT = (0.0, (8.0, 2.0, 1.5, 2.0))


def paper_bytes(sheet: Sheet, decimals: int, form: str) -> bytes:
    """Return the contents of an SVG or a PDF file."""
    try:
        import matplotlib as mpl
    except ImportError as error:  # pragma: no cover
        message = 'SVG and PDF need matplotlib: pip install "assur[plot]"'
        raise ImportError(message) from error

    width, height = sheet.size
    figure = Figure(figsize=(width / INCH, height / INCH))
    layers = list(dict.fromkeys(mark.layer for mark in sheet.marks))
    for layer in layers:
        ax = figure.add_axes((0.0, 0.0, 1.0, 1.0), gid=f"layer {layer}")
        ax.set(xlim=(0.0, width), ylim=(0.0, height))
        ax.set_axis_off()
        pen = _Pen(ax, sheet, INKS.get(layer, INK), decimals)
        for mark in sheet.marks:
            if mark.layer == layer:
                pen.draw(mark)
    stream = BytesIO()
    settings: Any = {"svg.hashsalt": "assur", "pdf.fonttype": 42, "svg.fonttype": "path"}
    with mpl.rc_context(settings), warnings.catch_warnings():
        # Names may be in any script; letters that the font lacks are boxes.
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        when = {"Date": None} if form == "svg" else {"CreationDate": None}
        figure.savefig(stream, format=form, metadata=when)
    raw = stream.getvalue()
    return _named_layers(raw, layers, sheet) if form == "svg" else raw


def _named_layers(raw: bytes, layers: list[str], sheet: Sheet) -> bytes:
    """Write the size in mm, and mark groups as the layers that Inkscape knows."""
    text = raw.decode()
    width, height = sheet.size
    text = re.sub(r'height="[\d.]+pt"', f'height="{height:g}mm"', text, count=1)
    text = re.sub(r'width="[\d.]+pt"', f'width="{width:g}mm"', text, count=1)
    space = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
    text = text.replace("<svg ", f"<svg {space}", 1)
    for layer in layers:
        name = quoteattr(layer)
        old = f"<g id={quoteattr(f'layer {layer}')}>"
        ident = quoteattr(re.sub(r"\s", "_", layer))
        text = text.replace(
            old, f'<g id={ident} inkscape:groupmode="layer" inkscape:label={name}>', 1
        )
    return text.encode()


class _Pen:
    """Draws marks on axes whose data are mm of the paper."""

    def __init__(self, ax: Any, sheet: Sheet, ink: str, decimals: int) -> None:
        self._ax, self._sheet, self._ink, self._decimals = ax, sheet, ink, decimals
        self._per = 1.0 / sheet.scale

    def draw(self, mark: Mark) -> None:
        if isinstance(mark, Outline):
            self._outline(mark)
        elif isinstance(mark, Circle):
            self._circle(mark)
        elif isinstance(mark, Filled):
            self._fill(self._at(mark.points))
        elif isinstance(mark, Text):
            self._text(self._at(mark.at), mark.text, mark.height, mark.anchor)
        elif isinstance(mark, Distance):
            self._distance(mark)
        else:
            self._diameter(mark)

    def _at(self, points: Float) -> Float:
        on_paper: Float = (points - self._sheet.origin) * self._sheet.scale
        return on_paper

    def _path(self, path: Any, weight: float, dash_dotted: bool = False) -> None:

        self._ax.add_artist(
            PathPatch(
                path,
                facecolor="none",
                edgecolor=self._ink,
                linewidth=weight * POINTS,
                linestyle=DASH_DOT if dash_dotted else "solid",
                capstyle="butt",
                joinstyle="round",
            )
        )

    def _outline(self, mark: Outline) -> None:
        self._path(_path_of(self._at(mark.points), mark), mark.weight, mark.dash_dotted)

    def _circle(self, mark: Circle) -> None:

        self._ax.add_artist(
            Patch(
                tuple(self._at(mark.centre)),
                mark.radius * self._sheet.scale,
                facecolor=self._ink if mark.filled else "none",
                edgecolor="none" if mark.filled else self._ink,
                linewidth=mark.weight * POINTS,
            )
        )

    def _fill(self, points: Float) -> None:

        self._ax.add_artist(Polygon(points, facecolor=self._ink, edgecolor="none"))

    def _text(self, at: Float, text: str, height: float, anchor: str, angle: float = 0.0) -> None:
        across = "left" if anchor == "left" else "center"
        upward = "center" if anchor == "middle" else "baseline"
        self._ax.text(
            *at, valid_text(text), fontsize=height * POINTS / CAPITALS, color=self._ink, ha=across,
            va=upward, rotation=np.degrees(angle), rotation_mode="anchor", parse_math=False,
        )  # fmt: skip

    def _line(self, start: Float, end: Float) -> None:

        self._path(Path(np.stack([start, end])), THIN)

    def _head(self, tip: Float, along: Float) -> None:
        """Draw an arrow head that points along a direction."""
        left = np.array([-along[1], along[0]])
        back = tip - ARROW * along
        self._fill(np.stack([tip, back + ARROW_WIDTH / 2 * left, back - ARROW_WIDTH / 2 * left]))

    def _distance(self, mark: Distance) -> None:
        first, second = (self._at(foot) for foot in mark.feet())
        for point, foot in ((mark.start, first), (mark.end, second)):
            self._extension(self._at(point), foot)
        length = float(np.hypot(*(second - first)))
        along = (second - first) / length if length else mark.along
        outside = length < 3.0 * ARROW
        reach = 2.0 * ARROW * along if outside else 0.0 * along
        self._line(first - reach, second + reach)
        self._head(first, along if outside else -along)
        self._head(second, -along if outside else along)
        angle = float(np.arctan2(along[1], along[0]))
        # Texts are read from below and from the right.
        if angle > np.pi / 2.0 + 1e-9 or angle <= -np.pi / 2.0 + 1e-9:
            angle += np.pi
        above = left_of(angle)
        text = number_text(mark.value, self._decimals)
        half = LETTER * TEXT_HEIGHT * len(text) / 2.0
        middle = (first + second) / 2.0
        if 2.0 * half > length:
            # Beside the dimension where it has no room in it.
            middle = second + (GAP + half) * along
            self._line(second + reach, middle + half * along)
        self._text(middle + GAP * above, text, TEXT_HEIGHT, "below", angle)

    def _extension(self, point: Float, foot: Float) -> None:
        gap = foot - point
        length = float(np.hypot(*gap))
        if length > GAP:
            unit = gap / length
            self._line(point + GAP * unit, foot + BEYOND * unit)

    def _diameter(self, mark: Diameter) -> None:
        away = unit_vector(mark.angle)
        tip = self._at(mark.centre + mark.radius * away)
        end = self._at(mark.text_at(self._per))
        count = f"{mark.count}× " if mark.count > 1 else ""
        text = f"{count}⌀{number_text(2.0 * mark.radius, self._decimals)}"
        self._line(tip, end)
        self._head(tip, -away)
        self._text(end + np.array([GAP, 0.0]), text, TEXT_HEIGHT, "left")


def _path_of(points: Float, mark: Outline) -> Any:
    """Return a path of lines and of arcs by their bulges."""
    bulges = np.zeros(len(points)) if mark.bulges is None else mark.bulges
    vertices, codes = [points[:1]], [np.array([Path.MOVETO])]
    count = len(points) if mark.closed else len(points) - 1
    for i in range(count):
        start, end = points[i], points[(i + 1) % len(points)]
        if bulges[i]:
            curve = _arc(start, end, float(bulges[i]))
            vertices.append(curve)
            codes.append(np.full(len(curve), Path.CURVE4))
        else:
            vertices.append(end[None])
            codes.append(np.array([Path.LINETO]))
    if mark.closed:
        vertices.append(points[:1])
        codes.append(np.array([Path.CLOSEPOLY]))
    return Path(np.concatenate(vertices), np.concatenate(codes).astype(np.uint8))


def _arc(start: Float, end: Float, bulge: float) -> Float:
    """Return the Bézier curves of an arc after its start."""
    chord = end - start
    left = np.array([-chord[1], chord[0]])
    centre = (start + end) / 2.0 + left * (1.0 - bulge**2) / (4.0 * bulge)
    radius = float(np.hypot(*(start - centre)))
    first = float(np.degrees(np.arctan2(*(start - centre)[::-1])))
    swept = float(np.degrees(4.0 * np.arctan(bulge)))
    low, high = sorted((first, first + swept))
    unit: Float = np.asarray(Path.arc(low, high).vertices, dtype=np.float64)
    curve: Float = centre + radius * unit
    return curve[1:] if swept > 0.0 else curve[::-1][1:]
