"""Diagrams of a motion's quantities: value, velocity, acceleration, jerk; see `Motion.diagram`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._validate import checked_entries, whole_number
from assur.errors import InputError
from assur.pictures import chart
from assur.pictures.diagrams.line_names import Named, name_lines
from assur.pictures.diagrams.notes import Note, write_notes
from assur.pictures.diagrams.peaks import is_flat, peaks
from assur.pictures.diagrams.quantities import quantities
from assur.pictures.diagrams.sources import AlongDriver, OverTime
from assur.pictures.numerals import number
from assur.pictures.points import settle
from assur.pictures.style import blend, style_of
from assur.pictures.text import name_font, printable, shortened

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Motion, TimedMotion
    from assur.pictures.diagrams.quantities import Line, Quantity
    from assur.pictures.diagrams.sources import Source
    from assur.pictures.style import Style

# Diagrams of one figure: more are too small to be read.
MOST_PANELS = 12
# Height of one diagram in a column, inches.
LOW = 2.6
# A curve whose range is this multiple of that of its middle nine tenths runs to infinity.
RUNAWAY, MIDDLE, KEPT = 12.0, (5.0, 95.0), 1.0
DASHED = (0.0, (4.0, 2.0))
BAND = 0.22
# Above and below the curves, relative to their range: for the extremes.
ROOM = 0.22


class Shown(NamedTuple):
    """A line of a diagram with what distinguishes it from others."""

    of: Quantity
    line: Line
    name: str
    colour: str
    width: float
    dashes: Any


def motion_diagram(
    motion: Motion,
    name: Any,
    ax: Any,
    speeds: tuple[Float, Float, Float] | None,
    orders: Any,
    degrees: bool,
    dark: bool,
) -> Any:
    """See `Motion.diagram`."""
    source = AlongDriver(motion, speeds, degrees)
    shown = quantities(motion, name)
    return diagrams(source, shown, ax, orders, style_of(dark), listed=not isinstance(name, str))


def timed_diagram(
    timed: TimedMotion, name: Any, ax: Any, orders: Any, degrees: bool, dark: bool
) -> Any:
    """See `TimedMotion.diagram`."""
    source = OverTime(timed, degrees)
    shown = quantities(timed.motion, name)
    return diagrams(source, shown, ax, orders, style_of(dark), listed=not isinstance(name, str))


def diagrams(
    source: Source, shown: list[Quantity], ax: Any, orders: Any, style: Style, listed: bool = False
) -> Any:
    """Draw one diagram per order; `listed`: several quantities, each with its name beside it."""
    chosen = _checked_orders(orders, source.orders)
    count = len(chosen)
    rows, columns = (2, 2) if count == 4 else (count, 1)
    panels = [_Panel(source, shown, order, style) for order in chosen]
    axes = chart.chart_axes(ax, style, rows, columns, chart.HEIGHT if count in (1, 4) else LOW)
    for i, (panel, axis) in enumerate(zip(panels, np.atleast_1d(axes).flat, strict=True)):
        panel.draw(axis, listed, last=ax is not None or i >= count - columns)
    settle(np.atleast_1d(axes).flat[0])
    for panel, axis in zip(panels, np.atleast_1d(axes).flat, strict=True):
        panel.write(axis)
    return axes


def _checked_orders(orders: Any, highest: int) -> list[int]:
    if orders is None:
        return list(range(highest + 1))
    listed = checked_entries(orders, "orders", MOST_PANELS)
    for order in listed:
        whole_number(order, "orders", 0, 3, needed="0 (value), 1, 2 or 3 is needed")
        if order > highest:
            message = (
                f"orders has {order}: this motion was solved to order {highest}; "
                f"solve(q, order={order}) has more"
            )
            raise InputError(message)
    return [int(order) for order in listed]


class _Panel:
    """The diagram of one order."""

    def __init__(
        self, source: Source, quantities: list[Quantity], order: int, style: Style
    ) -> None:
        self.source, self.quantities, self.order, self.style = source, quantities, order, style
        self.lines = [shown for k in range(len(quantities)) for shown in self._shown(k)]
        self.designs = len(self.lines[0].line.values)

    def _shown(self, k: int) -> list[Shown]:
        of = self.quantities[k]
        lines = self.source.lines(of, self.order)
        several = len(self.quantities) > 1
        sized = any(line.part == "v" for line in lines)
        batch = len(lines[0].values) > 1
        if sized and (several or batch):
            lines = [line for line in lines if line.part == "v"]
        colours = (self.style.ink, self.style.velocity, self.style.acceleration, self.style.ink)
        colour = self.style.group(k) if several else colours[self.order]
        shown = []
        for line in lines:
            symbol = {"": "", "v": "|{}|".format("pvaj"[self.order])}.get(line.part, line.part)
            alone = of.axis is not None or line.part == ""
            name = of.shown if alone else f"{of.name} {symbol}" if several else symbol
            if several and line.part == "v":
                name = of.name
            thin = sized and line.part != "v"
            dashes = DASHED if line.part == "y" and of.axis is None else "solid"
            shown.append(Shown(of, line, name, colour, 1.3 if thin else 2.2, dashes))
        return shown

    def draw(self, ax: Any, listed: bool, last: bool) -> None:
        """Draw the curves; their names and extremes come when all axes have their places."""
        x, style = self.source.x, self.style
        self.named = listed or len(self.lines) > 1
        values = np.concatenate([shown.line.values.reshape(-1) for shown in self.lines])
        kept = _kept(values)
        for shown in self.lines:
            gid = f"curve {shown.name or shown.of.name}"
            middle = _band(ax, x, shown, style) if self.designs > 1 else shown.line.values[0]
            ax.plot(
                x, middle, color=shown.colour, linewidth=shown.width, linestyle=shown.dashes,
                gid=gid, solid_capstyle="round",
            )  # fmt: skip
        ax.set_xlim(float(x.min()), float(x.max()))
        chart.headroom(ax, kept, ROOM)
        if all(shown.line.part == "v" for shown in self.lines):
            ax.set_ylim(bottom=0.0)
        if self.source.in_degrees:
            chart.degree_ticks(ax, float(x.min()), float(x.max()))
        known = kept[np.isfinite(kept)]
        title, unit = self.source.title(self.quantities[0].kind, self.order)
        unit, self.power = chart.scaled(ax, unit, float(np.abs(known).max(initial=0.0)))
        chart.title(ax, f"{title}, {unit}", style)
        if self.order or (known.size and known.min() < 0.0 < known.max()):
            chart.zero_line(ax, style)
        self._name(ax, listed)
        if last:
            ax.set_xlabel(self.source.label, color=style.second, fontsize=chart.TEXT)
        else:
            ax.tick_params(labelbottom=False)

    def _name(self, ax: Any, listed: bool) -> None:
        """Write what it is of on the right, above the diagram."""
        designs = f"{self.designs} designs" if self.designs > 1 else ""
        name = "" if listed else shortened(printable(self.quantities[0].shown))
        if designs:
            text = f"{name}, {designs}" if name else designs
            ax.set_title(
                text, loc="right", color=self.style.second, fontsize=chart.TEXT, parse_math=False
            )
        elif name:
            font = name_font() if self.quantities[0].kind == "joint" else None
            ax.set_title(
                name, loc="right", color=self.style.second, fontproperties=font, parse_math=False,
                **({} if font else {"fontsize": chart.TEXT + 1.0}),
            )  # fmt: skip

    def write(self, ax: Any) -> None:
        """Write names and extremes clear of the curves."""
        notes = [note for shown in self.lines for note in self._extremes(ax, shown)]
        write_notes(ax, notes, self.style)
        low, high = ax.get_ylim()
        named = []
        for shown in self.lines:
            values = _median(shown.line.values)
            name = self._written(shown, values)
            inside = np.where((values >= low) & (values <= high), values, np.nan)
            if name:
                named.append(Named(self.source.x, inside, name, shown.colour, self.named))
        name_lines(ax, named)

    def _written(self, shown: Shown, values: Float) -> str:
        """Return the name beside a line, or the value of a single line that is constant."""
        if self.named:
            return shown.name
        known = values[np.isfinite(values)]
        if not known.size or self.designs > 1 or not is_flat(values):
            return ""
        return f"{number(float(known[0]) / self.power)} throughout"

    def _extremes(self, ax: Any, shown: Shown) -> list[Any]:
        """Return notes at the greatest and the least value of a line, over all designs."""
        values, x = shown.line.values, self.source.x
        thin = shown.width < 2.0
        if not np.isfinite(values).any() or thin:
            return []
        gid = f"extreme {shown.name or shown.of.name}"
        if self.designs == 1 and is_flat(values[0]):
            return []
        notes = []
        size = float(np.nanmax(np.abs(values)))
        span = float(np.nanmax(values) - np.nanmin(values)) / self.power
        low, high = ax.get_ylim()
        for sign in (1, -1):
            if shown.line.part == "v" and sign < 0:
                continue
            best = np.where(np.isfinite(values), sign * values, -np.inf).max(axis=1)
            design = int(np.argmax(best))
            slopes = None if shown.line.slopes is None else shown.line.slopes[design]
            again = self.source.again(shown.of, self.order, shown.line.part, design)
            extremes = peaks(x, values[design], slopes, again)
            if not extremes:
                continue
            peak = extremes[0 if sign > 0 else 1]
            value = 0.0 if abs(peak.y) < 1e-12 * size else peak.y
            text = f"{number(value / self.power, span)} at {self.source.place(peak.x)}"
            inside = low <= value <= high
            marker = "o" if inside else "^" if sign > 0 else "v"
            y = value if inside else high if sign > 0 else low
            notes.append(Note(peak.x, y, text, shown.colour, gid, marker, optional=not inside))
        return notes


def _kept(values: Float) -> Float:
    """Return the values that fix the limits: without those that run to infinity at dead points."""
    known = values[np.isfinite(values)]
    if known.size < 3:
        return known
    low, high = np.percentile(known, MIDDLE)
    span = float(high - low)
    if span <= 0.0 or float(np.ptp(known)) < RUNAWAY * span:
        return known
    return np.clip(known, low - KEPT * span, high + KEPT * span)


def _median(values: Float) -> Float:
    """Return the median of the designs that have a position."""
    if len(values) == 1:
        alone: Float = values[0]
        return alone
    medians: Float = np.full(values.shape[1], np.nan)
    known = np.isfinite(values).any(axis=0)
    medians[known] = np.nanmedian(values[:, known], axis=0)
    return medians


def _band(ax: Any, x: Float, shown: Shown, style: Style) -> Float:
    """Draw from the least to the greatest of the designs; return the median."""
    values = shown.line.values
    known = np.isfinite(values).any(axis=0)
    low = np.where(known, np.where(np.isfinite(values), values, np.inf).min(axis=0), np.nan)
    high = np.where(known, np.where(np.isfinite(values), values, -np.inf).max(axis=0), np.nan)
    gid = f"band {shown.name or shown.of.name}"
    ax.fill_between(
        x, low, high, color=blend(shown.colour, style.canvas, BAND), linewidth=0.0, gid=gid
    )
    for edge in (low, high):
        ax.plot(x, edge, color=shown.colour, linewidth=0.7, alpha=0.6, gid=f"edge {shown.of.name}")
    return _median(values)
