"""A coordinate over q along all circuits: see `ConfigurationCurve.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur.description.dotted_names import split_name
from assur.errors import InputError
from assur.pictures.chart import CURVE, chart_axes, title
from assur.pictures.maps.callouts import write_along, write_beside
from assur.pictures.maps.quantity_axis import name_axis
from assur.pictures.numerals import angle_text, length_unit, true_minus
from assur.pictures.points import settle
from assur.pictures.style import style_of
from assur.pictures.text import shortened

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import CircuitMotion, ConfigurationCurve, Mechanism

SAMPLES = 240
DIAMOND = 9.0
# A span this near to a turn is one.
NEAR = 1e-6
TURN = 2.0 * np.pi
# More dead points than this are marked without their q.
MOST = 8
DASHES = (0.0, (3.0, 4.0))
# Values farther from the middle than this multiple of the mechanism's size are out of sight.
FAR = 4.0
# Curves this near, relative to their range, over half of one of them look like one.
ALIKE = 0.008


def curve_picture(curve: ConfigurationCurve, name: Any, ax: Any, dark: bool) -> Axes:
    """See `ConfigurationCurve.plot`."""
    mechanism = curve.mechanism
    name = _output(mechanism) if name is None else name
    of_angle = isinstance(name, str) and name in mechanism.links
    driver = mechanism.driver
    turns = not isinstance(driver, str) or driver not in mechanism.slides
    motions = [curve.motion(i, samples=SAMPLES) for i in range(len(curve.circuits))]
    if not motions:
        message = "the configuration curve has no circuit: the mechanism cannot be assembled"
        raise InputError(message)
    values = [_coordinate(mechanism, motion, name) for motion in motions]
    if not of_angle:
        values = _in_sight(mechanism, values)
    lines = [np.stack([m.q, y], axis=1) for m, y in zip(motions, values, strict=True)]
    style = style_of(dark)
    ax = chart_axes(ax, style)
    wrap = [
        flag and any(np.ptp(line[:, k]) >= TURN - NEAR for line in lines if np.isfinite(line).all())
        for k, flag in enumerate((turns, of_angle))
    ]
    drawn = [_in_window(line, (turns, of_angle), (wrap[0], wrap[1])) for line in lines]
    colours = [style.ink, style.path, *style.groups]
    for i, line in enumerate(drawn):
        # Dashes on another circuit let it be seen.
        hides = any(_coincide(line, earlier) for earlier in drawn[:i])
        ax.plot(
            *line.T, color=colours[i % len(colours)], linewidth=CURVE, gid=f"circuit {i}",
            solid_capstyle="butt", dash_capstyle="butt", linestyle=DASHES if hides else "solid",
        )  # fmt: skip
    dead = _dead_points(curve, motions, lines, (turns, of_angle), (wrap[0], wrap[1]))
    if len(dead):
        ax.plot(
            *dead.T, "D", color=style.error, markersize=DIAMOND, markeredgecolor=style.canvas,
            zorder=4.0, gid="dead points", linestyle="none",
        )  # fmt: skip
    _limits(ax, drawn, (wrap[0], wrap[1]))
    q_name = driver if isinstance(driver, str) else "q"
    everything = np.concatenate(drawn)
    name_axis(ax.xaxis, q_name, everything[:, 0], turns, style)
    unit, _ = name_axis(ax.yaxis, name, everything[:, 1], of_angle, style)
    ax.set_ylabel("")
    name = shortened(name)
    title(ax, name if of_angle else f"{name}, {unit}", style)
    _write(ax, drawn, dead, colours, turns, style)
    shown: Axes = ax
    return shown


def _output(mechanism: Mechanism) -> str:
    """Return the coordinate that a driver usually moves."""
    driver = mechanism.driver
    slides = [n for n, s in mechanism.slides.items() if s.on == "ground" and n != driver]
    fixed = set(mechanism.links.get("ground", ()))
    driven = driver if isinstance(driver, str) else getattr(driver, "link", None)
    moving = [link for link in mechanism.links if link not in ("ground", driven)]
    turning = [link for link in moving if fixed & set(mechanism.links[link])]
    return next(iter([*slides, *turning[::-1], *moving[::-1]]), next(iter(mechanism.links)))


def _coordinate(mechanism: Mechanism, motion: CircuitMotion, name: Any) -> Float:
    if isinstance(name, str):
        joint, axis = split_name(name)
        if joint in motion.joints and axis in ("x", "y"):
            at: Float = motion.joints[joint][:, "xy".index(axis)]
            return at
        if name in motion.links:
            return motion.links[name]
        if name in motion.slides:
            return motion.slides[name]
    known = ", ".join([*mechanism.links, *mechanism.slides, *(f"{j}.x" for j in motion.joints)])
    message = f"plot({short(name)}): no such coordinate; there are {known}, and .y of joints"
    raise InputError(message)


def _in_sight(mechanism: Mechanism, values: list[Float]) -> list[Float]:
    """Return values with gaps where a joint goes toward infinity."""
    size = float(np.ptp(np.array(list(mechanism.joints.values())), axis=0).max())
    middle = float(np.median(np.concatenate(values)))
    return [np.where(np.abs(heights - middle) <= FAR * size, heights, np.nan) for heights in values]


def _coincide(line: Float, second_line: Float) -> bool:
    """Whether much of a line lies on another one."""
    first, second = (points[np.isfinite(points).all(axis=1)][::4] for points in (line, second_line))
    if not len(first) or not len(second):
        return False
    both = np.concatenate([first, second])
    span = np.maximum(np.ptp(both, axis=0), 1e-300)
    gaps = np.abs((first[:, None] - second[None]) / span)
    # Along x samples lie apart.
    near = (gaps[..., 0] < 3.0 * ALIKE) & (gaps[..., 1] < ALIKE)
    return bool(near.any(axis=1).mean() > 0.5)


def _shift(line: Float, angles: tuple[bool, bool]) -> Float:
    """Return whole turns that bring the middle of a line's angles into (−π, π]."""
    middle = (np.nanmin(line, axis=0) + np.nanmax(line, axis=0)) / 2.0
    return np.where(angles, -TURN * np.round(middle / TURN), 0.0)


