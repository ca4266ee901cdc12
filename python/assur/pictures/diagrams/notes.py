"""Texts on diagrams, kept clear of curves and of each other."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.font_manager import FontProperties

from assur.pictures.chart import MARK, TEXT
from assur.pictures.scene.labels import along, between
from assur.pictures.text import STEP, name_font, text_size

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.pictures.style import Style

# Names of lines: places tried along each; beyond this distance from others, points, none is better.
PLACES, FAR = 48, 24.0
NAME = 11.0
# Between a line and its name, points; what a name that is beside its line costs.
GAP, ASIDE = 3.0, 6.0
# Gaps between a point and its text that are tried, points; beyond ENOUGH from curves no place is
# better; what a point of gap costs, and a text that is beside its point and not above or below.
REACHES, ENOUGH, FARTHER, HABIT = (2.0, 8.0, 16.0, 28.0), 7.0, 0.35, 2.0
SHIFTS = (0.0, 8.0, -8.0, 16.0, -16.0, 24.0, -24.0)


class Note(NamedTuple):
    """A text that belongs to a point of a diagram, in the units of its data."""

    x: float
    y: float
    text: str
    colour: str
    gid: str = "mark text"
    marker: str | None = "o"
    size: float = TEXT
    # Where there is no room, nothing is written.
    optional: bool = False
    # Whether it may lie on its point, in an area.
    centred: bool = False


class Named(NamedTuple):
    """A curve with its name, written beside it."""

    x: Float
    y: Float
    text: str
    colour: str
    italic: bool = True


def settle(ax: Any) -> None:
    """Arrange the figure's axes, so that places in points are known."""
    figure = ax.figure
    if hasattr(figure, "get_figure"):
        figure = figure.get_figure(root=True)
    engine = figure.get_layout_engine()
    if engine is not None:
        with warnings.catch_warnings():
            # Of figures too small for their axes.
            warnings.simplefilter("ignore")
            engine.execute(figure)


def in_points(ax: Any, points: Float) -> Float:
    """Return points of the data in points of print."""
    shown: Float = ax.transData.transform(points)
    return shown * (72.0 / float(ax.figure.dpi))


def bounds(ax: Any) -> tuple[Float, Float]:
    """Return the corners of the axes in points of print."""
    box = ax.bbox.get_points() * (72.0 / float(ax.figure.dpi))
    return box[0], box[1]


def obstacles(ax: Any) -> Float:
    """Return points along all curves and about all texts of a diagram, points of print."""
    low, high = bounds(ax)
    lines: list[Float] = []
    segments = [np.zeros((2, 0, 2))]
    for line in ax.lines:
        if str(line.get_gid()).startswith(("zero", "event")):
            # Texts may cover them.
            continue
        points = np.column_stack([np.asarray(one, dtype=np.float64) for one in line.get_data()])
        if line.get_transform() != ax.transData:
            # A level or a place all across the axes.
            points = line.get_transform().transform(points) * (72.0 / float(ax.figure.dpi))
        else:
            points = in_points(ax, points)
        if line.get_linestyle() == "None":
            lines.extend(_box(point, MARK / 2.0 + 1.0) for point in points)
            continue
        segments.append(_within(points, low, high))
    boxes = [_outline(text, float(ax.figure.dpi)) for text in ax.texts if text.get_text()]
    starts, ends = np.concatenate(segments, axis=1)
    curves = between(starts, ends, STEP)
    return np.concatenate([curves, along([*lines, *boxes], STEP)])


def _within(points: Float, low: Float, high: Float) -> Float:
    """Return the starts and ends of a line's segments within a box, (2, n, 2)."""
    known: Any = np.isfinite(points).all(axis=1)
    pairs = known[:-1] & known[1:]
    starts, ends = points[:-1][pairs], points[1:][pairs]
    span = ends - starts
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = np.sort(np.array([low - starts, high - starts]) / span, axis=0)
    inside = (starts >= low) & (starts <= high)
    # A segment along an axis is within its limits all the way or nowhere.
    first = np.where(span == 0.0, np.where(inside, 0.0, 2.0), parts[0]).max(axis=1).clip(0.0)
    last = np.where(span == 0.0, np.where(inside, 1.0, -1.0), parts[1]).min(axis=1).clip(max=1.0)
    kept = first <= last
    starts, span = starts[kept], span[kept]
    return np.array([starts + first[kept, None] * span, starts + last[kept, None] * span])


def _box(point: Float, half: float) -> Float:
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    return point + half * corners


def _outline(text: Any, dpi: float) -> Float:
    box = text.get_window_extent().get_points() * (72.0 / dpi)
    (x0, y0), (x1, y1) = box
    middle = (y0 + y1) / 2.0
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0], [x0, middle], [x1, middle]])


