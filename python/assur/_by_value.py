"""Equality by value for frozen dataclasses that hold arrays."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

__all__ = ["ByValue", "key_of"]


def key_of(value: Any) -> Any:
    """Return the key by which a value is compared: for arrays their shapes and numbers."""
    if isinstance(value, np.ndarray):
        # Added to 0, −0 is 0: as numbers they are equal.
        return value.shape, (value + 0.0).tobytes()
    if type(value) is tuple:
        return tuple(map(key_of, value))
    # A number of NumPy would compare itself with the key of an array.
    return value.item() if isinstance(value, np.generic) else value


class ByValue:
    """Equal to what has the same type and the same fields; hashed alike.

    A frozen dataclass inherits it with ``eq=False``: its own comparison would compare arrays.
    Fields with ``compare=False`` do not enter it.
    """

    __slots__ = ()

    def _key(self) -> tuple[Any, ...]:
        instance: Any = self
        return tuple(
            key_of(getattr(self, field.name)) for field in fields(instance) if field.compare
        )

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        assert isinstance(other, ByValue)
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash((type(self), self._key()))
