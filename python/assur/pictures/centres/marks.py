"""Marks and names of instant centres, lines of Kennedy, arrows to centres out of sight."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D

from assur.pictures.axes import FOOT
from assur.pictures.text import write_names
from assur.pictures.vectors.arrows import LOOKS, arrow
from assur.pictures.vectors.dots import dots
from assur.pictures.vectors.symbols import formula_font, formula_size

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.axes import Canvas
    from assur.pictures.centres.rate_centres import Centre
    from assur.pictures.linkage.subject import Subject

DOT = 5.0
# Arrows at the border: their length and their distance from it, points.
BORDER_ARROW, BORDER = 22.0, 22.0
# Centres nearer than this, points, have one name.
TOGETHER = 4.0
# If more centres are in one place, this many are named and the others counted.
NAMED = 4


class CentreMarks:
    """Draws centres; names them all in the end, clear of the drawing.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    on : Canvas
        Where it is drawn.
    numbers : dict of str to int
        Of the links.
    head : float
        Height of the heading, points.
    """

    def __init__(self, subject: Subject, on: Canvas, numbers: dict[str, int], head: float) -> None:
        self._subject, self._on, self._numbers, self._head = subject, on, numbers, head
        self._lines: list[Float] = subject.lines(on, subject.frames[0])
        self._places: list[Float] = []
        self._texts: list[list[str]] = []
        self._gids: list[str] = []
        self._colours: list[str] = []

    def kennedy(self, line: tuple[Centre, Centre, Centre]) -> None:
        """Draw the line through the three centres, or toward one at infinity."""
        points = np.array([centre.at for centre in line if centre.at is not None])
        if len(points) < 2:
            direction = next(centre.direction for centre in line if centre.at is None)
            points = np.array([points[0], points[0] + direction * 30.0 / self._on.scale])
        spread = points @ (points[-1] - points[0])
        ends = points[[int(np.argmin(spread)), int(np.argmax(spread))]]
        pair = " ".join(line[0].links)
        self._line(ends, f"line of Kennedy {pair}")

    def _line(self, ends: Float, gid: str) -> None:
        self._on.ax.add_artist(
            Line2D(
                *ends.T,
                color=self._on.style.second,
                linewidth=0.9,
                linestyle=(0.0, (5.0, 3.0)),
                zorder=1.4,
                gid=gid,
            )
        )
        low, high = self._on.low, self._on.high
        if ((ends > low - (high - low)) & (ends < high + (high - low))).all():
            self._lines.append(ends)

    def centre(self, centre: Centre) -> None:
        """Mark a centre, or show at the border where it is."""
        gid = f"centre {' '.join(centre.links)}"
        inside = centre.at is not None and bool(
            ((centre.at > self._on.low) & (centre.at < self._on.high)).all()
        )
        numbers = sorted(self._numbers[link] for link in centre.links)
        name = "{}{}" if numbers[-1] < 10 else "{},{}"
        text = name.format(*numbers)
        if not inside or centre.at is None:
            self._beyond(centre, text, f"{gid} beyond")
            return
        if not centre.permanent:
            dots(self._on, centre.at, DOT, self._on.style.path, gid)
        self._name(centre.at, text, gid, self._on.style.ink)

    def _beyond(self, centre: Centre, text: str, gid: str) -> None:
        middle = (self._on.low + self._on.high) / 2.0
        if centre.at is None:
            direction = centre.direction * (1.0 if centre.direction[1] > -1e-9 else -1.0)
            start = np.clip(centre.origin, self._on.low, self._on.high)
            text += r"}^{\infty"
        else:
            direction = (centre.at - middle) / np.hypot(*(centre.at - middle))
            start = middle
        # The scale bar is below, the heading above.
        low = self._on.low + np.array([BORDER, FOOT]) / self._on.scale
        high = self._on.high - np.array([BORDER, BORDER + self._head]) / self._on.scale
        room = np.maximum(np.where(direction > 0.0, high - start, start - low), 0.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            tip = start + direction * float(np.nanmin(room / np.abs(direction)))
        tail = tip - direction * BORDER_ARROW / self._on.scale
        if not any(np.hypot(*(tip - place)) * self._on.scale < TOGETHER for place in self._places):
            arrow(self._on, tail, tip, LOOKS["part"], self._on.style.second, gid)
            self._lines.append(np.array([tail, tip]))
        self._name(tip, text, gid, self._on.style.second)

    def _name(self, place: Float, text: str, gid: str, colour: str) -> None:
        for i, known_place in enumerate(self._places):
            if np.hypot(*(place - known_place)) * self._on.scale < TOGETHER:
                self._texts[i].append(text)
                return
        self._places.append(place)
        self._texts.append([text])
        self._gids.append(f"{gid} name")
        self._colours.append(colour)

    def _radius(self, place: Float) -> float:
        """Return the radius of the symbol at a place, points."""
        joints = self._subject.places(self._subject.frames[0])
        for name, joint in zip(self._subject.scene.names, joints, strict=True):
            if np.hypot(*(place - joint)) * self._on.scale < TOGETHER:
                return name.radius * self._on.size
        return DOT / 2.0 + 1.0

    def write(self) -> None:
        """Write the names of the centres and the numbers of the links."""
        texts = [_together(words) for words in self._texts]
        places, radii = [*self._places], [self._radius(place) for place in self._places]
        gids, colours = [*self._gids], [*self._colours]
        for link, number in self._numbers.items():
            joints = self._subject.whole.local[link]
            if link == "ground" or len(joints) < 2:
                continue
            frame = self._subject.frames[0][self._subject.scene.links.index(link)]
            middle = np.mean(list(joints.values())[: 2 if len(joints) == 2 else None], axis=0)
            cosine, sine = np.cos(frame[2]), np.sin(frame[2])
            places.append(frame[:2] + np.array([[cosine, -sine], [sine, cosine]]) @ middle)
            texts.append(str(number))
            radii.append(5.0 * self._on.size)
            gids.append(f"number {link}")
            colours.append(self._on.style.second)
        font = formula_font(10.5)
        write_names(
            self._on,
            texts,
            np.array(places).reshape(-1, 2),
            np.array(radii),
            self._lines,
            gids,
            font=font,
            colours=colours,
            sizes=[formula_size(text, font) for text in texts],
        )


def _together(names: list[str]) -> str:
    """Write the names of centres in one place."""
    shown = names if len(names) <= NAMED + 1 else names[:NAMED]
    text = ", ".join(f"$P_{{{name}}}$" for name in shown)
    return text if shown is names else f"{text} and {len(names) - NAMED} more"
