"""The arrays that a motion holds, by name: shaped at first access."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Float: TypeAlias = npt.NDArray[np.float64]


class Held(Mapping[str, tuple[Float, ...]]):
    """Arrays of joints, links or slides by name, one for each order, read-only.

    `flat` holds them as the core wrote them, by kind, index and order; with several
    `drivers` each order adds an axis.
    """

    def __init__(
        self,
        kind: str,
        indices: dict[str, int],
        flat: dict[tuple[str, int, int], Float],
        shape: tuple[int, ...],
        drivers: int,
        order: int,
    ) -> None:
        self._kind = kind
        self._indices = indices
        self._flat = flat
        self._shape = shape
        self._drivers = drivers
        self._order = order
        self._shaped: dict[str, tuple[Float, ...]] = {}

    def __getitem__(self, name: str) -> tuple[Float, ...]:
        shaped = self._shaped.get(name)
        if shaped is None:
            index = self._indices[name]
            shaped = tuple(self._array(index, order) for order in range(self._order + 1))
            self._shaped[name] = shaped
        return shaped

    def _array(self, index: int, order: int) -> Float:
        tail = (self._drivers,) * order if self._drivers > 1 else ()
        array = self._flat[self._kind, index, order].reshape(self._shape + tail)
        array.flags.writeable = False
        return array

    def __iter__(self) -> Iterator[str]:
        return iter(self._indices)

    def __len__(self) -> int:
        return len(self._indices)

    def __contains__(self, name: object) -> bool:
        return name in self._indices

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self.items()),)
