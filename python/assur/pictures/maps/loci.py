"""Singular curves and workspaces."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.pictures.axes import scale_bar
from assur.pictures.chart import chart_axes, title
from assur.pictures.linkage.artists import Drawn
from assur.pictures.linkage.position import name_joints
from assur.pictures.linkage.subject import Subject
from assur.pictures.maps.callouts import write_along
from assur.pictures.maps.counts import fill_counts
from assur.pictures.maps.quantity_axis import name_axis
from assur.pictures.points import settle
from assur.pictures.style import style_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Mechanism, SingularLocus, Workspace
    from assur.pictures.axes import Canvas
    from assur.pictures.style import Style

LINE = 2.0
# The kinds by what they mean; dead points have the colour of errors.
NAMES = {1: "limit of reach", 2: "dead points"}
# Dashes of dead points at the rim of a workspace let its boundary be seen.
DASHES: dict[int, Any] = {1: "solid", 2: (0.0, (4.0, 1.6))}


def workspace_picture(
    workspace: Workspace, loci: Sequence[SingularLocus], ax: Any, dark: bool
) -> Axes:
    """See `Workspace.plot`."""
    style = style_of(dark)
    lines = [locus.joints[workspace.joint] for locus in workspace.boundary]
    corners = np.array([[workspace.x[0], workspace.y[0]], [workspace.x[-1], workspace.y[-1]]])
    seen = [np.clip(line, corners[0], corners[1]) for line in lines]
    subject, on = _canvas(workspace.mechanism, [*(seen or [corners])], ax, style)

    def named(number: int) -> str:
        return "" if number == 0 else "1 way" if number == 1 else f"{number} ways"

    fill_counts(on.ax, workspace.x, workspace.y, workspace.count, lines, style, named, below=0.08)
    # The boundary may be among the loci.
    kinds = {1: lines, 2: [locus.joints[workspace.joint] for locus in loci if locus.kind == 2]}
    for kind, of_kind in kinds.items():
        for line in of_kind:
            _draw(on.ax, line, kind, style)
    _lightly(subject, on, [line for of_kind in kinds.values() for line in of_kind])
    _name_lines(on.ax, kinds, style)
    scale_bar(on)
    return on.ax


def locus_picture(locus: SingularLocus, joint: str | None, ax: Any, dark: bool) -> Axes:
    """See `SingularLocus.plot`."""
    style = style_of(dark)
    if joint is None:
        return _over_drivers(locus, ax, style)
    line = locus.joints[joint]
    if ax is not None and getattr(ax, "_assur_drawn", False):
        # Into a picture that has the mechanism.
        _draw(ax, line, locus.kind, style)
    else:
        subject, on = _canvas(locus.mechanism, [line], ax, style)
        ax = on.ax
        _draw(ax, line, locus.kind, style)
        _lightly(subject, on, [line])
        scale_bar(on)
    _name_lines(ax, {locus.kind: [line]}, style)
    drawn: Axes = ax
    return drawn


def _canvas(
    mechanism: Mechanism, lines: list[Float], ax: Any, style: Style
) -> tuple[Subject, Canvas]:
    subject = Subject(mechanism.solve(mechanism.q0_array, order=0))
    on = subject.canvas(ax, style, lines)
    return subject, on


def _lightly(subject: Subject, on: Canvas, lines: list[Float]) -> None:
    """Draw the mechanism as in its drawing, in the colour of lesser text."""
    style = replace(on.style, ink=on.style.second)
    pale = replace(on, style=style)
    Drawn(pale, subject.scene, subject.frames[0], zorder=2.5)
    name_joints(subject, pale, subject.frames[0], lines)


def _draw(ax: Any, line: Float, kind: int, style: Style) -> None:
    ax.plot(
        *line.T, color=_colour(kind, style), linewidth=LINE, linestyle=DASHES[kind],
        scalex=False, scaley=False, zorder=2.0, gid=f"singular kind {kind}",
    )  # fmt: skip


def _colour(kind: int, style: Style) -> str:
    return style.ink if kind == 1 else style.error


def _name_lines(ax: Any, kinds: dict[int, list[Float]], style: Style) -> None:
    """Write the name of each kind beside its longest line, once in a picture."""
    settle(ax)
    written = [text.get_text() for text in ax.texts]
    for kind, lines in kinds.items():
        text = NAMES[kind]
        if not lines or text in written:
            continue
        longest = max(lines, key=lambda line: float(np.hypot(*np.diff(line, axis=0).T).sum()))
        drawn = [
            np.column_stack(line.get_data())
            for line in ax.lines
            if line.get_transform() == ax.transData and len(line.get_xdata()) > 1
        ]
        artists = [
            artist
            for artist in ax.get_children()
            if hasattr(artist, "get_text") and artist.get_text()
        ]
        inside = [artist for artist in artists if artist.get_gid()]
        write_along(
            ax, [text], [longest], [_colour(kind, style)], [f"name kind {kind}"], drawn, inside
        )


def _over_drivers(locus: SingularLocus, ax: Any, style: Style) -> Axes:
    """Draw the coordinates of two drivers along a locus."""
    drivers = locus.mechanism.driver
    assert isinstance(drivers, tuple)
    moving = np.flatnonzero(np.ptp(locus.q, axis=0) > 0.0).tolist()
    if len(moving) > 2:
        message = f"the curve is over {len(moving)} drivers: plot(joint) draws it in the plane"
        raise InputError(message)
    first, second = (moving + [i for i in range(len(drivers)) if i not in moving])[:2]
    first, second = sorted((first, second))
    old = ax is not None and bool(ax.lines)
    limits = (ax.get_xlim(), ax.get_ylim()) if old else None
    ax = chart_axes(ax, style)
    line = locus.q[:, [first, second]]
    ax.plot(
        *line.T, color=_colour(locus.kind, style), linewidth=LINE, linestyle=DASHES[locus.kind],
        gid=f"singular kind {locus.kind}",
    )  # fmt: skip
    for axis, i, k in ((ax.xaxis, first, 0), (ax.yaxis, second, 1)):
        driver = drivers[i]
        is_angle = not isinstance(driver, str) or driver not in locus.mechanism.slides
        low, high = float(line[:, k].min()), float(line[:, k].max())
        if limits is not None:
            low, high = min(low, limits[k][0]), max(high, limits[k][1])
        else:
            low, high = low - 0.05 * (high - low), high + 0.05 * (high - low)
        (ax.set_xlim if k == 0 else ax.set_ylim)(low, high)
        text = driver if isinstance(driver, str) else f"{driver.link} − {driver.relative_to}"
        name_axis(axis, text, line[:, k], is_angle, style)
    title(ax, "singular positions", style)
    _name_lines(ax, {locus.kind: [line]}, style)
    drawn: Axes = ax
    return drawn