def _in_window(line: Float, angles: tuple[bool, bool], wrap: tuple[bool, bool]) -> Float:
    """Return a line with its angles in one turn: cut where it leaves that, with a gap."""
    line = line + _shift(line, (angles[0] and not wrap[0], angles[1] and not wrap[1]))
    for axis in np.flatnonzero(wrap).tolist():
        turn = np.round(np.nan_to_num(line[:, axis]) / TURN)
        pieces = []
        for i in np.flatnonzero(np.diff(turn)).tolist()[::-1]:
            # Both sides get the point on the edge, and a gap between them.
            edge = (max(turn[i], turn[i + 1]) - 0.5) * TURN
            part = (edge - line[i, axis]) / (line[i + 1, axis] - line[i, axis])
            cut = line[i] + part * (line[i + 1] - line[i])
            pieces.append((i, cut))
        shifted = line.copy()
        shifted[:, axis] -= TURN * turn
        for i, cut in pieces:
            before, after = cut.copy(), cut.copy()
            before[axis] -= TURN * turn[i]
            after[axis] -= TURN * turn[i + 1]
            gap = np.full((1, 2), np.nan)
            shifted = np.vstack(
                [shifted[: i + 1], before[None], gap, after[None], shifted[i + 1 :]]
            )
        line = shifted
    return line


def _dead_points(
    curve: ConfigurationCurve,
    motions: list[CircuitMotion],
    lines: list[Float],
    angles: tuple[bool, bool],
    wrap: tuple[bool, bool],
) -> Float:
    """Return where the folds are on the lines: where a branch passes into another."""
    marks = []
    for circuit, motion, line in zip(curve.circuits, motions, lines, strict=True):
        shift = _shift(line, (angles[0] and not wrap[0], angles[1] and not wrap[1]))
        on_circuit = {number for number, _ in circuit.branches}
        for fold in curve.folds:
            if not on_circuit & set(fold.branches):
                continue
            of_branch = np.isin(motion.branch, fold.branches)
            gaps = np.where(of_branch, np.abs(motion.q - fold.q), np.inf)
            at = line[int(np.argmin(gaps))] + shift
            at[0] = fold.q + shift[0]
            marks.append(at - np.where(wrap, TURN * np.round(at / TURN), 0.0))
    places = np.array(marks).reshape(-1, 2)
    places = places[np.isfinite(places).all(axis=1)]
    # Folds of several circuits at one place are one mark.
    kept: list[Float] = []
    for place in places:
        if all(np.abs(place - known).max() > 1e-6 for known in kept):
            kept.append(place)
    return np.array(kept).reshape(-1, 2)


def _limits(ax: Any, lines: list[Float], wrap: tuple[bool, bool]) -> None:
    everything = np.concatenate(lines)
    low, high = np.nanmin(everything, axis=0), np.nanmax(everything, axis=0)
    span = np.maximum(high - low, 1e-9)
    room = np.array([0.06, 0.12]) * span
    low, high = low - room, high + room
    for axis, put in enumerate((ax.set_xlim, ax.set_ylim)):
        if wrap[axis]:
            put(-np.pi, np.pi)
        else:
            put(float(low[axis]), float(high[axis]))


def _write(
    ax: Any, lines: list[Float], dead: Float, colours: list[str], turns: bool, style: Any
) -> None:
    """Write the circuits' numbers and the dead points' q, clear of the lines."""
    settle(ax)
    written: list[Any] = []
    if 0 < len(dead) <= MOST:
        texts = [angle_text(q, 1) if turns else _length(q) for q in dead[:, 0].tolist()]
        written = write_beside(ax, texts, dead, DIAMOND, style.error, "dead point text", lines)
    if len(lines) > 1:
        names = [f"circuit {i}" for i in range(len(lines))]
        gids = [f"name {name}" for name in names]
        line_colours = [colours[i % len(colours)] for i in range(len(lines))]
        write_along(ax, names, lines, line_colours, gids, avoid=written)


def _length(length: float) -> str:
    """Write a coordinate in m with the unit that suits it, in four digits."""
    unit, factor = length_unit(abs(length))
    return true_minus(f"{length * factor:.4g} {unit}")
