"""How the results of a mechanism follow from those of another description of it.

Each comparison returns what does not agree, as sentences; nothing is returned for what agrees.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import Status
from models.mechanisms.mechanism_data import arguments
from models.mechanisms.variants import KINDS
from oracles.kinematics.agreement import ANALOGUE, POSITION
from oracles.kinematics.variant_rounding import moved_drawings

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from models.mechanisms.mechanism_data import Description
    from models.mechanisms.variants import Variant

    Array = NDArray[np.float64]

# Both may be off by the law, and so is the drawing of the second, and what both have at it.
TERMS = 5.0
# From this condition on rounding decides whether a position is before or behind a fold.
BORDERLINE = 1e5


class Pairing:
    """A mechanism and another description of it."""

    def __init__(self, d: Description, one: assur.Mechanism, variant: Variant) -> None:
        self.d, self.variant, self.frame = d, variant, variant.frame
        self.one, self.two = one, assur.Mechanism(**arguments(variant.description))
        self.units = self.frame.units(d)
        start = np.atleast_1d(one.q0)
        self.drawn_q = start if variant.drawn is None else variant.drawn
        # Results of both at the second's drawing: the constants between them.
        self.at_first = one.solve(self.plain(self.drawn_q), order=1)
        self.at_second = self.two.solve(self.two.q0, order=0)
        self.drawn_condition = float(self.at_first.condition)
        self.rounded = TERMS * (self.drawn_condition if variant.drawn is not None else 1.0)
        self.turning = [kind == "angle" for kind, *_ in d.drivers]
        # A link half a turn on behind a gap has turned clockwise by convention, in a mirror too,
        # and which position it is counted from is the drawing's.
        self.counts_turns = variant.drawn is None and not self.frame.mirror

    def plain(self, q: Array) -> Any:
        """A coordinate as `solve` takes it."""
        return q if len(self.d.drivers) > 1 else float(q[0])

    def q(self, q: Any) -> Any:
        """The second's coordinate for one of the first; of one driver any array."""
        start = np.atleast_1d(self.two.q0)
        if len(self.d.drivers) == 1:
            return start[0] + self.units[0] * (np.asarray(q) - self.drawn_q[0])
        return start + self.units * (np.asarray(q) - self.drawn_q)

    def name(self, kind: str, name: str) -> str:
        return self.variant.names[kind][name]

    def grows(self, kind: str) -> float:
        """What values of a kind are multiplied by (joints: by the matrix)."""
        return self.frame.scale if kind == "slide" else self.frame.hand

    def value(self, kind: str, name: str, value: Any) -> Any:
        """The second's value of a link's angle or a slide."""
        first = float(getattr(self.at_first, kind)(name).value)
        second = float(getattr(self.at_second, kind)(self.name(kind, name)).value)
        return second + self.grows(kind) * (np.asarray(value) - first)

    # -- motions ------------------------------------------------------------------------------

    def motions(self, q: Array) -> Iterator[str]:
        """Statuses, values and analogues at coordinates of the first."""
        many = len(self.d.drivers) > 1
        order = 1 if many else 2
        a = self.one.solve(q, order=order, on_error="nan", threads=1)
        b = self.two.solve(self.q(q), order=order, on_error="nan", threads=1)
        there = [np.asarray(m.status) <= Status.SINGULAR for m in (a, b)]
        both = there[0] & there[1]
        for one, two, motion in ((there[0], there[1], a), (there[1], there[0], b)):
            lost = one & ~two & (np.asarray(motion.condition) < BORDERLINE)
            for i in np.flatnonzero(lost)[:1]:
                yield f"status at q = {q[i]!r}: {Status(a.status[i])!r}, {Status(b.status[i])!r}"
        regular = both & (np.asarray(a.status) == Status.OK) & (np.asarray(b.status) == Status.OK)
        if regular.any():
            yield from self._values(a, b, regular, order, q)

    def _values(
        self, a: assur.Motion, b: assur.Motion, rows: NDArray[np.bool_], order: int, q: Array
    ) -> Iterator[str]:
        kappa = np.maximum(a.condition, b.condition)[rows]
        size, arm = self._size(a, rows), self._arm()
        least = np.zeros(len(kappa))
        long = 1.0 if all(self.turning) else size
        for k in range(order + 1):
            own = np.zeros(len(kappa))
            worst: list[tuple[Array, str, str]] = []
            for kind in KINDS:
                for name in self.variant.names[kind]:
                    have, want, unit = self._both(a, b, rows, kind, name, k)
                    unit = arm if kind == "link" else unit
                    flat = (len(kappa), -1)
                    worst.append((unit * np.abs(have - want).reshape(flat).max(1), kind, name))
                    own = np.maximum(own, unit * np.abs(want).reshape(flat).max(1))
            if k:
                least = np.maximum(own, least / long)
            for error, kind, name in worst:
                # The constants between both come from the drawing, and are known as well as it is.
                known = kappa if kind == "joint" else np.maximum(kappa, self.drawn_condition)
                law = ANALOGUE * kappa**2 * least if k else POSITION * known * size
                law = self.rounded * self.frame.scale * law + 1e-300
                beyond = np.flatnonzero(~(error <= law))
                if not len(beyond):
                    continue
                at = q[np.flatnonzero(rows)[beyond]]
                unit = arm if kind == "link" else 1.0
                law = law[beyond] + unit * self._by_drawing(at, kind, name, k)
                for i in np.flatnonzero(~(error[beyond] <= law))[:1]:
                    text = f"off by {error[beyond][i]:.3g}, law {law[i]:.3g}"
                    yield f"order {k} of {kind} {name} at q = {at[i]!r}: {text}"
                    return

    def _by_drawing(self, q: Array, kind: str, name: str, k: int) -> Array:
        """How far rounding of the second's drawing moves a result, at coordinates of the first."""
        own, total = self._apart(q, kind, name, k), np.zeros(len(q))
        for variant, part in moved_drawings(self.variant):
            moved = Pairing(self.d, self.one, variant)._apart(q, kind, name, k)
            total += part * np.abs(moved - own).reshape(len(q), -1).max(1)
        return total

    def _apart(self, q: Array, kind: str, name: str, k: int) -> Array:
        a = self.one.solve(q, order=k, on_error="nan", threads=1)
        b = self.two.solve(self.q(q), order=k, on_error="nan", threads=1)
        have, want, _ = self._both(a, b, np.full(len(q), True), kind, name, k)
        return np.asarray(have - want)

    def _both(
        self, a: Any, b: Any, rows: Any, kind: str, name: str, k: int
    ) -> tuple[Array, Array, float]:
        """The second's values, and what they should be."""
        index = f"d{k}" if k else "value"
        x = getattr(getattr(a, kind)(name), index)[rows]
        y = getattr(getattr(b, kind)(self.name(kind, name)), index)[rows]
        if k:
            per = self.units if len(self.d.drivers) > 1 else self.units[0]
            y = y * per**k
        if kind == "joint":
            want = np.einsum("ij,nj...->ni...", self.frame.matrix, x)
            return y, (want + self.frame.shift if k == 0 else want), 1.0
        if k:
            return y, self.grows(kind) * x, 1.0
        want = self.value(kind, name, x)
        if kind == "link" and not self.counts_turns:
            want = want + math.tau * np.round((y - want) / math.tau)
        return y, want, 1.0

    def _size(self, a: assur.Motion, rows: Any) -> float:
        places = [np.abs(a.joint(n).value[rows]).max() for n in self.d.joints]
        slides = [np.abs(a.slide(n).value[rows]).max() for n in self.d.slides]
        drawn = [max(map(abs, place)) for place in self.d.joints.values()]
        shift = max(map(abs, self.frame.shift)) / self.frame.scale
        return 2.0 * float(max(*places, *drawn, shift, *slides, 1e-300))

    def _arm(self) -> float:
        arms = [
            math.dist(*(self.d.joints[j] for j in n[:2])) for n in self.d.links.values() if n[1:]
        ]
        return self.frame.scale * min(arms, default=1.0)
