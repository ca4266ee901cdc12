"""The figures of the paper on the crank-rocker with friction, each by one call."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import finite_array, real_number, short
from assur._trig import sin_cos
from assur._validate import checked_entries
from assur.errors import InputError
from assur.papers.crank_rocker.theory import (
    blocked,
    ground_range,
    least_transmission_angle,
    solve,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import AxesLike, Panels
    from assur.kinematics.mechanism import Mechanism

# Points of a curve; rockers, of figure 3.
POINTS, ROCKERS = 721, 60
# Curves of one diagram; pictures of one figure: more cannot be read.
MOST_CURVES, MOST_PANELS = 100, 12
# Length of the arrow of a force, points.
ARROW = 44.0
TINT = 0.2


def plot_zone(
    *,
    coupler: float = 4.0,
    margin: float | tuple[float, float] = 0.05,
    gamma_min: float = 0.0,
    ax: Axes | None = None,
    dark: bool = False,
) -> Axes:
    """Draw the grounds for which the crank turns over the rocker's length (needs matplotlib).

    Parameters
    ----------
    coupler : float
        Relative to the crank.
    margin : float or (float, float)
        Margin to the least and to the greatest ground.
    gamma_min : float
        Least transmission angle, rad: the zone that friction leaves is drawn too.
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
    Manzhosov and Petrova, figure 3.

    Examples
    --------
    >>> import assur
    >>> axes = assur.crank_rocker.plot_zone(coupler=4.0, gamma_min=0.2)
    >>> [zone.get_gid() for zone in axes.collections]
    ['zone', 'zone with friction']
    """
    from assur.pictures import chart
    from assur.pictures.diagrams.notes import Note, write_notes
    from assur.pictures.numerals import number
    from assur.pictures.points import settle
    from assur.pictures.style import blend, style_of

    style, length = style_of(dark), real_number(coupler, "coupler")
    # From the shortest rocker that leaves a zone to one as long as the coupler.
    margins = finite_array(margin, "margin")
    if margins.shape not in ((), (2,)):
        message = f"margin is {short(margin)}: a number is needed, or two of them"
        raise InputError(message)
    gamma_min = real_number(gamma_min, "gamma_min")
    first = 1.0 + float(np.sum(np.broadcast_to(margins / 2.0, (2,))))
    if not length > first:
        message = f"coupler is {coupler!r}: with these margins it must be above {first:.6g}"
        raise InputError(message, value=length)
    chart.require_shown(length)
    rockers = np.linspace(first, length, ROCKERS)
    axes: Axes = chart.chart_axes(ax, style, height=4.2)
    zones = [(0.0, "zone", style.driver, TINT)]
    if gamma_min:
        zones.append((gamma_min, "zone with friction", style.velocity, 2.0 * TINT))
    notes = []
    for angle, gid, colour, tint in zones:
        low, high = map(np.asarray, ground_range(length, rockers, margin=margin, gamma_min=angle))
        known = np.isfinite(low)
        x, low, high = rockers[known], low[known], high[known]
        axes.fill_between(
            x, low, high, color=blend(colour, style.canvas, tint), linewidth=0.0, gid=gid
        )
        for edge in (low, high):
            axes.plot(x, edge, color=colour, linewidth=1.6, gid=f"limit {gid}")
        text = f"γ > {number(angle)} rad" if angle else "the crank turns"
        at = len(x) // 2 if len(zones) == 1 or angle else len(x) - 2
        middle = float(low[at] / 2.0 + high[at] / 2.0)
        if angle or len(zones) == 1:
            notes.append(Note(float(x[at]), middle, text, colour, "zone text", None, centred=True))
    axes.set_xlim(float(rockers[0]), float(rockers[-1]))
    chart.title(axes, "Ground / crank", style, _zone_sentence(margins, gamma_min))
    axes.set_xlabel("rocker / crank", color=style.second, fontsize=chart.TEXT)
    settle(axes)
    write_notes(axes, notes, style)
    return axes


def _zone_sentence(margins: Float, gamma_min: float) -> str:
    text = (
        f"the crank turns; margins {' and '.join(f'{value:g}' for value in np.atleast_1d(margins))}"
    )
    return f"{text}; dark: friction leaves γ above its least" if gamma_min else text


def plot_push_and_pull(
    l1: float,
    l2: float,
    l3: float,
    l4: float,
    *,
    phi1: float | Sequence[float] = (1.6, 4.2),
    ax: AxesLike | None = None,
    dark: bool = False,
) -> Panels:
    """Draw the mechanism at crank angles with the force of the coupler on the rocker.

    Parameters
    ----------
    l1, l2, l3, l4 : float
        Crank, coupler, rocker and ground, m.
    phi1 : float or sequence of float
        Crank angles, rad, of a picture each: by default one of pushing and one of pulling.
    ax : sequence of matplotlib axes, optional
        Where to draw, one for each angle; a new figure by default.
    dark : bool
        Colours for a dark canvas.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        The axes drawn on; their titles say whether the coupler pushes or pulls, and γ.

    References
    ----------
    Manzhosov and Petrova, figure 4.

    Examples
    --------
    >>> import assur
    >>> axes = assur.crank_rocker.plot_push_and_pull(1.0, 4.5, 1.5, 4.8)
    >>> [ax.get_title(loc="left") for ax in axes]
    ['The coupler pushes: γ = 1.477 rad', 'The coupler pulls: γ = 1.334 rad']
    """
    from assur.pictures import chart
    from assur.pictures.axes import checked_axes, listed_axes, pyplot
    from assur.pictures.style import style_of

    style, lengths = style_of(dark), _checked_lengths(l1=l1, l2=l2, l3=l3, l4=l4)
    angles = [real_number(angle, "phi1") for angle in checked_entries(phi1, "phi1", MOST_PANELS)]
    if ax is None:
        size = (4.6 * len(angles), 3.0)
        room = {"left": 0.01, "right": 0.99, "bottom": 0.0, "top": 0.88, "wspace": 0.02}
        _, ax = pyplot().subplots(
            1, len(angles), figsize=size, facecolor=style.canvas, gridspec_kw=room
        )
    panels = np.array([checked_axes(axes) for axes in listed_axes(ax)], dtype=object)
    if len(panels) != len(angles):
        message = f"ax has {len(panels)} axes: {len(angles)} are needed"
        raise InputError(message)
    for panel, phi in zip(panels, angles, strict=True):
        mechanism, places = _drawn(phi, lengths)
        mechanism.plot(ax=panel, dark=dark)
        solved = solve(phi, *lengths)
        pushes = bool(solved.pushes)
        b, c = places["B"], places["C"]
        along = (c - b) / lengths[1] * (1.0 if pushes else -1.0)
        panel.annotate(
            "", c, xytext=ARROW * along, textcoords="offset points", gid="force", zorder=7.0,
            arrowprops={
                "arrowstyle": "<|-", "color": style.force, "linewidth": 2.6, "shrinkA": 0.0,
                "shrinkB": 0.0, "mutation_scale": 15.0,
            },
        )  # fmt: skip
        verb = "pushes" if pushes else "pulls"
        chart.title(panel, f"The coupler {verb}: γ = {float(solved.gamma):.3f} rad", style)
    return panels


def _checked_lengths(**lengths: Any) -> tuple[float, float, float, float]:
    """Return crank, coupler, rocker and ground of one mechanism."""
    l1, l2, l3, l4 = (real_number(length, name) for name, length in lengths.items())
    return l1, l2, l3, l4


def _drawn(
    phi: float, lengths: tuple[float, float, float, float]
) -> tuple[Mechanism, dict[str, Any]]:
    """Return the crank-rocker as drawn in the paper, and where its joints are."""
    from assur.kinematics.mechanism import Mechanism

    l1, _, l3, l4 = lengths
    solved = solve(phi, *lengths)
    sine, cosine = sin_cos(np.array([phi, float(solved.phi3)]))
    places = {
        "A": np.zeros(2),
        "B": l1 * np.array([cosine[0], sine[0]]),
        "C": np.array([-l4 + l3 * cosine[1], l3 * sine[1]]),
        "D": np.array([-l4, 0.0]),
    }
    links = {
        "ground": ["A", "D"],
        "crank": ["A", "B"],
        "coupler": ["B", "C"],
        "rocker": ["D", "C"],
    }
    joints = {name: (float(x), float(y)) for name, (x, y) in places.items()}
    return Mechanism(joints, links, "crank"), places


def plot_least_angle(*, ax: Axes | None = None, dark: bool = False) -> Axes:
    """Draw the least transmission angle over the reduced friction f_p (needs matplotlib).

    Parameters
    ----------
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
    Manzhosov and Petrova, figure 5.

    Examples
    --------
    >>> import assur
    >>> axes = assur.crank_rocker.plot_least_angle()
    >>> [text.get_text() for text in axes.texts]
    ['γ_min = arcsin f_p', 'blocked', 'moves']
    """
    from assur.pictures import chart
    from assur.pictures.diagrams.notes import Note, write_notes
    from assur.pictures.points import settle
    from assur.pictures.style import blend, style_of

    style = style_of(dark)
    axes: Axes = chart.chart_axes(ax, style)
    # Closer where the curve is steep.
    reduced = 1.0 - np.square(np.linspace(1.0, 0.0, 300)[:-1])
    least = np.array(
        [least_transmission_angle(float(f), 1.0, 0.0, 0.0, 1.0) for f in reduced], dtype=float
    )
    axes.fill_between(
        reduced,
        0.0,
        least,
        color=blend(style.error, style.canvas, TINT),
        linewidth=0.0,
        gid="blocked",
    )
    axes.plot(reduced, least, color=style.ink, linewidth=chart.CURVE, gid="curve least angle")
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, math.pi / 2.0))
    chart.title(axes, "Least transmission angle, rad", style, "γ_min = arcsin f_p")
    axes.set_xlabel("reduced friction f_p", color=style.second, fontsize=chart.TEXT)
    settle(axes)
    texts = (("blocked", 0.75, 0.4), ("moves", 0.3, 1.0))
    notes = [Note(x, y, text, style.ink, text, None, centred=True) for text, x, y in texts]
    write_notes(axes, notes, style)
    return axes


def plot_transmission(
    l1: float,
    l2: float,
    l3: float,
    l4: float | Sequence[float],
    *,
    gamma_min: float | None = None,
    ax: AxesLike | None = None,
    dark: bool = False,
) -> Panels:
    """Draw the angle γ₂₃ and the transmission angle γ over the crank's angle, for some grounds.

    Parameters
    ----------
    l1, l2, l3 : float
        Crank, coupler and rocker, m.
    l4 : float or sequence of float
        Grounds, m; the last is drawn bold.
    gamma_min : float, optional
        Least transmission angle, rad: the region below it is shaded, and where the last ground's
        mechanism is there.
    ax : pair of matplotlib axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Colours for a dark canvas.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        Of γ₂₃ and of γ.

    References
    ----------
    Manzhosov and Petrova, figure 6.

    Examples
    --------
    >>> import assur
    >>> axes = assur.crank_rocker.plot_transmission(1, 4.5, 1.5, [4.8, 4.9, 4.995], gamma_min=0.2)
    >>> [line.get_gid() for line in axes[1].lines]
    ['curve l₄ = 4.8', 'curve l₄ = 4.9', 'curve l₄ = 4.995', 'least angle']
    """
    from assur.pictures import chart
    from assur.pictures.diagrams.line_names import Named, name_lines
    from assur.pictures.points import settle
    from assur.pictures.style import blend, style_of

    style = style_of(dark)
    grounds = [real_number(length, "l4") for length in checked_entries(l4, "l4", MOST_CURVES)]
    l1, l2, l3, _ = _checked_lengths(l1=l1, l2=l2, l3=l3, l4=grounds[-1])
    least = None if gamma_min is None else real_number(gamma_min, "gamma_min")
    jams = [] if least is None else blocked(l1, l2, l3, grounds[-1], least)
    axes: Panels = chart.chart_axes(ax, style, 2, 1, 2.9)
    phi = np.linspace(0.0, 2.0 * math.pi, POINTS)
    x = np.degrees(phi)
    named: list[list[Named]] = [[], []]
    for i, ground in enumerate(grounds):
        solved = solve(phi, l1, l2, l3, ground)
        bold = i == len(grounds) - 1
        colour = style.ink if bold else style.second
        for panel, values, lines in zip(axes, (solved.gamma23, solved.gamma), named, strict=True):
            panel.plot(
                x, values, color=colour, linewidth=chart.CURVE if bold else 1.0,
                gid=f"curve l₄ = {ground:g}", zorder=2.0 + bold,
            )  # fmt: skip
            lines.append(Named(x, values, f"l₄ = {ground:g}" if bold or not i else "", colour))
    for panel, text in zip(axes, ("Angle γ₂₃, rad", "Transmission angle γ, rad"), strict=True):
        panel.set_xlim(0.0, 360.0)
        chart.degree_ticks(panel, 0.0, 360.0)
        chart.title(panel, text, style)
        panel.margins(y=0.1)
    axes[0].tick_params(labelbottom=False)
    axes[1].set_xlabel("φ₁", color=style.second, fontsize=chart.TEXT)
    axes[1].set_ylim(bottom=0.0)
    if least is not None:
        tint = blend(style.error, style.canvas, TINT)
        axes[1].axhspan(0.0, least, color=tint, linewidth=0.0, gid="blocked", zorder=0.4)
        axes[1].axhline(least, color=style.error, linewidth=1.2, gid="least angle")
        for low, high in jams:
            for turn in (0.0, 360.0):
                axes[1].axvspan(
                    math.degrees(low) + turn, math.degrees(high) + turn, color=tint,
                    linewidth=0.0, zorder=0.4, gid="jams",
                )  # fmt: skip
        axes[1].set_xlim(0.0, 360.0)
    settle(axes[0])
    for panel, lines in zip(axes, named, strict=True):
        name_lines(panel, lines)
    return axes
