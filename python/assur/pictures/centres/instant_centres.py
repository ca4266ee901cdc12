"""All instant centres on the mechanism: see `assur.pictures.instant_centres`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur._arrays import flag
from assur._validate import checked_index, checked_names, require_one_driver
from assur.errors import InputError
from assur.pictures.axes import scale_bar
from assur.pictures.centres.marks import CentreMarks
from assur.pictures.centres.rate_centres import centres_of, kennedy_lines
from assur.pictures.linkage.position import draw_position
from assur.pictures.linkage.refine import checked_motion
from assur.pictures.linkage.subject import Subject
from assur.pictures.style import style_of
from assur.pictures.vectors.heading import LINE_HEIGHT, link_numbers, wrapped, write_heading

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur._faces import Motion


# Centres farther from the mechanism than this multiple of its size are shown at the border.
SIGHT = 0.75
# Kennedy's lines are drawn by default for up to this many links.
FEW = 6
# A legend of more letters may need two lines.
LONG = 60


def instant_centres(
    motion: Motion,
    *,
    at: int | tuple[int, ...] = (),
    links: Sequence[str] | None = None,
    lines: bool | None = None,
    ax: Axes | None = None,
    dark: bool = False,
) -> Axes:
    """Draw the instant centres of all pairs of links on the mechanism (needs matplotlib).

    Links are numbered, the ground is 1; P24 is the centre of links 2 and 4, about which one turns
    relative to the other. By the theorem of Aronhold and Kennedy the three centres of three links
    lie on a line.

    Parameters
    ----------
    motion : Motion
        Of one design and one driver.
    at : int or tuple of int
        Index of the position into its shape.
    links : sequence of str, optional
        Only the centres of these; all by default.
    lines : bool, optional
        Whether to draw lines of Kennedy, two through each centre that is not a joint; by default
        for up to six links.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Light lines on a dark ground.

    Returns
    -------
    matplotlib.axes.Axes
        The axes drawn on. A centre is named ``centre crank coupler``, one out of sight
        ``centre crank coupler beyond``: an arrow at the border points to it.

    Raises
    ------
    InputError
        An unknown link, several drivers, a position without analogues.

    Examples
    --------
    >>> import assur
    >>> from assur.pictures import instant_centres
    >>> axes = instant_centres(assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0))
    >>> sum(artist.get_gid() == "centre ground coupler" for artist in axes.lines)
    1
    """
    motion = checked_motion(motion)
    require_one_driver(motion.driver_count, "instant_centres")
    index = checked_index(at, motion.shape, "at")
    position = motion[index] if index else motion
    chosen = _checked_links(position, links)
    subject = Subject(position)
    if not all(np.isfinite(position.link(link).d1) for link in chosen):
        message = f"no instant centres: {position.explain()}"
        raise InputError(message)
    centres = centres_of(position, chosen)
    seen = {
        pair: centre
        for pair, centre in centres.items()
        if centre.at is not None and subject.sees(centre.at, SIGHT).all()
    }
    numbers = link_numbers(position.mechanism)
    points = [centre.at for centre in seen.values()]
    around = np.array(points, dtype=np.float64).reshape(-1, 2)
    ordered = sorted(chosen, key=numbers.__getitem__)
    legend = ", ".join(f"{numbers[link]} {link}" for link in ordered)
    head = LINE_HEIGHT * (2 if len(legend) < LONG else 3)
    on = subject.canvas(ax, style_of(dark), [around], head)
    draw_position(subject, on, subject.frames[0], names=False)
    drawing = CentreMarks(subject, on, numbers, head)
    if flag(lines, "lines") if lines is not None else len(chosen) <= FEW:
        for line in kennedy_lines(centres, chosen):
            if frozenset(line[0].links) in seen:
                drawing.kennedy(line)
    for centre in centres.values():
        drawing.centre(centre)
    drawing.write()
    write_heading(on, ["Instant centres", *wrapped(on, legend)])
    scale_bar(on)
    return on.ax


def _checked_links(position: Motion, links: Sequence[str] | None) -> list[str]:
    known = list(position.mechanism.links)
    if links is None:
        return known
    chosen = checked_names(links, "links")
    for link in chosen:
        position.mechanism.core.index_of("link", link)
    if len(set(chosen)) < 2:
        message = f"links is {chosen}: instant centres need two links"
        raise InputError(message)
    return [link for link in known if link in chosen]
