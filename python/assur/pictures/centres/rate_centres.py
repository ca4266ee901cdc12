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
    """Return the instant centres of links at one position; none of pairs at relative rest."""
    found = {}
    for one, other in combinations(links, 2):
        centre = _centre(motion, one, other)
        if centre is not None:
            found[frozenset((one, other))] = centre
    return found


def _centre(motion: Motion, one: str, other: str) -> Centre | None:
    mechanism = motion.mechanism
    joints = [joint for joint in mechanism.links[one] if joint in mechanism.links[other]]
    if joints:
        place = motion.joint(joints[0]).value
        return Centre((one, other), place, np.zeros(2), True, place)
    at = motion.instant_centre(one, other)
    sliding = _sliding(mechanism, one, other)
    if sliding is None and np.isfinite(at).all():
        return Centre((one, other), at, np.zeros(2), False, at)
    if sliding is None and np.isnan(at).all():
        return None
    # A translation: the centre is infinitely far across it.
    first, second = motion.reference_points[one], motion.reference_points[other]
    arm = first.value - second.value
    turn = motion.link(other).d1
    relative = first.d1 - second.d1 - turn * np.array([-arm[1], arm[0]])
    if sliding is not None:
        # A slide's direction is that of its guide, at rest too.
        own = float(mechanism.dimensions.get(f"{sliding}.angle", 0.0))
        angle = float(motion.link(mechanism.slides[sliding].on).value) + own
        relative = unit_vector(angle)
    length = float(np.hypot(*relative))
    if not length > 0.0:
        return None
    across = np.array([-relative[1], relative[0]]) / length
    origin = _sliding_point(motion, sliding) if sliding is not None else first.value
    return Centre((one, other), None, across, sliding is not None, origin)


def _sliding(mechanism: Mechanism, one: str, other: str) -> str | None:
    """Return the slide between two links."""
    for name, slide in mechanism.slides.items():
        if {slide.link, slide.on} == {one, other}:
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
        own = []
        for third in links:
            if third in pair:
                continue
            others = [centres.get(frozenset((link, third))) for link in centre.links]
            if None in others:
                continue
            own.append((centre, *(other for other in others if other is not None)))
        own.sort(key=lambda line: -sum(other.permanent for other in line[1:]))
        lines += [line for line in own[:2] if len(line) == 3]
    return lines
