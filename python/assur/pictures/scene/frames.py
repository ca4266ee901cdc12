"""Frames of the links over a motion: where each is, and how it is turned."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur._faces import Motion

# Joints farther from the middle of the drawing than this multiple of its size are out of sight.
FAR = 4.0


@dataclass(frozen=True, eq=False)
class Frames:
    """Places of the links' frames over positions of one design.

    Attributes
    ----------
    links : tuple of str
        The links.
    values : tuple of ndarray
        (N, links, 3) with x, y in m and the angle in rad: the value, then derivatives by q.
    local : dict of str to dict of str to ndarray
        Coordinates of each link's joints in its frame, m.
    """

    links: tuple[str, ...]
    values: tuple[Float, ...]
    local: dict[str, dict[str, Float]]

    @property
    def is_known(self) -> npt.NDArray[np.bool_]:
        """Whether there is a position, (N,)."""
        return np.asarray(np.isfinite(self.values[0]).all(axis=(1, 2)))

    def world(self, link: str, point: Float | tuple[float, float]) -> Float:
        """Return a point of a link in the drawing's axes at every position, (N, 2)."""
        x, y, cosine, sine = self._axes(link)
        px, py = point
        placed: Float = np.empty((len(x), 2))
        placed[:, 0] = x + cosine * px - sine * py
        placed[:, 1] = y + sine * px + cosine * py
        return placed

    def seen_from(self, link: str, points: Float) -> Float:
        """Return points of the drawing's axes, one at each position, in a link's frame."""
        x, y, cosine, sine = self._axes(link)
        dx, dy = points[:, 0] - x, points[:, 1] - y
        return np.stack([cosine * dx + sine * dy, cosine * dy - sine * dx], axis=-1)

    def _axes(self, link: str) -> tuple[Float, Float, Float, Float]:
        """Return the origin of a link's frame, and the direction of its x axis."""
        i = self.links.index(link)
        x, y, _ = self.values[0][:, i].T
        cosines, sines = self._directions
        return x, y, cosines[:, i], sines[:, i]

    @cached_property
    def _directions(self) -> tuple[Float, Float]:
        angles = self.values[0][:, :, 2]
        return np.cos(angles), np.sin(angles)

    def angle(self, link: str) -> Float:
        """Return the angle of a link at every position, rad."""
        angles: Float = self.values[0][:, self.links.index(link), 2]
        return angles

    def joints(self) -> dict[str, Float]:
        """Return the path of every joint, (N, 2)."""
        return self._joints

    @cached_property
    def _joints(self) -> dict[str, Float]:
        last = {
            joint: (link, at) for link, joints in self.local.items() for joint, at in joints.items()
        }
        return {joint: self.world(link, at) for joint, (link, at) in last.items()}


def frames_of(motion: Motion) -> Frames:
    """Return the frames of all links of one design."""
    mechanism = motion.mechanism
    if mechanism.shape:
        message = f"a batch of designs {mechanism.shape} is not drawn: take one with design(i)"
        raise InputError(message)
    links = tuple(mechanism.links)
    # Derivatives by several coordinates are not of frames along a motion.
    orders = motion.order + 1 if mechanism.driver_count == 1 else 1
    values = tuple(np.zeros((motion.status.size, len(links), 3)) for _ in range(orders))
    for i, (link, joints) in enumerate(mechanism.links.items()):
        # The ground's frame is the drawing's.
        if link == "ground":
            continue
        # A link's frame is at its first joint; without one it takes another solution.
        origin = motion.joint(joints[0]) if joints else motion.reference_points[link]
        angle = motion.link(link)
        for columns, place, turned in zip(values, origin.arrays, angle.arrays, strict=False):
            columns[:, i, :2] = place.reshape(-1, 2)
            columns[:, i, 2] = turned.reshape(-1)
    frames = Frames(links, values, {})
    known = np.flatnonzero(frames.is_known)
    if not known.size:
        message = f"there is no position to draw: {motion.explain(() if not motion.shape else 0)}"
        raise InputError(message)
    # Links are rigid: one position shows where their joints are.
    row = int(known[0])
    places = {joint: motion.joint(joint).value.reshape(-1, 2)[row] for joint in mechanism.joints}
    for i, (link, joints) in enumerate(mechanism.links.items()):
        frames.local[link] = _local(values[0][row, i], {joint: places[joint] for joint in joints})
    return frames


def _local(frame: Float, places: dict[str, Float]) -> dict[str, Float]:
    """Return places of the drawing's axes in a frame."""
    if not places:
        return {}
    cosine, sine = np.cos(frame[2]), np.sin(frame[2])
    away = np.array(list(places.values())) - frame[:2]
    return dict(zip(places, away @ np.array([[cosine, -sine], [sine, cosine]]), strict=True))


def nearby(whole: Frames, at: Frames, drawing: Float) -> Frames:
    """Return the positions of both; from the whole motion only those near the drawing's joints.

    Where a joint goes toward infinity no picture can follow.
    """
    centre = drawing.mean(axis=0)
    reach = FAR * float(np.abs(drawing - centre).max())
    paths = np.stack(list(whole.joints().values()), axis=1)
    with np.errstate(invalid="ignore"):
        near = whole.is_known & (np.abs(paths - centre) <= reach).all(axis=(1, 2))
    values = np.concatenate([whole.values[0][near], at.values[0][at.is_known]])
    return Frames(whole.links, (values,), at.local)
