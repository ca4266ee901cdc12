"""The figures of the two papers on the slider-crank, each by one call."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Literal, overload

import numpy as np

from assur._arrays import flag, real_number
from assur._other_names import renamed_rates
from assur._validate import checked_entries, one_of, refuse_without_speed, whole_number
from assur.errors import InputError
from assur.papers.slider_crank.theory import contour, rod_angle, rod_point, stroke

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import AxesLike, Panels
    from assur.kinematics.quantity import Analogues
    from assur.pictures.diagrams.quantities import Line, Quantity

# Points of a curve over a turn.
POINTS = 721
# Curves of one diagram; rows or columns of diagrams: more cannot be read.
MOST_CURVES, MOST_PANELS = 100, 12
# Points between the dead points, where a relative deviation is defined.
BETWEEN = 1001


def plot_contour(
    phi: float, crank: float, rod: float, *, ax: Axes | None = None, dark: bool = False
) -> Axes:
    """Draw the closed vector contour l₁ + l₂ = l₃ at one position (needs matplotlib).

    Parameters
    ----------
    phi : float
        Crank angle, rad.
    crank, rod : float
        Lengths, m.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Colours for a dark canvas.

    Returns
    -------
    matplotlib.axes.Axes
        The axes drawn on.

    References
    ----------
    Chernysh et al. (2021), figure 2.

    Examples
    --------
    >>> import assur, math
    >>> axes = assur.slider_crank.plot_contour(math.pi / 3, 0.11, 0.407)
    >>> [text.get_text() for text in axes.texts if text.get_text().startswith("l")]
    ['l₁', 'l₂', 'l₃']
    """
    from assur.pictures.axes import canvas, scale_bar
    from assur.pictures.style import style_of
    from assur.pictures.text import name_font, write_names

    corners = contour(phi, crank, rod)
    o, a, b, _ = corners
    style = style_of(dark)
    on = canvas(ax, (corners.min(axis=0), corners.max(axis=0)), style, float(crank))
    lines = []
    for start, end, name, colour in (
        (o, a, "l₁", style.driver),
        (a, b, "l₂", style.ink),
        (o, b, "l₃", style.path),
    ):
        on.ax.annotate(
            "", end, start, gid=f"vector {name}",
            arrowprops={
                "arrowstyle": "-|>", "color": colour, "linewidth": 2.2, "shrinkA": 0.0,
                "shrinkB": 0.0, "mutation_scale": 16.0,
            },
        )  # fmt: skip
        lines.append(np.array([start, end]))
        along = end - start
        across = np.array([-along[1], along[0]]) / math.sqrt(float((along * along).sum()))
        # Outside the triangle: the middle of it is on the other side.
        middle = (start + end) / 2.0
        outward = 1.0 if float(((middle - corners[:3].mean(axis=0)) * across).sum()) > 0.0 else -1.0
        on.ax.annotate(
            name, middle, xytext=tuple(12.0 * outward * across), textcoords="offset points",
            fontproperties=name_font(), color=colour, horizontalalignment="center",
            verticalalignment="center", gid=f"name {name}",
        )  # fmt: skip
    write_names(
        on, ["O", "A", "B"], corners[:3], np.full(3, 4.0), lines, ["name O", "name A", "name B"]
    )
    for name, point in zip("OAB", corners[:3], strict=True):
        on.ax.plot(
            *point, "o", markersize=7.0, markerfacecolor=style.canvas, markeredgecolor=style.ink,
            markeredgewidth=1.6, zorder=4.0, gid=f"joint {name}", scalex=False, scaley=False,
        )  # fmt: skip
    scale_bar(on)
    return on.ax


def plot_positions(
    phi: float,
    crank: float,
    rod: float,
    *,
    along: float | None = None,
    across: float = 0.0,
    ax: Axes | None = None,
    dark: bool = False,
) -> Axes:
    """Draw the mechanism at one position with the paths of A, B and a point of the rod.

    Parameters
    ----------
    phi : float
        Crank angle, rad.
    crank, rod : float
        Lengths, m.
    along, across : float
        The point S2, m, as for `rod_point`; the rod's middle by default.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Colours for a dark canvas.

    Returns
    -------
    matplotlib.axes.Axes
        The axes drawn on.

    References
    ----------
    Chernysh et al. (2021), figure 4.

    Examples
    --------
    >>> import assur, math
    >>> axes = assur.slider_crank.plot_positions(math.pi / 3, 0.11, 0.407)
    >>> [line.get_gid() for line in axes.lines if str(line.get_gid()).startswith("path")]
    ['path A', 'path B', 'path S2']
    """
    from assur.mechanisms.named import SliderCrank
    from assur.pictures.style import style_of

    style = style_of(dark)
    phi, crank, rod = (
        real_number(value, name) for value, name in ((phi, "phi"), (crank, "crank"), (rod, "rod"))
    )
    place = rod / 2.0 if along is None else real_number(along, "along")
    across = real_number(across, "across")
    ax = SliderCrank(crank, rod).plot(phi, ax=ax, dark=dark)
    turn = np.linspace(0.0, 2.0 * math.pi, POINTS)
    for name, at in (("A", 0.0), ("B", rod), ("S2", place)):
        offset = across if name == "S2" else 0.0
        path = rod_point(turn, crank, rod, at, offset).value
        ax.plot(
            *path.T, color=style.path, linewidth=1.4, zorder=1.5, gid=f"path {name}", scalex=False,
            scaley=False,
        )  # fmt: skip
    point = rod_point(phi, crank, rod, place, across).value
    ax.plot(
        *point, "o", markersize=5.0, color=style.path, zorder=6.0, gid="point S2", scalex=False,
        scaley=False,
    )  # fmt: skip
    from assur.pictures.text import name_font

    ax.annotate(
        "S₂", (point[0], point[1]), xytext=(7.0, 9.0), textcoords="offset points",
        fontproperties=name_font(), color=style.path, horizontalalignment="center",
        verticalalignment="center", gid="name S2",
    )  # fmt: skip
    return ax


class _Formulas:
    """A quantity of the papers over the crank's angle; see `assur.pictures.diagrams.sources`."""

    titles: ClassVar[dict[str, tuple[str, str, str]]] = {
        "stroke": ("Stroke s, {}", "Velocity v, {}", "Acceleration a, {}"),
        "rod": ("Rod's angle φ₂, {}", "Rod's velocity ω₂, {}", "Rod's acceleration ε₂, {}"),
    }

    def __init__(
        self, quantity: str, lengths: tuple[float, float], speeds: Any, degrees: bool
    ) -> None:
        self._of = stroke if quantity == "stroke" else rod_angle
        self._quantity, self._lengths, self._speeds = quantity, lengths, speeds
        turn = np.linspace(0.0, 2.0 * math.pi, POINTS)
        self.in_degrees, self.orders = degrees, 2
        self.x: Float = np.degrees(turn) if degrees else turn
        self.label = "φ" if degrees else "φ, rad"

    def place(self, x: float) -> str:
        """Write a crank angle."""
        from assur.pictures.numerals import degrees_text, radians_text

        return degrees_text(x, 360.0) if self.in_degrees else radians_text(x)

    def title(self, kind: str, order: int) -> tuple[str, str]:
        """Return what a diagram shows, and its unit."""
        del kind
        name = self.titles[self._quantity][order].removesuffix(", {}")
        unit = "m" if self._quantity == "stroke" else "rad"
        if order == 0:
            return name, "°" if unit == "rad" and self.in_degrees else unit
        power = "" if order == 1 else "²"
        return name, f"{unit}/rad{power}" if self._speeds is None else f"{unit}/s{power}"

    def lines(self, of: Quantity, order: int) -> list[Line]:
        """Return the curve."""
        from assur.pictures.diagrams.quantities import Line

        del of
        return [Line("", self._values(self.x, order)[None], None)]

    def again(self, of: Quantity, order: int, part: str, design: int) -> Any:
        """Return the function itself."""
        del of, part, design
        return lambda x: self._values(x, order)

    def _values(self, x: Float, order: int) -> Float:
        analogues: Analogues = self._of(np.radians(x) if self.in_degrees else x, *self._lengths)
        if order == 0:
            in_degrees = self._quantity == "rod" and self.in_degrees
            return np.degrees(analogues.value) if in_degrees else analogues.value
        if self._speeds is None:
            return analogues.d1 if order == 1 else analogues.d2
        speed, acceleration = self._speeds
        return (
            analogues.velocity(speed) if order == 1 else analogues.acceleration(speed, acceleration)
        )


