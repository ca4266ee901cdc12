"""The Jacobian of all pairs and drivers from positions of joints and directions of guides.

Every moving link has a velocity at the ground's first joint and an angular velocity; every pair
and driver is a row or two.  Lengths are in parts of the drawing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from models.mechanisms.mechanism_data import GROUND

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from models.mechanisms.mechanism_data import Description


def jacobian(
    description: Description, joints: Mapping[str, Any], along: Mapping[str, Any]
) -> NDArray[np.float64]:
    """Places and unit vectors as complex arrays of one shape; the result adds two axes to it."""
    index = {n: i for i, n in enumerate(n for n in description.links if n != GROUND)}
    fixed = description.links[GROUND]
    base = complex(*description.joints[fixed[0]]) if fixed else 0j
    unit = max(abs(complex(*p) - base) for p in description.joints.values())
    at = {n: (np.asarray(p) - base) / unit for n, p in joints.items()}
    shape = np.broadcast_shapes(*(p.shape for p in at.values()))
    rows: list[NDArray[np.float64]] = []

    def relative(a: str, b: str, direction: Any, place: Any = 0.0, turning: float = 0.0) -> None:
        """A row: velocity of `a` relative to `b` at a point along a direction, and its rotation."""
        out = np.zeros((*shape, 3 * len(index)))
        lever = np.imag(np.conj(place) * direction) + turning
        for link, sign in ((a, 1.0), (b, -1.0)):
            if link != GROUND:
                k = 3 * index[link]
                out[..., k] = sign * np.real(direction)
                out[..., k + 1] = sign * np.imag(direction)
                out[..., k + 2] = sign * lever
        rows.append(out)

    def guide(name: str, direction: Any) -> None:
        """Along or across a guide; any point of it serves, because the links turn together."""
        slide = description.slides[name]
        own = description.links[slide.link]
        place = at[own[0]] if own else at[str(slide.origin)]
        relative(slide.link, slide.on, direction, place)

    for joint, place in at.items():
        first, *others = [n for n, own in description.links.items() if joint in own]
        for other in others:
            relative(first, other, 1.0, place)
            relative(first, other, 1j, place)
    for name, slide in description.slides.items():
        relative(slide.link, slide.on, 0.0, turning=1.0)
        guide(name, 1j * np.asarray(along[name]))
    for kind, name, *on in description.drivers:
        if kind == "angle":
            relative(name, on[0] if on else GROUND, 0.0, turning=1.0)
        else:
            guide(name, np.asarray(along[name]))
    return np.stack(rows, axis=-2)


def regularity(description: Description, overconstrained: bool = False) -> float:
    """The least singular value at the drawing; 0 without as many rows as unknowns (or more)."""
    joints = {n: complex(*p) for n, p in description.joints.items()}
    along = {n: np.exp(1j * s.angle) for n, s in description.slides.items()}
    rows = jacobian(description, joints, along)
    if rows.shape[0] < rows.shape[1] or (rows.shape[0] > rows.shape[1] and not overconstrained):
        return 0.0
    return float(np.linalg.svd(rows, compute_uv=False)[-1])
