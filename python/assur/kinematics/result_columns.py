"""The arrays that a motion holds, by name: shaped at first access."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Float: TypeAlias = npt.NDArray[np.float64]
# Arrays by name, one for each order.
Arrays: TypeAlias = Mapping[str, tuple[Float, ...]]
# Indices by name.
Names: TypeAlias = dict[str, int]


@dataclass(eq=False, slots=True)
class Buffers:
    """What the core wrote: an array for each column, or one for all of a small result; statuses.

    The core clears `complete` while it writes.
    """

    arrays: list[Float]
    status: npt.NDArray[np.uint8]
    complete: bool = True

    def column(self, index: int, first: int, count: int) -> Float:
        """Return a column: with one array for all, `count` numbers of it from the `first`."""
        if len(self.arrays) == 1:
            return self.arrays[0][first : first + count]
        return self.arrays[index]


@dataclass(eq=False, slots=True)
class Layout:
    """What the columns of a result are.

    The core writes those of joints, then of slides, then of links: for each, its orders in turn.
    With several drivers each order adds an axis.
    """

    joints: Names
    links: Names
    slides: Names
    # Axes of the designs, then of the positions.
    shape: tuple[int, ...]
    drivers: int
    order: int

    def numbers(self, order: int) -> int:
        """Return how many numbers a position has up to an order, for each component."""
        d = self.drivers
        if d == 1:
            return order + 1
        return sum([1, d, d * d, d * d * d][: order + 1])

    def held(self, kind: str, buffers: Buffers) -> Held:
        """Return the arrays of joints, slides or links."""
        joints, slides = len(self.joints), len(self.slides)
        if kind == "joint":
            return Held(self, buffers, self.joints, 2, (0, 0))
        if kind == "slide":
            return Held(self, buffers, self.slides, 1, (joints, 2 * joints))
        return Held(self, buffers, self.links, 1, (joints + slides, 2 * joints + slides))


class Held(Mapping[str, tuple[Float, ...]]):
    """Arrays of joints, links or slides by name, one for each order, read-only.

    Each has `width` components; `before` counts the others ahead of them, and their components.
    """

    def __init__(
        self, layout: Layout, buffers: Buffers, names: Names, width: int, before: tuple[int, int]
    ) -> None:
        self._layout = layout
        self._buffers = buffers
        self._names = names
        self._width = width
        self._before = before
        self._shaped: dict[str, tuple[Float, ...]] = {}

    def __getitem__(self, name: str) -> tuple[Float, ...]:
        shaped = self._shaped.get(name)
        if shaped is None:
            if name not in self._names:
                raise KeyError(name)
            place = [*self._names].index(name)
            orders = range(self._layout.order + 1)
            shaped = tuple([self._array(place, order) for order in orders])
            self._shaped[name] = shaped
        return shaped

    def columns(self) -> list[Float]:
        """Return all columns as the core wrote them."""
        orders = range(self._layout.order + 1)
        return [self._column(place, order) for place in range(len(self)) for order in orders]

    def _column(self, place: int, order: int) -> Float:
        layout, (things, components) = self._layout, self._before
        rows, each = self._buffers.status.size, layout.numbers(layout.order)
        below, upto = layout.numbers(order - 1), layout.numbers(order)
        first = (components + place * self._width) * each + self._width * below
        index = (things + place) * (layout.order + 1) + order
        return self._buffers.column(index, rows * first, rows * self._width * (upto - below))

    def _array(self, place: int, order: int) -> Float:
        layout = self._layout
        shape = (*layout.shape, 2) if self._width == 2 else layout.shape
        if layout.drivers > 1:
            shape += (layout.drivers,) * order
        array = self._column(place, order).reshape(shape)
        array.flags.writeable = False
        return array

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self.items()),)


class Results:
    """The arrays of a motion by name, one for each order; made at first access."""

    __slots__ = ("_held", "_layout", "buffers")

    def __init__(self, layout: Layout | None, buffers: Buffers | None) -> None:
        self._layout = layout
        # The same arrays as written by the core; None in a copy.
        self.buffers = buffers
        self._held: dict[str, Arrays] = {}

    @property
    def joints(self) -> Arrays:
        """Arrays of joints."""
        return self._of("joint")

    @property
    def links(self) -> Arrays:
        """Arrays of links."""
        return self._of("link")

    @property
    def slides(self) -> Arrays:
        """Arrays of slides."""
        return self._of("slide")

    def _of(self, kind: str) -> Arrays:
        held = self._held.get(kind)
        if held is None:
            assert self._layout is not None
            assert self.buffers is not None
            held = self._held[kind] = self._layout.held(kind, self.buffers)
        return held

    def columns(self) -> list[Float]:
        """Return all arrays as the core wrote them, in its order."""
        held = self.joints, self.slides, self.links
        return [column for of in held if isinstance(of, Held) for column in of.columns()]

    def each(self, change: Callable[[Float], Float]) -> Results:
        """Return every array changed, without buffers."""
        changed = Results(None, None)
        for kind in ("joint", "link", "slide"):
            held = self._of(kind)
            changed._held[kind] = {n: tuple(map(change, arrays)) for n, arrays in held.items()}
        return changed

    def without_buffers(self, copy: bool) -> Results:
        """Return the same arrays, or copies of them, that the core cannot overwrite."""
        bare = Results(None, None)
        for kind in ("joint", "link", "slide"):
            held = self._of(kind)
            if copy:
                held = {name: tuple(a.copy() for a in arrays) for name, arrays in held.items()}
            bare._held[kind] = held
        return bare