@renamed_rates
@overload
def plot_motion(
    quantity: Literal["stroke", "rod"],
    crank: float,
    rod: float,
    *,
    speed: float | None = ...,
    acceleration: float = ...,
    orders: int,
    ax: AxesLike | None = ...,
    degrees: bool = ...,
    dark: bool = ...,
) -> Axes: ...
@overload
def plot_motion(
    quantity: Literal["stroke", "rod"],
    crank: float,
    rod: float,
    *,
    speed: float | None = ...,
    acceleration: float = ...,
    orders: Sequence[int] | None = ...,
    ax: AxesLike | None = ...,
    degrees: bool = ...,
    dark: bool = ...,
) -> Panels: ...
def plot_motion(
    quantity: Literal["stroke", "rod"],
    crank: float,
    rod: float,
    *,
    speed: float | None = None,
    acceleration: float = 0.0,
    orders: int | Sequence[int] | None = None,
    ax: AxesLike | None = None,
    degrees: bool = True,
    dark: bool = False,
) -> Axes | Panels:
    """Draw the stroke or the rod's angle with its velocity and acceleration over a turn.

    Parameters
    ----------
    quantity : {"stroke", "rod"}
        The slider's stroke, or the angle of the rod.
    crank, rod : float
        Lengths, m.
    speed, acceleration : float, optional
        Of the crank, rad/s, rad/s²; analogues are drawn without a speed.
    orders : int or sequence of int, optional
        0 the value, 1 velocity, 2 acceleration; all by default.
    ax : matplotlib axes or array of them, optional
        Where to draw, one for each order; a new figure by default.
    degrees : bool
        Whether angles are in degrees.
    dark : bool
        Colours for a dark canvas.

    Returns
    -------
    matplotlib.axes.Axes or ndarray of them
        The axes drawn on, one for each order.

    References
    ----------
    Chernysh et al. (2021), figures 5 to 7 (stroke) and 8 to 10 (rod).

    Examples
    --------
    >>> import assur
    >>> axes = assur.slider_crank.plot_motion("stroke", 0.11, 0.407, speed=31.0, orders=1)
    >>> axes.get_title(loc="left"), [text.get_text() for text in axes.texts]
    ('Velocity v, m/s', ['3.53 at 76°', '−3.53 at 284°'])
    """
    from assur.pictures.diagrams.diagram import diagrams
    from assur.pictures.diagrams.quantities import Quantity
    from assur.pictures.style import style_of

    one_of(quantity, ("stroke", "rod"), "quantity")
    lengths = real_number(crank, "crank"), real_number(rod, "rod")
    refuse_without_speed(speed, "speed", acceleration=acceleration)
    speeds = None
    if speed is not None:
        speeds = real_number(speed, "speed"), real_number(acceleration, "acceleration")
    source = _Formulas(quantity, lengths, speeds, flag(degrees, "degrees"))
    # The title has its name.
    of = Quantity("slide" if quantity == "stroke" else "link", "")
    axes: Axes | Panels = diagrams(source, [of], ax, orders, style_of(dark))
    return axes


