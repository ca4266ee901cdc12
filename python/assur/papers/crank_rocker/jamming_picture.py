"""Pictures of a crank-rocker that becomes a slider-crank; see `JammingRun.plot`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from assur.description.words import Slide
from assur.pictures.style import style_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.pictures.style import Style

# Positions are drawn at every 15°.
STEP = math.pi / 12.0
NAMES = {"jam": "C jams", "return": "D is back"}
# For the names of events, relative to the range.
ROOM = 0.3


class _Jamming(Protocol):
    """What is drawn: see `assur.crank_rocker.JammingRun`."""

    @property
    def t(self) -> Float: ...
    @property
    def phi1(self) -> Float: ...
    @property
    def gamma(self) -> Float: ...
    @property
    def l4(self) -> Float: ...
    @property
    def B(self) -> Float: ...
    @property
    def C(self) -> Float: ...
    @property
    def D(self) -> Float: ...
    @property
    def sliding(self) -> npt.NDArray[np.bool_]: ...
    @property
    def events(self) -> Any: ...


def jamming_picture(run: _Jamming, what: str, ax: Any, degrees: bool, dark: bool) -> Axes:
    """See `JammingRun.plot`."""
    style = style_of(dark)
    if what == "positions":
        positions: Axes = _positions(run, ax, dark, style)
        return positions
    diagram: Axes = _diagram(run, what, ax, degrees, style)
    return diagram


def mechanism_of(run: _Jamming) -> Mechanism:
    """Return the mechanism with its support on a slide: the crank and the slide drive it."""
    joints: dict[str, tuple[float, float]] = {"A": (0.0, 0.0)}
    for name, points in (("B", run.B), ("C", run.C), ("D", run.D)):
        joints[name] = (float(points[0, 0]), float(points[0, 1]))
    return with_sliding_support(joints)


def with_sliding_support(joints: Mapping[str, Any]) -> Mechanism:
    """Return the crank-rocker of A, B, C, D whose support D slides along the line through A."""
    from assur.kinematics.mechanism import Mechanism

    links = {
        "ground": ["A"],
        "crank": ["A", "B"],
        "coupler": ["B", "C"],
        "rocker": ["D", "C"],
        "support": ["D"],
    }
    slides = {"line": Slide("support", on="ground", angle=0.0, origin="A")}
    return Mechanism(joints, links, ["crank", "line"], slides=slides)


def _positions(run: _Jamming, ax: Any, dark: bool, style: Style) -> Any:
    """Draw the first position with its symbols, the others as lines, in colour while D slides."""
    turned = np.abs(run.phi1 - run.phi1[0])
    last = min(float(turned[-1]), 2.0 * math.pi)
    # The end of a turn is its start.
    steps = np.arange(0.0, last - 0.5 * STEP, STEP)
    rows = np.unique(np.searchsorted(turned, steps))
    q = np.stack([run.phi1, run.D[:, 0]], axis=-1)[rows]
    ax = mechanism_of(run).plot(q, ax=ax, labels="first", dark=dark)
    for artist in list(ax.get_children()):
        if _misleads(artist, run, ax):
            artist.remove()
    events = np.flatnonzero(np.isin(run.t, [event.t for event in run.events]))
    sliding = np.union1d(rows[run.sliding[rows]], events)
    for row in sliding.tolist():
        chain = np.array([(0.0, 0.0), run.B[row], run.C[row], run.D[row]])
        ax.plot(
            *chain.T, color=style.error, linewidth=1.1, zorder=1.1, gid="sliding", scalex=False,
            scaley=False,
        )  # fmt: skip
    ax.plot(
        *run.C.T, color=style.path, linewidth=1.8, zorder=1.6, gid="path C", scalex=False,
        scaley=False,
    )  # fmt: skip
    if sliding.size:
        from assur.pictures.chart import TEXT

        travel = float(np.ptp(run.l4[run.sliding])) if run.sliding.any() else 0.0
        ax.annotate(
            f"C jammed: D slides {travel:.3g} m", (1.0, 1.0), xytext=(-10.0, -8.0),
            xycoords="axes fraction", textcoords="offset points", color=style.error, fontsize=TEXT,
            horizontalalignment="right", verticalalignment="top", gid="sliding text",
        )  # fmt: skip
    return ax


def _misleads(artist: Any, run: _Jamming, ax: Any) -> bool:
    """Whether an artist is misleading: the rod, not a drive, moves D; the crank turns."""
    gid = artist.get_gid()
    if gid == "limit crank":
        return True
    if gid != "driver" or not hasattr(artist, "get_path"):
        return False
    middle = artist.get_transform().transform(artist.get_path().vertices).mean(axis=0)
    pivot, support = ax.transData.transform(np.array([(0.0, 0.0), run.D[0]]))
    return bool(np.square(middle - support).sum() < np.square(middle - pivot).sum())


def _diagram(run: _Jamming, what: str, ax: Any, degrees: bool, style: Style) -> Any:
    """Draw the ground or the transmission angle over the crank's angle, with the events."""
    from assur.pictures import chart
    from assur.pictures.diagrams.notes import Note, write_notes
    from assur.pictures.diagrams.peaks import peaks
    from assur.pictures.numerals import degrees_text, number
    from assur.pictures.points import settle
    from assur.pictures.style import blend

    axes = chart.chart_axes(ax, style)
    x = np.degrees(run.phi1) if degrees else run.phi1
    values, title = (
        (run.l4, "Ground l₄, m") if what == "ground" else (run.gamma, "Transmission angle γ, rad")
    )
    axes.plot(x, values, color=style.ink, linewidth=chart.CURVE, gid=f"curve {what}")
    axes.set_xlim(float(x.min()), float(x.max()))
    chart.headroom(axes, values)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + (ROOM - chart.HEADROOM) * (high - low))
    if degrees:
        chart.degree_ticks(axes, float(x.min()), float(x.max()))
    chart.title(axes, title, style)
    axes.set_xlabel("φ₁" if degrees else "φ₁, rad", color=style.second, fontsize=chart.TEXT)
    for start, end in _stretches(x, run.sliding):
        tint = blend(style.error, style.canvas, 0.2)
        axes.axvspan(start, end, color=tint, linewidth=0.0, zorder=0.4, gid="sliding")
    settle(axes)
    notes = [
        Note(peak.x, peak.y, f"{number(peak.y, float(np.ptp(values)))} at {place}", style.ink)
        for peak in peaks(x, values)
        for place in [degrees_text(peak.x, 360.0) if degrees else f"{peak.x:.2f} rad"]
        if what == "angle" or not peak.greatest
    ]
    bottom, top = axes.get_ylim()
    for event in run.events:
        at = math.degrees(event.phi1) if degrees else event.phi1
        text = (
            f"{NAMES.get(event.kind, event.kind)} at {degrees_text(math.degrees(event.phi1), 10.0)}"
        )
        axes.axvline(at, color=style.error, linewidth=0.9, zorder=0.8, gid=f"event {event.kind}")
        y = top - 0.06 * (top - bottom)
        notes.append(Note(at, y, text, style.error, "event text", None))
    write_notes(axes, notes, style)
    return axes


def _stretches(x: Float, sliding: Any) -> list[tuple[float, float]]:
    """Return where D slides."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], sliding, [False]]).astype(int)))
    return [
        (float(x[start]), float(x[min(end, len(x) - 1)]))
        for start, end in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
    ]
