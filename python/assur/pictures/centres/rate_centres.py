"""Instant centres of all pairs of links, by the motion's derivatives; lines of Kennedy."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur.pictures.scene.geometry import unit_vector

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur._faces import Mechanism, Motion


class Centre(NamedTuple):
    """The instant centre of two links.

    Attributes
    ----------
    links : (str, str)
        In the order of the description.
    at : ndarray or None
        Where, m; None at infinity.
    direction : ndarray
        Of a centre at infinity, a unit vector.
    permanent : bool
        Whether the links have a joint or slide there.
    origin : ndarray
        A point of the pair from which the centre lies in that direction, m.
    """

    links: tuple[str, str]
    at: Float | None
    direction: Float
    permanent: bool
    origin: Float


def centres_of(motion: Motion, links: Sequence[str]) -> dict[frozenset[str], Centre]:
    """Return the instant centres of links at one position, except for pairs at relative rest."""
    centres = {}
    for first, second in combinations(links, 2):
        centre = _centre(motion, first, second)
        if centre is not None:
            centres[frozenset((first, second))] = centre
    return centres


def _centre(motion: Motion, link: str, base: str) -> Centre | None:
    mechanism = motion.mechanism
    joints = [joint for joint in mechanism.links[link] if joint in mechanism.links[base]]
    if joints:
        place = motion.joint(joints[0]).value
        return Centre((link, base), place, np.zeros(2), True, place)
    at = motion.instant_centre(link, base)
    sliding = _sliding(mechanism, link, base)
    if sliding is None and np.isfinite(at).all():
        return Centre((link, base), at, np.zeros(2), False, at)
    if sliding is None and np.isnan(at).all():
        return None
    # A translation: the centre is infinitely far across it.
    first, second = motion.reference_points[link], motion.reference_points[base]
    arm = first.value - second.value
    turn = motion.link(base).d1
    relative = first.d1 - second.d1 - turn * np.array([-arm[1], arm[0]])
    if sliding is not None:
        # A slide's direction is that of its guide, at rest too.
        guide_angle = float(mechanism.dimensions.get(f"{sliding}.angle", 0.0))
        angle = float(motion.link(mechanism.slides[sliding].on).value) + guide_angle
        relative = unit_vector(angle)
    length = float(np.hypot(*relative))
    if not length > 0.0:
        return None
    across = np.array([-relative[1], relative[0]]) / length
    origin = _sliding_point(motion, sliding) if sliding is not None else first.value
    return Centre((link, base), None, across, sliding is not None, origin)


def _sliding(mechanism: Mechanism, link: str, base: str) -> str | None:
    """Return the slide between two links."""
    for name, slide in mechanism.slides.items():
        if {slide.link, slide.on} == {link, base}:
            return name
    return None


def _sliding_point(motion: Motion, name: str) -> Float:
    link = motion.mechanism.slides[name].link
    joints = motion.mechanism.links[link]
    point: Float = (motion.joint(joints[0]) if joints else motion.reference_points[link]).value
    return point


def kennedy_lines(
    centres: dict[frozenset[str], Centre], links: Sequence[str]
) -> list[tuple[Centre, Centre, Centre]]:
    """Return for every centre that is not permanent up to two lines that give it.

    Each is the centre, then the two others on the line; permanent ones are preferred.
    """
    lines = []
    for pair, centre in centres.items():
        if centre.permanent or centre.at is None:
            continue
        of_centre = []
        for third in links:
            if third in pair:
                continue
            pair_centres = [centres.get(frozenset((link, third))) for link in centre.links]
            if None in pair_centres:
                continue
            of_centre.append((centre, *(known for known in pair_centres if known is not None)))
        of_centre.sort(key=lambda line: -sum(known.permanent for known in line[1:]))
        lines += [line for line in of_centre[:2] if len(line) == 3]
    return lines