def write_notes(ax: Any, notes: Sequence[Note], style: Style) -> None:
    """Mark points and write beside them, on a settled figure."""
    for note in notes:
        if note.marker:
            ax.plot(
                [note.x], [note.y], note.marker, markersize=MARK, markerfacecolor=style.canvas,
                markeredgecolor=note.colour, markeredgewidth=1.6, zorder=4.0, clip_on=False,
                gid="mark", scalex=False, scaley=False,
            )  # fmt: skip
    if not notes:
        return
    points = in_points(ax, np.array([(note.x, note.y) for note in notes]))
    middles = _placed(ax, points, notes)
    for note, point, middle in zip(notes, points, middles, strict=True):
        if middle is None:
            continue
        written = ax.annotate(
            note.text, (note.x, note.y), xytext=middle - point, textcoords="offset points",
            horizontalalignment="center", verticalalignment="center", color=style.ink,
            fontsize=note.size, zorder=5.0, gid=note.gid, parse_math=False,
        )  # fmt: skip
        if not note.centred:
            # The grid stops at the text.
            written.set_bbox({"facecolor": style.canvas, "edgecolor": "none", "pad": 0.6})
        written.set_in_layout(False)


def _placed(ax: Any, points: Float, notes: Sequence[Note]) -> list[Any]:
    """Return the middles of the texts, the nearest to their points that are clear."""
    angles = np.arange(16) * (np.pi / 8.0) + np.pi / 2.0
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    low, high = bounds(ax)
    blocked = obstacles(ax)
    found: list[Any] = []
    for note, point in zip(notes, points, strict=True):
        half = (np.array(text_size(note.text, FontProperties(size=note.size))) + 2.0) / 2.0
        best, place, free = -np.inf, point, -np.inf
        reaches = REACHES[:2] if note.optional else REACHES
        own = MARK / 2.0 if note.marker else 0.0
        tried = [
            (
                point + direction * (reach + own + np.abs(direction) @ half),
                FARTHER * reach + HABIT * (1.0 - abs(float(direction[1]))),
            )
            for reach in reaches
            for direction in directions
        ]
        if note.centred:
            shifts = [np.array([x, y]) for x in SHIFTS for y in (0.0, 3.0, -3.0)]
            tried += [(point + shift, 0.05 * float(np.abs(shift).sum())) for shift in shifts]
        for middle, cost in tried:
            border = float(min((middle - half - low).min(), (high - middle - half).min()))
            clear = min(distance(middle, half, blocked), border)
            # Texts may come closer to the border than to curves.
            worth = min(distance(middle, half, blocked), ENOUGH, 3.0 * border - 2.0) - cost
            if worth > best:
                best, place, free = worth, middle, clear
        if note.optional and free < 0.5:
            found.append(None)
            continue
        found.append(place)
        box = np.array([place - half, place + half])
        (x0, y0), (x1, y1) = box
        outline = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]])
        blocked = np.concatenate([blocked, along([outline], STEP)])
    return found


def name_lines(ax: Any, named: Sequence[Named]) -> None:
    """Write the names of curves beside them, where they are far from the others."""
    for one in named:
        font = name_font(NAME) if one.italic else FontProperties(size=TEXT)
        rows = one.text.split("\n")
        sizes = np.array([text_size(row, font) for row in rows])
        half = (sizes.max(axis=0) * (1.0, 1.4 * len(rows) - 0.4) + 2.0) / 2.0
        own = in_points(ax, np.column_stack([one.x, one.y]))
        own = own[np.isfinite(own).all(axis=1)]
        if len(own) < 2:
            continue
        line = along([own], STEP)
        others = along(
            [in_points(ax, np.column_stack([o.x, o.y])) for o in named if o is not one], STEP
        )
        every = obstacles(ax)
        low, high = bounds(ax)
        at = line[np.linspace(0, len(line) - 1, PLACES).astype(int)]
        best, place = -np.inf, at[0]
        for axis, side in ((1, 1.0), (1, -1.0), (0, 1.0), (0, -1.0)):
            for point in at:
                # As near as clears the line's own slope beside it.
                other = 1 - axis
                beside = line[np.abs(line[:, other] - point[other]) <= half[other]]
                middle = point.copy()
                middle[axis] = side * ((side * beside[:, axis]).max() + GAP + half[axis])
                room = min((middle - half - low).min(), (high - middle - half).min())
                worth = min(distance(middle, half, others), FAR)
                worth = min(worth, 3.0 * distance(middle, half, every), 3.0 * room)
                worth -= 0.05 * float(np.ptp(beside[:, axis])) + ASIDE * other
                if worth > best:
                    best, place = worth, middle
        x, y = ax.transData.inverted().transform(place * (float(ax.figure.dpi) / 72.0))
        written = ax.text(
            x, y, one.text, fontproperties=font, color=one.colour, horizontalalignment="center",
            verticalalignment="center", zorder=5.0, gid=f"name {one.text}", parse_math=False,
        )  # fmt: skip
        written.set_in_layout(False)


def distance(middle: Float, half: Float, points: Float) -> float:
    """Return how far a box is from points, negative inside."""
    if not len(points):
        return FAR
    apart = np.abs(points - middle) - half
    outside = np.hypot(*np.maximum(apart, 0.0).T)
    return float((outside + np.minimum(apart.max(axis=1), 0.0)).min())