def plot_convergence(
    k: float | Sequence[float] = (1.5, 3.0, 5.0),
    *,
    count: int = 8,
    ax: AxesLike | None = None,
    dark: bool = False,
) -> Panels:
    """Draw the largest error of the stroke's series over its harmonics, and over its terms.

    Parameters
    ----------
    k : float or sequence of float
        Ratios rod / crank, above 1.
    count : int
        The greatest number of even harmonics, and of terms.
    ax : pair of matplotlib axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Colours for a dark canvas.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        Errors per crank length: over the even harmonics kept with all terms, and over the terms
        kept in each coefficient with all harmonics.

    References
    ----------
    Chernysh et al. (2021), equations 11 to 14.

    Examples
    --------
    >>> import assur
    >>> axes = assur.slider_crank.plot_convergence((3.0, 5.0), count=4)
    >>> [round(float(line.get_ydata()[0]), 6) for line in axes[1].lines]  # formula 14
    [0.004906, 0.001021]
    """
    from assur.pictures import chart
    from assur.pictures.diagrams.line_names import Named, name_lines
    from assur.pictures.points import settle
    from assur.pictures.style import style_of

    style, last = style_of(dark), whole_number(count, "count", 1, 100)
    ratios = [real_number(value, "k") for value in checked_entries(k, "k", MOST_CURVES)]
    axes: Panels = chart.chart_axes(ax, style, 1, 2)
    counts = np.arange(1, last + 1)
    phi = np.linspace(0.0, 2.0 * math.pi, POINTS)
    named: list[list[Named]] = [[], []]
    for i, ratio in enumerate(ratios):
        exact = stroke(phi, 1.0, ratio).value
        for which, panel in enumerate(axes):
            errors = np.array([_error(phi, ratio, exact, n, last, which) for n in counts.tolist()])
            colour = style.group(i)
            panel.semilogy(
                counts, errors, "o-", color=colour, linewidth=1.8, markersize=4.5,
                gid=f"curve k = {ratio:g}",
            )  # fmt: skip
            named[which].append(Named(counts.astype(float), errors, f"k = {ratio:g}", colour))
    for panel, text in zip(
        axes, ("even harmonics, all terms", "terms, all harmonics"), strict=True
    ):
        panel.set_xticks(counts)
        panel.set_xlabel(text, color=style.second, fontsize=chart.TEXT)
        chart.title(panel, "Largest error of the stroke / crank", style)
        panel.minorticks_off()
    settle(axes[0])
    for panel, lines in zip(axes, named, strict=True):
        name_lines(panel, lines)
    return axes


