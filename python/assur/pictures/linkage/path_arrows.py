"""Velocities and accelerations of joints as arrows along their paths."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import finite_array
from assur.errors import InputError
from assur.pictures.vectors.arrows import path_vectors

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur._faces import Motion
    from assur.pictures.axes import Canvas

# Besides the position drawn; the longest arrow is this fraction of the mechanism's size.
ALONG, LONGEST = 12, 0.22
# Shorter vectors are not drawn: their scale would overflow.
LEAST = 1e-290


class PathArrows:
    """Arrows of one kind for all joints drawn, to one scale."""

    def __init__(
        self,
        motion: Motion,
        joints: Sequence[str],
        kind: str,
        speeds: tuple[Any, Any],
        row: int,
        size: float,
    ) -> None:
        order = 1 if kind == "velocity" else 2
        if motion.order < order:
            message = (
                f"vectors={kind!r} needs order {order}: this motion was solved to {motion.order}"
            )
            raise InputError(message)
        speed, acceleration = (
            finite_array(rate, name)
            for rate, name in zip(speeds, ("speed", "acceleration"), strict=True)
        )
        self._kind, self._joints = kind, list(joints)
        rows = np.unique([row, *range(0, len(motion.q), max(1, (len(motion.q) - 1) // ALONG))])
        self._here = rows == row
        self._points, self._vectors = [], []
        for name in joints:
            point = motion.joint(name)
            values = (
                point.velocity(speed) if order == 1 else point.acceleration(speed, acceleration)
            )
            if values.shape != point.value.shape:
                message = (
                    f"speed and acceleration give the shape {values.shape[:-1]}: a picture has one "
                    f"speed at each position {motion.shape}"
                )
                raise InputError(message)
            self._points.append(point.value[rows])
            self._vectors.append(values[rows])
        lengths = np.hypot(*np.moveaxis(np.array(self._vectors), -1, 0))
        longest = float(np.nanmax(lengths, initial=0.0))
        # Metres of the picture to a unit.
        self._scale = LONGEST * size / longest if longest > LEAST else 0.0

    def tips(self) -> list[Float]:
        """Return where the arrows end, m."""
        return [
            points + self._scale * vectors
            for points, vectors in zip(self._points, self._vectors, strict=True)
        ]

    def shafts(self) -> list[Float]:
        """Return the arrows' lines, m."""
        return [
            np.array(ends)
            for points, tips in zip(self._points, self.tips(), strict=True)
            for ends in zip(points, tips, strict=True)
        ]

    def draw(self, on: Canvas, lines: Sequence[Float], boxes: list[Float]) -> None:
        """Draw them; the values stand at the position that is drawn, clear of `boxes`."""
        scale = self._scale * on.scale
        for name, points, vectors in zip(self._joints, self._points, self._vectors, strict=True):
            gid = f"{self._kind} {name}"
            kind: Any = self._kind
            away, here = ~self._here, self._here
            gids = [gid] * int(away.sum())
            path_vectors(on, points[away], vectors[away], kind, gids, scale, texts=False)
            path_vectors(
                on,
                points[here],
                vectors[here],
                kind,
                [f"{gid} here"],
                scale,
                lines,
                names=[name] if len(self._joints) > 1 else [],
                boxes=boxes,
            )
