"""Names in plans of velocities and accelerations: images, points of guides, the heading."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.numerals import number
from assur.pictures.vectors.heading import link_numbers, listed, place_text

if TYPE_CHECKING:
    from assur._faces import Motion
    from assur.pictures.plans.plan import Plan


def numbered(point: str, link: int) -> str:
    """Return the name of a link's point that coincides with a point of another link."""
    return f"{point}{link}" if len(point) == 1 and point.isalpha() else f"{point}({link})"


def point_names(plan: Plan, numbers: dict[str, int]) -> dict[str, str]:
    """Return the names of points in subscripts; points of guides have the link's number."""
    return {
        point: numbered(plan.under[point].point, numbers[plan.under[point].guide])
        if point in plan.under
        else point
        for point in plan.images
    }


def image_names(plan: Plan, numbers: dict[str, int]) -> dict[str, str]:
    """Return the names of images: small letters, unless two points differ by that alone."""
    names = point_names(plan, numbers)
    lower = {point: name.lower() for point, name in names.items()}
    return lower if len(set(lower.values())) == len(names) else names


def pole_name(images: dict[str, str], fixed: frozenset[str]) -> str:
    """Return the name of the pole, which no image of a moving point has."""
    taken = {name for point, name in images.items() if point not in fixed}
    return next(name for name in ("o", "π", "pole") if name not in taken)


def heading(position: Motion, plan: Plan, what: str, speed: Any, acceleration: Any) -> list[str]:
    """Return the lines above a plan: what it is, at which position and speed."""
    noun = {"velocity": "velocities", "acceleration": "accelerations"}[what]
    mechanism = position.mechanism
    drivers = mechanism.description.drivers
    angles = [driver not in mechanism.slides for driver in drivers]
    parts = [place_text(position), _rates("ω", speed, angles, "/s")]
    if what == "acceleration" and np.any(np.asarray(acceleration)):
        parts.append(_rates("α", acceleration, angles, "/s²"))
    numbers = link_numbers(mechanism)
    images = image_names(plan, numbers)
    legend = [
        f"{images[name]} is the image of the point of {under.guide} at {under.point}"
        for name, under in plan.under.items()
    ]
    return [f"Plan of {noun}", ", ".join(parts), *legend]


def _rates(letter: str, values: Any, angles: list[bool], per: str) -> str:
    rates = np.broadcast_to(np.asarray(values, dtype=np.float64), (len(angles),))
    texts = [
        f"{number(float(rate))} {'rad' if is_angle else 'm'}{per}"
        for rate, is_angle in zip(rates, angles, strict=True)
    ]
    return f"{letter if all(angles) else {'ω': 'q̇', 'α': 'q̈'}[letter]} = {listed(texts)}"