def _error(phi: Float, k: float, exact: Float, n: int, last: int, by_terms: int) -> float:
    harmonics, terms = (2 * last, n) if by_terms else (2 * n, None)
    near = stroke(phi, 1.0, k, method="series", harmonics=harmonics, terms=terms).value
    return float(np.abs(near - exact).max())


def plot_deviation(
    lam: float = 1.0 / 3.0,
    n: int | Sequence[int] = (1, 2),
    *,
    quantity: Literal["stroke", "d1"] | Sequence[Literal["stroke", "d1"]] = ("stroke", "d1"),
    ax: AxesLike | None = None,
    dark: bool = False,
) -> Panels:
    """Draw how far approximations of the continued fraction are off, per cent of the exact value.

    Parameters
    ----------
    lam : float
        λ = crank / rod, below 1.
    n : int or sequence of int
        Numbers of the approximations: a column each.
    quantity : {"stroke", "d1"} or sequence of them
        Stroke and velocity analogue: a row each.
    ax : array of matplotlib axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Colours for a dark canvas.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        The axes drawn on, (quantities, approximations).

    References
    ----------
    Ambarcumyanc and Subbotina (2017), figures 2 and 3.

    Examples
    --------
    >>> import assur
    >>> axes = assur.slider_crank.plot_deviation()
    >>> [ax.texts[0].get_text() for ax in axes.flat]
    ['−0.473 at 74°', '−0.0132 at 81°', '0.949 at 128°', '0.0297 at 118°']
    """
    from assur.pictures import chart
    from assur.pictures.diagrams.notes import Note, write_notes
    from assur.pictures.diagrams.peaks import peaks
    from assur.pictures.diagrams.quantities import ORDERS
    from assur.pictures.numerals import degrees_text, number
    from assur.pictures.points import settle
    from assur.pictures.style import style_of

    style, ratio = style_of(dark), real_number(lam, "lam")
    if not 0.0 < ratio < 1.0:
        message = f"lam is {lam!r}: crank over rod must be above 0 and below 1"
        raise InputError(message, value=ratio)
    known = ("stroke", "d1")
    quantities = [
        one_of(word, known, "quantity")
        for word in checked_entries(quantity, "quantity", MOST_PANELS)
    ]
    numbers = [whole_number(value, "n", 1, 1000) for value in checked_entries(n, "n", MOST_PANELS)]
    rows, columns = len(quantities), len(numbers)
    axes = np.reshape(chart.chart_axes(ax, style, rows, columns, 2.6), (rows, columns))
    phi = np.linspace(0.0, math.pi, BETWEEN)[1:-1]
    notes = []
    for (row, column), panel in np.ndenumerate(axes):
        order = 0 if quantities[row] == "stroke" else 1
        which = numbers[column]

        def off(x: Float, order: int = order, which: int = which) -> Float:
            near, exact = (
                stroke(np.radians(x), 1.0, 1.0 / ratio, method=method, n=which)
                for method in ("fraction", "exact")
            )
            name = ORDERS[order]
            percent: Float = 100.0 * (getattr(near, name) / getattr(exact, name) - 1.0)
            return percent

        x = np.degrees(phi)
        values = off(x)
        colour = style.velocity if order else style.ink
        panel.plot(x, values, color=colour, linewidth=chart.CURVE, gid="curve deviation")
        panel.set_xlim(0.0, 180.0)
        chart.degree_ticks(panel, 0.0, 180.0)
        chart.headroom(panel, values)
        name = "Velocity analogue" if order else "Stroke"
        chart.title(panel, f"{name}, n = {which}: deviation, %", style)
        chart.zero_line(panel, style)
        if row == rows - 1:
            panel.set_xlabel("φ", color=style.second, fontsize=chart.TEXT)
        extremes = peaks(x, values, again=off)
        # None where they are equal to the last digit.
        if extremes:
            largest = max(extremes, key=lambda peak: abs(peak.y))
            text = f"{number(largest.y)} at {degrees_text(largest.x, 180.0)}"
            notes.append((panel, Note(largest.x, largest.y, text, colour, "extreme")))
    settle(axes.flat[0])
    for panel, note in notes:
        write_notes(panel, [note], style)
    return axes
