"""Colours of pictures: one palette on white paper, one on a dark canvas."""

from __future__ import annotations

from dataclasses import dataclass

from assur._arrays import flag


@dataclass(frozen=True)
class Style:
    """Colours by their meaning, as ``#rrggbb``.

    Attributes
    ----------
    canvas, ink, second, faint, grid : str
        The ground of the picture, links and text, lesser text, other positions, lines of a grid.
    driver, path, velocity, acceleration, force, error : str
        What they are called; `error` is also for dead points.
    groups : tuple of str
        Assur groups in solving order, repeated beyond the last.
    """

    canvas: str
    ink: str
    second: str
    faint: str
    grid: str
    driver: str
    path: str
    velocity: str
    acceleration: str
    force: str
    error: str
    groups: tuple[str, ...]

    def group(self, number: int) -> str:
        """Return the colour of a group."""
        return self.groups[number % len(self.groups)]


LIGHT = Style(
    canvas="#FFFFFF",
    ink="#17202A",
    second="#55616D",
    faint="#C4CCD4",
    grid="#DDE2E7",
    driver="#1D5FB8",
    path="#0E94A4",
    velocity="#0E4A2A",
    acceleration="#5E1A73",
    force="#B5820F",
    error="#BE4230",
    groups=("#8B4A9C", "#B0641A", "#3A7D44", "#B8336A", "#6A6A1E", "#4B5FA8"),
)

DARK = Style(
    canvas="#0F1419",
    ink="#E9EEF3",
    second="#A3AFBA",
    faint="#46525E",
    grid="#2A333C",
    driver="#3F8CFF",
    path="#9BE9FF",
    velocity="#79BF98",
    acceleration="#C183B8",
    force="#F7CC2A",
    error="#F0714B",
    groups=("#C183B8", "#E59A4C", "#79BF98", "#F08BAF", "#C9C25A", "#93A8F0"),
)


def style_of(dark: bool) -> Style:
    """Return the colours for a dark canvas, or for paper."""
    return DARK if flag(dark, "dark") else LIGHT


def blend(colour: str, canvas: str, part: float) -> tuple[float, float, float]:
    """Return a colour mixed with the canvas, opaque: pictures stay small, and print."""
    mixed = [
        part * int(colour[i : i + 2], 16) / 255.0
        + (1.0 - part) * int(canvas[i : i + 2], 16) / 255.0
        for i in (1, 3, 5)
    ]
    return mixed[0], mixed[1], mixed[2]
